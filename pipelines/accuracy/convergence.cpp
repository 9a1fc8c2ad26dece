#include "pipelines/accuracy/convergence.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fem/petsc_error.hpp"
#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

/// Wall and processor time since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  [[nodiscard]] double cpu_seconds() const {
    return static_cast<double>(std::clock() - cpu_begin_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t cpu_begin_ = std::clock();
};

constexpr std::size_t most_runs = 3;

struct Seconds {
  double wall = 0.0, cpu = 0.0;
  int runs = 0;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Runs work once, and again where there is time for it. Nothing is kept between the runs.
template <typename Work>
Seconds timed(Repetitions& again, const Work& work) {
  std::vector<double> wall;
  std::vector<double> cpu;
  do {
    const Stopwatch watch;
    work();
    wall.push_back(watch.seconds());
    cpu.push_back(watch.cpu_seconds());
    if (interrupt_requested()) break;
  } while (wall.size() < most_runs && again.take(wall.front()));
  return {median(wall), median(cpu), static_cast<int>(wall.size())};
}

TimedStructure structure_of(const Rung& rung, const TimedStructure& base, Repetitions& again) {
  if (base.solved == nullptr || (rung.same_basis && rung.same_mesh)) return base;
  if (!rung.same_mesh) return timed_structure(rung.scene, again);
  TimedStructure result;
  const Seconds modes = timed(again, [&] {
    result.solved = std::make_shared<const SolvedStructure>(
        SolvedStructure{base.solved->mesh, solve_structure(base.solved->mesh, rung.scene)});
  });
  result.seconds = base.mesh_seconds + modes.wall;
  result.cpu_seconds = base.mesh_cpu_seconds + modes.cpu;
  result.runs = std::min(base.runs, modes.runs);
  return result;
}

/// What a run on this rung would have told of its error; the source of the ladder alone is asked.
std::optional<double> told_error(const ReducedModel& model, const SceneDescription& scene,
                                 const RicherModels& richer, const std::string& source,
                                 CurveResult& curve) {
  if (curve.integrated) return std::nullopt;
  if (source == "harmonics") {
    SceneDescription checked = scene;
    checked.settings.harmonics.checked = true;
    check_harmonics(model, checked, std::get<double>(curve.load), curve,
                    [] { return interrupt_requested(); });
  }
  const CurveBudget budget = error_budget(model, scene, richer, curve);
  for (const ErrorRow& row : budget.rows) {
    const bool asked = row.source == source && row.goal == "peak_amplitude";
    if (asked) return 1.0 / (1.0 + row.effect) - 1.0;  // against the refined value
  }
  return std::nullopt;
}

struct Traced {
  CurveResult curve;
  Seconds seconds;
};

/// The motion at the highest peak of a curve, integrated on until it repeats itself.
CurveResult integrated_at_peak(const ReducedModel& model, SceneDescription scene,
                               CurveResult curve) {
  const solver::ResponsePoint peak = *highest_peak(curve.curve);
  const double hz = peak.frequency / (2.0 * std::numbers::pi);
  scene.response->frequency_begin_hz = scene.response->frequency_end_hz = hz;
  curve.curve = integrated_elsewhere(model, scene, std::get<double>(curve.load), peak, {});
  curve.integrated = true;
  for (solver::ResponsePoint& point : curve.curve.points) point.mark = peak.mark;
  return curve;
}

Traced traced(const Rung& rung, const ReducedModel& model, const CurveRequest& request,
              Repetitions& again) {
  Traced result;
  const auto trace = [&] {
    result.curve =
        trace_curve(model, rung.scene, request, [](const auto&) { return !interrupt_requested(); });
  };
  if (!rung.in_time) {
    result.seconds = timed(again, trace);
    return result;
  }
  trace();
  const CurveResult balanced = result.curve;
  if (!balanced.curve.complete || highest_peak(balanced.curve) == nullptr) return result;
  result.seconds =
      timed(again, [&] { result.curve = integrated_at_peak(model, rung.scene, balanced); });
  return result;
}

/// Peaks are solved for; of a sweep in time what is highest between its ends stands for one.
bool is_peak(const solver::ResponsePoint& highest, const CurveResult& curve) {
  const std::vector<solver::ResponsePoint>& points = curve.curve.points;
  return highest.mark == solver::PointMark::peak ||
         (curve.integrated && &highest != &points.front() && &highest != &points.back());
}

/// @param keep  what has come of each curve.
void climb_rung(const Rung& rung, const std::string& source, const TimedStructure& base,
                Repetitions& again, const std::function<void(RungResult)>& keep) {
  const TimedStructure structure = structure_of(rung, base, again);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(rung.scene, structure.solved.get(), warnings);
  require_curves(model, rung.scene);
  const RicherModels richer = richer_models(model, rung.scene, structure.solved.get(), {source});
  for (const CurveRequest& request : curve_requests(rung.scene)) {
    if (interrupt_requested()) throw InterruptedError("interrupted; what was finished is kept");
    if (!is_loaded(request)) continue;
    auto [curve, tracing] = traced(rung, model, request, again);
    const solver::ResponsePoint* peak = highest_peak(curve.curve);
    if (peak == nullptr || !curve.curve.complete) continue;
    RungResult result{.curve = curve.name,
                      .value = rung.value,
                      .seconds = structure.seconds + tracing.wall,
                      .cpu_seconds = structure.cpu_seconds + tracing.cpu,
                      .runs = std::min(structure.runs, tracing.runs),
                      .amplitude = peak->amplitude,
                      .frequency = peak->frequency,
                      .is_peak = is_peak(*peak, curve)};
    result.estimated_error = told_error(model, rung.scene, richer, source, curve);
    keep(std::move(result));
  }
}

/// Peaks, or motions at one frequency: an error from one to the other has an order.
bool are_alike(const RungResult& one, const RungResult& other) {
  return (one.is_peak && other.is_peak) || one.frequency == other.frequency;
}

/// Errors against the finest rung that has the curve, and their orders, in place of earlier ones.
void add_errors(const Ladder& ladder, std::vector<RungResult>& results) {
  std::map<std::string, double> sizes;
  for (const Rung& rung : ladder.rungs) sizes[rung.value] = rung.size;
  std::map<std::string, const RungResult*> finest;
  for (RungResult& result : results) {
    result.true_error.reset();
    result.order.reset();
    finest[result.curve] = &result;
  }
  std::map<std::string, RungResult*> before;
  for (RungResult& result : results) {
    if (&result == finest[result.curve]) continue;
    result.true_error = result.amplitude / finest[result.curve]->amplitude - 1.0;
    const RungResult* coarser = before[result.curve];
    const bool has_order = coarser != nullptr && are_alike(*coarser, result) &&
                           are_alike(result, *finest[result.curve]);
    if (has_order && sizes[result.value] > 0.0) {
      result.order = std::log(std::abs(*coarser->true_error / *result.true_error)) /
                     std::log(sizes[coarser->value] / sizes[result.value]);
      if (!std::isfinite(*result.order)) result.order.reset();
    }
    before[result.curve] = &result;
  }
}

}  // namespace

bool Repetitions::take(double seconds) {
  if (seconds > left_) return false;
  left_ -= seconds;
  return true;
}

TimedStructure timed_structure(const SceneDescription& scene, Repetitions& again) {
  TimedStructure result;
  if (std::holds_alternative<ModalModel>(scene.model)) {
    result.runs = static_cast<int>(most_runs);
    return result;
  }
  std::optional<mesh::Mesh> mesh;
  const Seconds meshing = timed(again, [&] {
    const TemporaryFolder folder;
    mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
    check_names(*mesh, scene);
  });
  StructureModes modes;
  const Seconds solving = timed(again, [&] { modes = solve_structure(*mesh, scene); });
  result.solved =
      std::make_shared<const SolvedStructure>(SolvedStructure{std::move(*mesh), std::move(modes)});
  result.mesh_seconds = meshing.wall;
  result.mesh_cpu_seconds = meshing.cpu;
  result.seconds = meshing.wall + solving.wall;
  result.cpu_seconds = meshing.cpu + solving.cpu;
  result.runs = std::min(meshing.runs, solving.runs);
  return result;
}

std::vector<RungResult> climb(const Ladder& ladder, const TimedStructure& base, Repetitions& again,
                              const ClimbObserver& observer) {
  std::vector<RungResult> results;
  const auto keep = [&](RungResult result) {
    results.push_back(std::move(result));
    add_errors(ladder, results);
    observer.keep(results);
  };
  for (const Rung& rung : ladder.rungs) {
    const Stopwatch watch;
    const auto leave_out = [&](const std::exception& error) {
      observer.say(fmt::format("{} = {}: left out: {}", ladder.knob, rung.value, error.what()));
    };
    try {
      if (!rung.refused.empty()) throw SceneError(rung.refused);
      climb_rung(rung, ladder.source, base, again, keep);
      observer.say(fmt::format("{} = {}: {:.1f} s", ladder.knob, rung.value, watch.seconds()));
    } catch (const SceneError& error) {
      leave_out(error);
    } catch (const RefusedError& error) {
      leave_out(error);
    } catch (const fem::MemoryError& error) {
      leave_out(error);
    }
  }
  return results;
}

}  // namespace microslip::pipelines
