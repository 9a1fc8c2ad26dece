#include "pipelines/response/sampled_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contact/contact_force.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "solver/sampled_walk.hpp"

namespace microslip::pipelines {
namespace {

using contact::most_instants;

int instants_of(const ReducedModel& model) {
  return contact::instants_of(model.patches, model.effects);
}

/// Forces are of third order.
bool is_plain(const ReducedModel& model) {
  return contact::are_plain(model.patches, model.effects);
}

Eigen::Index n_points(const ReducedModel& model) {
  Eigen::Index n = 0;
  for (const contact::Patch& patch : model.patches) n += patch.cells.size();
  return n;
}

/// Located events are as cheap as many instants along a line. In a plane they are ten times as dear
/// as 256, which the walk of a few points led by the errors of these is as well: of 12, 24, 48 and
/// 96 points that strike it took 8, 21, 19 and 12 s, with located events 26, 39, 83 and above 150.
bool can_be_located(const ReducedModel& model) {
  constexpr Eigen::Index most_points = 32;
  return !model.effects.second_direction || n_points(model) <= most_points;
}

/// Whether close folds and steps by the hundred are signs that errors lead the walk: those of many
/// points are less than such folds are apart. Of 60 plain points that strike two to ten folds of 24
/// are none, the peaks within 2e-4; blades of 63 to 570 have those of located events, some within
/// 1e-5, for a sixth of the time. Of 40 whose friction falls with the speed eight of ten are none.
bool can_be_led(const ReducedModel& model) {
  const Eigen::Index most_points = is_plain(model) ? 32 : 128;
  return can_be_located(model) && n_points(model) <= most_points;
}

/// From which on located events are as cheap.
int dearest_instants(const ReducedModel& model) {
  constexpr int of_others = 512;
  return is_plain(model) || model.effects.second_direction ? most_instants : of_others;
}

/// What sampled forces err by, told by those of half as many instants, or of twice as many where
/// half are fewer than harmonics need.
class SampledError {
 public:
  SampledError(const ReducedModel& model, double load)
      : plain_(is_plain(model)),
        force_(contact_of(model, load).modal_force()),
        work_(force_->workspace()),
        excitation_(std::hypot(model.force_sine.norm(), model.force_cosine.norm())) {
    ReducedModel other = model;
    const int least = 8 * (model.effects.n_harmonics + 1);  // contact/sampled/patch_force.hpp
    const int own = instants_of(model);
    finer_ = own / 2 < least;
    other.effects.doublings += finer_ ? 1 : -1;
    while (finer_ && instants_of(other) < std::min(2 * least, most_instants)) {
      ++other.effects.doublings;
    }
    other_force_ = contact_of(other, load).modal_force();
    other_work_ = other_force_->workspace();
  }

  /// Whether it is to be asked for at a point. Plain forces err where they stick for less than a
  /// few instants.
  [[nodiscard]] bool concerns(const solver::ResponsePoint& point) {
    constexpr std::size_t every = 3;
    constexpr double short_stick = 0.05;
    const double stick = point.report.stick_share;
    if (plain_ && !(stick > 0.0 && stick < short_stick)) return false;
    return ++count_ % every == 1 || point.mark != solver::PointMark::none;
  }

  /// Of the force, or of a tenth of the excitation where that is more.
  [[nodiscard]] double at(const solver::ResponsePoint& point) const {
    // Against located events over 36 random scenes, of the largest along a curve: 0.06 to 0.44 of
    // what half of 256 instants change or more of them, up to 1.4 of what twice as many do.
    const double share = finer_ ? 1.4 : 0.45;
    constexpr double least_force = 0.1;
    const auto force = [&](const contact::ModalForce& of, contact::ModalForce::Workspace& work) {
      return of.evaluate(point.q, point.frequency, {}, work).force;
    };
    const contact::Harmonics own = force(*force_, *work_);
    const double change = (force(*other_force_, *other_work_).rows() - own.rows()).norm();
    return share * change / std::max(own.rows().norm(), least_force * excitation_);
  }

 private:
  bool plain_;
  bool finer_ = false;
  std::unique_ptr<contact::ModalForce> force_, other_force_;
  std::unique_ptr<contact::ModalForce::Workspace> work_, other_work_;
  double excitation_;  // [N/√kg]
  std::size_t count_ = 0;
};

/// Sticks, for about as long as from one instant to the next.
bool sticks_shortly(const solver::ResponsePoint& point) {
  constexpr double share = 0.03;
  return point.report.stick_share > 0.0 && point.report.stick_share < share;
}

/// Points that stick shortly and take so many evaluations, one after the other,
/// that noise must be what cuts their steps.
class DearPoints {
 public:
  void add(const solver::ResponsePoint& point) {
    constexpr std::size_t in_a_row = 40;
    constexpr long usual = 30;  // six, or twelve among many folds
    evaluations_.push_back(sticks_shortly(point) ? point.contact_evaluations : 0);
    sum_ += evaluations_.back();
    if (evaluations_.size() <= in_a_row) return;
    sum_ -= evaluations_[evaluations_.size() - 1 - in_a_row];
    met_ = met_ || sum_ > usual * static_cast<long>(in_a_row);
  }
  [[nodiscard]] bool met() const { return met_; }

 private:
  std::vector<long> evaluations_;
  long sum_ = 0;  // of the last
  bool met_ = false;
};

/// A branch of such points that did not reach its end, or whose peaks and folds cannot be found; of
/// forces that are not plain and can be located, any such branch.
bool walked_on_noise(const solver::ResponseCurve& curve, bool any) {
  using solver::Diagnosis;
  if (!any && std::ranges::none_of(curve.points, sticks_shortly)) return false;
  constexpr std::array ends{Diagnosis::out_of_range, Diagnosis::unbounded, Diagnosis::interrupted};
  if (!curve.complete) return std::ranges::find(ends, curve.diagnosis) == ends.end();
  constexpr auto most_unsolved = 2;
  return std::ranges::count_if(curve.log, [](const solver::SolverEvent& event) {
           return event.remedy == solver::Remedy::peak_unsolved ||
                  event.remedy == solver::Remedy::fold_unsolved;
         }) > most_unsolved;
}

bool has_left_out(const solver::ResponseCurve& curve) {
  return !curve.complete && std::ranges::find(curve.log, solver::Remedy::row_left_out,
                                              &solver::SolverEvent::remedy) != curve.log.end();
}

/// Whether errors of sampled forces lead the walk along a curve, asked on the way and after.
class Noise {
 public:
  explicit Noise(const ReducedModel& model)
      : led_(can_be_led(model)), any_(can_be_located(model) && !is_plain(model)) {}

  void add(const solver::ResponsePoint& point) {
    dear_.add(point);
    walk_.add(point);
  }
  [[nodiscard]] bool met() const { return dear_.met() || (led_ && walk_.is_led_by_errors()); }
  [[nodiscard]] bool met(const solver::ResponseCurve& curve) const {
    return met() || walked_on_noise(curve, any_) || has_left_out(curve) ||
           (led_ && std::ranges::any_of(curve.detached, [](const auto& branch) {
              return solver::is_led_by_errors(branch.points);
            }));
  }

 private:
  bool led_;
  bool any_;
  DearPoints dear_;
  solver::SampledWalk walk_;
};

/// A curve as it was traced, and what its forces err by.
struct Tracing {
  solver::ResponseCurve curve;
  double error = 0.0;  ///< largest that was met
  bool noisy = false;
  int instants = 0;
};

/// Whether nothing closer is left to trace a curve with.
bool is_last(const ReducedModel& model) {
  if (model.effects.located) return true;
  return !can_be_located(model) && instants_of(model) >= most_instants;
}

/// Ended where it is to be traced again, with what is closer.
Tracing checked_tracing(const ReducedModel& model, double load,
                        const solver::ContinuationOptions& options,
                        const solver::PointObserver& observe) {
  const double tolerance = model.effects.force_tolerance;
  Tracing result;
  result.instants = instants_of(model);
  Noise noise(model);
  const bool last = is_last(model);
  const bool sampled = contact::is_sampled(model.patches, model.effects);
  std::unique_ptr<SampledError> error;
  if (sampled) error = std::make_unique<SampledError>(model, load);
  const auto judge = [&](const solver::ResponsePoint& point) {
    if (!error) return;
    noise.add(point);
    if (error->concerns(point)) result.error = std::max(result.error, error->at(point));
  };
  if (options.frequency_begin == options.frequency_end) {
    result.curve = solver::solve_at_frequency(balanced_scene(model, load, options),
                                              options.frequency_begin, options);
    for (const solver::ResponsePoint& point : result.curve.points) judge(point);
    result.noisy = sampled && has_left_out(result.curve);
    return result;
  }
  solver::ContinuationOptions leaving = with_search_scene(options, model, load);
  leaving.leave_sampled_walks = sampled && can_be_led(model);
  result.curve = solver::trace_response(
      balanced_scene(model, load, options), leaving, [&](const solver::ResponsePoint& point) {
        judge(point);
        return (last || (result.error <= tolerance && !noise.met())) && observe(point);
      });
  result.noisy = sampled && noise.met(result.curve);
  return result;
}

/// Gives a model as many doublings as the order of forces asks for; located events, where they
/// are as cheap or the walk was led by errors.
/// @return what was done.
std::vector<solver::Remedy> refined(ReducedModel& model, double error, bool noisy) {
  const double order = is_plain(model) ? 3.0 : 2.0;
  const double ratio = std::max(error / model.effects.force_tolerance, 1.0);
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(ratio) / order)));
  const bool dear = instants_of(model) << doublings > dearest_instants(model);
  if (can_be_located(model) && (noisy || dear)) {
    model.effects.located = true;
    return {solver::Remedy::located_events};
  }
  std::vector<solver::Remedy> done;
  for (int i = 0; i < doublings && instants_of(model) < most_instants; ++i) {
    ++model.effects.doublings;
    done.push_back(solver::Remedy::more_instants);
  }
  return done;
}

/// What was spent on a curve that is given up.
void add_cost(const solver::ResponseCurve& given_up, solver::ResponseCurve& curve) {
  curve.contact_evaluations += given_up.contact_evaluations;
  curve.iterations += given_up.iterations;
  curve.seconds += given_up.seconds;
}

double last_place(const solver::ResponseCurve& curve, const solver::ContinuationOptions& options) {
  return curve.points.empty() ? options.frequency_begin : curve.points.back().frequency;
}

/// Whether less is known by a curve traced with more: no end, where there was one, or cut short.
bool is_less(const solver::ResponseCurve& next, const solver::ResponseCurve& before, bool stopped) {
  if (next.complete) return false;
  return before.complete || (stopped && next.points.size() < before.points.size());
}

void tell_error(Tracing& tracing) {
  tracing.curve.message +=
      fmt::format("{}contact forces sampled {} times a period err by some {:.0e}",
                  tracing.curve.message.empty() ? "" : "; ", tracing.instants, tracing.error);
}

}  // namespace

solver::ResponseCurve sampled_curve(const ReducedModel& given, const SceneDescription& scene,
                                    double load, const solver::ContinuationOptions& options,
                                    const solver::PointObserver& observe) {
  const double tolerance = given.effects.force_tolerance;
  ReducedModel model = given;
  Tracing kept = checked_tracing(model, load, options, observe);
  double error = kept.error;
  bool noisy = kept.noisy;
  double place = last_place(kept.curve, options);
  std::vector<solver::SolverEvent> log;
  while ((error > tolerance || noisy) && !is_last(model) && !options.stop()) {
    for (const solver::Remedy remedy : refined(model, error, noisy)) log.push_back({place, remedy});
    solver::ContinuationOptions again = continuation_options(scene, model);
    again.search_starts = options.search_starts;
    again.near_begin = options.near_begin;
    again.stop = options.stop;
    Tracing next =
        checked_tracing(model, load, again, [&](const auto&) { return !options.stop(); });
    error = next.error;
    noisy = next.noisy;
    place = last_place(next.curve, options);
    if (is_less(next.curve, kept.curve, options.stop())) {
      add_cost(next.curve, kept.curve);
      continue;
    }
    add_cost(kept.curve, next.curve);
    next.curve.log.insert(next.curve.log.begin(), log.begin(), log.end());
    kept = std::move(next);
  }
  if (kept.error > tolerance) tell_error(kept);
  return std::move(kept.curve);
}

ReducedModel model_of(ReducedModel model, const solver::ResponseCurve& curve) {
  for (const solver::SolverEvent& event : curve.log) {
    if (event.remedy == solver::Remedy::located_events) model.effects.located = true;
    if (event.remedy == solver::Remedy::more_instants) ++model.effects.doublings;
  }
  return model;
}

}  // namespace microslip::pipelines
