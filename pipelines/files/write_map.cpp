#include "pipelines/files/write_map.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/hdf5_file.hpp"
#include "pipelines/files/vtk_file.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {
namespace {

const std::vector<std::string> state_names{"stick", "positive slip", "negative slip", "separated",
                                           "slip in two directions"};
const std::vector<std::string> start_names{"stick_start_deg", "positive_slip_start_deg",
                                           "negative_slip_start_deg", "separation_start_deg",
                                           "slip_start_deg"};
const std::vector<std::string> share_names{"stick_share", "positive_slip_share",
                                           "negative_slip_share", "separation_share", "slip_share"};
const std::vector<std::string> count_names{"stick_starts", "positive_slip_starts",
                                           "negative_slip_starts", "separation_starts",
                                           "slip_starts"};

void require_rows(const char* what, const NamedMap& map, Eigen::Index rows, Eigen::Index expected) {
  if (rows == expected) return;
  throw std::invalid_argument("map " + map.name + " has " + std::to_string(rows) + " " + what +
                              ", the model has " + std::to_string(expected));
}

/// Positions of the contact points [m]; a row along p where the model has none.
Eigen::MatrixX3d point_positions(const contact::Patch& patch) {
  const Eigen::MatrixX3d& points = patch.cells.points;
  const Eigen::Index n = patch.cells.weights.size();
  const bool given = points.rows() == n &&
                     (n < 2 || (points.rowwise() - points.row(0)).cwiseAbs().maxCoeff() > 0.0);
  if (given) return points;
  constexpr double spacing = 1e-3;  // [m]: a scale for pictures, nothing is computed from it
  Eigen::MatrixX3d row(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    row.row(i) = spacing * static_cast<double>(i) * patch.frame.row(0);
  }
  return row;
}

vtkSmartPointer<vtkPolyData> make_surface(const contact::Patch& patch) {
  const bool has_cells = patch.connectivity.rows() > 0;
  const Eigen::MatrixX3d positions = has_cells ? patch.vertices.points : point_positions(patch);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : positions.rowwise()) points->InsertNextPoint(x[0], x[1], x[2]);
  vtkNew<vtkCellArray> cells;
  if (has_cells) {
    for (const auto& cell : patch.connectivity.rowwise()) {
      const std::vector<vtkIdType> corners(cell.begin(), cell.end());
      cells->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
    }
  } else {
    for (vtkIdType point = 0; point < positions.rows(); ++point) cells->InsertNextCell(1, &point);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  if (has_cells) {
    surface->SetPolys(cells);
  } else {
    surface->SetVerts(cells);
  }
  return surface;
}

constexpr double degree = std::numbers::pi / 180.0;

/// How often each state begins, n × 5.
Eigen::MatrixXi start_counts(const contact::ContactMap& map) {
  const Eigen::Index n_states = map.state_share.cols();
  const Eigen::Index m = n_states > 0 ? map.state_starts.cols() / n_states : 0;
  Eigen::MatrixXi counts(map.state_share.rows(), n_states);
  for (Eigen::Index state = 0; state < n_states; ++state) {
    const auto starts = map.state_starts.middleCols(state * m, m).array();
    counts.col(state) = (starts == starts).cast<int>().rowwise().sum().matrix();
  }
  return counts;
}

void add_cycle_totals(vtkDataSetAttributes& data, const contact::ContactMap& map) {
  for (Eigen::Index state = 0; state < map.state_start.cols(); ++state) {
    add_array(data, start_names.at(static_cast<std::size_t>(state)),
              map.state_start.col(state) / degree);
  }
  const Eigen::MatrixXi counts = start_counts(map);
  for (Eigen::Index state = 0; state < counts.cols(); ++state) {
    const auto name = static_cast<std::size_t>(state);
    add_array(data, share_names.at(name), map.state_share.col(state));
    add_integers(data, count_names.at(name), counts.col(state));
  }
  for (const auto& array : cycle_arrays()) {
    const Eigen::VectorXd& values = map.*array.values;
    if (values.size() > 0) add_array(data, array.name, values);
  }
}

void add_instant(vtkDataSetAttributes& data, const contact::ContactMap& map, Eigen::Index phase) {
  add_integers(data, "state", map.state.col(phase).cast<int>());
  for (const auto& array : instant_arrays()) {
    const Eigen::MatrixXd& values = map.*array.values;
    if (values.size() > 0) add_array(data, array.name, values.col(phase));
  }
}

double in_degrees(double phase) {
  const double exact = phase / degree;
  const double rounded = std::round(exact * 1e6) / 1e6;  // 45, not 45.00000000000001
  return std::abs(rounded - exact) < 1e-9 ? rounded : exact;
}

void write_series(const std::filesystem::path& folder, const contact::Patch& patch,
                  const NamedMap& map) {
  const auto surface = make_surface(patch);
  const bool smooth = map.vertices.phase.size() > 0;
  const bool points_only = patch.connectivity.rows() == 0;
  std::vector<std::pair<double, std::string>> steps;
  for (Eigen::Index step = 0; step < map.points.phase.size(); ++step) {
    vtkNew<vtkPolyData> frame;
    frame->ShallowCopy(surface);
    add_instant(*frame->GetCellData(), map.points, step);
    add_cycle_totals(*frame->GetCellData(), map.points);
    frame->GetCellData()->SetActiveScalars("state");  // what ParaView colours by on opening: crisp
    if (smooth || points_only) {
      const contact::ContactMap& nodal = points_only ? map.points : map.vertices;
      add_instant(*frame->GetPointData(), nodal, step);
      add_cycle_totals(*frame->GetPointData(), nodal);
    }
    const double phase_deg = in_degrees(map.points.phase[step]);
    add_array(*frame->GetFieldData(), "frequency_Hz",
              Eigen::VectorXd::Constant(1, map.frequency_hz));
    add_array(*frame->GetFieldData(), "phase_deg", Eigen::VectorXd::Constant(1, phase_deg));
    add_texts(*frame->GetFieldData(), "state_names", state_names);
    const std::string name = step_name(map.name, static_cast<int>(step), ".vtp");
    write_vtk_file(folder / name, *frame);
    steps.emplace_back(phase_deg, name);
  }
  if (!steps.empty()) steps.emplace_back(360.0, steps.front().second);
  write_pvd(folder / (map.name + ".pvd"), steps);
}

/// Coordinates (p, r) in the plane of the patch, from its centroid where it has cells.
Eigen::MatrixXd in_plane(const contact::Patch& patch, const Eigen::MatrixX3d& positions) {
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();
  if (patch.connectivity.rows() > 0 && patch.cells.weights.sum() > 0.0) {
    origin = contact::centroid(patch).transpose();
  }
  const Eigen::MatrixX3d local = (positions.rowwise() - origin) * patch.frame.transpose();
  Eigen::MatrixXd plane(local.rows(), 2);
  plane << local.col(0), local.col(2);
  return plane;
}

/// Transition angles, shares of the period and fields of the period under names that begin with `stem`.
void write_transitions(Hdf5Writer& out, const std::string& stem, const contact::ContactMap& map) {
  out.matrix(stem + "state_start_deg", map.state_start / degree, "deg");
  out.matrix(stem + "state_starts_deg", map.state_starts / degree, "deg");
  out.matrix(stem + "state_share", map.state_share, "1");
  for (const auto& array : cycle_arrays()) {
    const Eigen::VectorXd& values = map.*array.values;
    if (values.size() > 0) out.vector(stem + array.name, values, array.unit);
  }
}

void write_map_data(const std::filesystem::path& file, const contact::Patch& patch,
                    const NamedMap& map) {
  Hdf5Writer out;
  out.text("program", "microslip");
  out.vector("/frequency_Hz", Eigen::VectorXd::Constant(1, map.frequency_hz), "Hz");
  out.vector("/amplitude_m", Eigen::VectorXd::Constant(1, map.amplitude), "m");
  out.vector("/stable", Eigen::VectorXd::Constant(1, static_cast<double>(map.stability)), "1");
  out.vector("/phase_deg", map.points.phase * (180.0 / std::numbers::pi), "deg");
  out.matrix("/points", in_plane(patch, point_positions(patch)), "m");
  out.vector("/weights", patch.cells.weights, "m^2");
  out.matrix("/vertices", in_plane(patch, patch.vertices.points), "m");
  out.integers("/cells", patch.connectivity.cast<std::int64_t>(), "1");
  out.bytes("/state", map.points.state, "1");
  for (const auto& array : instant_arrays()) {
    const Eigen::MatrixXd& values = map.points.*array.values;
    if (values.size() > 0) out.matrix(fmt::format("/{}", array.name), values, array.unit);
  }
  write_transitions(out, "/", map.points);
  if (map.vertices.phase.size() > 0) {
    out.bytes("/vertex_state", map.vertices.state, "1");
    write_transitions(out, "/vertex_", map.vertices);
  }
  out.write(file);
}

}  // namespace

void write_map(const std::filesystem::path& folder, const contact::Patch& patch,
               const NamedMap& map) {
  const Eigen::Index n = patch.cells.weights.size();
  require_rows("contact points", map, map.points.state.rows(), n);
  if (patch.connectivity.rows() > 0) require_rows("cells", map, patch.connectivity.rows(), n);
  if (patch.connectivity.rows() > 0 && map.vertices.phase.size() > 0) {
    require_rows("vertices", map, map.vertices.state.rows(), patch.vertices.points.rows());
  }
  make_folder(folder);
  write_series(folder, patch, map);
  write_map_data(folder / (map.name + ".h5"), patch, map);
}

}  // namespace microslip::pipelines
