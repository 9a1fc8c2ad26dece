#include "pipelines/files/write_vtk.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesh/shape_functions.hpp"
#include "pipelines/files/vtk_file.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {
namespace {

using Face = std::vector<vtkIdType>;

int cell_type(mesh::ElementType type) {
  switch (type) {
    case mesh::ElementType::tet4:
      return VTK_TETRA;
    case mesh::ElementType::tet10:
      return VTK_QUADRATIC_TETRA;
    case mesh::ElementType::hex8:
      return VTK_HEXAHEDRON;
    case mesh::ElementType::hex20:
      return VTK_QUADRATIC_HEXAHEDRON;
    case mesh::ElementType::wedge6:
      return VTK_WEDGE;
    case mesh::ElementType::wedge15:
      return VTK_QUADRATIC_WEDGE;
    case mesh::ElementType::pyramid5:
      return VTK_PYRAMID;
    case mesh::ElementType::pyramid13:
      return VTK_QUADRATIC_PYRAMID;
  }
  throw std::invalid_argument("element type without a VTK cell");
}

/// Nodes of a cell. The first triangle of VTK's linear wedge looks outward; of all else the order
/// is ours (mesh/element_type.hpp). VTK's headers say the same of the quadratic wedge, but its
/// shape functions and what reads such files (meshio, gmsh) count that one as we do.
std::vector<vtkIdType> cell_nodes(
    mesh::ElementType type, const Eigen::Ref<const Eigen::RowVectorX<Eigen::Index>>& element) {
  std::vector<vtkIdType> nodes(element.begin(), element.end());
  if (type == mesh::ElementType::wedge6) {
    std::swap(nodes[1], nodes[2]);
    std::swap(nodes[4], nodes[5]);
  }
  return nodes;
}

/// The mesh as VTK sees it.
vtkSmartPointer<vtkUnstructuredGrid> make_grid(const mesh::Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.n_nodes());
  for (Eigen::Index node = 0; node < mesh.n_nodes(); ++node) {
    points->SetPoint(node, mesh.nodes()(node, 0), mesh.nodes()(node, 1), mesh.nodes()(node, 2));
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->Allocate(mesh.n_elements());
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto& element : block.connectivity.rowwise()) {
      const std::vector<vtkIdType> nodes = cell_nodes(block.type, element);
      grid->InsertNextCell(cell_type(block.type), static_cast<vtkIdType>(nodes.size()),
                           nodes.data());
    }
  }
  return grid;
}

void add_names(vtkPointData& data, const mesh::Mesh& mesh, const std::string& prefix,
               const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    Eigen::VectorXi inside = Eigen::VectorXi::Zero(mesh.n_nodes());
    for (const Eigen::Index node : mesh.node_set(name)) inside[node] = 1;
    add_integers(data, prefix + name, inside);
  }
}

/// Displacements [x y z] per node from one column of degrees of freedom.
Eigen::MatrixX3d per_node(const Eigen::Ref<const Eigen::VectorXd>& dofs) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      dofs.data(), dofs.size() / 3, 3);
}

/// Corner nodes of the faces that belong to one element only, in the element's outward order.
std::vector<Face> outer_faces(const mesh::Mesh& mesh) {
  struct Found {
    Face corners;
    int count = 0;
  };
  std::map<Face, Found> found;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const std::vector<int>& face : mesh::faces(mesh::linear(block.type))) {
      for (Eigen::Index element = 0; element < block.connectivity.rows(); ++element) {
        Face corners;
        for (const int node : face) corners.push_back(block.connectivity(element, node));
        Face key = corners;
        std::ranges::sort(key);
        Found& entry = found[key];
        entry.corners = std::move(corners);
        ++entry.count;
      }
    }
  }
  std::vector<Face> outer;
  for (auto& [key, entry] : found) {
    if (entry.count == 1) outer.push_back(std::move(entry.corners));
  }
  return outer;
}

/// The outer faces with nodes of their own.
struct Skin {
  std::vector<Eigen::Index> nodes;  ///< mesh node of each skin node
  vtkSmartPointer<vtkPolyData> surface = vtkSmartPointer<vtkPolyData>::New();
};

Skin make_skin(const mesh::Mesh& mesh) {
  Skin skin;
  std::map<vtkIdType, vtkIdType> numbers;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  for (Face& face : outer_faces(mesh)) {
    for (vtkIdType& node : face) {
      const auto [entry, is_new] =
          numbers.try_emplace(node, static_cast<vtkIdType>(skin.nodes.size()));
      if (is_new) {
        skin.nodes.push_back(node);
        points->InsertNextPoint(mesh.nodes()(node, 0), mesh.nodes()(node, 1),
                                mesh.nodes()(node, 2));
      }
      node = entry->second;
    }
    faces->InsertNextCell(static_cast<vtkIdType>(face.size()), face.data());
  }
  skin.surface->SetPoints(points);
  skin.surface->SetPolys(faces);
  return skin;
}

/// Rows of Φ at the nodes of the skin, x y z per node.
Eigen::MatrixXd skin_shapes(const Skin& skin, const Eigen::MatrixXd& shapes) {
  Eigen::MatrixXd rows(3 * static_cast<Eigen::Index>(skin.nodes.size()), shapes.cols());
  for (std::size_t i = 0; i < skin.nodes.size(); ++i) {
    rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = shapes.middleRows<3>(3 * skin.nodes[i]);
  }
  return rows;
}

/// What ParaView colours by its size as it opens the file, and "Warp By Vector" takes first.
void show_first(vtkPointData& data, const char* name) {
  data.SetActiveVectors(name);
  data.SetActiveScalars(name);
}

}  // namespace

void write_modes_vtu(const std::filesystem::path& file, const mesh::Mesh& mesh,
                     const fem::ModalBasis& basis) {
  const auto grid = make_grid(mesh);
  for (Eigen::Index mode = 0; mode < basis.shapes.cols(); ++mode) {
    add_array(*grid->GetPointData(), "mode_" + std::to_string(mode + 1),
              per_node(basis.shapes.col(mode)));
  }
  show_first(*grid->GetPointData(), "mode_1");
  add_names(*grid->GetPointData(), mesh, "surface_", mesh.surface_names());
  add_names(*grid->GetPointData(), mesh, "set_", mesh.node_set_names());
  add_array(*grid->GetFieldData(), "frequency_Hz", basis.frequency / (2.0 * std::numbers::pi));
  write_vtk_file(file, *grid);
}

std::vector<std::string> write_motion(const std::filesystem::path& folder, const std::string& name,
                                      const mesh::Mesh& mesh, const fem::ModalBasis& basis,
                                      const contact::Harmonics& q, double frequency_hz,
                                      int n_phases) {
  make_folder(folder);
  const Skin skin = make_skin(mesh);
  const Eigen::MatrixXd shapes = skin_shapes(skin, basis.shapes);
  std::vector<std::pair<double, std::string>> steps;
  for (int step = 0; step < n_phases; ++step) {
    const double turn = static_cast<double>(step) / n_phases;
    const Eigen::VectorXd displacement = shapes * q.at(2.0 * std::numbers::pi * turn);
    vtkNew<vtkPolyData> frame;
    frame->ShallowCopy(skin.surface);
    add_float_array(*frame->GetPointData(), "displacement_m", per_node(displacement));
    show_first(*frame->GetPointData(), "displacement_m");
    add_array(*frame->GetFieldData(), "frequency_Hz", Eigen::VectorXd::Constant(1, frequency_hz));
    const std::string frame_name = step_name(name, step, ".vtp");
    write_vtk_file(folder / frame_name, *frame);
    steps.emplace_back(360.0 * turn, frame_name);
  }
  std::vector<std::string> names{name + ".pvd"};
  for (const auto& [phase, frame] : steps) names.push_back(frame);
  steps.emplace_back(360.0, steps.front().second);
  write_pvd(folder / names.front(), steps);
  return names;
}

}  // namespace microslip::pipelines
