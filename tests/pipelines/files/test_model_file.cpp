#include "pipelines/files/model_file.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "pipelines/system/output_file.hpp"
#include "tests/pipelines/hdf5_reading.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_model_file {
namespace {

void expect_structure(const std::filesystem::path& file, const ReducedModel& model) {
  EXPECT_EQ(dataset_of(file, "/angular_frequency"), model.frequency);
  EXPECT_EQ(dataset_of(file, "/damping_ratio"), model.damping_ratio);
  EXPECT_EQ(dataset_of(file, "/force_sine"), model.force_sine);
  EXPECT_EQ(dataset_of(file, "/force_cosine"), model.force_cosine);
  EXPECT_EQ(dataset_of(file, "/force_static"), model.force_static);
  EXPECT_EQ(dataset_of(file, "/output"), model.output);
}

void expect_samples(const std::filesystem::path& file, const std::string& stem,
                    const contact::PatchSamples& samples) {
  EXPECT_EQ(dataset_of(file, stem + "phi_u"), samples.shapes.u);
  EXPECT_EQ(dataset_of(file, stem + "phi_v"), samples.shapes.v);
  EXPECT_EQ(dataset_of(file, stem + "phi_w"), samples.shapes.w);
  EXPECT_EQ(dataset_of(file, stem + "tangential_stiffness"), samples.stiffness.col(0));
  EXPECT_EQ(dataset_of(file, stem + "normal_stiffness"), samples.stiffness.col(1));
  EXPECT_EQ(dataset_of(file, stem + "tangential_stiffness_r"), samples.stiffness.col(2));
  EXPECT_EQ(dataset_of(file, stem + "friction_coefficient"), samples.friction);
  EXPECT_EQ(dataset_of(file, stem + "preload"), samples.preload_field);
}

void expect_patch(const std::filesystem::path& file, const std::string& folder,
                  const contact::Patch& patch) {
  EXPECT_EQ(dataset_of(file, folder + "points"), patch.cells.points);
  EXPECT_EQ(dataset_of(file, folder + "weights"), patch.cells.weights);
  EXPECT_EQ(dataset_of(file, folder + "frame"), patch.frame);
  expect_samples(file, folder, patch.cells);
  EXPECT_EQ(dataset_of(file, folder + "fit_degree")(0, 0), patch.fit_degree);
  EXPECT_EQ(dataset_of(file, folder + "fit_error"), patch.fit_error);
  EXPECT_EQ(dataset_of(file, folder + "vertices"), patch.vertices.points);
  EXPECT_EQ(dataset_of(file, folder + "cells"), patch.connectivity.cast<double>());
  expect_samples(file, folder + "vertex_", patch.vertices);
}

TEST(ModelFile, HoldsTheModelBitForBit) {
  const synthetic::Folder folder("model");
  const std::filesystem::path file = folder.path() / "model.h5";
  const ReducedModel model = synthetic::model();
  write_model(file, model);
  expect_structure(file, model);
  expect_patch(file, "/contact/", model.patches[0]);
}

TEST(ModelFile, HoldsSeveralPatchesInOrder) {
  const synthetic::Folder folder("model_patches");
  const std::filesystem::path file = folder.path() / "model.h5";
  ReducedModel model = synthetic::model();
  model.patches.push_back(synthetic::model(2, 3).patches[0]);
  model.patches[1].cells.friction *= 0.5;
  write_model(file, model);
  expect_patch(file, "/contact/", model.patches[0]);
  expect_patch(file, "/contact_2/", model.patches[1]);
}

TEST(ModelFile, ModelWithoutContactHasDatasetsWithoutElements) {
  const synthetic::Folder folder("model_bare");
  const std::filesystem::path file = folder.path() / "model.h5";
  ReducedModel model;
  model.frequency = model.damping_ratio = model.output = Eigen::Vector2d(1.0, 2.0);
  model.force_sine = model.force_cosine = model.force_static = Eigen::Vector2d(3.0, 4.0);
  write_model(file, model);
  expect_structure(file, model);
  EXPECT_EQ(dataset_of(file, "/contact/weights").size(), 0);
  EXPECT_EQ(dataset_of(file, "/contact/phi_u").size(), 0);
  EXPECT_EQ(dataset_of(file, "/contact/vertex_preload").size(), 0);
}

TEST(ModelFile, NamesUnitsAndShapesAreThoseOfTheInterface) {
  const synthetic::Folder folder("model_names");
  const std::filesystem::path file = folder.path() / "model.h5";
  write_model(file, synthetic::model());
  const std::string script =
      "import sys, h5py\n"
      "f = h5py.File(sys.argv[1], 'r')\n"
      "for name, unit, shape in [('frequency_Hz', 'Hz', (2,)), ('damping_ratio', '1', (2,)),\n"
      "    ('contact/points', 'm', (48, 3)), ('contact/weights', 'm^2', (48,)),\n"
      "    ('contact/frame', '1', (3, 3)), ('contact/phi_u', '1/kg^0.5', (48, 2)),\n"
      "    ('contact/phi_v', '1/kg^0.5', (48, 2)), ('contact/phi_w', '1/kg^0.5', (48, 2)),\n"
      "    ('contact/tangential_stiffness', 'N/m^3', (48,)),\n"
      "    ('contact/normal_stiffness', 'N/m^3', (48,))]:\n"
      "    d = f[name]\n"
      "    assert d.shape == shape and d.attrs['unit'] in (unit, unit.encode()), (name, d.shape)\n"
      "assert abs(f['frequency_Hz'][0] - 296.123456789012) < 1e-12\n"
      "assert list(f['contact/frame'][0]) == [0, 0, 1]\n"
      "def units(name, item):\n"
      "    assert not isinstance(item, h5py.Dataset) or 'unit' in item.attrs, name\n"
      "f.visititems(units)\n";
  write_whole(folder.path() / "check.py", script);
  const std::string command =
      "/usr/bin/python3 " + (folder.path() / "check.py").string() + " " + file.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace microslip::pipelines::test_model_file
