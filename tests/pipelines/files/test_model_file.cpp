#include "pipelines/files/model_file.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines {
namespace {

void expect_same_structure(const ReducedModel& a, const ReducedModel& b) {
  EXPECT_EQ(a.frequency, b.frequency);
  EXPECT_EQ(a.damping_ratio, b.damping_ratio);
  EXPECT_EQ(a.force_sine, b.force_sine);
  EXPECT_EQ(a.force_cosine, b.force_cosine);
  EXPECT_EQ(a.force_static, b.force_static);
  EXPECT_EQ(a.output, b.output);
}

void expect_same_shapes(const contact::ModalShapes& a, const contact::ModalShapes& b) {
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.w, b.w);
}

void expect_same_samples(const contact::PatchSamples& a, const contact::PatchSamples& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.weights, b.weights);
  expect_same_shapes(a.shapes, b.shapes);
  EXPECT_EQ(a.stiffness, b.stiffness);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.preload, b.preload);
}

void expect_same_contact(const ReducedModel& a, const ReducedModel& b) {
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    const contact::Patch& one = a.patches[i];
    const contact::Patch& other = b.patches[i];
    EXPECT_EQ(one.frame, other.frame);
    EXPECT_EQ(one.fit_degree, other.fit_degree);
    EXPECT_EQ(one.fit_error, other.fit_error);
    EXPECT_EQ(one.connectivity, other.connectivity);
    expect_same_samples(one.cells, other.cells);
    expect_same_samples(one.vertices, other.vertices);
  }
}

std::string read_failure(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_model(file));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(ModelFile, ReadsBackBitForBit) {
  const synthetic::Folder folder("model");
  const ReducedModel model = synthetic::model();
  write_model(folder.path() / "model.h5", model);
  const ReducedModel back = read_model(folder.path() / "model.h5");
  expect_same_structure(back, model);
  expect_same_contact(back, model);
}

TEST(ModelFile, SeveralPatchesReadBackInOrder) {
  const synthetic::Folder folder("model_patches");
  ReducedModel model = synthetic::model();
  model.patches.push_back(synthetic::model(2, 3).patches[0]);
  model.patches[1].cells.friction *= 0.5;
  write_model(folder.path() / "model.h5", model);
  const ReducedModel back = read_model(folder.path() / "model.h5");
  expect_same_contact(back, model);
  EXPECT_EQ(back.patches[1].name, "contact_2");
}

TEST(ModelFile, ModelWithoutContactOrCellsReadsBack) {
  const synthetic::Folder folder("model_bare");
  ReducedModel model;
  model.frequency = model.damping_ratio = model.output = Eigen::Vector2d(1.0, 2.0);
  model.force_sine = model.force_cosine = model.force_static = Eigen::Vector2d(3.0, 4.0);
  write_model(folder.path() / "model.h5", model);
  const ReducedModel back = read_model(folder.path() / "model.h5");
  expect_same_structure(back, model);
  expect_same_contact(back, model);
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

TEST(ModelFile, MissingAndForeignFilesAreNamed) {
  const synthetic::Folder folder("model_missing");
  EXPECT_NE(read_failure(folder.path() / "none.h5").find("none.h5"), std::string::npos);
  write_whole(folder.path() / "text.h5", "frequency 1 2 3");
  EXPECT_NE(read_failure(folder.path() / "text.h5").find("text.h5"), std::string::npos);
}

TEST(ModelFile, TruncatedFileIsASceneErrorWhereverItIsCut) {
  const synthetic::Folder folder("model_cut");
  write_model(folder.path() / "whole.h5", synthetic::model());
  std::ifstream in(folder.path() / "whole.h5", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (const double part : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    const auto size = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
    write_whole(folder.path() / "cut.h5", std::string_view(bytes).substr(0, size));
    EXPECT_NE(read_failure(folder.path() / "cut.h5").find("cut.h5"), std::string::npos) << part;
  }
}

TEST(ModelFile, ArraysThatDoNotFitTogetherAreNamed) {
  const synthetic::Folder folder("model_sizes");
  ReducedModel model = synthetic::model();
  model.output.conservativeResize(1);
  write_model(folder.path() / "model.h5", model);
  EXPECT_NE(read_failure(folder.path() / "model.h5").find("/output has 1 rows, expected 2"),
            std::string::npos);
}

}  // namespace
}  // namespace microslip::pipelines
