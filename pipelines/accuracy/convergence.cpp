#include "pipelines/accuracy/convergence.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/description/curve_request.hpp"
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

TimedStructure structure_of(const Rung& rung, const TimedStructure& base) {
  if (base.solved == nullptr || (rung.same_basis && rung.same_mesh)) return base;
  if (!rung.same_mesh) return timed_structure(rung.scene);
  const Stopwatch watch;
  TimedStructure result;
  result.solved = std::make_shared<const SolvedStructure>(
      SolvedStructure{base.solved->mesh, solve_structure(base.solved->mesh, rung.scene)});
  result.seconds = base.mesh_seconds + watch.seconds();
  result.cpu_seconds = base.mesh_cpu_seconds + watch.cpu_seconds();
  return result;
}

/// What a run on this rung would have told of its error; the source of the ladder alone is asked.
std::optional<double> told_error(const ReducedModel& model, const SceneDescription& scene,
                                 const RicherModels& richer, const std::string& source,
                                 CurveResult& curve) {
  if (source == "harmonics") {
    SceneDescription checked = scene;
    checked.settings.harmonics.checked = true;
    check_harmonics(model, checked, std::get<double>(curve.load), curve);
  }
  const CurveBudget budget = error_budget(model, scene, richer, curve);
  for (const ErrorRow& row : budget.rows) {
    const bool asked = row.source == source && row.goal == "peak_amplitude";
    if (asked) return 1.0 / (1.0 + row.effect) - 1.0;  // against the refined value
  }
  return std::nullopt;
}

void climb_rung(const Rung& rung, const std::string& source, const TimedStructure& base,
                std::vector<RungResult>& results) {
  const TimedStructure structure = structure_of(rung, base);
  std::vector<std::string> warnings;
  const ReducedModel model = model_of(rung.scene, structure.solved.get(), warnings);
  const RicherModels richer = richer_models(model, rung.scene, structure.solved.get(), {source});
  for (const CurveRequest& request : curve_requests(rung.scene)) {
    if (interrupt_requested()) throw InterruptedError("interrupted; finished ladders are kept");
    if (std::holds_alternative<LimitName>(request.load)) continue;
    const Stopwatch watch;
    CurveResult curve =
        trace_curve(model, rung.scene, request, [](const auto&) { return !interrupt_requested(); });
    const double seconds = structure.seconds + watch.seconds();
    const double cpu_seconds = structure.cpu_seconds + watch.cpu_seconds();
    const solver::ResponsePoint* peak = highest_peak(curve.curve);
    if (peak == nullptr || !curve.curve.complete) continue;
    RungResult result{curve.name,  rung.value,      seconds,
                      cpu_seconds, peak->amplitude, peak->frequency};
    result.estimated_error = told_error(model, rung.scene, richer, source, curve);
    results.push_back(std::move(result));
  }
}

/// Errors against the finest rung that has the curve, and their orders.
void add_errors(const Ladder& ladder, std::vector<RungResult>& results) {
  std::map<std::string, double> sizes;
  for (const Rung& rung : ladder.rungs) sizes[rung.value] = rung.size;
  std::map<std::string, const RungResult*> finest;
  for (const RungResult& result : results) finest[result.curve] = &result;
  std::map<std::string, RungResult*> before;
  for (RungResult& result : results) {
    if (&result == finest[result.curve]) continue;
    result.true_error = result.amplitude / finest[result.curve]->amplitude - 1.0;
    const RungResult* coarser = before[result.curve];
    if (coarser != nullptr && sizes[result.value] > 0.0) {
      result.order = std::log(std::abs(*coarser->true_error / *result.true_error)) /
                     std::log(sizes[coarser->value] / sizes[result.value]);
      if (!std::isfinite(*result.order)) result.order.reset();
    }
    before[result.curve] = &result;
  }
}

}  // namespace

TimedStructure timed_structure(const SceneDescription& scene) {
  TimedStructure result;
  if (std::holds_alternative<ModalModel>(scene.model)) return result;
  const Stopwatch watch;
  const TemporaryFolder folder;
  mesh::Mesh mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
  check_names(mesh, scene);
  result.mesh_seconds = watch.seconds();
  result.mesh_cpu_seconds = watch.cpu_seconds();
  StructureModes modes = solve_structure(mesh, scene);
  result.solved =
      std::make_shared<const SolvedStructure>(SolvedStructure{std::move(mesh), std::move(modes)});
  result.seconds = watch.seconds();
  result.cpu_seconds = watch.cpu_seconds();
  return result;
}

std::vector<RungResult> climb(const Ladder& ladder, const TimedStructure& base,
                              const std::function<void(const std::string&)>& say) {
  std::vector<RungResult> results;
  for (const Rung& rung : ladder.rungs) {
    const Stopwatch watch;
    try {
      climb_rung(rung, ladder.source, base, results);
      say(fmt::format("{} = {}: {:.1f} s", ladder.knob, rung.value, watch.seconds()));
    } catch (const SceneError& error) {
      say(fmt::format("{} = {}: left out: {}", ladder.knob, rung.value, error.what()));
    } catch (const RefusedError& error) {
      say(fmt::format("{} = {}: left out: {}", ladder.knob, rung.value, error.what()));
    }
  }
  add_errors(ladder, results);
  return results;
}

}  // namespace microslip::pipelines
