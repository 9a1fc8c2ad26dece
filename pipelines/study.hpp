/// @file
/// The whole flow, stage by stage: the page to read first. Each function is one command of the program
/// and returns its exit code; errors are thrown (exit_code.hpp).
#pragma once

#include <filesystem>

#include "pipelines/model/campbell.hpp"
#include "pipelines/run/check_study.hpp"
#include "pipelines/run/run_options.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// `run`: geometry → modes → curves → maps → best preload → plots.
int run_study(const SceneDescription& scene, const RunOptions& options);
/// `modes`: geometry → modes → contact model.
int modes_study(const SceneDescription& scene, const RunOptions& options);
/// `mesh`: geometry → mesh file.
int mesh_study(const SceneDescription& scene, const RunOptions& options);
/// `converge`: every ladder of the discretisation, tables in converge/ and plots.
int converge_study(const SceneDescription& scene, const RunOptions& options);
/// `campbell`: natural frequencies over speed, tables and plot in campbell/.
int campbell_study(const SceneDescription& scene, const CampbellRequest& request,
                   const RunOptions& options);
/// `report`: plots and report from a run folder.
int report_study(const std::filesystem::path& folder);

}  // namespace microslip::pipelines
