#include "pipelines/files/model_file.hpp"

#include <numbers>
#include <string>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/hdf5_file.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* mode_shape_unit = "1/kg^0.5";
constexpr const char* modal_force_unit = "N/kg^0.5";

void write_shapes(Hdf5Writer& out, const std::string& stem, const contact::ModalShapes& shapes) {
  out.matrix(stem + "phi_u", shapes.u, mode_shape_unit);
  out.matrix(stem + "phi_v", shapes.v, mode_shape_unit);
  out.matrix(stem + "phi_w", shapes.w, mode_shape_unit);
}

void write_structure(Hdf5Writer& out, const ReducedModel& model) {
  out.vector("/frequency_Hz", model.frequency / (2.0 * std::numbers::pi), "Hz");
  out.vector("/angular_frequency", model.frequency, "rad/s");
  out.vector("/damping_ratio", model.damping_ratio, "1");
  out.vector("/n_attachment", Eigen::VectorXd::Constant(1, static_cast<double>(model.n_attachment)),
             "1");
  out.vector("/force_sine", model.force_sine, modal_force_unit);
  out.vector("/force_cosine", model.force_cosine, modal_force_unit);
  out.vector("/force_static", model.force_static, modal_force_unit);
  out.vector("/output", model.output, mode_shape_unit);
}

/// Datasets of one patch begin with this: /contact/, /contact_2/, …
std::string folder_of(std::size_t patch) {
  return patch == 0 ? "/contact/" : "/contact_" + std::to_string(patch + 1) + "/";
}

void write_samples(Hdf5Writer& out, const std::string& stem, const contact::PatchSamples& samples) {
  write_shapes(out, stem, samples.shapes);
  const bool any = samples.size() > 0;
  for (const SampleArray& array : sample_arrays()) {
    out.vector(stem + array.name, any ? array.get(samples) : Eigen::VectorXd(), array.unit);
  }
}

void write_patch(Hdf5Writer& out, const std::string& folder, const contact::Patch& patch) {
  out.matrix(folder + "points", patch.cells.points, "m");
  out.vector(folder + "weights", patch.cells.weights, "m^2");
  out.matrix(folder + "frame", patch.frame, "1");
  write_samples(out, folder, patch.cells);
  out.vector(folder + "fit_degree",
             Eigen::VectorXd::Constant(1, static_cast<double>(patch.fit_degree)), "1");
  out.vector(folder + "fit_error", patch.fit_error, "1");
  out.matrix(folder + "vertices", patch.vertices.points, "m");
  out.integers(folder + "cells", patch.connectivity.cast<std::int64_t>(), "1");
  write_samples(out, folder + "vertex_", patch.vertices);
}

}  // namespace

void write_model(const std::filesystem::path& file, const ReducedModel& model) {
  Hdf5Writer out;
  out.text("program", "microslip");
  write_structure(out, model);
  if (model.patches.empty()) write_patch(out, folder_of(0), {});  // datasets without elements
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    write_patch(out, folder_of(i), model.patches[i]);
    if (model.patches.size() > 1) {
      out.text(folder_of(i).substr(1, folder_of(i).size() - 2), model.patches[i].name);
    }
  }
  out.write(file);
}

}  // namespace microslip::pipelines
