/// @file
/// Reads written VTK files back for the tests, with the library.
#pragma once

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace microslip::pipelines {

template <typename Reader>
auto read_vtk(const std::filesystem::path& file) {
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkSmartPointer<std::remove_pointer_t<decltype(reader->GetOutput())>>(reader->GetOutput());
}

inline auto read_vtp(const std::filesystem::path& file) {
  return read_vtk<vtkXMLPolyDataReader>(file);
}

inline auto read_vtu(const std::filesystem::path& file) {
  return read_vtk<vtkXMLUnstructuredGridReader>(file);
}

/// Tuples × components; 0 × 0 when there is no such array.
inline Eigen::MatrixXd values(vtkFieldData& data, const std::string& name) {
  vtkDataArray* array = data.GetArray(name.c_str());
  if (array == nullptr) return {};
  Eigen::MatrixXd result(array->GetNumberOfTuples(), array->GetNumberOfComponents());
  for (Eigen::Index row = 0; row < result.rows(); ++row) {
    for (Eigen::Index column = 0; column < result.cols(); ++column) {
      result(row, column) = array->GetComponent(row, static_cast<int>(column));
    }
  }
  return result;
}

/// Value of an XML attribute in a line; empty when it is not there.
inline std::string attribute(const std::string& line, const std::string& name) {
  const std::string key = name + "=\"";
  const std::size_t begin = line.find(key);
  if (begin == std::string::npos) return "";
  const std::size_t value = begin + key.size();
  return line.substr(value, line.find('"', value) - value);
}

/// (time, file) of every entry of a .pvd.
inline std::vector<std::pair<double, std::string>> pvd_steps(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::pair<double, std::string>> steps;
  for (std::string line; std::getline(in, line);) {
    if (line.find("<DataSet ") == std::string::npos) continue;
    steps.emplace_back(std::stod(attribute(line, "timestep")), attribute(line, "file"));
  }
  return steps;
}

}  // namespace microslip::pipelines
