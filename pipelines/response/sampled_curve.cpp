#include "pipelines/response/sampled_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contact/contact_force.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/response/response_stage.hpp"

namespace microslip::pipelines {
namespace {

constexpr int most_instants = 2048;

bool is_along_a_line(const ReducedModel& model) {
  return !model.effects.second_direction &&
         std::ranges::all_of(model.patches,
                             [](const contact::Patch& patch) { return patch.rules.plain(); });
}

/// What sampled forces err by, told by those of half as many instants, or of twice as many where
/// half are fewer than harmonics need.
class SampledError {
 public:
  SampledError(const ReducedModel& model, double load)
      : along_a_line_(is_along_a_line(model)),
        force_(contact_of(model, load).modal_force()),
        work_(force_->workspace()),
        excitation_(std::hypot(model.force_sine.norm(), model.force_cosine.norm())) {
    ReducedModel other = model;
    const int least = 8 * (model.effects.n_harmonics + 1);  // contact/sampled/patch_force.hpp
    const int own = contact::instants_of(model.patches, model.effects);
    finer_ = own / 2 < least;
    other.effects.doublings += finer_ ? 1 : -1;
    while (finer_ && contact::instants_of(other.patches, other.effects) / 2 < least) {
      ++other.effects.doublings;
    }
    other_force_ = contact_of(other, load).modal_force();
    other_work_ = other_force_->workspace();
  }

  /// Whether it is to be asked for at a point. Along a line forces err where they stick for less
  /// than a few instants.
  [[nodiscard]] bool concerns(const solver::ResponsePoint& point) {
    constexpr std::size_t every = 3;
    constexpr double short_stick = 0.05;
    const double stick = point.report.stick_share;
    if (along_a_line_ && !(stick > 0.0 && stick < short_stick)) return false;
    return ++count_ % every == 1 || point.mark != solver::PointMark::none;
  }

  /// Of the force, or of a tenth of the excitation where that is more.
  [[nodiscard]] double at(const solver::ResponsePoint& point) const {
    // Measured against located events over random scenes: at most 0.38 of what half as many change,
    // at most 1.2 of what twice as many do.
    const double share = finer_ ? 1.3 : 0.4;
    constexpr double least_force = 0.1;
    const auto force = [&](const contact::ModalForce& of, contact::ModalForce::Workspace& work) {
      return of.evaluate(point.q, point.frequency, {}, work).force;
    };
    const contact::Harmonics own = force(*force_, *work_);
    const double change = (force(*other_force_, *other_work_).rows() - own.rows()).norm();
    return share * change / std::max(own.rows().norm(), least_force * excitation_);
  }

 private:
  bool along_a_line_;
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

/// A branch of such points that did not reach its end, or whose peaks and folds cannot be found.
bool walked_on_noise(const solver::ResponseCurve& curve) {
  using solver::Diagnosis;
  if (std::ranges::none_of(curve.points, sticks_shortly)) return false;
  constexpr std::array ends{Diagnosis::out_of_range, Diagnosis::unbounded, Diagnosis::interrupted};
  if (!curve.complete) return std::ranges::find(ends, curve.diagnosis) == ends.end();
  constexpr auto most_unsolved = 2;
  return std::ranges::count_if(curve.log, [](const solver::SolverEvent& event) {
           return event.remedy == solver::Remedy::peak_unsolved ||
                  event.remedy == solver::Remedy::fold_unsolved;
         }) > most_unsolved;
}

/// A curve as it was traced, and what its forces err by.
struct Tracing {
  solver::ResponseCurve curve;
  double error = 0.0;  ///< largest that was met
  bool noisy = false;
};

/// @param given_up  the error that ends the tracing.
Tracing traced(const ReducedModel& model, double load, const solver::ContinuationOptions& options,
               double given_up, const solver::PointObserver& observe) {
  Tracing result;
  DearPoints dear;
  const bool sampled = contact::is_sampled(model.patches, model.effects);
  std::unique_ptr<SampledError> error;
  if (sampled) error = std::make_unique<SampledError>(model, load);
  const auto judge = [&](const solver::ResponsePoint& point) {
    if (!error) return;
    dear.add(point);
    if (error->concerns(point)) result.error = std::max(result.error, error->at(point));
  };
  if (options.frequency_begin == options.frequency_end) {
    result.curve = solver::solve_at_frequency(balanced_scene(model, load, options),
                                              options.frequency_begin, options);
    for (const solver::ResponsePoint& point : result.curve.points) judge(point);
    return result;
  }
  result.curve = solver::trace_response(
      balanced_scene(model, load, options), options, [&](const solver::ResponsePoint& point) {
        judge(point);
        return result.error <= given_up && !dear.met() && observe(point);
      });
  result.noisy = sampled && (dear.met() || walked_on_noise(result.curve));
  return result;
}

/// Gives a model as many doublings as the order of forces asks for; along a line located events,
/// where they are as cheap as the most instants.
/// @return what was done.
std::vector<solver::Remedy> refined(ReducedModel& model, const Tracing& tracing, double tolerance) {
  const bool line = is_along_a_line(model);
  const double order = line ? 3.0 : 2.0;
  const double ratio = std::max(tracing.error / tolerance, 1.0);
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(ratio) / order)));
  const auto instants = [&] { return contact::instants_of(model.patches, model.effects); };
  if (line && (tracing.noisy || instants() << doublings > most_instants)) {
    model.effects.located = true;
    return {solver::Remedy::located_events};
  }
  std::vector<solver::Remedy> done;
  for (int i = 0; i < doublings && instants() < most_instants; ++i) {
    ++model.effects.doublings;
    done.push_back(solver::Remedy::more_instants);
  }
  return done;
}

/// What was spent on a curve that is given up.
void add_cost(const solver::ResponseCurve& before, solver::ResponseCurve& curve) {
  curve.contact_evaluations += before.contact_evaluations;
  curve.iterations += before.iterations;
  curve.seconds += before.seconds;
}

void tell_error(double error, solver::ResponseCurve& curve) {
  curve.message += fmt::format("{}contact forces sampled {} times a period err by some {:.0e}",
                               curve.message.empty() ? "" : "; ", most_instants, error);
}

}  // namespace

solver::ResponseCurve sampled_curve(const ReducedModel& given, const SceneDescription& scene,
                                    double load, const solver::ContinuationOptions& options,
                                    const solver::PointObserver& observe) {
  const double tolerance = given.effects.force_tolerance;
  ReducedModel model = given;
  const auto is_last = [&] {
    return model.effects.located ||
           contact::instants_of(model.patches, model.effects) >= most_instants;
  };
  Tracing tracing = traced(model, load, options, tolerance, observe);
  std::vector<solver::SolverEvent> log;
  while ((tracing.error > tolerance || tracing.noisy) && !is_last() && !options.stop()) {
    const solver::ResponseCurve& before = tracing.curve;
    const double place =
        before.points.empty() ? options.frequency_begin : before.points.back().frequency;
    for (const solver::Remedy remedy : refined(model, tracing, tolerance)) {
      log.push_back({place, remedy});
    }
    solver::ContinuationOptions again = continuation_options(scene, model);
    again.search_starts = options.search_starts;
    again.near_begin = options.near_begin;
    again.stop = options.stop;
    const double given_up = is_last() ? std::numeric_limits<double>::infinity() : tolerance;
    Tracing next =
        traced(model, load, again, given_up, [&](const auto&) { return !options.stop(); });
    if (tracing.error <= tolerance && before.complete && !next.curve.complete) break;
    add_cost(before, next.curve);
    next.curve.log.insert(next.curve.log.begin(), log.begin(), log.end());
    tracing = std::move(next);
  }
  if (tracing.error > tolerance) tell_error(tracing.error, tracing.curve);
  return std::move(tracing.curve);
}

ReducedModel model_of(ReducedModel model, const solver::ResponseCurve& curve) {
  for (const solver::SolverEvent& event : curve.log) {
    if (event.remedy == solver::Remedy::located_events) model.effects.located = true;
    if (event.remedy == solver::Remedy::more_instants) ++model.effects.doublings;
  }
  return model;
}

}  // namespace microslip::pipelines
