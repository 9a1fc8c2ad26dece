#include "pipelines/files/write_vtk.hpp"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

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
  }
  throw std::invalid_argument("element type without a VTK cell");
}

/// The mesh as VTK sees it; the node order is the same (mesh/element_type.hpp).
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
      const std::vector<vtkIdType> nodes(element.begin(), element.end());
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
std::vector<Face> outer_faces(vtkUnstructuredGrid& grid) {
  struct Found {
    Face corners;
    int count = 0;
  };
  std::map<Face, Found> found;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    vtkCell* element = grid.GetCell(cell);
    for (int face = 0; face < element->GetNumberOfFaces(); ++face) {
      vtkCell* side = element->GetFace(face);
      const vtkIdType* ids = side->GetPointIds()->GetPointer(0);
      Face corners(ids, ids + side->GetNumberOfEdges());  // corners come first
      Face key = corners;
      std::ranges::sort(key);
      Found& entry = found[key];
      entry.corners = std::move(corners);
      ++entry.count;
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
  const auto grid = make_grid(mesh);
  for (Face& face : outer_faces(*grid)) {
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

}  // namespace

void write_modes_vtu(const std::filesystem::path& file, const mesh::Mesh& mesh,
                     const fem::ModalBasis& basis) {
  const auto grid = make_grid(mesh);
  for (Eigen::Index mode = 0; mode < basis.shapes.cols(); ++mode) {
    add_array(*grid->GetPointData(), "mode_" + std::to_string(mode + 1),
              per_node(basis.shapes.col(mode)));
  }
  grid->GetPointData()->SetActiveVectors("mode_1");  // what "Warp By Vector" takes first
  add_names(*grid->GetPointData(), mesh, "surface_", mesh.surface_names());
  add_names(*grid->GetPointData(), mesh, "set_", mesh.node_set_names());
  add_array(*grid->GetFieldData(), "frequency_Hz", basis.frequency / (2.0 * std::numbers::pi));
  write_vtk_file(file, *grid);
}

void write_motion(const std::filesystem::path& folder, const std::string& name,
                  const mesh::Mesh& mesh, const fem::ModalBasis& basis, const contact::Harmonics& q,
                  double frequency_hz, int n_phases) {
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
    frame->GetPointData()->SetActiveVectors("displacement_m");
    add_array(*frame->GetFieldData(), "frequency_Hz", Eigen::VectorXd::Constant(1, frequency_hz));
    const std::string frame_name = step_name(name, step, ".vtp");
    write_vtk_file(folder / frame_name, *frame);
    steps.emplace_back(360.0 * turn, frame_name);
  }
  steps.emplace_back(360.0, steps.front().second);
  write_pvd(folder / (name + ".pvd"), steps);
}

}  // namespace microslip::pipelines
