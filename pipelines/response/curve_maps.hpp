/// @file
/// A solved curve → maps of its contact.
#pragma once

#include <string>
#include <vector>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

struct CurveMaps {
  std::vector<NamedMap> maps;
  std::vector<std::string> missing;  ///< which map there is not, why, and what to set
};

/// Contact maps the scene asks for on this curve: at its highest peak, its folds, or all solutions
/// of the branch at given frequencies (numbered in branch order).
[[nodiscard]] CurveMaps curve_maps(const ReducedModel& model, const SceneDescription& scene,
                                   const CurveResult& result);

}  // namespace microslip::pipelines
