/// @file
/// The curves of one model, solved by all ranks of an MPI start. Rank 0 asks, keeps and tells; each
/// other rank gets scene and model once and solves one curve at a time: the function is that of
/// rank 0, and so are the numbers. Points come as they are found: a run looks as on one rank.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {

/// trace_curve() of the model, wherever it is solved.
using CurveSolver =
    std::function<CurveResult(const CurveRequest& request, const solver::PointObserver& observe,
                              const solver::ResponseCurve* near)>;
/// What is done with curve i, by whoever calls it.
using CurveTask = std::function<void(std::size_t i, const CurveSolver& solve)>;

/// Runs task(i) for i < n: on threads here, and on one for each other rank, which waits for it.
/// @param scene  curves are asked for by the names of curve_requests().
/// @param jobs   threads here and ranks beside this one on the machine, at least one of each.
/// @return       how many curves each rank has solved.
/// @throws       what `task` throws, with the error of another rank as if it were one of this.
std::vector<int> share_curves(const ReducedModel& model, const SceneDescription& scene,
                              std::size_t n, int jobs, const CurveTask& task);

/// The part of the other ranks (structure/on_all_ranks.hpp).
inline constexpr std::string_view curves_work = "curves";
void take_part_in_curves(std::string_view bytes);

}  // namespace microslip::pipelines
