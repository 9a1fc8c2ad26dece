/// @file
/// What accuracy costs: the highest peak of every curve on every rung of a ladder, its error
/// against the finest rung, the error that a run would have told there, and the time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/ladders.hpp"
#include "pipelines/effects/model_family.hpp"

namespace microslip::pipelines {

/// One curve on one rung.
struct RungResult {
  std::string curve;
  std::string value;
  double seconds = 0.0;      ///< wall time: mesh, modes and this curve; median of `runs`
  double cpu_seconds = 0.0;  ///< processor time of the same
  int runs = 1;              ///< how often the curve was timed
  double amplitude = 0.0;    ///< of its highest peak [m]
  double frequency = 0.0;    ///< [rad/s]
  bool is_peak = true;       ///< false: the highest place is an end of the range
  std::optional<double>
      true_error{};  ///< relative, signed: amplitude / that of the finest rung − 1
  std::optional<double> estimated_error{};  ///< the same as the error budget of that rung tells it
  std::optional<double> order{};  ///< d log|true error| / d log(size), from the rung before
};

/// Mesh and modes of a scene, and what they took.
struct TimedStructure {
  std::shared_ptr<const SolvedStructure> solved;
  double mesh_seconds = 0.0, mesh_cpu_seconds = 0.0;  ///< of the mesh alone
  double seconds = 0.0, cpu_seconds = 0.0;            ///< of both; medians
  int runs = 1;                                       ///< how often they were timed
};

/// Time that repetitions may take together, so that a study ends:
/// once it is over everything is timed once.
class Repetitions {
 public:
  /// @param seconds  of all of them.
  explicit Repetitions(double seconds) : left_(seconds) {}
  /// Whether what has just taken so long is run again; takes the time for it.
  [[nodiscard]] bool take(double seconds);

 private:
  double left_;
};

/// @return  nothing solved for kinds without a mesh. @throws as solved_structure().
[[nodiscard]] TimedStructure timed_structure(const SceneDescription& scene, Repetitions& again);

/// Told on the way.
struct ClimbObserver {
  std::function<void(const std::string&)> say;  ///< a sentence for every rung
  /// All that is known, after every curve: errors are against the finest rung until then.
  std::function<void(const std::vector<RungResult>&)> keep;
};

/// Curves are traced one after the other, so that times are those of one core, three times each
/// where the time for repetitions allows it. A rung that is refused, or that memory does not hold,
/// is left out.
/// @param base  of the scene, for rungs that share it.
/// @throws InterruptedError  what was found has been handed on.
[[nodiscard]] std::vector<RungResult> climb(const Ladder& ladder, const TimedStructure& base,
                                            Repetitions& again, const ClimbObserver& observer);

}  // namespace microslip::pipelines
