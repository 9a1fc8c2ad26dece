#include "pipelines/effects/effect_indicators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "contact/contact_force.hpp"
#include "contact/dense.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/model/linear_limits.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr int n_trial_frequencies = 21;

/// 0 of nothing is nothing.
double ratio(double part, double whole) {
  if (part == 0.0) return 0.0;
  return whole > 0.0 ? part / whole : unlimited;
}

struct Range {
  double low, high;  // [rad/s]
  [[nodiscard]] bool has(double frequency) const { return frequency >= low && frequency <= high; }
};

Range range_of(const SceneDescription& scene) {
  const auto [low, high] =
      std::minmax(scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  return {2.0 * std::numbers::pi * low, 2.0 * std::numbers::pi * high};
}

struct Limit {
  bool stuck;
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd resonances;
};

std::vector<Limit> limits_of(const ReducedModel& model) {
  const Eigen::Index n = model.frequency.size();
  std::vector<Limit> limits{{false, Eigen::MatrixXd::Zero(n, n), {}},
                            {true, stuck_stiffness(model), {}}};
  for (Limit& limit : limits) limit.resonances = resonances(model, limit.stiffness);
  return limits;
}

std::vector<double> frequencies_in(const Range& range, const Limit& limit) {
  std::set<double> all;
  for (int i = 0; i < n_trial_frequencies; ++i) {
    all.insert(range.low + (range.high - range.low) * i / (n_trial_frequencies - 1));
  }
  for (const double resonance : limit.resonances) {
    if (range.has(resonance)) all.insert(resonance);
  }
  return {all.begin(), all.end()};
}

/// Resonances outside the range that contact bends into it on the way to the other limit.
std::vector<double> frequencies_near(const Range& range, const std::vector<Limit>& limits,
                                     const Limit& limit) {
  constexpr double margin = 0.02;  // damping and excitation move a peak a little
  std::vector<double> near;
  const auto n = std::min(limits[0].resonances.size(), limits[1].resonances.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto [from, to] = std::minmax(limits[0].resonances[i], limits[1].resonances[i]);
    const bool meets = (1.0 - margin) * from <= range.high && (1.0 + margin) * to >= range.low;
    if (meets && !range.has(limit.resonances[i])) near.push_back(limit.resonances[i]);
  }
  return near;
}

/// Amplitudes and means of the points of a patch along p, q, r [m], n × 3.
struct PointMotions {
  Eigen::MatrixX3d amplitude, mean;
};

/// Of all patches, at one frequency of a limit.
struct LimitMotion {
  bool stuck;
  bool in_range;
  double frequency;
  Eigen::VectorXcd q;
  std::vector<PointMotions> patches;
};

Eigen::VectorXd static_response(const ReducedModel& model, const Eigen::MatrixXd& stiffness) {
  const Eigen::Index n = model.frequency.size();
  if (model.force_static.isZero(0.0)) return Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd total = stiffness;
  total.diagonal() += model.frequency.array().square().matrix();
  return contact::solved(total, model.force_static);
}

PointMotions motions_of(const contact::PatchSamples& cells, const Eigen::VectorXcd& q,
                        const Eigen::VectorXd& mean) {
  PointMotions motions{Eigen::MatrixX3d::Zero(cells.size(), 3),
                       Eigen::MatrixX3d::Zero(cells.size(), 3)};
  int axis = 0;
  for (const Eigen::MatrixXd* shape : {&cells.shapes.u, &cells.shapes.v, &cells.shapes.w}) {
    if (shape->size() > 0) {
      motions.amplitude.col(axis) = (shape->cast<std::complex<double>>() * q).cwiseAbs();
      motions.mean.col(axis) = (*shape * mean).cwiseAbs();
    }
    ++axis;
  }
  return motions;
}

LimitMotion motion_at(const ReducedModel& model, const Limit& limit, double frequency,
                      bool in_range) {
  LimitMotion motion{
      limit.stuck, in_range, frequency, linear_response(model, limit.stiffness, frequency), {}};
  const Eigen::VectorXd mean = static_response(model, limit.stiffness);
  for (const contact::Patch& patch : model.patches) {
    motion.patches.push_back(motions_of(patch.cells, motion.q, mean));
  }
  return motion;
}

std::vector<LimitMotion> limit_motions(const ReducedModel& model, const SceneDescription& scene) {
  std::vector<LimitMotion> motions;
  const Range range = range_of(scene);
  const std::vector<Limit> limits = limits_of(model);
  for (const Limit& limit : limits) {
    for (const double frequency : frequencies_in(range, limit)) {
      motions.push_back(motion_at(model, limit, frequency, true));
    }
    for (const double frequency : frequencies_near(range, limits, limit)) {
      motions.push_back(motion_at(model, limit, frequency, false));
    }
  }
  return motions;
}

/// What one motion does at one point.
/// @param fallen  μ at speed, where it falls: a point that sticks may as well slip then.
void add_point(const contact::PatchSamples& cells, Eigen::Index i, double rest_load,
               const LimitMotion& motion, const PointMotions& at,
               const std::optional<double>& fallen, ContactReach& reach) {
  const Eigen::RowVector3d largest = at.amplitude.row(i) + at.mean.row(i);
  const Eigen::RowVector3d force = cells.stiffness.row(i).cwiseProduct(largest);
  // A limit without bound moves everything without bound.
  const bool bounded = force.allFinite();
  const double change = bounded ? force[1] : unlimited;
  const double load = ratio(change, std::abs(rest_load));
  const bool loaded = rest_load > 0.0;
  const double along = bounded ? std::hypot(force[0], force[2]) : unlimited;
  const auto over_held = [&](double friction) {
    return ratio(along, std::max(0.0, friction * (rest_load - change)));
  };
  const bool holds = motion.stuck && loaded && cells.has_friction(i);
  const auto add_nearby = [&](double size) {
    reach.nearby = std::max(reach.nearby, size);
    if (!motion.in_range) reach.outside = std::max(reach.outside, size);
  };
  if (holds && fallen) add_nearby(over_held(*fallen));
  if (motion.stuck == loaded) {
    add_nearby(load);
    if (motion.in_range && (load > 1.0 || !loaded)) reach.slip = std::max(reach.slip, load);
  }
  if (!motion.in_range) return;
  reach.load = std::max(reach.load, load);
  const double mean = cells.stiffness(i, 1) * at.mean(i, 1);
  const double drift = ratio(std::isfinite(mean) ? mean : unlimited, std::abs(rest_load));
  reach.bias_load = std::max(reach.bias_load, drift + std::max(0.0, load - 1.0));
  if (holds) reach.slip = std::max(reach.slip, over_held(cells.friction[i]));
}

/// μ at the highest speed of the limits, of each patch whose friction falls by as much as is told;
/// empty: it does not.
using FallenFriction = std::vector<std::optional<double>>;

FallenFriction fallen_friction(const ReducedModel& model, const SceneDescription& scene,
                               const std::vector<LimitMotion>& motions) {
  const std::vector<contact::SurfaceRules> rules = surface_rules(scene);
  FallenFriction fallen(model.patches.size());
  for (std::size_t k = 0; k < fallen.size(); ++k) {
    const auto& law = rules[k].friction;
    if (!law) continue;
    double fastest = 0.0;
    for (const LimitMotion& motion : motions) {
      const Eigen::MatrixX3d& amplitude = motion.patches[k].amplitude;
      const double largest = std::hypot(amplitude.col(0).maxCoeff(), amplitude.col(2).maxCoeff());
      constexpr double any = 1e300;  // [m/s]
      fastest = std::max(fastest, std::isfinite(largest) ? motion.frequency * largest : any);
    }
    const double there = law->at(fastest).value;
    constexpr double least = 0.99;  // of that at rest
    if (there < least * law->at_rest()) fallen[k] = there;
  }
  return fallen;
}

/// @param springs  the model whose springs act: without those along the normal no load varies.
ContactReach reach_under(const ReducedModel& model, const ReducedModel& springs,
                         const std::vector<LimitMotion>& motions, const FallenFriction& fallen,
                         double load) {
  ContactReach reach;
  const contact::ContactForce contact(model.patches, {}, load);
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    const contact::PatchSamples& cells = springs.patches[k].cells;
    const auto& points = contact.points(k);
    for (const LimitMotion& motion : motions) {
      for (Eigen::Index i = 0; i < cells.size(); ++i) {
        add_point(cells, i, points[static_cast<std::size_t>(i)].rest_load, motion,
                  motion.patches[k], fallen[k], reach);
      }
    }
  }
  return reach;
}

}  // namespace

std::vector<double> loads_of(const ReducedModel& model, const SceneDescription& scene) {
  std::vector<double> loads;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto asked = load_of(request, model);
    if (const auto* load = std::get_if<double>(&asked)) loads.push_back(*load);
  }
  const auto& optimum = scene.response->optimum;
  if (!optimum) return loads;
  if (!optimum->of_preload()) {
    const auto load = optimum->load ? optimum->load : model.static_preload;
    if (load) loads.push_back(*load);
  } else if (optimum->range) {
    loads.insert(loads.end(), optimum->range->begin(), optimum->range->end());
  }
  return loads;
}

namespace {

ContactReach larger(const ContactReach& a, const ContactReach& b) {
  return {std::max(a.slip, b.slip), std::max(a.load, b.load), std::max(a.bias_load, b.bias_load),
          std::max(a.nearby, b.nearby), std::max(a.outside, b.outside)};
}

/// A limit in its own modes, damping between them left out.
struct LimitModes {
  Eigen::VectorXd square;   ///< ω² [rad²/s²]
  Eigen::VectorXd damping;  ///< 2ζω [1/s]
  Eigen::VectorXd patch;    ///< motion of the patch squared, over its area [m²/kg]
};

LimitModes modes_of(const ReducedModel& model, const Limit& limit) {
  Eigen::MatrixXd total = limit.stiffness;
  total.diagonal() += model.frequency.array().square().matrix();
  const auto pairs = contact::symmetric_pairs(total);
  if (!pairs) return {};
  const Eigen::VectorXd damping = 2.0 * model.damping_ratio.cwiseProduct(model.frequency);
  LimitModes modes{pairs->values, pairs->vectors.cwiseAbs2().transpose() * damping,
                   Eigen::VectorXd::Zero(pairs->values.size())};
  for (const contact::Patch& patch : model.patches) {
    const contact::PatchSamples& cells = patch.cells;
    for (const Eigen::MatrixXd* shape : {&cells.shapes.u, &cells.shapes.v, &cells.shapes.w}) {
      if (shape->size() == 0) continue;
      modes.patch += (*shape * pairs->vectors).cwiseAbs2().transpose() * cells.weights;
    }
  }
  return modes;
}

/// Of the patch to a force on it: of the mode that answers most.
double answer(const LimitModes& modes, double frequency) {
  const auto dynamic = ((modes.square.array() - frequency * frequency).square() +
                        (modes.damping.array() * frequency).square())
                           .sqrt();
  return (modes.patch.array() / dynamic).maxCoeff();
}

/// Of the multiples of a frequency.
void add_answers(const LimitModes& modes, double frequency, HarmonicAnswer& most) {
  constexpr int highest = 30;  // as chosen harmonics, theory section 22
  const double at_first = answer(modes, frequency);
  for (int k = 2; k <= highest; ++k) {
    const double here = answer(modes, k * frequency) / at_first / (k * k);
    if (here > most.ratio) most = {here, k, k * frequency};
  }
}

/// Stuck frequencies of the first n modes [rad/s].
Eigen::VectorXd stuck_resonances(const ReducedModel& model, Eigen::Index n) {
  Eigen::MatrixXd total = stuck_stiffness(model);
  total.diagonal() += model.frequency.array().square().matrix();
  return contact::symmetric_eigenvalues(total.topLeftCorner(n, n))
      .value_or(Eigen::VectorXd())
      .cwiseMax(0.0)
      .cwiseSqrt();
}

double attachment_share(const ReducedModel& model, const SceneDescription& scene) {
  const Eigen::VectorXd with = stuck_resonances(model, model.frequency.size());
  const Eigen::VectorXd without =
      stuck_resonances(model, model.frequency.size() - model.n_attachment);
  if (with.size() == 0 || without.size() == 0) return unlimited;
  const Range range = scene.response ? range_of(scene) : Range{0.0, 0.0};
  Eigen::Index nearest = 0;
  (without.array() - 0.5 * (range.low + range.high)).abs().minCoeff(&nearest);
  return ratio(std::abs(without[nearest] - with[nearest]), with[nearest]);
}

/// The linear limits of a scene, under any of its loads. Where effects.normal_motion is "off" what
/// slips and what may coexist is that of constant loads; what is left out is told of varying ones.
class Reach {
 public:
  Reach(const ReducedModel& model, const SceneDescription& scene)
      : model_(model),
        motions_(limit_motions(model, scene)),
        fallen_(fallen_friction(model, scene, motions_)) {
    if (setting_of(scene, "normal_motion") != "off") return;
    constant_ = model;
    for (contact::Patch& patch : constant_->patches) patch.cells.stiffness.col(1).setZero();
    constant_motions_ = limit_motions(*constant_, scene);
  }

  [[nodiscard]] ContactReach under(double load) const {
    ContactReach reach = reach_under(model_, model_, motions_, fallen_, load);
    if (!constant_) return reach;
    const ContactReach constant = reach_under(model_, *constant_, constant_motions_, fallen_, load);
    reach.slip = constant.slip;
    reach.nearby = constant.nearby;
    reach.outside = constant.outside;
    return reach;
  }

 private:
  const ReducedModel& model_;
  std::vector<LimitMotion> motions_;
  FallenFriction fallen_;
  std::optional<ReducedModel> constant_;
  std::vector<LimitMotion> constant_motions_;
};

}  // namespace

ContactReach contact_reach(const ReducedModel& model, const SceneDescription& scene, double load) {
  return Reach(model, scene).under(load);
}

std::optional<ContactReach> contact_reach(const ReducedModel& model,
                                          const SceneDescription& scene) {
  if (!scene.response || model.patches.empty()) return std::nullopt;
  std::optional<ContactReach> most;
  try {
    const Reach reach(model, scene);
    for (const double load : loads_of(model, scene)) {
      most = larger(most.value_or(ContactReach{}), reach.under(load));
    }
  } catch (const contact::LoadError&) {
    // Refused where it is solved for, with a message of its own.
  } catch (const RefusedError&) {
    // A gap without normal stiffness, as above.
  }
  return most;
}

int n_linear_curves(const ReducedModel& model, const SceneDescription& scene) {
  const bool solved = setting_of(scene, "nonlinearity") == "on" || is_rough(scene);
  if (!scene.response || model.patches.empty() || solved) return 0;
  const Reach reach(model, scene);
  return static_cast<int>(std::ranges::count_if(curve_requests(scene), [&](const auto& request) {
    const auto asked = load_of(request, model);
    const auto* load = std::get_if<double>(&asked);
    try {
      return load != nullptr && reach.under(*load).slip < 1.0;
    } catch (const contact::LoadError&) {  // refused where it is solved for
      return false;
    } catch (const RefusedError&) {
      return false;
    }
  }));
}

double normal_energy_share(const ReducedModel& model, const SceneDescription& scene) {
  double most = 0.0;
  const Limit stuck = limits_of(model)[1];
  for (const double frequency : frequencies_in(range_of(scene), stuck)) {
    const LimitMotion motion = motion_at(model, stuck, frequency, true);
    double normal = 0.0;
    for (std::size_t k = 0; k < model.patches.size(); ++k) {
      const contact::PatchSamples& cells = model.patches[k].cells;
      normal += cells.weights.cwiseProduct(cells.stiffness.col(1))
                    .dot(motion.patches[k].amplitude.col(1).cwiseAbs2());
    }
    const double modes = model.frequency.cwiseAbs2().dot(motion.q.cwiseAbs2());
    const double springs = (motion.q.adjoint() * stuck.stiffness * motion.q).value().real();
    const double share = ratio(normal, modes + springs);
    most = std::max(most, std::isfinite(share) ? share : unlimited);
  }
  return most;
}

HarmonicAnswer harmonic_answer(const ReducedModel& model, const SceneDescription& scene) {
  const Range range = range_of(scene);
  const std::vector<Limit> limits = limits_of(model);
  HarmonicAnswer most;
  bool any = false;
  for (const Limit& limit : limits) {
    const LimitModes modes = modes_of(model, limit);
    for (const double resonance : limit.resonances) {
      if (!range.has(resonance) || modes.patch.size() == 0) continue;
      any = true;
      add_answers(modes, resonance, most);
    }
  }
  if (any) return most;
  const LimitModes free = modes_of(model, limits.front());
  for (const double end : {range.low, range.high}) {
    if (free.patch.size() > 0) add_answers(free, end, most);
  }
  return most;
}

double turning_force(const contact::Patch& patch, const Eigen::VectorXcd& q) {
  const contact::PatchSamples& cells = patch.cells;
  if (cells.shapes.v.size() == 0) return 0.0;
  const Eigen::VectorXcd load = (cells.weights.cwiseProduct(cells.stiffness.col(1))).asDiagonal() *
                                (cells.shapes.v.cast<std::complex<double>>() * q);
  const Eigen::RowVector3d middle = contact::centroid(patch).transpose();
  double most = 0.0;
  for (const Eigen::Index axis : {0, 2}) {
    const Eigen::VectorXd at =
        (cells.points.rowwise() - middle) * patch.frame.row(axis).transpose();
    const double half_size = 0.5 * (at.maxCoeff() - at.minCoeff());
    if (half_size > 0.0)
      most = std::max(most, std::abs(at.cast<std::complex<double>>().dot(load)) / half_size);
  }
  return most;
}

std::vector<double> turning_forces(const ReducedModel& model, const SceneDescription& scene) {
  std::vector<double> most(model.patches.size(), 0.0);
  for (const LimitMotion& motion : limit_motions(model, scene)) {
    if (!motion.stuck || !motion.in_range) continue;
    for (std::size_t k = 0; k < most.size(); ++k) {
      const double force = turning_force(model.patches[k], motion.q);
      most[k] = std::max(most[k], std::isfinite(force) ? force : unlimited);
    }
  }
  return most;
}

namespace {

/// Of a motion along a face.
struct Spread {
  double mean = 0.0;       ///< square of the mean over the area [m²]
  double variation = 0.0;  ///< mean square of what differs from it [m²]
  [[nodiscard]] double size() const { return mean + variation; }
};

Spread spread_of(const contact::PatchSamples& cells, const Eigen::VectorXcd& q) {
  const Eigen::VectorXd share = cells.weights / cells.weights.sum();
  Spread spread;
  for (const Eigen::MatrixXd* shape : {&cells.shapes.u, &cells.shapes.w}) {
    if (shape->size() == 0) continue;
    const Eigen::VectorXcd motion = shape->cast<std::complex<double>>() * q;
    const std::complex<double> mean = share.cast<std::complex<double>>().dot(motion);
    spread.mean += std::norm(mean);
    spread.variation += share.dot((motion.array() - mean).abs2().matrix());
  }
  return spread;
}

}  // namespace

double uneven_motion(const ReducedModel& model, const SceneDescription& scene) {
  double most = 0.0;
  const std::vector<LimitMotion> motions = limit_motions(model, scene);
  for (const contact::Patch& patch : model.patches) {
    std::array<Spread, 2> largest;  // of the limits
    for (const LimitMotion& motion : motions) {
      if (!motion.in_range || !motion.q.allFinite()) continue;
      const Spread spread = spread_of(patch.cells, motion.q);
      Spread& of_limit = largest[motion.stuck ? 1 : 0];
      if (spread.size() > of_limit.size()) of_limit = spread;
    }
    for (const Spread& spread : largest) {
      most = std::max(most, std::sqrt(ratio(spread.variation, 3.0 * spread.mean)));
    }
  }
  return most;
}

double friction_change(const ReducedModel& model, const SceneDescription& scene) {
  double most = 0.0;
  const std::vector<contact::SurfaceRules> rules = surface_rules(as_written(scene));
  for (const LimitMotion& motion : limit_motions(model, scene)) {
    for (std::size_t k = 0; k < model.patches.size(); ++k) {
      const auto& law = rules[k].friction;
      if (!law) continue;
      const Eigen::MatrixX3d& amplitude = motion.patches[k].amplitude;
      const double speed =
          motion.frequency *
          (amplitude.col(0).cwiseAbs2() + amplitude.col(2).cwiseAbs2()).cwiseSqrt().maxCoeff();
      if (!std::isfinite(speed)) return unlimited;
      most = std::max(most, ratio(std::abs(law->at(speed).value - law->at_rest()), law->at_rest()));
    }
  }
  return most;
}

double residual_share(const ReducedModel& model, const SceneDescription& scene) {
  if (model.n_attachment > 0) return attachment_share(model, scene);
  double most = 0.0;
  for (const contact::Patch& patch : model.patches) {
    const contact::PatchSamples& cells = patch.cells;
    if (cells.compliance.rows() == 0) continue;
    most = std::max(
        most, cells.compliance.col(0).cwiseProduct(cells.stiffness.col(0)).cwiseAbs().maxCoeff());
  }
  return most;
}

}  // namespace microslip::pipelines
