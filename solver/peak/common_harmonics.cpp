#include "solver/peak/common_harmonics.hpp"

#include <algorithm>

#include "solver/harmonics/harmonic_choice.hpp"
#include "solver/branch/start_point.hpp"

namespace microslip::solver {

ContinuationOptions with_common_harmonics(const SceneFamily& family,
                                          const std::vector<double>& values,
                                          const ContinuationOptions& range) {
  if (!(range.harmonic_tolerance > 0.0)) return range;
  HarmonicSet set(1);
  for (const double value : values) {
    const Scene scene = family(value);
    set = set.united(first_harmonics(scene, range).orders());
    const std::vector<ResponsePoint> points = trace_response(scene, range).points;
    const auto largest = std::max_element(
        points.begin(), points.end(),
        [](const ResponsePoint& a, const ResponsePoint& b) { return a.amplitude < b.amplitude; });
    for (auto point = points.begin(); point != points.end(); ++point) {
      if (point == largest || point->mark == PointMark::peak) set = set.united(point->orders);
    }
  }
  ContinuationOptions common = range;
  common.harmonic_tolerance = 0.0;
  common.n_harmonics = set.highest();
  common.orders = set.orders();
  return common;
}

double left_out_at(const Scene& scene, const ResponsePoint& peak, const ContinuationOptions& range) {
  const HarmonicChoice choice(scene, range.harmonic_tolerance, range.n_harmonics);
  const HarmonicBalance balance(scene, HarmonicSet(peak.orders));
  const Eigen::VectorXd x = balance.unknowns(peak.q);
  Scaling scaling = natural_scaling(balance, x, peak.frequency);
  scaling.parameter = 0.1 * peak.frequency;  // the widest a resonance is
  const auto tangent = null_vector(balance.evaluate(x, peak.frequency), scaling, 1.0);
  const BranchVector hold{Eigen::VectorXd::Zero(x.size()), 1.0};
  return choice.enlarged(balance, {x, peak.frequency}, tangent.value_or(hold), scaling).missing;
}

}  // namespace microslip::solver
