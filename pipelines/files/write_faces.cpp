#include "pipelines/files/write_faces.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>
#include <chrono>

#include <nlohmann/json.hpp>

#include "pipelines/files/plot_script.hpp"
#include "pipelines/files/vtk_file.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

/// Per triangle the normal of its face.
Eigen::MatrixX3d normals_of(const mesh::StepGeometry& geometry) {
  Eigen::MatrixX3d normals(geometry.triangles.rows(), 3);
  auto face = geometry.faces.begin();
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    while (face->number != geometry.owner[static_cast<std::size_t>(i)]) ++face;
    normals.row(i) = face->normal;
  }
  return normals;
}

}  // namespace

void write_faces_vtp(const std::filesystem::path& file, const mesh::StepGeometry& geometry) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : geometry.nodes.rowwise()) points->InsertNextPoint(x[0], x[1], x[2]);
  vtkNew<vtkCellArray> triangles;
  for (const auto& corners : geometry.triangles.rowwise()) {
    const std::array<vtkIdType, 3> nodes{corners[0], corners[1], corners[2]};
    triangles->InsertNextCell(3, nodes.data());
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  add_integers(
      *surface->GetCellData(), "face",
      Eigen::Map<const Eigen::VectorXi>(geometry.owner.data(), std::ssize(geometry.owner)));
  add_array(*surface->GetCellData(), "normal", normals_of(geometry));
  surface->GetCellData()->SetActiveScalars("face");
  write_vtk_file(file, *surface);
}

std::string draw_faces(const std::filesystem::path& picture, const std::string& title,
                       const mesh::StepGeometry& geometry) {
  using namespace std::chrono_literals;
  using Json = nlohmann::json;
  Json nodes = Json::array();
  for (const auto& x : geometry.nodes.rowwise()) nodes.push_back({x[0], x[1], x[2]});
  Json triangles = Json::array();
  for (const auto& corners : geometry.triangles.rowwise()) {
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  const TemporaryFolder folder;
  const std::filesystem::path data = folder.path() / "faces.json";
  write_whole(
      data,
      Json{{"title", title}, {"nodes", nodes}, {"triangles", triangles}, {"face", geometry.owner}}
          .dump());
  return run_plot_script("plot_faces.py",
                         {data.string(), std::filesystem::absolute(picture).string()}, 120s);
}

}  // namespace microslip::pipelines
