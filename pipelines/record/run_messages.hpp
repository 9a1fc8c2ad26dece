/// @file
/// What the log says of a run's parts, in words.
#pragma once

#include <string>
#include <vector>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/response/run_summary.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "solver/optimum.hpp"

namespace microslip::pipelines {

/// Sizes and times of the modal analysis, then a line for each mode.
[[nodiscard]] std::vector<std::string> modes_text(const StructureModes& modes);

/// How a curve ended, and its largest amplitude.
[[nodiscard]] std::string outcome_text(const CurveResult& result);

/// A line for each branch or solution that was found beside the curve.
[[nodiscard]] std::vector<std::string> detached_text(const CurveResult& result);

/// One of those rises above the curve, with points that are not known to be unstable: what is told
/// of the curve is not the most that may be seen.
[[nodiscard]] bool has_higher_branch(const CurveResult& result);

/// Where every solution found is unstable, detached ones included: the motion there has another
/// period than the force, or none. Empty: nowhere.
[[nodiscard]] std::string restless_text(const CurveResult& result);

/// The peak that is told of a curve is unstable, and what is stable of it is lower by more than a
/// per cent: no motion stays at that peak. Empty: it is not.
[[nodiscard]] std::string unstable_peak_text(const CurveResult& result);

/// Another peak of the curve that is as high as its highest, to what is known of it: a bar follows
/// one peak. Empty: there is none, or no bar.
[[nodiscard]] std::string rival_text(const CurveResult& result, const CurveBudget& budget);

/// The best value lies where one peak falls and another rises. Empty: it does not.
[[nodiscard]] std::string crossing_text(const solver::Optimum& optimum);

/// Where a curve has so many folds that no sweep follows them. Empty: it has fewer.
[[nodiscard]] std::string many_folds_text(const CurveResult& result);

/// What the harmonics given leave out at the highest peak, if that is 2 % or more. Empty: less,
/// or not known.
[[nodiscard]] std::string left_out_text(const CurveResult& result);

/// Points are certified to 1e-10 unless rounding errors of nearly cancelling terms are larger; that
/// is told. Empty: all are. On rough surfaces the two counts of dissipation differ by themselves
/// (theory section 11).
[[nodiscard]] std::string precision_text(const CurveSummary& curve, const ReducedModel& model);

/// A best value with its peak, to the digits that its errors allow where they are told;
/// or why there is none.
/// @param unit  of the value, with a space before it.
[[nodiscard]] std::string best_text(const solver::Optimum& optimum, const std::string& unit,
                                    const CurveBudget& budget);

/// Of a bracket that is searched with fewer harmonics than the best value; "": it is not.
[[nodiscard]] std::string few_harmonics_text(const OptimumBracket& bracket);

/// The best value with other contact data: to the digits that the errors of the best value as given
/// allow.
[[nodiscard]] std::string bracket_text(const OptimumOfFactor& entry, const CurveBudget& budget);

/// "peak … m at … Hz", or what stands in its place.
[[nodiscard]] std::string amplitude_text(const solver::PeakOfParameter& best);

/// The lowest value of a search that found no best one, as far as there is one.
[[nodiscard]] std::string lowest_text(const solver::Optimum& optimum);

/// Where a bracket looks farther than the scene asks for; empty: nowhere.
[[nodiscard]] std::string range_text(const OptimumOfFactor& entry);

}  // namespace microslip::pipelines
