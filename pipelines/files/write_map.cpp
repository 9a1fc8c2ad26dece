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
void require_rows(const char* what, const NamedMap& map, Eigen::Index rows, Eigen::Index expected) {
  if (rows == expected) return;
  throw std::invalid_argument("map " + map.name + " has " + std::to_string(rows) + " " + what +
                              ", the model has " + std::to_string(expected));
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

void add_cycle_totals(vtkDataSetAttributes& data, const contact::ContactMap& map) {
  for (Eigen::Index state = 0; state < map.state_start.cols(); ++state) {
    const char* stem = state_stems()[static_cast<std::size_t>(state)];
    for (const auto& array : state_arrays()) {
      add_array(data, fmt::format("{}_{}", stem, array.name), array.get(map, state));
    }
    for (const auto& array : state_counts()) {
      add_integers(data, fmt::format("{}_{}", stem, array.name), array.get(map, state));
    }
  }
  for (const auto& array : cycle_arrays()) {
    const Eigen::VectorXd& values = map.*array.values;
    if (values.size() > 0) add_array(data, array.name, values);
  }
}

void add_instant(vtkDataSetAttributes& data, const contact::ContactMap& map, Eigen::Index phase) {
  add_integers(data, state_entry.name, map.state.col(phase).cast<int>());
  for (const auto& array : instant_arrays()) {
    const Eigen::MatrixXd& values = map.*array.values;
    if (values.size() > 0) add_array(data, array.name, values.col(phase));
  }
}

double in_degrees(double phase) {
  const double exact = phase * (180.0 / std::numbers::pi);
  const double rounded = std::round(exact * 1e6) / 1e6;  // 45, not 45.00000000000001
  return std::abs(rounded - exact) < 1e-9 ? rounded : exact;
}

/// @return names of its files.
std::vector<std::string> write_series(const std::filesystem::path& folder,
                                      const contact::Patch& patch, const NamedMap& map) {
  const auto surface = make_surface(patch);
  const bool smooth = map.vertices.phase.size() > 0;
  const bool points_only = patch.connectivity.rows() == 0;
  std::vector<std::pair<double, std::string>> steps;
  for (Eigen::Index step = 0; step < map.points.phase.size(); ++step) {
    vtkNew<vtkPolyData> frame;
    frame->ShallowCopy(surface);
    add_instant(*frame->GetCellData(), map.points, step);
    add_cycle_totals(*frame->GetCellData(), map.points);
    frame->GetCellData()->SetActiveScalars(
        state_entry.name);  // what ParaView colours by on opening: crisp
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
  std::vector<std::string> names{map.name + ".pvd"};
  for (const auto& [phase, name] : steps) names.push_back(name);
  if (!steps.empty()) steps.emplace_back(360.0, steps.front().second);
  write_pvd(folder / names.front(), steps);
  return names;
}

/// Transition angles, shares of the period and fields of the period under names that begin with
/// `stem`.
void write_transitions(Hdf5Writer& out, const std::string& stem, const contact::ContactMap& map) {
  for (const auto& array : transition_arrays()) {
    out.matrix(stem + array.name, array.get(map), array.unit);
  }
  for (const auto& array : cycle_arrays()) {
    const Eigen::VectorXd& values = map.*array.values;
    if (values.size() > 0) out.vector(stem + array.name, values, array.unit);
  }
}

void write_map_data(const std::filesystem::path& file, const contact::Patch& patch,
                    const NamedMap& map) {
  const auto at_root = [](const auto& array) { return fmt::format("/{}", array.name); };
  Hdf5Writer out;
  out.text("program", "microslip");
  for (const auto& array : map_arrays()) out.vector(at_root(array), array.get(map), array.unit);
  for (const auto& array : map_places()) out.matrix(at_root(array), array.get(patch), array.unit);
  for (const auto& array : weight_arrays()) {
    out.vector(at_root(array), array.get(patch), array.unit);
  }
  for (const auto& array : cell_arrays()) {
    out.integers(at_root(array), array.get(patch), array.unit);
  }
  out.bytes(at_root(state_entry), map.points.state, state_entry.unit);
  for (const auto& array : instant_arrays()) {
    const Eigen::MatrixXd& values = map.points.*array.values;
    if (values.size() > 0) out.matrix(at_root(array), values, array.unit);
  }
  write_transitions(out, "/", map.points);
  if (map.vertices.phase.size() > 0) {
    out.bytes(fmt::format("/vertex_{}", state_entry.name), map.vertices.state, state_entry.unit);
    write_transitions(out, "/vertex_", map.vertices);
  }
  out.write(file);
}

}  // namespace

std::vector<std::string> write_map(const std::filesystem::path& folder, const contact::Patch& patch,
                                   const NamedMap& map) {
  const Eigen::Index n = patch.cells.weights.size();
  require_rows("contact points", map, map.points.state.rows(), n);
  if (patch.connectivity.rows() > 0) require_rows("cells", map, patch.connectivity.rows(), n);
  if (patch.connectivity.rows() > 0 && map.vertices.phase.size() > 0) {
    require_rows("vertices", map, map.vertices.state.rows(), patch.vertices.points.rows());
  }
  make_folder(folder);
  std::vector<std::string> names = write_series(folder, patch, map);
  names.push_back(map.name + ".h5");
  write_map_data(folder / names.back(), patch, map);
  return names;
}

}  // namespace microslip::pipelines
