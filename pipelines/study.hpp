/// @file
/// The whole flow, stage by stage: study.cpp is the page to read first. Each function, here and in
/// the headers of the other commands, is one command of the program and returns its exit code;
/// errors are thrown (exit_code.hpp).
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/record/run_options.hpp"
#include "pipelines/studies/campbell_study.hpp"
#include "pipelines/studies/check_study.hpp"
#include "pipelines/studies/converge_study.hpp"
#include "pipelines/studies/mesh_study.hpp"
#include "pipelines/studies/report_study.hpp"

namespace microslip::pipelines {

/// `run`: geometry → modes → curves → maps → best preload → plots.
int run_study(const SceneDescription& scene, const RunOptions& options);
/// `modes`: geometry → modes → contact model.
int modes_study(const SceneDescription& scene, const RunOptions& options);

}  // namespace microslip::pipelines
