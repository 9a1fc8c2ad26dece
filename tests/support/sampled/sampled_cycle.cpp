#include "tests/support/sampled/sampled_cycle.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/support/sampled/sampled_force.hpp"
#include "tests/support/sampled/sampled_history.hpp"
#include "tests/support/sampled/sampled_motion.hpp"
#include "tests/support/sampled/sampled_slider.hpp"

namespace microslip::contact {
namespace {

// Storage of one thread, so that an evaluation allocates little once it has grown.
struct Workshop {
  SampledMotion motion;
  SampledSlider slider;
  SampledForce force;
};

Workshop& workshop() {
  thread_local Workshop shop;
  return shop;
}

void check_harmonics(int n_harmonics, int n_samples, int factor) {
  if (factor * n_harmonics >= n_samples) {
    throw std::invalid_argument("SampledLaw: " + std::to_string(n_harmonics) + " harmonics from " +
                                std::to_string(n_samples) + " samples; more than " +
                                std::to_string(factor * n_harmonics) + " are needed");
  }
}

}  // namespace

SampledLaw::SampledLaw(const SurfaceLaw& law, int n_samples) : law_(law), n_samples_(n_samples) {
  if (n_samples < 8) {
    throw std::invalid_argument("SampledLaw: " + std::to_string(n_samples) +
                                " samples; at least 8 are needed");
  }
}

void SampledLaw::traction(const Harmonics& motion, double frequency, PointTraction& result) const {
  const int n_harmonics = motion.n_harmonics();
  check_harmonics(n_harmonics, n_samples_, 4);
  const SampleGrid& grid = sample_grid(n_samples_, 2 * n_harmonics);
  Workshop& shop = workshop();
  shop.motion.set(law_, motion, frequency, grid);
  shop.slider.march(shop.motion);
  shop.force.traction(shop.motion, shop.slider, grid, n_harmonics, result);
}

PointHistory SampledLaw::history(const Harmonics& motion, double frequency,
                                 const Eigen::VectorXd& phases, int n_harmonics) const {
  check_harmonics(motion.n_harmonics(), n_samples_, 4);
  check_harmonics(n_harmonics, n_samples_, 2);
  const SampleGrid& grid = sample_grid(n_samples_, std::max(2 * motion.n_harmonics(), n_harmonics));
  Workshop& shop = workshop();
  shop.motion.set(law_, motion, frequency, grid);
  shop.slider.march(shop.motion);
  const bool has_spring = law_.first_stiffness() > 0.0;
  PointHistory history;
  history.regime = shop.slider.regime();
  history.segments = sampled_segments(shop.motion, shop.slider, has_spring);
  history.force = shop.force.force(shop.motion, shop.slider, grid, n_harmonics);
  if (has_spring) {
    const SampledWork work = sampled_work(shop.motion, shop.slider);
    history.dissipated_energy = work.dissipated_energy;
    history.slip_distance = work.slip_distance;
    history.normal_slip = work.normal_slip;
  }
  history.instants.reserve(static_cast<std::size_t>(phases.size()));
  for (const double phase : phases) {
    history.instants.push_back(sampled_instant(law_, motion, shop.motion, shop.slider, phase));
  }
  return history;
}

Eigen::Vector3d SampledLaw::stuck_stiffness() const {
  const SurfaceState rest = law_.at(0.0, 0.0);
  const double k_u =
      rest.friction_coefficient > 0.0 ? law_.first_stiffness() * rest.stiffness_ratio : 0.0;
  const double k_v = law_.is_smooth() ? law_.point().normal_stiffness : rest.load_by_approach;
  return {k_u, k_v, 0.0};
}

std::optional<LinearRange> SampledLaw::linear_range() const {
  std::optional<LinearRange> range = law_.linear_range();
  if (range.has_value()) range->stiffness[2] = 0.0;
  return range;
}

double SampledLaw::load_at_rest() const { return law_.load_at_rest(); }

}  // namespace microslip::contact
