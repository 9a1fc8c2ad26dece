#include "pipelines/files/model_file.hpp"

#include <numbers>
#include <string>
#include <utility>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/hdf5_file.hpp"
#include "pipelines/system/scene_error.hpp"

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

/// Numbers that are used together must fit together, whoever wrote the file.
void check_size(const std::filesystem::path& file, const std::string& name, Eigen::Index size,
                Eigen::Index expected) {
  if (size != expected) {
    throw SceneError(file.string() + ": dataset " + name + " has " + std::to_string(size) +
                     " rows, expected " + std::to_string(expected));
  }
}

void check_sizes(const std::filesystem::path& file, const ReducedModel& model) {
  const Eigen::Index n_modes = model.frequency.size();
  check_size(file, "/damping_ratio", model.damping_ratio.size(), n_modes);
  check_size(file, "/force_sine", model.force_sine.size(), n_modes);
  check_size(file, "/force_cosine", model.force_cosine.size(), n_modes);
  check_size(file, "/force_static", model.force_static.size(), n_modes);
  check_size(file, "/output", model.output.size(), n_modes);
}

/// Three columns are part of the type; another width is a damaged or foreign file.
Eigen::MatrixX3d read_positions(const Hdf5Reader& in, const std::filesystem::path& file,
                                const std::string& name) {
  const Eigen::MatrixXd values = in.matrix(name);
  if (values.cols() != 3) throw SceneError(file.string() + ": dataset " + name + " is not n × 3");
  return values;
}

/// @param n  places, that all arrays must have.
void read_samples(const Hdf5Reader& in, const std::filesystem::path& file, const std::string& stem,
                  Eigen::Index n, contact::PatchSamples& samples) {
  samples.shapes = {in.matrix(stem + "phi_u"), in.matrix(stem + "phi_v"),
                    in.matrix(stem + "phi_w")};
  check_size(file, stem + "phi_u", samples.shapes.u.rows(), n);
  samples.stiffness.resize(n, 3);
  for (const SampleArray& array : sample_arrays()) {
    const Eigen::VectorXd values = in.vector(stem + array.name);
    check_size(file, stem + array.name, values.size(), n);
    array.set(samples, values);
  }
}

contact::Patch read_patch(const Hdf5Reader& in, const std::filesystem::path& file,
                          const std::string& folder) {
  contact::Patch patch;
  patch.name = folder.substr(1, folder.size() - 2);
  patch.cells.points = read_positions(in, file, folder + "points");
  patch.cells.weights = in.vector(folder + "weights");
  const Eigen::MatrixX3d frame = read_positions(in, file, folder + "frame");
  check_size(file, folder + "frame", frame.rows(), 3);
  patch.frame = frame;
  read_samples(in, file, folder, patch.cells.weights.size(), patch.cells);
  const Eigen::VectorXd degree = in.vector(folder + "fit_degree");
  check_size(file, folder + "fit_degree", degree.size(), 1);
  patch.fit_degree = static_cast<int>(degree[0]);
  patch.fit_error = in.vector(folder + "fit_error");
  patch.vertices.points = read_positions(in, file, folder + "vertices");
  patch.connectivity = in.integers(folder + "cells").cast<Eigen::Index>();
  read_samples(in, file, folder + "vertex_", patch.vertices.points.rows(), patch.vertices);
  return patch;
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

ReducedModel read_model(const std::filesystem::path& file) {
  const Hdf5Reader in(file);
  ReducedModel model;
  model.frequency = in.vector("/angular_frequency");
  model.damping_ratio = in.vector("/damping_ratio");
  const Eigen::VectorXd n_attachment = in.vector("/n_attachment");
  check_size(file, "/n_attachment", n_attachment.size(), 1);
  model.n_attachment = static_cast<Eigen::Index>(n_attachment[0]);
  model.force_sine = in.vector("/force_sine");
  model.force_cosine = in.vector("/force_cosine");
  model.force_static = in.vector("/force_static");
  model.output = in.vector("/output");
  check_sizes(file, model);
  for (std::size_t i = 0; i == 0 || in.has(folder_of(i) + "weights"); ++i) {
    contact::Patch patch = read_patch(in, file, folder_of(i));
    if (patch.cells.weights.size() > 0) model.patches.push_back(std::move(patch));
  }
  return model;
}

}  // namespace microslip::pipelines
