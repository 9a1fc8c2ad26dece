#include "pipelines/accuracy/along_curve.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "contact/contact_force.hpp"
#include "contact/phase.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/effects/effect_sizes.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/curve_load.hpp"
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

/// Amplitudes of harmonic k of the points [m].
Eigen::VectorXd amplitudes(const Eigen::MatrixXd& motion, int k) {
  return (motion.col(2 * k - 1).cwiseAbs2() + motion.col(2 * k).cwiseAbs2()).cwiseSqrt();
}

/// Which of the motion of a point changes its load.
enum class Part { all, mean };

/// |mean| + Σ_k amplitude of harmonic k, or the first of it alone.
Eigen::VectorXd largest_motion(const Eigen::MatrixXd& motion, Part part) {
  Eigen::VectorXd most = motion.col(0).cwiseAbs();
  for (int k = 1; part == Part::all && 2 * k < motion.cols(); ++k) most += amplitudes(motion, k);
  return most;
}

/// k_v times that over the load at rest, of the point where it is largest.
double load_change(const ReducedModel& model, const contact::ContactForce& contact,
                   const contact::Harmonics& q, Part part) {
  double largest = 0.0;
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    const contact::PatchSamples& cells = model.patches[k].cells;
    if (cells.shapes.v.size() == 0) continue;
    const Eigen::VectorXd most = largest_motion(motion_of(cells.shapes.v, q), part);
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

/// Σ_k kω amplitude of the fastest point [m/s].
double fastest(const contact::ModalShapes& shapes, const solver::ResponsePoint& point) {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(shapes.u.rows());
  for (const Eigen::MatrixXd* shape : {&shapes.u, &shapes.w}) {
    if (shape->size() == 0) continue;
    const Eigen::MatrixXd motion = motion_of(*shape, point.q);
    Eigen::VectorXd speed = Eigen::VectorXd::Zero(motion.rows());
    for (int k = 1; k <= point.q.n_harmonics(); ++k) {
      speed += k * point.frequency * amplitudes(motion, k);
    }
    square += speed.cwiseAbs2();
  }
  return std::sqrt(square.maxCoeff());
}

double coefficient_change(const ReducedModel& model,
                          const std::vector<contact::SurfaceRules>& rules,
                          const solver::ResponsePoint& point) {
  double most = 0.0;
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    const auto& law = rules[k].friction;
    if (!law) continue;
    const double value = law->at(fastest(model.patches[k].cells.shapes, point)).value;
    most = std::max(most, ratio(std::abs(value - law->at_rest()), law->at_rest()));
  }
  return most;
}

/// What all points together carry at least [N]. @param at_rest  [N].
double least_load(const ReducedModel& model, double at_rest, const contact::Harmonics& q) {
  double most = 0.0;
  for (const contact::Patch& patch : model.patches) {
    const contact::PatchSamples& cells = patch.cells;
    if (!model.effects.normal_motion || cells.shapes.v.size() == 0) continue;
    const Eigen::RowVectorXd force = cells.weights.cwiseProduct(cells.stiffness.col(1)).transpose();
    most += largest_motion(force * motion_of(cells.shapes.v, q), Part::all)[0];
  }
  return std::max(0.0, at_rest - most);
}

/// Motion that the force of an order drives in the free structure.
double driven(const ReducedModel& model, const contact::Harmonics& force, int k, double frequency) {
  const Eigen::ArrayXd square = model.frequency.array().square() - std::pow(k * frequency, 2);
  const Eigen::ArrayXd damping =
      2.0 * model.damping_ratio.array() * model.frequency.array() * k * frequency;
  const Eigen::ArrayXd size = (force.sine(k).array().square() + force.cosine(k).array().square());
  return std::sqrt((size.transpose() / (square.square() + damping.square()).transpose()).sum());
}

/// The largest of the orders that are left out, over the motion of the first.
class DrivenHarmonics {
 public:
  DrivenHarmonics(const ReducedModel& model, double load)
      : model_(model),
        force_(contact::ContactForce(model.patches, with_more(model.effects), load).modal_force()),
        work_(force_->workspace()) {}

  double operator()(const solver::ResponsePoint& point) const {
    const contact::Harmonics force =
        force_->evaluate(point.q, point.frequency, {.n_harmonics = highest}, *work_).force;
    double most = 0.0;
    for (int k = 2; k <= highest; ++k) {
      most = std::max(most, driven(model_, force, k, point.frequency));
    }
    return ratio(most, std::hypot(point.q.sine().norm(), point.q.cosine().norm()));
  }

 private:
  static constexpr int highest = 9;
  static contact::ContactEffects with_more(contact::ContactEffects effects) {
    effects.n_harmonics = highest;
    return effects;
  }

  const ReducedModel& model_;
  std::unique_ptr<contact::ModalForce> force_;
  std::unique_ptr<contact::ModalForce::Workspace> work_;
};

using Indicator = std::function<double(const solver::ResponsePoint&)>;

/// Of a motion under a load. Empty: of no effect that is looked at.
/// @param with  the model that has the effect; nullptr: there is none.
Indicator indicator_of(std::string_view effect, const ReducedModel& model,
                       const SceneDescription& scene, const ReducedModel* with, double load) {
  using Point = solver::ResponsePoint;
  if (effect == "second_direction") {
    return [&model](const Point& point) { return ratio_along_r(model, point.q); };
  }
  if (effect == "higher_harmonics") {
    return [driven = std::make_shared<DrivenHarmonics>(model, load)](const Point& point) {
      return (*driven)(point);
    };
  }
  if (effect == "rate_dependence") {
    return [&model, rules = surface_rules(as_written(scene))](const Point& point) {
      return coefficient_change(model, rules, point);
    };
  }
  const bool varies = setting_of(scene, "normal_motion") != "off";
  if (effect == "moments" && with != nullptr && load > 0.0 && varies) {
    return [with, load](const Point& point) {
      const Eigen::VectorXcd motion = point.q.sine().transpose() +
                                      std::complex<double>(0.0, 1.0) * point.q.cosine().transpose();
      return turning_size(*with, load, motion);
    };
  }
  const contact::ContactForce contact(model.patches, {}, load);  // for its loads at rest
  if (effect == "roughness" && load > 0.0) {
    const double stiffness = roughness_height(scene) * total_normal_stiffness(model);
    return [&model, stiffness, at_rest = contact.at_rest().carried](const Point& point) {
      return ratio(stiffness, least_load(model, at_rest, point.q));
    };
  }
  if (effect != "normal_motion" && effect != "separation" && effect != "mean_coupling") return {};
  const Part part = effect == "mean_coupling" ? Part::mean : Part::all;
  return [&model, contact, part](const Point& point) {
    return load_change(model, contact, point.q, part);
  };
}

/// What no model puts back: separation that is "off", harmonics above the first.
std::vector<std::string> without_model(const ReducedModel& model, const SceneDescription& scene,
                                       const solver::ResponseCurve& curve) {
  std::vector<std::string> names;
  if (model.effects.normal_motion && setting_of(scene, "separation") == "off") {
    names.emplace_back("separation");
  }
  const bool first_alone = std::ranges::all_of(
      curve.points, [](const solver::ResponsePoint& point) { return point.q.n_harmonics() == 1; });
  if (first_alone && !model.patches.empty()) names.emplace_back("higher_harmonics");
  return names;
}

}  // namespace

std::vector<IndicatorOfCurve> indicators_along(const ReducedModel& simulated,
                                               const SceneDescription& scene,
                                               const std::vector<RicherModel>& others,
                                               const CurveResult& result) {
  const ReducedModel model = model_of(simulated, result.curve);
  const auto* load = std::get_if<double>(&result.load);
  if (load == nullptr || result.integrated) return {};
  std::vector<IndicatorOfCurve> all;
  const auto add = [&](const std::string& effect, const ReducedModel* with) {
    const Indicator indicator = indicator_of(effect, model, scene, with, *load);
    if (!indicator) return;
    Eigen::VectorXd at(std::ssize(result.curve.points));
    std::ranges::transform(result.curve.points, at.begin(), indicator);
    all.push_back({effect, std::move(at)});
  };
  for (const RicherModel& other : others) add(other.source, &other.model);
  for (const std::string& effect : without_model(model, scene, result.curve)) add(effect, nullptr);
  return all;
}

ErrorRow largest_along(const IndicatorOfCurve& indicator, const CurveResult& result) {
  ErrorRow row{result.name, largest_indicator_goal, indicator.effect,
               0.0,         ErrorKind::estimated,   0.0};
  for (Eigen::Index i = 0; i < indicator.at.size(); ++i) {
    if (!(indicator.at[i] > row.effect)) continue;
    row.effect = indicator.at[i];
    row.where_hz = result.curve.points[static_cast<std::size_t>(i)].frequency / contact::two_pi;
  }
  return row;
}

}  // namespace microslip::pipelines
