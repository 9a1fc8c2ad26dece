#include "contact/force/any_harmonics_force.hpp"

#include <memory>
#include <vector>

#include "contact/line/event_law.hpp"

namespace microslip::contact {
namespace {

std::vector<std::shared_ptr<const PointLaw>> event_laws(const ContactPatch& patch) {
  std::vector<std::shared_ptr<const PointLaw>> laws;
  laws.reserve(patch.points().size());
  for (const PointParameters& point : patch.points()) {
    laws.push_back(std::make_shared<EventLaw>(point));
  }
  return laws;
}

ModalShapes without_second_direction(ModalShapes shapes) {
  shapes.w.resize(0, 0);
  return shapes;
}

}  // namespace

AnyHarmonicsForce::AnyHarmonicsForce(const ContactPatch& patch, const ModalShapes& shapes)
    : closed_(patch, shapes),
      events_(patch.weights(), event_laws(patch), without_second_direction(shapes)) {}

ForceAndJacobian AnyHarmonicsForce::evaluate(const Harmonics& q, double frequency) const {
  return q.n_harmonics() == 1 ? closed_.evaluate(q, frequency) : events_.evaluate(q, frequency);
}

ForceAndJacobian AnyHarmonicsForce::evaluate_rows(const Harmonics& q, double frequency,
                                                  const std::vector<Eigen::Index>& rows) const {
  return q.n_harmonics() == 1 ? closed_.evaluate_rows(q, frequency, rows)
                              : events_.evaluate_rows(q, frequency, rows);
}

Harmonics AnyHarmonicsForce::force_up_to(const Harmonics& q, double frequency,
                                         int n_harmonics) const {
  return events_.force_up_to(q, frequency, n_harmonics);
}

CycleReport AnyHarmonicsForce::report(const Harmonics& q, double frequency) const {
  return q.n_harmonics() == 1 ? closed_.report(q, frequency) : events_.report(q, frequency);
}

void AnyHarmonicsForce::states(const Harmonics& q, double frequency, ContactStates& result) const {
  if (q.n_harmonics() == 1) {
    closed_.states(q, frequency, result);
  } else {
    events_.states(q, frequency, result);
  }
}

Eigen::MatrixXd AnyHarmonicsForce::stuck_stiffness() const { return closed_.stuck_stiffness(); }

LinearState AnyHarmonicsForce::linear_state(const Harmonics& centre, double radius) const {
  return centre.n_harmonics() == 1 ? closed_.linear_state(centre, radius)
                                   : events_.linear_state(centre, radius);
}

}  // namespace microslip::contact
