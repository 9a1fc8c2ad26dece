#include "contact/force/linear_proof.hpp"

#include "contact/force/sleeping_points.hpp"
#include "contact/patch/point_motions.hpp"

namespace microslip::contact {

LinearState linear_state(const ContactPatch& patch, const ModalShapes& shapes,
                         const Harmonics& centre, double radius) {
  const std::vector<PointMotion> motions = point_motions(shapes, centre);
  bool stuck = true;
  bool open = true;
  for (std::size_t i = 0; i < motions.size() && (stuck || open); ++i) {
    const PointParameters& point = patch.points()[i];
    const auto row = static_cast<Eigen::Index>(i);
    const bool rubs = point.friction_coefficient > 0.0 && point.tangential_stiffness > 0.0;
    if (patch.weights()[row] == 0.0 || (!rubs && point.normal_stiffness == 0.0)) continue;
    const SleepProof proof =
        prove_asleep(point, motions[i], shapes.u.row(row).norm(), shapes.v.row(row).norm());
    const bool holds = proof.radius > radius;
    stuck = stuck && holds && proof.state == SleepState::stuck && point.preload >= 0.0;
    open = open && holds && proof.state == SleepState::open && point.preload <= 0.0;
  }
  if (stuck) return LinearState::stuck;
  return open ? LinearState::free : LinearState::unknown;
}

}  // namespace microslip::contact
