#include "solver/balance/first_harmonics.hpp"

#include <utility>
#include <vector>

namespace microslip::solver {

HarmonicSet least_harmonics(const Scene& scene) {
  std::vector<int> orders{1};
  for (int k = 1; k <= scene.excitation.n_harmonics(); ++k) {
    const bool excited =
        scene.excitation.sine(k).norm() > 0.0 || scene.excitation.cosine(k).norm() > 0.0;
    if (excited) orders.push_back(k);
  }
  return HarmonicSet(std::move(orders));
}

HarmonicSet first_harmonics(const Scene& scene, const ContinuationOptions& options) {
  if (options.harmonic_tolerance > 0.0) return least_harmonics(scene);
  if (options.orders.empty()) return {options.n_harmonics};
  using enum HarmonicSet::Mean;
  return HarmonicSet(options.orders, options.without_mean ? left_out : unknown);
}

}  // namespace microslip::solver
