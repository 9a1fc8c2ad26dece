#include "pipelines/files/model_file.hpp"

#include <string>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/hdf5_file.hpp"

namespace microslip::pipelines {
namespace {

void write_structure(Hdf5Writer& out, const ReducedModel& model) {
  for (const auto& array : model_arrays()) {
    out.vector(std::string("/") + array.name, array.get(model), array.unit);
  }
}

/// Datasets of one patch begin with this: /contact/, /contact_2/, …
std::string folder_of(std::size_t patch) {
  return patch == 0 ? "/contact/" : "/contact_" + std::to_string(patch + 1) + "/";
}

void write_samples(Hdf5Writer& out, const std::string& stem, const contact::PatchSamples& samples) {
  for (const auto& array : shape_arrays()) {
    out.matrix(stem + array.name, array.get(samples), array.unit);
  }
  const bool any = samples.size() > 0;
  for (const auto& array : sample_arrays()) {
    out.vector(stem + array.name, any ? array.get(samples) : Eigen::VectorXd(), array.unit);
  }
}

void write_patch(Hdf5Writer& out, const std::string& folder, const contact::Patch& patch) {
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

}  // namespace

void write_model(const std::filesystem::path& file, const ReducedModel& model) {
  Hdf5Writer out;
  out.text("program", "microslip");
  write_structure(out, model);
  if (model.patches.empty()) write_patch(out, folder_of(0), {});  // datasets without elements
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    write_patch(out, folder_of(i), model.patches[i]);
    if (model.patches.size() > 1) {
      out.text(folder_of(i).substr(1, folder_of(i).size() - 2), model.patches[i].name);
    }
  }
  out.write(file);
}

}  // namespace microslip::pipelines
