#include "pipelines/import/mesh_file.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/mesh_error.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_mesh_file {
namespace {

/// One tetrahedron of edge 60 with its foot as a node set.
constexpr const char* deck = R"(*NODE
1, 0, 0, 0
2, 60, 0, 0
3, 0, 60, 0
4, 0, 0, 60
*ELEMENT, TYPE=C3D4, ELSET=all
1, 1, 2, 3, 4
*NSET, NSET=foot
1, 2, 3
)";

class MeshFile : public testing::Test {
 protected:
  MeshFile() { ::unsetenv("MICROSLIP_CONVERTER"); }
  ~MeshFile() override { ::unsetenv("MICROSLIP_CONVERTER"); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }

  /// A converter that misbehaves.
  void convert_by(const std::string& body) const {
    ::setenv("MICROSLIP_CONVERTER", write("converter.py", body).c_str(), 1);
  }

  static std::string message_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const SceneError& error) {
      return error.what();
    } catch (const mesh::MeshError& error) {
      return error.what();
    }
    return "no error";
  }

  static std::string refusal(const std::filesystem::path& file,
                             const ConverterLimits& limits = {}) {
    return message_of([&] { static_cast<void>(read_mesh(file, 1.0, limits)); });
  }

 private:
  test::TemporaryFolder folder_;
};

void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
  }
}

TEST_F(MeshFile, IsReadWithTheUnitGiven) {
  const MeshOfFile read = read_mesh(write("blade.INP", deck), 1e-3);
  EXPECT_NEAR(read.mesh.volume(), 0.06 * 0.06 * 0.06 / 6.0, 1e-18);
  EXPECT_NEAR(read.mesh.surface("foot").area, 0.06 * 0.06 / 2.0, 1e-15);
}

TEST_F(MeshFile, APackedOneIsToldToBeUnpacked) {
  expect_words(refusal(write("blade.inp", "\x1f\x8b\b")),
               {"blade.inp: is packed by gzip", "gunzip"});
}

TEST(UnitQuestion, IsAskedWhereSceneAndFileSayAnotherUnit) {
  EXPECT_EQ(unit_question("bar.unv", 1e-3, 1e-3, 80.0), "");
  EXPECT_EQ(unit_question("bar.unv", std::nullopt, 1e-3, 80.0), "");
  EXPECT_EQ(unit_question("bar.inp", 1e-3, std::nullopt, 80.0), "");
  EXPECT_EQ(unit_question("bar.med", 0.01, 1e-3, 80.0)
                .find("model.length_unit: 0.01 m is written, and "
                      "bar.med says 0.001 m"),
            0U);
  expect_words(unit_question("bar.unv", 1e-3, 1.0, 0.08), {"bar.unv says 1 m", "Salome writes m"});
  EXPECT_EQ(unit_question("bar.unv", 1e-3, 1.0, 80.0), "");  // no blade of 80 m
  EXPECT_NE(unit_question("bar.med", 1e-3, 1.0, 80.0), "");
}

TEST_F(MeshFile, AMissingUnitIsAskedForWithTheSizesThereAre) {
  const MeshFileModel model{
      write("blade.inp", deck), std::nullopt, "blade.toml:4: model.file", {}, {}, {}};
  EXPECT_FALSE(read_mesh(model.file, std::nullopt).length_unit.has_value());
  expect_words(message_of([&] { static_cast<void>(read_mesh(model)); }),
               {"blade.toml:4", "model.length_unit", "60 x 60 x 60 m", "60 x 60 x 60 mm",
                "1.52 x 1.52 x 1.52 m"});
}

/// A second part that nothing but a tie holds.
constexpr const char* tied = R"(*NODE
11, 0, 0, -90
12, 60, 0, -90
13, 0, 60, -90
14, 0, 0, -30
*ELEMENT, TYPE=C3D4
2, 11, 12, 13, 14
*TIE, NAME=joint
foot, top
*EQUATION
2
1, 1, 1., 14, 1, -1.
)";

TEST_F(MeshFile, ATieIsAnErrorOfAMeshAndARemarkWhereTheModesAreGiven) {
  const std::filesystem::path file = write("tied.inp", std::string(deck) + tied);
  MeshFileModel model{file, 1e-3, "blade.toml:4: model.file", {}, {}, {}};
  expect_words(message_of([&] { static_cast<void>(read_mesh(model)); }),
               {"tied.inp:17: *TIE is not read", "another structure"});
  model.modes.emplace();
  const mesh::Mesh mesh = read_mesh(model);
  EXPECT_EQ(mesh.n_elements(), 2);
  ASSERT_EQ(mesh.remarks().size(), 2U);
  expect_words(mesh.remarks()[0], {"tied.inp:17: *TIE is no part of the mesh"});
  expect_words(mesh.remarks()[1], {"tied.inp:19: *EQUATION"});
}

TEST_F(MeshFile, ErrorsAreToldByFileAndLine) {
  EXPECT_EQ(refusal("no/such.inp"), "no/such.inp: no such file");
  expect_words(refusal(write("cut.inp", std::string(deck).substr(0, 30))),
               {"cut.inp:4", "three coordinates"});
  expect_words(
      refusal(write("short.inp", "*NODE\n1, 0, 0\n2\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n")),
      {"short.inp:3", "three coordinates"});
  expect_words(
      refusal(write("unknown.bdf",
                    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
                    "GRID,5,,1.,1.,1.\nCTETRA,1,1,1,2,3,4\nCTETX,2,1,2,3,4,5\n"
                    "CTRIA3,3,2,2,3,5\nENDDATA\n")),
      {"unknown.bdf:7: CTETX is not read; bodies are CTETRA", "1 face belongs to no"});
  std::string wrong = deck;
  wrong.replace(wrong.find("60, 0, 0"), 2, "x");
  expect_words(refusal(write("wrong.inp", wrong)), {"wrong.inp:3", "\"x\""});
  std::string turned = deck;
  turned.replace(turned.find("1, 1, 2, 3"), 10, "1, 2, 1, 3");
  expect_words(refusal(write("turned.inp", turned)), {"bad-mesh: ", "turned.inp: 1 of 1 elements"});
}

TEST_F(MeshFile, WhatIsNoMeshIsToldBeforeItIsReadWhole) {
  for (const char* ending : {".inp", ".unv", ".vtu", ".e", ".msh"}) {
    const std::filesystem::path zeros = write(std::string("zeros") + ending, "");
    std::filesystem::resize_file(zeros, 1U << 30U);
    const std::clock_t begin = std::clock();
    expect_words(refusal(zeros), {std::string("zeros") + ending});
    EXPECT_LT(std::clock() - begin, CLOCKS_PER_SEC) << ending;
  }
  expect_words(refusal(write("letters.inp", std::string(100000, 'a'))), {"letters.inp:1", "line"});
}

/// What a lost block of a disk leaves; binary data may hold what text may not.
TEST_F(MeshFile, ZerosInTextAreToldBeforeItIsReadWhole) {
  const std::vector<std::pair<std::string, std::string>> begins{
      {"zeros.inp", "*NODE\n1,0.,0.,0.\n"},
      {"zeros.bdf", "BEGIN BULK\nGRID,1,,0.,0.,0.\n"},
      {"zeros.unv", "    -1\n  2411\n"},
      {"zeros.vtk", "# vtk DataFile Version 3.0\nmesh\nASCII\n"},
      {"zeros.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n"}};
  for (const auto& [name, begin] : begins) {
    const std::filesystem::path zeros = write(name, begin);
    std::filesystem::resize_file(zeros, 1U << 30U);
    const std::clock_t before = std::clock();
    expect_words(refusal(zeros), {name + ":", "a byte of value 0"});
    EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC) << name;
  }
  for (const auto& [name, begin] :
       {std::pair<std::string, std::string>{"some.vtk",
                                            "# vtk DataFile Version 3.0\nmesh\nBINARY\n"},
        {"some.vtu", "<VTKFile>\n<AppendedData encoding=\"raw\">\n_"}}) {
    const std::filesystem::path some = write(name, begin);
    std::filesystem::resize_file(some, 200);
    EXPECT_EQ(refusal(some).find("a byte of value 0"), std::string::npos) << refusal(some);
  }
}

/// Memory is limited to what the user's own limit leaves (`ulimit -v`).
TEST_F(MeshFile, IsReadUnderALowerLimitOfTheUser) {
  const std::filesystem::path file = write("blade.inp", deck);
  const rlimit low{3600, 3600};  // s of processor time: a limit of memory would bind this test too
  ASSERT_EQ(setrlimit(RLIMIT_CPU, &low), 0);
  EXPECT_EQ(refusal(file, {7200.0, 1000.0}), "no error");
}

TEST_F(MeshFile, AConverterThatMisbehavesIsAnError) {
  const std::filesystem::path file = write("blade.inp", deck);
  convert_by("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n");
  expect_words(refusal(file), {"blade.inp: it cannot be converted", "signal 11"});
  convert_by("pass\n");
  expect_words(refusal(file), {"blade.inp", "left nothing"});
  convert_by("import time\ntime.sleep(100)\n");
  const auto begin = std::chrono::steady_clock::now();
  expect_words(refusal(file, {1.0, 1000.0}), {"blade.inp", "took longer than"});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace microslip::pipelines::test_mesh_file
