/// @file
/// A small made-up run for the tests of the writers: a patch of quadrilateral cells that tilts and
/// slides, one resonance with a fold. The numbers are smooth formulas, different for every entry,
/// so that a swapped row or column shows.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines::synthetic {

inline constexpr Eigen::Index n_modes = 2;

/// A folder of its own under the system's temporary folder, removed at the end.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("microslip_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  Folder(Folder&&) = delete;
  Folder& operator=(Folder&&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline contact::ModalShapes shapes_at(const Eigen::MatrixX3d& x) {
  contact::ModalShapes shapes{Eigen::MatrixXd(x.rows(), n_modes),
                              Eigen::MatrixXd(x.rows(), n_modes),
                              Eigen::MatrixXd(x.rows(), n_modes)};
  for (Eigen::Index mode = 0; mode < n_modes; ++mode) {
    const double k = static_cast<double>(mode + 1);
    shapes.u.col(mode) = 1.0 + 20.0 * k * x.col(2).array();
    shapes.v.col(mode) = 40.0 * k * x.col(0).array() - 0.2;
    shapes.w.col(mode) = 0.1 * k * x.col(1).array();
  }
  return shapes;
}

/// n_p × n_r cells of 2 mm × 1 mm in the plane y = 0.05 m; p = z, q = y, r = −x.
inline ReducedModel model(Eigen::Index n_p = 6, Eigen::Index n_r = 8) {
  constexpr double length = 2e-3;
  constexpr double width = 1e-3;
  ReducedModel m;
  m.frequency = Eigen::Vector2d(296.123456789012, 1234.5) * 2.0 * std::numbers::pi;
  m.damping_ratio = Eigen::Vector2d(0.002, 0.003);
  m.force_sine = Eigen::Vector2d(0.1, -0.2);
  m.force_cosine = Eigen::Vector2d(0.3, 0.0);
  m.force_static = Eigen::Vector2d(0.0, 1e-3);
  m.output = Eigen::Vector2d(0.9, 0.35);
  contact::Patch& patch = m.patches.emplace_back();
  patch.name = "contact";
  contact::PatchSamples& cells = patch.cells;
  contact::PatchSamples& vertices = patch.vertices;
  patch.frame << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  vertices.points.resize((n_p + 1) * (n_r + 1), 3);
  for (Eigen::Index i = 0; i <= n_p; ++i) {
    for (Eigen::Index j = 0; j <= n_r; ++j) {
      vertices.points.row(i * (n_r + 1) + j) << -width * static_cast<double>(j), 0.05,
          length * static_cast<double>(i);
    }
  }
  patch.connectivity.resize(n_p * n_r, 4);
  for (Eigen::Index i = 0; i < n_p; ++i) {
    for (Eigen::Index j = 0; j < n_r; ++j) {
      const Eigen::Index corner = i * (n_r + 1) + j;
      patch.connectivity.row(i * n_r + j) << corner, corner + 1, corner + n_r + 2, corner + n_r + 1;
    }
  }
  cells.points.resize(patch.connectivity.rows(), 3);
  for (Eigen::Index cell = 0; cell < patch.connectivity.rows(); ++cell) {
    cells.points.row(cell) = (vertices.points.row(patch.connectivity(cell, 0)) +
                              vertices.points.row(patch.connectivity(cell, 2))) /
                             2;
  }
  const Eigen::Index n = cells.points.rows();
  cells.weights = Eigen::VectorXd::Constant(n, length * width);
  cells.shapes = shapes_at(cells.points);
  cells.stiffness.resize(n, 3);
  cells.stiffness.col(0) = Eigen::VectorXd::LinSpaced(n, 1e11, 2e11);
  cells.stiffness.col(2) = Eigen::VectorXd::LinSpaced(n, 2e11, 9e11);
  cells.stiffness.col(1) = Eigen::VectorXd::LinSpaced(n, 3e11, 1e12);
  cells.friction = Eigen::VectorXd::LinSpaced(n, 0.3, 0.5);
  cells.preload_field = Eigen::VectorXd::Constant(n, 1.0 / cells.weights.sum());
  patch.fit_degree = 3;
  patch.fit_error = Eigen::Vector2d(1e-6, 2e-5);
  vertices.shapes = shapes_at(vertices.points);
  const Eigen::Index n_vertices = vertices.points.rows();
  vertices.stiffness.resize(n_vertices, 3);
  vertices.stiffness.col(0) = Eigen::VectorXd::LinSpaced(n_vertices, 1e11, 2e11);
  vertices.stiffness.col(2) = Eigen::VectorXd::LinSpaced(n_vertices, 2e11, 9e11);
  vertices.stiffness.col(1) = Eigen::VectorXd::LinSpaced(n_vertices, 3e11, 1e12);
  vertices.friction = Eigen::VectorXd::LinSpaced(n_vertices, 0.3, 0.5);
  vertices.preload_field = Eigen::VectorXd::Constant(n_vertices, cells.preload_field[0]);
  return m;
}

/// A load that travels over the patch: every state occurs at most phases.
inline contact::ContactMap map_at(const Eigen::MatrixX3d& x, int n_phases) {
  const Eigen::Index n = x.rows();
  contact::ContactMap map;
  map.phase.resize(n_phases);
  map.state.resize(n, n_phases);
  for (Eigen::MatrixXd* field : {&map.normal_traction, &map.friction_traction,
                                 &map.relative_displacement, &map.approach, &map.slip}) {
    field->resize(n, n_phases);
  }
  for (int j = 0; j < n_phases; ++j) {
    const double phase = 2.0 * std::numbers::pi * j / n_phases;
    map.phase[j] = phase;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double load = 0.6 + std::sin(phase + 250.0 * x(i, 0)) + 30.0 * x(i, 2);
      const double slide = std::cos(phase + 200.0 * x(i, 2));
      using contact::ContactState;
      const ContactState moving =
          slide > 0 ? ContactState::positive_slip : ContactState::negative_slip;
      const ContactState state = load <= 0.0             ? ContactState::separated
                                 : std::abs(slide) > 0.6 ? moving
                                                         : ContactState::stick;
      map.state(i, j) = static_cast<std::uint8_t>(state);
      map.normal_traction(i, j) = 1e6 * std::max(0.0, load);
      map.friction_traction(i, j) = 3e5 * slide * std::max(0.0, load);
      map.relative_displacement(i, j) = 1e-6 * slide;
      map.approach(i, j) = 1e-7 * load;
      map.slip(i, j) = 5e-7 * slide;
    }
  }
  map.friction_coefficient = Eigen::VectorXd::LinSpaced(n, 0.3, 0.5);
  map.dissipated_energy = Eigen::VectorXd::LinSpaced(n, 0.0, 2.0);
  map.slip_distance = Eigen::VectorXd::LinSpaced(n, 0.0, 4e-6);
  map.wear_depth = Eigen::VectorXd::LinSpaced(n, 0.0, 1e-12);
  map.state_start.resize(n, 5);
  map.state_start << Eigen::VectorXd::LinSpaced(n, 0.5, 1.0),
      Eigen::VectorXd::LinSpaced(n, 1.0, 2.0), Eigen::VectorXd::LinSpaced(n, 4.0, 5.0),
      Eigen::VectorXd::LinSpaced(n, 3.0, 3.5), Eigen::VectorXd::Zero(n);
  map.state_starts = map.state_start;
  map.state_share = Eigen::MatrixXd::Constant(n, 5, 0.2);
  map.state_share.col(3) = Eigen::VectorXd::LinSpaced(n, 0.3, 0.0);
  map.slip_guard = Eigen::VectorXd::LinSpaced(n, -2e5, 5e5);
  map.smallest_load = Eigen::VectorXd::LinSpaced(n, -1e5, 3e5);
  map.largest_load = Eigen::VectorXd::LinSpaced(n, 4e5, 9e5);
  map.slip_duration = Eigen::VectorXd::LinSpaced(n, 0.0, 0.7);
  map.separation_duration = Eigen::VectorXd::LinSpaced(n, 0.3, 0.0);
  return map;
}

inline NamedMap named_map(const ReducedModel& m, const std::string& name, int n_phases = 8) {
  const contact::Patch& patch = m.patches.front();
  return {name,
          301.25,
          2e-4,
          solver::Stability::stable,
          0,
          map_at(patch.cells.points, n_phases),
          patch.connectivity.rows() > 0 ? map_at(patch.vertices.points, n_phases)
                                        : contact::ContactMap{}};
}

/// One point whose numbers are all different.
inline solver::ResponsePoint point(double frequency_hz, double amplitude) {
  solver::ResponsePoint p;
  p.frequency = 2.0 * std::numbers::pi * frequency_hz;
  p.q = contact::Harmonics(1, n_modes,
                           Eigen::VectorXd::LinSpaced(3 * n_modes, 1.0, 6.0) / 3.0 * amplitude);
  p.amplitude = amplitude;
  p.first_amplitude = 0.99 * amplitude;
  p.mean = -0.01 * amplitude;
  p.phase = -std::numbers::pi / 4;
  p.residual = 1e-13;
  p.energy_imbalance = 2e-13;
  p.dissipation_mismatch = 3e-13;
  p.report = {0.5, 0.3, 0.2, 0.125, 1e-5};
  p.stability = solver::Stability::stable;
  p.iterations = 3;
  return p;
}

/// A Duffing-like branch that leans to lower frequencies: rises stable, turns at two folds with an
/// unstable part between, one peak.
inline CurveResult curve(const std::string& name, double preload, double peak_hz, double height,
                         double lean) {
  CurveResult result;
  result.name = name;
  result.load = preload;
  const double width = 1.2;  // [Hz], half-power
  double last = -1.0;
  for (int i = 0; i <= 240; ++i) {
    // The backbone bends with the square of the amplitude; s runs along the branch.
    const double s = (i - 120) / 6.0;
    const double amplitude = height / std::sqrt(1.0 + s * s);
    const double bend = lean * (amplitude / height) * (amplitude / height);
    const double frequency = peak_hz + width * s - bend + lean;
    solver::ResponsePoint p = point(frequency, amplitude);
    p.stability = frequency < last ? solver::Stability::unstable : solver::Stability::stable;
    if (i == 120) p.mark = solver::PointMark::peak;
    const bool turned = i > 0 && (frequency < last) != (result.curve.points.back().stability ==
                                                        solver::Stability::unstable);
    if (turned) p.mark = solver::PointMark::fold;
    last = frequency;
    result.curve.points.push_back(p);
  }
  result.curve.complete = true;
  result.curve.iterations = 700;
  result.curve.contact_evaluations = 900;
  result.curve.seconds = 0.25;
  return result;
}

}  // namespace microslip::pipelines::synthetic
