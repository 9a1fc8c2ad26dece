#include "pipelines/files/model_file.hpp"

#include <numbers>

#include "pipelines/files/hdf5_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* mode_shape_unit = "1/kg^0.5";
constexpr const char* modal_force_unit = "N/kg^0.5";
constexpr const char* stiffness_unit = "N/m^3";

void write_shapes(Hdf5Writer& out, const std::string& stem, const contact::ModalShapes& shapes) {
  out.matrix(stem + "phi_u", shapes.u, mode_shape_unit);
  out.matrix(stem + "phi_v", shapes.v, mode_shape_unit);
  out.matrix(stem + "phi_w", shapes.w, mode_shape_unit);
}

contact::ModalShapes read_shapes(const Hdf5Reader& in, const std::string& stem) {
  return {in.matrix(stem + "phi_u"), in.matrix(stem + "phi_v"), in.matrix(stem + "phi_w")};
}

void write_structure(Hdf5Writer& out, const ReducedModel& model) {
  out.vector("/frequency_Hz", model.frequency / (2.0 * std::numbers::pi), "Hz");
  out.vector("/angular_frequency", model.frequency, "rad/s");
  out.vector("/damping_ratio", model.damping_ratio, "1");
  out.vector("/n_attachment", Eigen::VectorXd::Constant(1, static_cast<double>(model.n_attachment)), "1");
  out.vector("/force_sine", model.force_sine, modal_force_unit);
  out.vector("/force_cosine", model.force_cosine, modal_force_unit);
  out.vector("/force_static", model.force_static, modal_force_unit);
  out.vector("/output", model.output, mode_shape_unit);
}

void write_points(Hdf5Writer& out, const ReducedModel& model) {
  out.matrix("/contact/points", model.points, "m");
  out.vector("/contact/weights", model.weights, "m^2");
  out.matrix("/contact/frame", model.frame, "1");
  write_shapes(out, "/contact/", model.shapes);
  out.vector("/contact/tangential_stiffness", model.tangential_stiffness, stiffness_unit);
  out.vector("/contact/tangential_stiffness_r", model.second_stiffness, stiffness_unit);
  out.vector("/contact/normal_stiffness", model.normal_stiffness, stiffness_unit);
  out.vector("/contact/friction_coefficient", model.friction_coefficient, "1");
  out.vector("/contact/preload", model.preload, "Pa");
  out.vector("/contact/fit_degree",
             Eigen::VectorXd::Constant(1, static_cast<double>(model.fit_degree)), "1");
  out.vector("/contact/fit_error", model.fit_error, "1");
}

void write_vertices(Hdf5Writer& out, const ReducedModel& model) {
  out.matrix("/contact/vertices", model.vertices, "m");
  out.integers("/contact/cells", model.cells.cast<std::int64_t>(), "1");
  write_shapes(out, "/contact/vertex_", model.vertex_shapes);
  out.vector("/contact/vertex_tangential_stiffness", model.vertex_tangential_stiffness,
             stiffness_unit);
  out.vector("/contact/vertex_tangential_stiffness_r", model.vertex_second_stiffness,
             stiffness_unit);
  out.vector("/contact/vertex_normal_stiffness", model.vertex_normal_stiffness, stiffness_unit);
  out.vector("/contact/vertex_friction_coefficient", model.vertex_friction_coefficient, "1");
  out.vector("/contact/vertex_preload", model.vertex_preload, "Pa");
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
  const Eigen::Index n_points = model.weights.size();
  check_size(file, "/damping_ratio", model.damping_ratio.size(), n_modes);
  check_size(file, "/force_sine", model.force_sine.size(), n_modes);
  check_size(file, "/force_cosine", model.force_cosine.size(), n_modes);
  check_size(file, "/force_static", model.force_static.size(), n_modes);
  check_size(file, "/output", model.output.size(), n_modes);
  check_size(file, "/contact/phi_u", model.shapes.u.rows(), n_points);
  check_size(file, "/contact/tangential_stiffness", model.tangential_stiffness.size(), n_points);
  check_size(file, "/contact/tangential_stiffness_r", model.second_stiffness.size(), n_points);
  check_size(file, "/contact/normal_stiffness", model.normal_stiffness.size(), n_points);
  check_size(file, "/contact/friction_coefficient", model.friction_coefficient.size(), n_points);
  check_size(file, "/contact/preload", model.preload.size(), n_points);
}

/// Three columns are part of the type; another width is a damaged or foreign file.
Eigen::MatrixX3d read_positions(const Hdf5Reader& in, const std::filesystem::path& file,
                                const std::string& name) {
  const Eigen::MatrixXd values = in.matrix(name);
  if (values.cols() != 3) throw SceneError(file.string() + ": dataset " + name + " is not n × 3");
  return values;
}

}  // namespace

void write_model(const std::filesystem::path& file, const ReducedModel& model) {
  Hdf5Writer out;
  out.text("program", "microslip");
  write_structure(out, model);
  write_points(out, model);
  write_vertices(out, model);
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
  model.points = read_positions(in, file, "/contact/points");
  model.weights = in.vector("/contact/weights");
  const Eigen::MatrixX3d frame = read_positions(in, file, "/contact/frame");
  check_size(file, "/contact/frame", frame.rows(), 3);
  model.frame = frame;
  model.shapes = read_shapes(in, "/contact/");
  model.tangential_stiffness = in.vector("/contact/tangential_stiffness");
  model.second_stiffness = in.vector("/contact/tangential_stiffness_r");
  model.normal_stiffness = in.vector("/contact/normal_stiffness");
  model.friction_coefficient = in.vector("/contact/friction_coefficient");
  model.preload = in.vector("/contact/preload");
  const Eigen::VectorXd degree = in.vector("/contact/fit_degree");
  check_size(file, "/contact/fit_degree", degree.size(), 1);
  model.fit_degree = static_cast<int>(degree[0]);
  model.fit_error = in.vector("/contact/fit_error");
  model.vertices = read_positions(in, file, "/contact/vertices");
  model.cells = in.integers("/contact/cells").cast<Eigen::Index>();
  model.vertex_shapes = read_shapes(in, "/contact/vertex_");
  model.vertex_tangential_stiffness = in.vector("/contact/vertex_tangential_stiffness");
  model.vertex_second_stiffness = in.vector("/contact/vertex_tangential_stiffness_r");
  model.vertex_normal_stiffness = in.vector("/contact/vertex_normal_stiffness");
  model.vertex_friction_coefficient = in.vector("/contact/vertex_friction_coefficient");
  model.vertex_preload = in.vector("/contact/vertex_preload");
  check_sizes(file, model);
  return model;
}

}  // namespace microslip::pipelines
