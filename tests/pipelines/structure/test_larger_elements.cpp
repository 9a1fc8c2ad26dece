#include "pipelines/structure/larger_elements.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/machine.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines::test_larger_elements {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr Eigen::Index n_modes = 4;

/// Large elements: each mesh and its modes take a quarter of a second.
SceneDescription blade(const std::vector<std::string>& overrides = {"accuracy.tolerance=0.02"}) {
  std::vector<std::string> all{"model.element_size=\"20 mm\"", "modes.count=4"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_scene(MICROSLIP_SCENES "/blade_to_ground.toml", all);
}

const mesh::Mesh& blade_mesh() {
  static const mesh::Mesh mesh = [] {
    const TemporaryFolder folder;
    return obtain_mesh(blade(), folder.path() / "mesh.msh");
  }();
  return mesh;
}

const SolvedStructure& solved_here(double factor) {
  static const SolvedStructure twice = on_larger_elements(blade(), 2.0, n_modes);
  static const SolvedStructure four_times = on_larger_elements(blade(), 4.0, n_modes);
  return factor == 2.0 ? twice : four_times;
}

void expect_same_bits(const SolvedStructure& one, const SolvedStructure& other) {
  EXPECT_EQ(one.mesh.nodes(), other.mesh.nodes());
  EXPECT_EQ(one.modes.basis.frequency, other.modes.basis.frequency);
  EXPECT_EQ(one.modes.basis.shapes, other.modes.basis.shapes);
  ASSERT_TRUE(one.modes.richer && other.modes.richer);
  EXPECT_EQ(one.modes.richer->basis.shapes, other.modes.richer->basis.shapes);
}

/// A program that tells its number, one line each time it is started, then goes on with `command`.
class Script {
 public:
  explicit Script(const std::string& command) {
    std::ofstream(program()) << "#!/bin/sh\necho $$ >> " << told().string() << '\n'
                             << command << '\n';
    fs::permissions(program(), fs::perms::owner_all);
  }
  [[nodiscard]] fs::path program() const { return folder_.path() / "program"; }
  [[nodiscard]] std::vector<pid_t> started() const {
    std::vector<pid_t> numbers;
    std::ifstream in(told());
    for (pid_t number = 0; in >> number;) numbers.push_back(number);
    return numbers;
  }

 private:
  [[nodiscard]] fs::path told() const { return folder_.path() / "told"; }
  TemporaryFolder folder_;
};

/// Where the machine has one core there is nothing beside.
class LargerElementsBeside : public testing::Test {
 protected:
  void SetUp() override {
    if (describe_machine().cores < 2) GTEST_SKIP() << "one core";
    // The program takes other kernels than this process where a processor is newer than OpenBLAS.
    using CoreName = char*();
    auto* name = reinterpret_cast<CoreName*>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
    if (name != nullptr) ::setenv("OPENBLAS_CORETYPE", name(), 1);
  }
};

TEST_F(LargerElementsBeside, HaveTheBitsOfThoseSolvedHere) {
  const Script script("exec " MICROSLIP_PROGRAM " \"$@\"");
  LargerElements larger(blade(), blade_mesh(), 2, script.program());
  ASSERT_TRUE(larger.began());
  expect_same_bits(larger.twice(n_modes), solved_here(2.0));
  expect_same_bits(larger.four_times(n_modes), solved_here(4.0));
  EXPECT_EQ(script.started().size(), 2U);
}

TEST_F(LargerElementsBeside, AreSolvedAgainWhereMoreModesAreWanted) {
  LargerElements larger(blade(), blade_mesh(), 2);
  expect_same_bits(larger.twice(n_modes + 1), on_larger_elements(blade(), 2.0, n_modes + 1));
}

// Of what is asked for closely, modes reach the harmonics chosen.
TEST_F(LargerElementsBeside, AreMeshesAloneWhereTheNumberOfModesIsNotKnown) {
  const SceneDescription close = blade({"accuracy.tolerance=0.01"});
  ASSERT_GT(close.settings.basis.reach, 0.0);
  const Script script("exec " MICROSLIP_PROGRAM " \"$@\"");
  LargerElements larger(close, blade_mesh(), 2, script.program());
  expect_same_bits(larger.twice(n_modes), solved_here(2.0));
  EXPECT_TRUE(script.started().empty());
}

TEST_F(LargerElementsBeside, AreSolvedHereWhereTheProgramFailsOrIsNotThere) {
  for (const char* program : {"/bin/false", "/nowhere/microslip"}) {
    LargerElements larger(blade(), blade_mesh(), 2, program);
    EXPECT_TRUE(larger.began()) << program;
    expect_same_bits(larger.twice(n_modes), solved_here(2.0));
    expect_same_bits(larger.four_times(n_modes), solved_here(4.0));
  }
}

TEST_F(LargerElementsBeside, EndAtOnceWithWhoWantsThem) {
  const Script script("exec sleep 60");
  std::optional<LargerElements> larger(std::in_place, blade(), blade_mesh(), 2, script.program());
  const auto patience = Clock::now() + 30s;  // for the mesh, on a machine that others use
  while (script.started().empty() && Clock::now() < patience) std::this_thread::sleep_for(5ms);
  ASSERT_EQ(script.started().size(), 1U);
  const auto begin = Clock::now();
  larger.reset();
  EXPECT_LT(Clock::now() - begin, 1s);
  EXPECT_NE(::kill(script.started().front(), 0), 0) << "the process is there still";
}

TEST(LargerElements, AreNotBegunWithoutACoreOrWithAnEndOfTime) {
  EXPECT_FALSE(LargerElements(blade(), blade_mesh(), 1).began());
  EXPECT_FALSE(LargerElements(blade({}), blade_mesh(), 2).began());
  begin_deadline(1000.0);
  EXPECT_FALSE(LargerElements(blade(), blade_mesh(), 2).began());
  begin_deadline(std::numeric_limits<double>::infinity());
}

TEST(SolverProcess, SaysThatAFileHoldsNoTask) {
  const TemporaryFolder folder;
  const fs::path task = folder.path() / "task";
  write_whole(task, std::string("nonsense"));
  for (const fs::path& file : {task, folder.path() / "none"}) {
    const ChildResult ended = run_child(
        {MICROSLIP_PROGRAM, solver_word, file.string(), (folder.path() / "modes").string()}, 60s);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_NE(ended.message.find("no task of this program"), std::string::npos) << ended.message;
  }
  EXPECT_EQ(run_child({MICROSLIP_PROGRAM, solver_word}, 60s).exit_code, 1);
}

}  // namespace
}  // namespace microslip::pipelines::test_larger_elements
