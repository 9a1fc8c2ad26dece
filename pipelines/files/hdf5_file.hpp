/// @file
/// Arrays with units in an HDF5 file, by names such as "/contact/points". The file is made in
/// memory and written whole, so a full disk leaves no torso.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

#include <Eigen/Core>

namespace microslip::pipelines {

using Hdf5Integers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Hdf5Bytes = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Collects datasets; groups are created as names ask for them. One at a time lives in the process,
/// others wait for its end: the library takes one thread at a time.
class Hdf5Writer {
 public:
  Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  Hdf5Writer(Hdf5Writer&&) = delete;
  Hdf5Writer& operator=(Hdf5Writer&&) = delete;
  ~Hdf5Writer();

  /// One dimension. @param unit  attribute `unit` of the dataset; "1" where it has none.
  void vector(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& values,
              const std::string& unit);
  /// Two dimensions, rows × columns as the matrix reads.
  void matrix(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& values,
              const std::string& unit);
  void integers(const std::string& name, const Hdf5Integers& values, const std::string& unit);
  void bytes(const std::string& name, const Hdf5Bytes& values, const std::string& unit);
  /// A text attribute of the file itself.
  void text(const std::string& name, const std::string& value);

  /// @throws ExhaustedError  cannot be written.
  void write(const std::filesystem::path& file);

 private:
  std::unique_lock<std::mutex> turn_;
  std::int64_t file_ = -1;
};

}  // namespace microslip::pipelines
