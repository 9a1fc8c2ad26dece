/// @file
/// Datasets of an HDF5 file as the tests of the writers read them.
#pragma once

#include <hdf5.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

namespace microslip::pipelines {

/// Numbers of any type, one column where there is one dimension.
/// @throws std::runtime_error  no such file or dataset; names it.
inline Eigen::MatrixXd dataset_of(const std::filesystem::path& file, const std::string& name) {
  const hid_t in = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = in < 0 ? in : H5Dopen2(in, name.c_str(), H5P_DEFAULT);
  if (set < 0) throw std::runtime_error(file.string() + ": no dataset " + name);
  const hid_t space = H5Dget_space(set);
  std::array<hsize_t, 2> size{0, 1};
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(
      static_cast<Eigen::Index>(size[0]), static_cast<Eigen::Index>(size[1]));
  if (values.size() > 0) {
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(in);
  return values;
}

}  // namespace microslip::pipelines
