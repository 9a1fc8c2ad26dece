#include "pipelines/files/hdf5_file.hpp"

#include <hdf5.h>

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>, "handles are kept as 64-bit integers");

template <typename Scalar>
using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// An HDF5 handle that closes itself.
template <herr_t (*close)(hid_t)>
class Hdf5Handle {
 public:
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle(Hdf5Handle&&) = delete;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
};
using Properties = Hdf5Handle<&H5Pclose>;
using Space = Hdf5Handle<&H5Sclose>;
using Type = Hdf5Handle<&H5Tclose>;
using Dataset = Hdf5Handle<&H5Dclose>;
using Attribute = Hdf5Handle<&H5Aclose>;

/// What the library can only fail at for want of memory while it builds a file in memory.
void require(bool done, const std::string& name) {
  if (!done) throw ExhaustedError("HDF5 could not build dataset " + name + " in memory");
}

void write_text_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), value.size() + 1);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Space space(H5Screate(H5S_SCALAR));
  const Attribute attribute(
      H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
  require(attribute.valid() && H5Awrite(attribute.get(), type.get(), value.c_str()) >= 0, name);
}

void write_dataset(hid_t file, const std::string& name, std::span<const hsize_t> dimensions,
                   hid_t type, const void* data, const std::string& unit) {
  const Space space(
      H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr));
  const Properties links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.get(), 1);
  const Properties timeless(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(timeless.get(), false);  // equal contents are equal files
  const Dataset dataset(
      H5Dcreate2(file, name.c_str(), type, space.get(), links.get(), timeless.get(), H5P_DEFAULT));
  require(dataset.valid(), name);
  const bool empty = H5Sget_simple_extent_npoints(space.get()) == 0;
  require(empty || H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, name);
  write_text_attribute(dataset.get(), "unit", unit);
}

template <typename Scalar>
void write_matrix(hid_t file, const std::string& name, const RowMajor<Scalar>& values, hid_t type,
                  const std::string& unit) {
  const std::array<hsize_t, 2> dimensions{static_cast<hsize_t>(values.rows()),
                                          static_cast<hsize_t>(values.cols())};
  write_dataset(file, name, dimensions, type, values.data(), unit);
}

std::mutex& library() {
  static std::mutex one;
  return one;
}

}  // namespace

Hdf5Writer::Hdf5Writer() : turn_(library()) {
  const Properties memory(H5Pcreate(H5P_FILE_ACCESS));
  constexpr std::size_t growth = 1U << 20U;  // bytes added at a time
  H5Pset_fapl_core(memory.get(), growth, false);
  file_ = H5Fcreate("in_memory.h5", H5F_ACC_TRUNC, H5P_DEFAULT, memory.get());
  require(file_ >= 0, "/");
}

Hdf5Writer::~Hdf5Writer() { H5Fclose(file_); }

void Hdf5Writer::vector(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& values,
                        const std::string& unit) {
  const std::array<hsize_t, 1> dimensions{static_cast<hsize_t>(values.size())};
  write_dataset(file_, name, dimensions, H5T_NATIVE_DOUBLE, values.data(), unit);
}

void Hdf5Writer::matrix(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& values,
                        const std::string& unit) {
  write_matrix<double>(file_, name, values, H5T_NATIVE_DOUBLE, unit);
}

void Hdf5Writer::integers(const std::string& name, const Hdf5Integers& values,
                          const std::string& unit) {
  write_matrix<std::int64_t>(file_, name, values, H5T_NATIVE_INT64, unit);
}

void Hdf5Writer::bytes(const std::string& name, const Hdf5Bytes& values, const std::string& unit) {
  write_matrix<std::uint8_t>(file_, name, values, H5T_NATIVE_UINT8, unit);
}

void Hdf5Writer::text(const std::string& name, const std::string& value) {
  write_text_attribute(file_, name, value);
}

void Hdf5Writer::write(const std::filesystem::path& file) {
  require(H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0, "/");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  require(size > 0, "/");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  require(H5Fget_file_image(file_, image.data(), image.size()) == size, "/");
  write_whole(file, image);
}

}  // namespace microslip::pipelines
