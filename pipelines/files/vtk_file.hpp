/// @file
/// What the VTK writers share: arrays from Eigen, files written whole, series over phase. VTK
/// objects do not leave the write_* files that include this.
#pragma once

#include <vtkFieldData.h>
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace microslip::pipelines {

/// Adds n × 1 or n × 3 values as doubles under `name`.
void add_array(vtkFieldData& data, const std::string& name,
               const Eigen::Ref<const Eigen::MatrixXd>& values);
/// The same in single precision: for pictures that come in long series.
void add_float_array(vtkFieldData& data, const std::string& name,
                     const Eigen::Ref<const Eigen::MatrixXd>& values);
void add_integers(vtkFieldData& data, const std::string& name,
                  const Eigen::Ref<const Eigen::VectorXi>& values);
void add_texts(vtkFieldData& data, const std::string& name, const std::vector<std::string>& values);

/// Compressed XML, .vtu for an unstructured grid and .vtp for poly data, as `file` says.
/// @throws ExhaustedError  cannot be written.
void write_vtk_file(const std::filesystem::path& file, vtkPointSet& data);

/// A .pvd collection: (time, file name beside it) in order of time.
/// @throws ExhaustedError  cannot be written.
void write_pvd(const std::filesystem::path& file,
               const std::vector<std::pair<double, std::string>>& steps);

/// Zero-padded step number, so that names sort as time does.
[[nodiscard]] std::string step_name(const std::string& stem, int step,
                                    const std::string& extension);

}  // namespace microslip::pipelines
