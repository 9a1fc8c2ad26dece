#include "pipelines/accuracy/along_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

#include "contact/contact_force.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/sampled_curve.hpp"

namespace microslip::pipelines {
namespace {

double ratio(double part, double whole) {
  if (part == 0.0) return 0.0;
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::infinity();
}

/// Harmonics of the points of a patch, n_points × (2H+1).
Eigen::MatrixXd motion_of(const Eigen::MatrixXd& shape, const contact::Harmonics& q) {
  return shape * q.rows().transpose();
}

/// k_v (|mean| + Σ_k amplitude of harmonic k) over the load at rest, of the point where it is
/// largest.
double load_change(const ReducedModel& model, const contact::ContactForce& contact,
                   const contact::Harmonics& q) {
  double largest = 0.0;
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    const contact::PatchSamples& cells = model.patches[k].cells;
    if (cells.shapes.v.size() == 0) continue;
    const Eigen::MatrixXd v = motion_of(cells.shapes.v, q);
    Eigen::VectorXd most = v.col(0).cwiseAbs();
    for (int h = 1; h <= q.n_harmonics(); ++h) {
      most += (v.col(2 * h - 1).cwiseAbs2() + v.col(2 * h).cwiseAbs2()).cwiseSqrt();
    }
    for (Eigen::Index i = 0; i < cells.size(); ++i) {
      const double at_rest = contact.points(k)[static_cast<std::size_t>(i)].rest_load;
      largest = std::max(largest, ratio(cells.stiffness(i, 1) * most[i], std::abs(at_rest)));
    }
  }
  return largest;
}

/// Over the area of all patches, the mean left out.
double rms(const ReducedModel& model, Eigen::MatrixXd contact::ModalShapes::*shape,
           const contact::Harmonics& q) {
  double sum = 0.0;
  for (const contact::Patch& patch : model.patches) {
    const Eigen::MatrixXd& shapes = patch.cells.shapes.*shape;
    if (shapes.size() == 0) continue;
    const Eigen::MatrixXd motion = motion_of(shapes, q);
    sum += patch.cells.weights.dot(motion.rightCols(motion.cols() - 1).rowwise().squaredNorm());
  }
  return std::sqrt(sum);
}

double ratio_along_r(const ReducedModel& model, const contact::Harmonics& q) {
  return ratio(rms(model, &contact::ModalShapes::w, q), rms(model, &contact::ModalShapes::u, q));
}

/// Of all solution points. Empty: of no effect that is looked at.
std::optional<double> largest_indicator(std::string_view effect, const ReducedModel& model,
                                        double load, const solver::ResponseCurve& curve) {
  const auto largest = [&](const auto& indicator) {
    double most = 0.0;
    for (const solver::ResponsePoint& point : curve.points) {
      most = std::max(most, indicator(point.q));
    }
    return most;
  };
  if (effect == "second_direction") {
    return largest([&](const contact::Harmonics& q) { return ratio_along_r(model, q); });
  }
  if (effect != "normal_motion") return std::nullopt;
  const contact::ContactForce contact(model.patches, {}, load);  // for its loads at rest
  return largest([&](const contact::Harmonics& q) { return load_change(model, contact, q); });
}

}  // namespace

std::vector<ErrorRow> rows_along_curve(const ReducedModel& simulated,
                                       const std::vector<RicherModel>& others,
                                       const CurveResult& result) {
  const ReducedModel model = model_of(simulated, result.curve);
  const auto* load = std::get_if<double>(&result.load);
  if (load == nullptr || result.integrated) return {};
  std::vector<ErrorRow> rows;
  for (const RicherModel& other : others) {
    const auto most = largest_indicator(other.source, model, *load, result.curve);
    if (!most) continue;
    rows.push_back(
        {result.name, largest_indicator_goal, other.source, *most, ErrorKind::estimated, 0.0});
  }
  return rows;
}

}  // namespace microslip::pipelines
