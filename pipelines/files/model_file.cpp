#include "pipelines/files/model_file.hpp"

#include <string>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/hdf5_file.hpp"
#include "pipelines/system/byte_archive.hpp"

namespace microslip::pipelines {
namespace {

template <typename Writer>
void write_structure(Writer& out, const ReducedModel& model) {
  for (const auto& array : model_arrays()) {
    out.vector(std::string("/") + array.name, array.get(model), array.unit);
  }
}

/// Datasets of one patch begin with this: /contact/, /contact_2/, …
std::string folder_of(std::size_t patch) {
  return patch == 0 ? "/contact/" : "/contact_" + std::to_string(patch + 1) + "/";
}

template <typename Writer>
void write_samples(Writer& out, const std::string& stem, const contact::PatchSamples& samples) {
  for (const auto& array : shape_arrays()) {
    out.matrix(stem + array.name, array.get(samples), array.unit);
  }
  const bool any = samples.size() > 0;
  for (const auto& array : sample_arrays()) {
    out.vector(stem + array.name, any ? array.get(samples) : Eigen::VectorXd(), array.unit);
  }
}

template <typename Writer>
void write_patch(Writer& out, const std::string& folder, const contact::Patch& patch) {
  for (const auto& array : patch_places()) {
    out.matrix(folder + array.name, array.get(patch), array.unit);
  }
  for (const auto& array : weight_arrays()) {
    out.vector(folder + array.name, array.get(patch), array.unit);
  }
  for (const auto& array : cell_arrays()) {
    out.integers(folder + array.name, array.get(patch), array.unit);
  }
  for (const auto& array : fit_arrays()) {
    out.vector(folder + array.name, array.get(patch), array.unit);
  }
  write_samples(out, folder, patch.cells);
  write_samples(out, folder + "vertex_", patch.vertices);
}

template <typename Writer>
void write_arrays(Writer& out, const ReducedModel& model) {
  write_structure(out, model);
  if (model.patches.empty()) write_patch(out, folder_of(0), {});  // datasets without elements
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    write_patch(out, folder_of(i), model.patches[i]);
    if (model.patches.size() > 1) {
      out.text(folder_of(i).substr(1, folder_of(i).size() - 2), model.patches[i].name);
    }
  }
}

/// Values alone: which comes after which is the same for all models.
struct ArrayBytes {
  ByteWriter bytes;
  void text(const std::string& /*name*/, const std::string& value) { bytes(value); }
  template <typename Values>
  void vector(const std::string& /*name*/, const Values& values, const char* /*unit*/) {
    bytes(values);
  }
  template <typename Values>
  void matrix(const std::string& /*name*/, const Values& values, const char* /*unit*/) {
    bytes(values);
  }
  template <typename Values>
  void integers(const std::string& /*name*/, const Values& values, const char* /*unit*/) {
    bytes(values);
  }
};

}  // namespace

void write_model(const std::filesystem::path& file, const ReducedModel& model) {
  Hdf5Writer out;
  out.text("program", "microslip");
  write_arrays(out, model);
  out.write(file);
}

std::string arrays_of(const ReducedModel& model) {
  ArrayBytes out;
  write_arrays(out, model);
  return out.bytes.bytes();
}

}  // namespace microslip::pipelines
