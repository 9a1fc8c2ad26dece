#include "pipelines/study.hpp"

#include <iostream>
#include <utility>

#include <fmt/format.h>

#include "mesh/element_shape.hpp"
#include "pipelines/contact_effects.hpp"
#include "pipelines/contact_stage.hpp"
#include "pipelines/curve_family.hpp"
#include "pipelines/effects.hpp"
#include "pipelines/response_stage.hpp"
#include "pipelines/run_record.hpp"
#include "pipelines/structure_stage.hpp"
#include "pipelines/write_report.hpp"

namespace microslip::pipelines {
namespace {

/// mesh → modes → contact: the finite-element half, or the numbers a modal scene gives.
ReducedModel reduce(const SceneDescription& scene, RunRecord& record) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    ReducedModel model = reduced_model(*modal);
    model.effects = contact_effects(model, scene);
    record.keep_effects(effects_of(scene, &model));
    record.keep_model(model);
    return model;
  }
  record.stage("mesh");
  const mesh::Mesh mesh = obtain_mesh(scene, record.mesh_file());
  check_names(mesh, scene);
  record.keep_mesh(mesh, scene.material.density);
  record.stage("modes");
  StructureModes structure = solve_structure(mesh, scene);
  record.keep_modes(mesh, structure, damping_ratios(scene.modes, structure.basis.frequency));
  record.stage("contact");
  std::vector<std::string> warnings;
  ReducedModel model =
      reduce_to_contact(mesh, scene, structure.basis,
                        structure.residual ? &*structure.residual : nullptr, warnings);
  for (const std::string& warning : warnings) record.progress().warning(warning);
  model.effects = contact_effects(model, scene);
  record.keep_effects(effects_of(scene, &model));
  record.keep_model(model);
  record.keep_structure(mesh, std::move(structure.basis));
  return model;
}

void require_response(const SceneDescription& scene) {
  if (!scene.response) {
    throw SceneError(scene.file.string() + ": [response] is missing: run needs a frequency range");
  }
}

}  // namespace

int run_study(const SceneDescription& scene, const RunOptions& options) {
  RunRecord record(scene, options);
  return record.run([&] {
    require_response(scene);
    const ReducedModel model = reduce(scene, record);
    require_held(model, scene);
    require_loads(model, scene);
    record.stage("curves");
    const std::vector<CurveResult> curves = trace_family(model, scene, options.jobs, record);
    record.keep_harmonics(scene);
    record.stage("maps");
    draw_maps(model, scene, curves, record);
    if (scene.response->optimum_preload) {
      record.stage("optimum");
      record.keep_optimum(best_preload(model, scene));
      record.keep_bracket(optimum_bracket(model, scene));
    }
    record.stage("report");
    record.keep_summary();  // the report reads it
    for (const std::string& warning : write_report(record.folder())) {
      record.progress().warning(warning);
    }
  });
}

int modes_study(const SceneDescription& scene, const RunOptions& options) {
  RunRecord record(scene, options);
  return record.run([&] { static_cast<void>(reduce(scene, record)); });
}

int mesh_study(const SceneDescription& scene, const RunOptions& options) {
  const mesh::Mesh mesh = obtain_mesh(scene, options.output);
  check_names(mesh, scene);
  std::cout << describe_mesh(mesh, scene.material.density) << '\n';
  for (const std::string& warning : mesh::shape_warnings(mesh)) std::cerr << "warning: " << warning << '\n';
  std::cout << "written: " << options.output.string() << '\n';
  return static_cast<int>(ExitCode::complete);
}

int report_study(const std::filesystem::path& folder) {
  rebuild_report(folder);
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
