/// @file
/// What the archive of bytes (system/byte_archive.hpp) is told of results.
#pragma once

#include <tuple>

#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "solver/point_shift.hpp"

// Structured bindings name every member: one that is added and not kept does not compile.
namespace microslip {
using pipelines::Is;

namespace contact {
auto members(Is<Harmonics> auto& value) { return std::tie(value.rows()); }
auto members(Is<CycleReport> auto& value) {
  auto& [stick, slip, separated, three_states, work, awake, gap] = value;
  return std::tie(stick, slip, separated, three_states, work, awake, gap);
}
}  // namespace contact

namespace solver {
auto members(Is<PeriodEnergy> auto& value) {
  auto& [friction, damping] = value;
  return std::tie(friction, damping);
}
auto members(Is<BranchSlope> auto& value) {
  auto& [amplitude, phase] = value;
  return std::tie(amplitude, phase);
}
auto members(Is<ResponsePoint> auto& value) {
  auto& [frequency, q, orders, left_out, amplitude, first, mean, phase, slope, residual, imbalance,
         mismatch, energy, report, stability, basis, sign, mark, iterations, evaluations, seconds] =
      value;
  return std::tie(frequency, q, orders, left_out, amplitude, first, mean, phase, slope, residual,
                  imbalance, mismatch, energy, report, stability, basis, sign, mark, iterations,
                  evaluations, seconds);
}
auto members(Is<SolverEvent> auto& value) {
  auto& [frequency, remedy] = value;
  return std::tie(frequency, remedy);
}
auto members(Is<DetachedBranch> auto& value) {
  auto& [points, closed] = value;
  return std::tie(points, closed);
}
auto members(Is<SettledPeak> auto& value) {
  auto& [frequency, amplitude, left_out, energy, is_end] = value;
  return std::tie(frequency, amplitude, left_out, energy, is_end);
}
auto members(Is<ResponseCurve> auto& value) {
  auto& [points, complete, diagnosis, message, certificate, log, detached, n_starts, iterations,
         evaluations, readings, cuts, seconds, settled_peak] = value;
  return std::tie(points, complete, diagnosis, message, certificate, log, detached, n_starts,
                  iterations, evaluations, readings, cuts, seconds, settled_peak);
}
auto members(Is<PointShift> auto& value) {
  auto& [frequency, amplitude] = value;
  return std::tie(frequency, amplitude);
}
auto members(Is<RicherPeak> auto& value) {
  auto& [frequency, amplitude, change, highest, seconds, energy, beyond, left_out] = value;
  return std::tie(frequency, amplitude, change, highest, seconds, energy, beyond, left_out);
}
auto members(Is<PeakOfParameter> auto& value) {
  auto& [parameter, frequency, amplitude, whole_curve, place, detached] = value;
  return std::tie(parameter, frequency, amplitude, whole_curve, place, detached);
}
auto members(Is<Optimum> auto& value) {
  auto& [best, trace, found, flat, reason, objection, message, notes, warnings, orders, n_curves,
         iterations, evaluations, seconds, best_curve, by_few] = value;
  static_cast<void>(best_curve);  // for the errors of the same run, which are kept themselves
  static_cast<void>(by_few);      // for its bracket, likewise
  return std::tie(best, trace, found, flat, reason, objection, message, notes, warnings, orders,
                  n_curves, iterations, evaluations, seconds);
}
}  // namespace solver

namespace pipelines {
auto members(Is<PatchShares> auto& value) {
  auto& [patch, reports] = value;
  return std::tie(patch, reports);
}
auto members(Is<CurveResult> auto& value) {
  auto& [name, load, curve, maps, patch_shares, gap, integrated, richer, lacks_time, band] = value;
  static_cast<void>(maps);  // drawn in a stage of their own, after the curves
  static_cast<void>(band);  // told in a stage of its own as well
  return std::tie(name, load, curve, patch_shares, gap, integrated, richer, lacks_time);
}
auto members(Is<OptimumOfFactor> auto& value) {
  auto& [parameter, factor, optimum, range, widened, n_harmonics] = value;
  return std::tie(parameter, factor, optimum, range, widened, n_harmonics);
}
auto members(Is<OptimumBracket> auto& value) {
  auto& [entries, left_out] = value;
  return std::tie(entries, left_out);
}
auto members(Is<NoBound> auto& value) {
  auto& [effect, why] = value;
  return std::tie(effect, why);
}
auto members(Is<ErrorRow> auto& value) {
  auto& [curve, goal, source, effect, kind, seconds, where_hz] = value;
  return std::tie(curve, goal, source, effect, kind, seconds, where_hz);
}

}  // namespace pipelines
}  // namespace microslip
