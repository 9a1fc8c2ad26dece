#include "pipelines/response/resonating_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace microslip::pipelines {

bool opens_and_closes(const solver::ResponseCurve& curve) {
  constexpr double seen = 1e-3;
  const auto [least, most] = std::ranges::minmax(
      curve.points, {}, [](const auto& point) { return point.report.separated_share; });
  const double open = most.report.separated_share;
  return open > seen && (curve.points.size() == 1 || open - least.report.separated_share > seen);
}

void tell_shapes_resonate(const Eigen::VectorXd& frequency, Eigen::Index n_attachment,
                          double highest, solver::ResponseCurve& curve) {
  if (n_attachment == 0 || curve.points.empty() || !opens_and_closes(curve)) return;
  const double top =
      std::ranges::max(curve.points, {}, &solver::ResponsePoint::frequency).frequency;
  const double order = std::floor(frequency.tail(n_attachment).minCoeff() / top);
  if (highest < order) return;
  if (!curve.message.empty()) curve.message += "; ";
  curve.message += fmt::format(
      "contact opens and closes, and harmonics from {:.0f} on meet resonances of attachment "
      "shapes, "
      "which no structure has: at a peak of the default blade they make 2 % (share/doc/theory.md, "
      "section 22); a larger modes.count moves them up",
      order);
}

void tell_unasked(int highest, int most, solver::ResponseCurve& curve) {
  if (highest >= most || curve.points.empty() || !opens_and_closes(curve)) return;
  if (!curve.message.empty()) curve.message += "; ";
  curve.message += fmt::format(
      "contact opens and closes, and harmonics above {} reach beyond the modes kept and were not "
      "asked: what they do, 1 % at a peak of the default blade, is in no bar; a larger modes.count "
      "asks them",
      highest);
}

}  // namespace microslip::pipelines
