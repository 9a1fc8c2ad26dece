/// @file
/// The command `converge`.
#pragma once

#include <string>
#include <vector>

#include "pipelines/accuracy/ladders.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/record/run_options.hpp"

namespace microslip::pipelines {

struct ConvergeRequest {
  std::vector<std::string> meshes{};  ///< files from coarse to fine, as typed; empty: none
  std::vector<double> sizes{};        ///< of elements, from coarse to fine [m]; empty: usual ones
  std::vector<std::string> knobs{};   ///< the only ones, in their order; empty: all of the scene
};

/// Of the scene, with the meshes, the sizes and the knobs asked for.
/// @throws SceneError  what the scene does not have; files as ladder_of_files().
[[nodiscard]] std::vector<Ladder> asked_ladders(const SceneDescription& scene,
                                                const ConvergeRequest& request);

/// `converge`: every ladder of the discretisation, tables in converge/ and plots.
int converge_study(const SceneDescription& scene, const ConvergeRequest& request,
                   const RunOptions& options);

}  // namespace microslip::pipelines
