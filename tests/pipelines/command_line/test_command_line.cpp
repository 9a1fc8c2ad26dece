/// The built program as a user meets it: exit codes, messages, and nothing half-written.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.hpp"

namespace microslip::test_command_line {
namespace {

using Json = nlohmann::json;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

const std::string table_header =
    "tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_sin,u_cos,v_mean,v_sin,"
    "v_cos\n";

constexpr const char* with_plots = "PYTHONPATH=";

constexpr const char* scene_text = R"([model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = 0.01
force_sine = [0.0, 0.3]
output = [0.9, 0.35]
points = [ { weight = 1, tangential_stiffness = 1e4, normal_stiffness = 1e4, friction_coefficient = 0.3, preload = 2, phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_1 = 0.1 } ]
[response]
frequency = [10, 30]
)";

/// A folder to work in, and the program run inside it, without plots.
class Program : public testing::Test {
 protected:
  Program() {
    ::setenv("PYTHONPATH", MICROSLIP_NO_PLOTS, 1);
    ::setenv("MICROSLIP_CACHE", "off", 1);
  }

  /// @param arguments  as typed in a shell.
  [[nodiscard]] Outcome run(const std::string& arguments,
                            const std::string& environment = "") const {
    std::string command = "cd '";
    command.append(folder()).append("' && ").append(environment);
    command.append(" '" MICROSLIP_PROGRAM "' ").append(arguments).append(" > .out 2> .err");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(path(".out")),
            content_of(path(".err"))};
  }

  /// The exit code, what standard error must hold, and that nothing looks like a crash.
  void expect(const std::string& arguments, int code, const std::vector<std::string>& parts) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.err;
    for (const std::string& part : parts) {
      EXPECT_NE(outcome.err.find(part), std::string::npos)
          << arguments << ": \"" << outcome.err << "\" lacks " << part;
    }
    for (const char* crash : {"terminate called", "what():", "internal error", "Aborted"}) {
      EXPECT_EQ(outcome.err.find(crash), std::string::npos) << arguments << "\n" << outcome.err;
    }
  }

  [[nodiscard]] std::string folder() const { return folder_.path().string(); }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(path(name));
  }

 private:
  test::TemporaryFolder folder_;
};

Json last_line(const std::string& out) {
  const std::string text = out.substr(0, out.find_last_not_of('\n') + 1);
  const auto begin = text.rfind('\n');
  return Json::parse(begin == std::string::npos ? text : text.substr(begin + 1));
}

// ---- help and misuse

TEST_F(Program, ExplainsEveryCommandAndOption) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* name : {"init", "check", "mesh", "modes", "run", "cycle", "converge", "report",
                           "--set", "--resume", "--no-cache", "--jobs", "--tolerance", "--budget",
                           "--dry-run", "--quiet", "--verbose", "--json", "--version"}) {
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
  }
  for (const char* command :
       {"init", "check", "mesh", "modes", "run", "cycle", "converge", "report"}) {
    const Outcome own = run(std::string(command) + " --help");
    EXPECT_EQ(own.code, 0) << command;
    EXPECT_NE(own.out.find("--set"), std::string::npos) << command;
  }
}

TEST_F(Program, TellsItsVersionBeforeAndAfterACommand) {
  for (const char* arguments : {"--version", "run --version"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, std::string("microslip ") + MICROSLIP_VERSION + "\n");
  }
}

TEST_F(Program, NamesWhatIsWrongWithACommandLine) {
  expect("", 1, {"expected a command", "run", "init"});
  expect("rnu scene.toml", 1, {"unknown command \"rnu\"", "did you mean \"run\"?"});
  expect("run", 1, {"scene"});
  expect("run scene.toml --tollerance 1%", 1, {"--tollerance", "did you mean --tolerance?"});
  expect("run scene.toml -j 0", 1, {"--jobs"});
  expect("run scene.toml -j many", 1, {"--jobs"});
  expect("run scene.toml -q -v", 1, {"--quiet"});
  expect("run scene.toml -o ''", 1, {"--output", "expected a name"});
  expect("run scene.toml --tolerance ''", 1, {"--tolerance", "expected a value"});
  expect("check a.toml b.toml", 1, {"b.toml"});
  expect("mesh scene.toml", 1, {"--output"});
  expect("check scene.toml --set", 1, {"--set"});
}

TEST_F(Program, KnowsAMeshAndAStepFileWhereASceneIsExpected) {
  write(path("blade.msh"), "$MeshFormat\n");
  write(path("blade.step"), "ISO-10303-21;\n");
  expect("run blade.msh", 1, {"blade.msh", "expected a scene", "init mesh blade.msh"});
  expect("check blade.step", 1, {"expected a scene", "init step blade.step"});
  expect("surfaces blade.step", 1, {"blade.step", "microslip faces"});
}

TEST_F(Program, SaysHowAQuantityIsWritten) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml --tolerance 5", 1, {"accuracy.tolerance", "did you mean 5 %?"});
  write(path("scene.toml"), std::string(scene_text) + "harmonic_tolerance = 1 %\n");
  expect("run scene.toml", 1, {"scene.toml:11:", "response.harmonic_tolerance", "quotes: \"1 %\""});
}

TEST_F(Program, SaysWhichNameOfAFolderCannotBe) {
  write(path("scene.toml"), scene_text);
  const std::string longer_than_names_are(300, 'n');
  expect("run scene.toml -o " + longer_than_names_are, 1, {"name too long"});
  std::filesystem::create_symlink("loop", path("loop"));
  expect("run scene.toml -o loop", 1, {"loop", "symbolic links"});
  std::filesystem::create_directories(path("locked/.lock"));
  expect("run scene.toml -o locked", 4, {"locked/.lock", "directory"});
}

TEST_F(Program, SaysWhyACurveIsIncompleteHoweverQuiet) {
  write(path("scene.toml"), scene_text);
  const Outcome outcome =
      run("run scene.toml -q --set 'modal.points[0].tangential_stiffness=5e16' --set "
          "response.harmonics=1");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("no-start"), std::string::npos) << outcome.err;
}

// Row 82. Hard: a curve that takes longer than anybody waits.
// Met in: random scenes of five harmonics.
// Right: exit 4 as `budget`, with the points it has.
TEST_F(Program, EndsACurveWhoseTimeIsOverWithWhatItHas) {
  write(path("scene.toml"), scene_text);
  for (const std::string method : {"harmonic_balance", "time"}) {
    const Outcome outcome =
        run("run scene.toml -q -o " + method + " --set response.method=" + method +
            " --set 'response.time_budget=1e-9 s'");
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("response.time_budget, 1e-09 s, is over; set it to more"),
              std::string::npos)
        << outcome.err;
    const Json summary = Json::parse(content_of(path(method + "/summary.json")));
    EXPECT_EQ(summary["exit_code"], 4);
    EXPECT_EQ(summary["curves"].at(0)["diagnosis"], "budget");
    EXPECT_TRUE(exists(method + "/curves/scale_1.csv"));
  }
}

TEST_F(Program, WritesTheEndsOfTheRangeAsTheyWereGiven) {
  write(path("scene.toml"), scene_text);
  EXPECT_EQ(
      run("run scene.toml -q -o r --set response.harmonics=1 --set 'response.frequency=[15, 30.7]'")
          .code,
      0);
  const std::string table = content_of(path("r/curves/scale_1.csv"));
  EXPECT_NE(table.find("\n15,"), std::string::npos);
  EXPECT_NE(table.find("\n30.7,"), std::string::npos);
  EXPECT_NE(content_of(path("r/modes.csv")).find("1,15.9,"), std::string::npos);
}

TEST_F(Program, RefusesOptionsThatACommandDoesNotKnow) {
  write(path("scene.toml"), scene_text);
  expect("--tolerance 1% modes scene.toml", 1, {"--tolerance", "not with modes"});
  expect("mesh --budget 60s scene.toml -o m.msh", 1, {"--budget", "not with mesh"});
  expect("--tolerance fast run scene.toml", 1, {"accuracy.tolerance", "off"});
  expect("converge --resume scene.toml", 1, {"--resume", "converge"});
  EXPECT_FALSE(exists("runs"));
}

TEST_F(Program, RefusesOptionsThatSayNothingToACommand) {
  write(path("t.csv"), table_header);
  expect("cycle t.csv --set modes.count=3", 1, {"--set", "cycle reads no scene"});
  expect("init modal --set modes.count=3", 1, {"--set"});
  expect("init modal --no-cache", 1, {"--no-cache"});
  expect("init modal --dry-run", 1, {"--dry-run"});
  expect("cycle t.csv --resume", 1, {"--resume", "run and modes"});
}

TEST_F(Program, ReadsACycleTableFromAPipe) {
  write(path("t.csv"), table_header + "1,1,0.5,1,3,1e-400,0,0.2,0\n");
  const Outcome piped = run("cycle /dev/stdin", "cat t.csv |");
  EXPECT_EQ(piped.code, 0) << piped.err;
  EXPECT_EQ(piped.out, run("cycle t.csv").out);
  expect("cycle .", 1, {"not a file"});
}

TEST_F(Program, EndsStandardOutputWithOneJsonObject) {
  write(path("scene.toml"), scene_text);
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n");
  const auto line = [&](const std::string& arguments) { return last_line(run(arguments).out); };
  const Json good = line("run scene.toml --json");
  EXPECT_EQ(good["exit_code"], 0);
  EXPECT_EQ(good["command"], "run");
  EXPECT_EQ(good["output"], "runs/scene");
  EXPECT_FALSE(good.contains("message"));
  const Json summary = Json::parse(content_of(path("runs/scene/summary.json")));
  EXPECT_EQ(good["curves"][0]["peak"], summary["curves"][0]["peak"]);
  EXPECT_GT(good["curves"][0]["peak"]["amplitude_m"], 0.0);
  EXPECT_EQ(good["curves"][0]["bar"], summary["curves"][0]["bar"]);
  EXPECT_TRUE(good["optimum"].is_null());
  const Json checked = line("check scene.toml --json");
  EXPECT_GT(checked["forecast"]["memory_GB"], 0.0);
  EXPECT_GT(checked["forecast"]["curves_seconds"], 0.0);
  ASSERT_TRUE(checked["effects"].is_array());
  EXPECT_TRUE(checked["effects"][0].contains("simulated"));
  EXPECT_GT(checked["forecast"]["plots_seconds"], 0.0);
  EXPECT_EQ(line("check scene.toml --without plots --json")["forecast"]["plots_seconds"], 0.0);
  const Json dry = line("run scene.toml --dry-run --json");
  EXPECT_EQ(dry["forecast"].size(), checked["forecast"].size());
  EXPECT_EQ(dry["forecast"]["memory_GB"], checked["forecast"]["memory_GB"]);
  // Seconds follow what other programs leave of the machine.
  EXPECT_GT(dry["forecast"]["curves_seconds"],
            0.1 * checked["forecast"]["curves_seconds"].get<double>());
  EXPECT_EQ(line("--json cycle t.csv")["exit_code"], 0);
  const Json bad = line("check none.toml --json");
  EXPECT_EQ(bad["exit_code"], 1);
  EXPECT_NE(bad["message"].get<std::string>().find("none.toml"), std::string::npos);
  EXPECT_EQ(line("check --json")["exit_code"], 1);
  EXPECT_EQ(line("chekc --json")["exit_code"], 1);
}

// ---- init, check

TEST_F(Program, ChecksItsOwnTemplates) {
  EXPECT_EQ(run("init modal -o modal.toml").code, 0);
  const Outcome checked = run("check modal.toml");
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_NE(checked.out.find("2 modes"), std::string::npos);
  EXPECT_EQ(run("init modal").out, content_of(path("modal.toml")));
  EXPECT_EQ(run("init").out, run("init blade").out);
}

TEST_F(Program, InitOverwritesNothing) {
  write(path("mine.toml"), "precious");
  expect("init modal -o mine.toml", 1, {"mine.toml", "exists"});
  EXPECT_EQ(content_of(path("mine.toml")), "precious");
  expect("init plate", 1, {"plate", "blade, step, mesh, modes, modal"});
}

TEST_F(Program, NamesBadScenes) {
  write(path("scene.toml"), scene_text);
  expect("check ''", 1, {"no such file"});
  expect("check none.toml", 1, {"none.toml: no such file"});
  expect("check .", 1, {"is a folder, not a file"});
  expect(std::string("check ").append(4200, 'x'), 1, {"too long"});
  expect("check scene.toml --set modal.frequncy=1", 1, {"--set modal.frequncy=1", "\"frequency\""});
  write(path("broken.toml"), std::string(scene_text) + "density = 1e\n");
  expect("check broken.toml", 1, {"broken.toml:11:"});
  write(path("mesh.toml"), run("init mesh").out);
  expect("check mesh.toml", 1, {"blade.msh", "no such file"});
  for (const char* law : {"{law='hyperbolic',static=0.3,rate=1e308}",
                          "{law='exponential',static=1e-300,kinetic=0.1,rate=1}"}) {
    expect(std::string("check scene.toml --set contact.friction_law=\"") + law + "\"", 1,
           {"friction_law", "from 1e-100 to 1e100"});
  }
}

// Row 93. Hard: a mesh that is a link to a device has no end.
// Met in: a link to a device as a mesh.
// Right: refused within 2 s, as is everything that is no file.
//
/// What has no end is not read to it: neither for the mesh nor to tell whether it has changed.
TEST_F(Program, AMeshWithoutEndIsRefusedAtOnce) {
  write(path("scene.toml"), run("init mesh").out);
  std::filesystem::create_symlink("/dev/zero", path("blade.msh"));
  for (const char* command :
       {"check scene.toml", "modes scene.toml -o out", "run scene.toml -o out"}) {
    const Outcome outcome = run(command, "ulimit -t 2;");  // seconds
    EXPECT_EQ(outcome.code, 1) << command;
    EXPECT_NE(outcome.err.find("blade.msh: not a file"), std::string::npos) << outcome.err;
  }
}

TEST_F(Program, WarnsOfAStructureThatNothingExcitesOrDamps) {
  write(path("scene.toml"), scene_text);
  const auto told = [&](const std::string& settings) {
    return run("check scene.toml" + settings).out;
  };
  EXPECT_EQ(told("").find("warning"), std::string::npos) << told("");
  EXPECT_NE(told(" --set modal.force_sine=[0,0]").find("warning: no force excites"),
            std::string::npos);
  EXPECT_NE(told(" --set modal.damping_ratio=[0.01,0]").find("warning: a mode has no damping"),
            std::string::npos);
  expect("check scene.toml --set 'modal.frequency=[1e200, 2]'", 1,
         {"modal.frequency", "size from 1e-100 to 1e100"});
}

TEST_F(Program, MeshesOnlyWhatHasAGeometry) {
  write(path("scene.toml"), scene_text);
  expect("mesh scene.toml -o m.msh", 1, {"model.kind", "\"blade\""});
  write(path("blade.toml"), run("init blade").out);
  const std::string coarse = " --set model.element_size=20mm";
  EXPECT_EQ(run("mesh blade.toml -o m.msh --dry-run" + coarse).code, 0);
  EXPECT_FALSE(exists("m.msh"));
  const Outcome meshed = run("mesh blade.toml -o m.msh" + coarse);
  EXPECT_EQ(meshed.code, 0) << meshed.err;
  EXPECT_TRUE(exists("m.msh"));
  expect("check blade.toml --set contact.surface=contct" + coarse, 1, {"contct", "\"contact\""});
  expect("mesh blade.toml -o no/such/folder/b.msh" + coarse, 1, {"no/such/folder"});
  expect("mesh blade.toml -o b.vtk" + coarse, 1, {"-o b.vtk", ".msh"});
}

TEST_F(Program, ReadsPathsWithSpacesAndLetters) {
  std::filesystem::create_directory(path("my scénes"));
  write(path("my scénes/a b.toml"), scene_text);
  EXPECT_EQ(run("check 'my scénes/a b.toml'").code, 0);
}

// ---- cycle

TEST_F(Program, WritesCyclesToStandardOutputOrAFile) {
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n1,1,0.5,1,1,0,0,2,0\n");
  const Outcome shown = run("cycle t.csv");
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_EQ(Json::parse(shown.out).size(), 2U);
  EXPECT_EQ(shown.err, "");
  EXPECT_EQ(run("cycle t.csv -o t.json").out, "");
  EXPECT_EQ(content_of(path("t.json")), shown.out);
  EXPECT_EQ(Json::parse(run("cycle t.csv --harmonics 3").out)[0]["friction"]["sin"].size(), 3U);
  expect("cycle t.csv --harmonics 0", 1, {"--harmonics"});
}

TEST_F(Program, MotionsTooSmallForAnyUnitAreNone) {
  const auto table = [](const char* amplitude) {
    return table_header + std::string("1,1,0.5,1,") + amplitude + ",0,0,0.2,0\n";
  };
  write(path("zero.csv"), table("0"));
  const std::string at_rest = run("cycle zero.csv").out;
  EXPECT_EQ(Json::parse(at_rest)[0]["regime"], "full_stick");
  for (const char* tiny : {"1e-101", "-1e-300", "5e-324"}) {
    write(path("tiny.csv"), table(tiny));
    EXPECT_EQ(run("cycle tiny.csv").out, at_rest) << tiny;
  }
  write(path("huge.csv"), table("1e101"));
  expect("cycle huge.csv", 1, {"huge.csv:2: u_sin", "1e101"});
}

TEST_F(Program, WritesNothingWhenARowIsBad) {
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n1,-1,0.5,1,1,0,0,2,0\n");
  write(path("old.json"), "old");
  expect("cycle t.csv -o old.json", 1, {"t.csv:3: normal_stiffness: -1 is negative"});
  EXPECT_EQ(content_of(path("old.json")), "old");
  EXPECT_EQ(run("cycle t.csv").out, "");
  expect("cycle t.csv -o new.json", 1, {"t.csv:3"});
  EXPECT_FALSE(exists("new.json"));
  expect("cycle none.csv", 1, {"none.csv: no such file"});
}

TEST_F(Program, ALargeFileThatIsNoTextIsRefusedAtItsBegin) {
  write(path("zeros.csv"), table_header);
  std::filesystem::resize_file(path("zeros.csv"), 900'000'000);  // sparse: takes no disk
  const auto begin = std::chrono::steady_clock::now();
  expect("cycle zeros.csv", 1, {"zeros.csv:2: a byte of value 0: this is no text"});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST_F(Program, PlotsCyclesIntoAFolder) {
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n1,1,0.5,1,1,0,0,2,0\n");
  const std::string plain = run("cycle t.csv").out;
  const Outcome drawn =
      run("cycle t.csv --plot below/loops", std::string("DISPLAY= ") + with_plots);
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_EQ(drawn.out, plain);
  for (const char* file : {"1.csv", "1.svg", "1.png", "2.csv", "2.svg", "2.png"}) {
    EXPECT_TRUE(exists(std::string("below/loops/") + file)) << file;
  }
  EXPECT_EQ(run("cycle t.csv --plot other --dry-run").code, 0);
  EXPECT_FALSE(exists("other"));
  expect("cycle t.csv --plot t.csv/below", 1, {"t.csv/below", "is a file"});
  expect("cycle t.csv --plot ''", 1, {"--plot", "folder"});
}

TEST_F(Program, DryRunWritesNothing) {
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n");
  write(path("scene.toml"), scene_text);
  EXPECT_EQ(run("cycle t.csv -o t.json --dry-run").code, 0);
  EXPECT_EQ(run("run scene.toml --dry-run").code, 0);
  EXPECT_FALSE(exists("t.json"));
  EXPECT_FALSE(exists("runs"));
}

TEST_F(Program, NumbersHaveAPointInAnyLocale) {
  write(path("t.csv"), table_header + "1.5,1,0.5,1,3,0,0,0.2,0\n");
  const std::string plain = run("cycle t.csv").out;
  for (const char* locale : {"LC_ALL=de_DE.UTF-8", "LC_ALL=fr_FR.UTF-8", "LC_ALL=nonsense"}) {
    EXPECT_EQ(run("cycle t.csv", locale).out, plain) << locale;
  }
}

// Row 59. Hard: a disk that is full from the begin.
// Met in: runs on full disks.
// Right: exit 4, what was there stays.
TEST_F(Program, AFullDiskIsExitFour) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  std::string command = "'" MICROSLIP_PROGRAM "' init modal > /dev/full 2> '";
  command.append(path("err").string()).append("'");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_NE(content_of(path("err")).find("standard output"), std::string::npos);
  write(path("scene.toml"), scene_text);
  command = "cd '" + folder() +
            "' && '" MICROSLIP_PROGRAM "' run scene.toml -q --json > /dev/full 2> err";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
  EXPECT_NE(content_of(path("err")).find("standard output"), std::string::npos);
}

/// Who reads the progress may leave before the end.
TEST_F(Program, ARunOutlivesTheReaderOfItsProgress) {
  write(path("scene.toml"), scene_text);
  const std::string command = "cd '" + folder() +
                              "' && { '" MICROSLIP_PROGRAM
                              "' run scene.toml -o out 2>&1; "
                              "echo $? > code; } | true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(content_of(path("code")), "0\n");
  EXPECT_EQ(Json::parse(content_of(path("out/summary.json")))["exit_code"], 0);
}

/// Not for want of disk: the command line names the wrong thing.
TEST_F(Program, AnOutputOfAnotherKindIsBadInput) {
  write(path("scene.toml"), scene_text);
  write(path("t.csv"), table_header + "1,1,0.5,1,3,0,0,0.2,0\n");
  for (const char* command : {"run", "modes"}) {
    expect(std::string(command) + " scene.toml -o t.csv", 1,
           {"-o t.csv", "is a file", "expected the name of a folder"});
    expect(std::string(command) + " scene.toml -o t.csv/below", 1,
           {"-o t.csv/below", "t.csv is a file"});
  }
  std::filesystem::create_directory(path("folder"));
  expect("cycle t.csv -o folder", 1, {"-o folder", "is a folder"});
  expect("cycle t.csv -o no/such/t.json", 1, {"-o no/such/t.json", "folder", "does not exist"});
  expect("init modal -o no/such/t.toml", 1, {"-o no/such/t.toml", "folder", "does not exist"});
  expect("cycle t.csv --plot scene.toml", 1, {"--plot scene.toml", "is a file"});
  EXPECT_EQ(content_of(path("scene.toml")), scene_text);
}

TEST_F(Program, ATableWithoutRowsIsAnEmptyListAndANotice) {
  write(path("t.csv"), table_header);
  const Outcome outcome = run("cycle t.csv");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "[]\n");
  EXPECT_NE(outcome.err.find("warning: t.csv: no rows below the header"), std::string::npos)
      << outcome.err;
}

// ---- start

/// Loading the libraries of finite elements takes longer than many a scene.
TEST_F(Program, LoadsItsLibrariesOnce) {
  const Outcome outcome = run("--version", "LD_DEBUG=statistics");
  ASSERT_EQ(outcome.code, 0);
  const std::string loaded = "total startup time";
  const auto first = outcome.err.find(loaded);
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(loaded, first + 1), std::string::npos) << outcome.err;
}

/// Kernels chosen by the program are those that OpenBLAS takes when it is told before it is loaded.
TEST_F(Program, KernelsChosenLateAreThoseChosenEarly) {
  write(path("scene.toml"), scene_text);
  ASSERT_EQ(run("run scene.toml -o late", "env -u OPENBLAS_CORETYPE").code, 0);
  const std::string blas = Json::parse(content_of(path("late/summary.json")))["machine"]["blas"];
  for (const char* kernels : {"SkylakeX", "Haswell"}) {
    if (blas.find(kernels) == std::string::npos) continue;
    ASSERT_EQ(run("run scene.toml -o early", std::string("OPENBLAS_CORETYPE=") + kernels).code, 0);
    EXPECT_EQ(Json::parse(content_of(path("early/summary.json")))["machine"]["blas"], blas);
    for (const char* file : {"curves/scale_1.csv", "curves/scale_1.states.csv"}) {
      EXPECT_EQ(content_of(path("late") / file), content_of(path("early") / file)) << file;
    }
  }
  if (__builtin_cpu_supports("avx2") != 0) {
    EXPECT_EQ(blas.find("Prescott"), std::string::npos) << blas;
  }
}

// ---- run on a modal scene

TEST_F(Program, RunsAModalSceneIntoAFolderOfWholeFiles) {
  write(path("scene.toml"), scene_text);
  const Outcome outcome =
      run("run scene.toml -o out --set response.preload_scale=[0.5,2]", with_plots);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name :
       {"scene.toml", "summary.json", "modes.csv", "model.h5", "log.txt", "curves/scale_0.5.csv",
        "curves/scale_2.states.csv", "plots/curves.png"}) {
    EXPECT_TRUE(exists(std::string("out/") + name)) << name;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
  const Json summary = Json::parse(content_of(path("out/summary.json")));
  EXPECT_EQ(summary["exit_code"], 0);
  EXPECT_EQ(summary["curves"].size(), 2U);
}

TEST_F(Program, LeavesOutWhatItIsToldTo) {
  write(path("scene.toml"), scene_text);
  EXPECT_EQ(
      run("run scene.toml -o out --set response.maps='[\"peak\"]' --without plots --without maps",
          with_plots)
          .code,
      0);
  EXPECT_TRUE(exists("out/report.md"));
  EXPECT_FALSE(exists("out/plots"));
  EXPECT_FALSE(exists("out/maps"));
  expect("run scene.toml -o out --without curves", 1, {"curves", "plots"});
}

/// The scene written into the run folder is a scene: run again,
/// it gives the same curve bit for bit.
TEST_F(Program, RunsTheSceneOfARunFolderToTheSameCurve) {
  write(path("scene.toml"), scene_text);
  ASSERT_EQ(run("run scene.toml -o one --set modal.damping_ratio='0.7 %'").code, 0);
  ASSERT_EQ(run("run one/scene.toml -o two").code, 0);
  EXPECT_EQ(content_of(path("one/curves/scale_1.csv")), content_of(path("two/curves/scale_1.csv")));
  EXPECT_EQ(content_of(path("one/scene.toml")), content_of(path("two/scene.toml")));
}

TEST_F(Program, ABadSceneLeavesNoRunFolder) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml --set modal.damping_ratio=-1", 1, {"damping_ratio", "negative"});
  EXPECT_FALSE(exists("runs"));
}

TEST_F(Program, RemovesNothingThatNoRunHasWritten) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml -q -o .", 1, {"-o .", "scene.toml", "choose another folder"});
  EXPECT_EQ(content_of(path("scene.toml")), scene_text);
  std::filesystem::create_directories(path("results/plots"));
  write(path("results/plots/mine.svg"), "mine");
  expect("run scene.toml -q -o results", 1, {"results", "plots", "choose another folder"});
  EXPECT_EQ(content_of(path("results/plots/mine.svg")), "mine");
  EXPECT_FALSE(exists("results/scene.toml"));
  write(path("log.txt"), "notes");
  expect("run scene.toml -q -o .", 1, {"-o .", "scene.toml", "choose another folder"});
  std::filesystem::create_directories(path("notes"));
  write(path("notes/log.txt"), "notes");
  expect("run scene.toml -q -o notes", 1, {"-o notes", "log.txt", "choose another folder"});
  EXPECT_EQ(content_of(path("notes/log.txt")), "notes");
}

TEST_F(Program, ARunReplacesAnEarlierOneWholeAndNothingElse) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml -q -o out --set response.preload_scale=[3,4]", 0, {});
  write(path("out/curves/mine.csv"), "mine");
  expect("run scene.toml -q -o out", 0, {});
  EXPECT_TRUE(exists("out/curves/scale_1.csv"));
  EXPECT_FALSE(exists("out/curves/scale_3.csv"));
  EXPECT_EQ(content_of(path("out/curves/mine.csv")), "mine");
  EXPECT_EQ(Json::parse(content_of(path("out/summary.json")))["exit_code"], 0);
}

/// A run that is refused after the folder was looked at leaves the results before as they were,
/// and tells its own end.
TEST_F(Program, ABadRunCostsNothingOfTheOneBefore) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml -q -o out", 0, {});
  const Json before = Json::parse(content_of(path("out/summary.json")));
  write(path("mesh.toml"),
        "[model]\nkind = \"mesh\"\nfile = \"none.msh\"\n[material]\nyoungs_modulus = 2e11\n"
        "poissons_ratio = 0.3\ndensity = 7800\n");
  write(path("none.msh"), "no mesh");
  expect("modes mesh.toml -q -o out", 1, {"none.msh"});
  Json after = Json::parse(content_of(path("out/summary.json")));
  EXPECT_EQ(after["exit_code"], 1);
  EXPECT_NE(after["message"].get<std::string>().find("none.msh"), std::string::npos);
  EXPECT_EQ(after["earlier"]["exit_code"], 0);
  after.erase("earlier");
  after["exit_code"] = before["exit_code"];
  after["message"] = before["message"];
  EXPECT_EQ(after, before);
  EXPECT_TRUE(exists("out/curves/scale_1.csv"));
}

TEST_F(Program, ResumesOnlyWhatWasBegun) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml --resume -o out", 1, {"--resume", "out holds no run"});
  EXPECT_FALSE(exists("out"));
  expect("run scene.toml -q -o out", 0, {});
  const std::string before = content_of(path("out/summary.json"));
  expect("run scene.toml --resume -o out", 0, {"nothing to resume"});
  EXPECT_EQ(content_of(path("out/summary.json")), before);
  expect("run scene.toml --resume -o out --set modal.damping_ratio=0.02", 1,
         {"--resume: modal.damping_ratio is", "0.02", "0.01", "out/scene.toml"});
  const std::string chain =
      "run '" MICROSLIP_SCENES "/chain_2dof.toml' -q --without plots -o chain";
  expect(chain, 0, {});
  expect(chain + " --resume --set contact.points[0].friction_coefficient=0.4", 1,
         {"--resume: contact.points[0] is {", "friction_coefficient = 0.4", "but {"});
}

// Row 27. Hard: a free body has solutions only where the contact holds it.
// Met in: scenes without supports.
// Right: refused by name unless the stuck limit holds it.
TEST_F(Program, RefusesARigidBodyModeThatNothingHolds) {
  write(path("scene.toml"), scene_text);
  expect("run scene.toml -o out --set 'modal.frequency=[0, 41.4]' --set 'modal.points=[]'", 2,
         {"scene.toml: rigid-body", "contact points"});
  EXPECT_EQ(content_of(path(".err")).find("supports"), std::string::npos)
      << "a modal scene has none";
  EXPECT_EQ(Json::parse(content_of(path("out/summary.json")))["exit_code"], 2);
}

using Clock = std::chrono::steady_clock;

/// Starts the program, which ends by _exit(127) where it cannot.
pid_t start(const std::vector<std::string>& arguments, const std::string& temporary_folder = {}) {
  std::vector<char*> words{const_cast<char*>("microslip")};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  if (!temporary_folder.empty()) ::setenv("TMPDIR", temporary_folder.c_str(), 1);
  ::execv(MICROSLIP_PROGRAM, words.data());
  ::_exit(127);
}

void wait_until(const std::function<bool()>& happens) {
  const auto patience = Clock::now() + std::chrono::seconds(20);
  while (!happens() && Clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(happens());
}

bool has_child(pid_t parent) {
  const std::string id = std::to_string(parent);
  return !content_of("/proc/" + id + "/task/" + id + "/children").empty();
}

/// Interrupts a child: exit code 3 within a second.
void interrupt(pid_t child, int signal = SIGINT) {
  const auto asked = Clock::now();
  ASSERT_EQ(::kill(child, signal), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_LT(Clock::now() - asked, std::chrono::milliseconds(1500));  // a second, and a busy machine
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

// Row 60. Hard: an interrupt at any instant, within libraries too.
// Met in: any run that takes long.
// Right: exit 3 within a second, what is complete is kept, and how to go on is said.
TEST_F(Program, AnInterruptEndsWithinASecondAndKeepsWhatIsComplete) {
  std::string scales = "[1";
  for (int i = 2; i <= 3000; ++i) scales.append(",").append(std::to_string(i));  // work for minutes
  write(path("scene.toml"), scene_text + ("preload_scale = " + scales + "]\n"));
  const pid_t child = start({"run", path("scene.toml"), "-o", path("out"), "-q"});
  ASSERT_GE(child, 0);
  wait_until([this] { return exists("out/curves/scale_1.csv"); });
  interrupt(child);
  const Json summary = Json::parse(content_of(path("out/summary.json")));
  EXPECT_EQ(summary["exit_code"], 3);
  EXPECT_TRUE(exists("out/curves/scale_1.csv"));
  const auto n_cut = std::ranges::count_if(
      summary["curves"], [](const Json& curve) { return !curve["complete"].get<bool>(); });
  EXPECT_LE(n_cut, std::thread::hardware_concurrency()) << "a curve was begun after the interrupt";
  EXPECT_NE(summary["message"].get<std::string>().find("--resume goes on"), std::string::npos);
  EXPECT_NE(content_of(path("out/report.md")).find("--resume goes on"), std::string::npos);
  EXPECT_FALSE(exists("out/.lock"));
}

/// A terminal that is closed, and the end of the processor time a batch system allows.
TEST_F(Program, SignalsFromOutsideAreAnsweredAsAnInterruptIs) {
  std::string scales = "[1";
  for (int i = 2; i <= 3000; ++i) scales.append(",").append(std::to_string(i));
  write(path("scene.toml"), scene_text + ("preload_scale = " + scales + "]\n"));
  for (const int signal : {SIGHUP, SIGXCPU}) {
    SCOPED_TRACE(signal);
    const pid_t child = start({"run", path("scene.toml"), "-o", path("out"), "-q"});
    ASSERT_GE(child, 0);
    wait_until([this] { return exists("out/curves/scale_1.csv"); });
    interrupt(child, signal);
    EXPECT_EQ(Json::parse(content_of(path("out/summary.json")))["exit_code"], 3);
    EXPECT_FALSE(exists("out/.lock"));
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(Program, UnderNohupAClosedTerminalIsNoInterrupt) {
  write(path("scene.toml"), scene_text + std::string("preload_scale = [1, 2, 3, 4, 5, 6, 7, 8]\n"));
  EXPECT_EQ(run("run scene.toml -q -o out & child=$!; sleep 0.3; kill -HUP $child; wait $child",
                "trap '' HUP;")
                .code,
            0);
}

/// Impatience costs neither the summary nor the lock.
TEST_F(Program, ASecondInterruptCostsNothing) {
  std::string scales = "[1";
  for (int i = 2; i <= 3000; ++i) scales.append(",").append(std::to_string(i));
  write(path("scene.toml"), scene_text + ("preload_scale = " + scales + "]\n"));
  const pid_t child = start({"run", path("scene.toml"), "-o", path("out"), "-q"});
  ASSERT_GE(child, 0);
  wait_until([this] { return exists("out/curves/scale_1.csv"); });
  for (int i = 0; i < 5; ++i) ASSERT_EQ(::kill(child, i % 2 == 0 ? SIGTERM : SIGINT), 0);
  interrupt(child);
  const Json summary = Json::parse(content_of(path("out/summary.json")));
  EXPECT_EQ(summary["exit_code"], 3);
  EXPECT_FALSE(summary["curves"].empty());
  EXPECT_FALSE(exists("out/.lock"));
}

/// What is quoted is as long as the user's file makes it; its place and the remedy are still seen.
TEST_F(Program, LongNamesAreToldInAFewLines) {
  write(path("key.toml"), scene_text + std::string(1000000, 'k') + " = 1\n");
  write(path("points.csv"), std::string(2000000, ','));
  const std::string parts(40000, 'a');
  for (const std::string& arguments :
       {std::string("check key.toml"), std::string("cycle points.csv"),
        "check " + std::string(4000, 'x'), "check key.toml --set " + parts + "=1"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << outcome.err.substr(0, 300);
    EXPECT_LT(outcome.err.size(), 2000U);
  }
  expect("check key.toml", 1, {"key.toml:11: response.kkk", " … ", "known here:"});
  expect("cycle points.csv", 1, {"points.csv:1: a line of 2000000 bytes"});
}

// Row 72. Hard: libraries that wait for ever for threads they have no memory for.
// Met in: `ulimit -v` of 200 to 450 MB: OpenBLAS hung, at exit too.
// Right: exit 4 in words, or done; no hang, no signal.
//
/// Under a limit of the address space the threads of OpenBLAS cannot start.
TEST_F(Program, LittleAddressSpaceIsNoHang) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes terabytes of address space";
#endif
  write(path("scene.toml"), scene_text);
  for (const char* megabytes : {"200", "250", "300", "450"}) {
    const std::string limit = std::string("ulimit -v ") + megabytes + "000; timeout 30";
    const Outcome version = run("--version", limit);
    if (version.code == 127) continue;  // too little to load the libraries: the loader says so
    EXPECT_EQ(version.code, 0) << megabytes << version.err;
    const Outcome outcome = run("run scene.toml -q -j 2 -o out", limit);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << outcome.code << outcome.err;
    EXPECT_FALSE(exists("out/.lock")) << megabytes;
    // Each thread would ask for a heap of its own, again at every allocation.
    const Outcome many =
        run("run scene.toml -q -j 2 --without plots -o many --set response.harmonics=3 "
            "--set response.preload_scale=[0.5,1,2,4]",
            limit);
    EXPECT_TRUE(many.code == 0 || many.code == 4) << megabytes << ": " << many.code << many.err;
    const Outcome large = run(  // matrices that are worth a call of LAPACK
        "run '" MICROSLIP_SCENES "/chain_2dof.toml' -q -j 1 --without plots -o large", limit);
    EXPECT_TRUE(large.code == 0 || large.code == 4) << megabytes << ": " << large.code << large.err;
  }
}

/// OpenBLAS asks for its buffer for ever where there is none, and MPI ends the process.
TEST_F(Program, LittleAddressSpaceOfAMeshedSceneIsExitFour) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes terabytes of address space";
#endif
  write(path("scene.toml"),
        "[model]\nkind = \"blade\"\nelement_size = \"20 mm\"\n[material]\nyoungs_modulus = 2e11\n"
        "poissons_ratio = 0.3\ndensity = 7800\n[supports]\nclamped = [\"root\"]\n");
  for (const char* megabytes : {"300", "450"}) {
    const std::string limit = std::string("ulimit -v ") + megabytes + "000; timeout -s KILL 60";
    const Outcome outcome = run("modes scene.toml -q -o out", limit);
    EXPECT_EQ(outcome.code, 4) << megabytes << outcome.err;
    EXPECT_NE(outcome.err.find("address space"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run("modes scene.toml -q -o out", "ulimit -v 900000; timeout -s KILL 60").code, 0);
}

TEST_F(Program, WhatMemoryClearlyDoesNotHoldIsNotMeshed) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer needs more address space itself";
#endif
  const std::string scene = "'" MICROSLIP_SCENES "/blade_to_ground.toml'";
  const std::string limit = "MICROSLIP_CACHE=off; ulimit -v 3000000; timeout -s KILL 60";
  for (const char* command : {"check ", "modes -o out ", "run -o out "}) {
    const Outcome outcome = run(command + scene + " --set model.element_size='1 mm'", limit);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("nothing is meshed"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("ulimit -v"), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(exists("out/mesh.msh"));
}

// Row 73. Hard: a limit of the file size ends a program by a signal.
// Met in: `ulimit -f`, which left `.lock` and `.part`.
// Right: exit 4, neither left, earlier results intact.
TEST_F(Program, ALimitOfTheFileSizeIsExitFour) {
  write(path("scene.toml"), scene_text);
  ASSERT_EQ(run("run scene.toml -q -o out").code, 0);
  const std::string curve = content_of(path("out/curves/scale_1.csv"));
  // Standard output and error are pipes: the limit is of their files as well.
  const int status =
      std::system(("cd '" + folder() +
                   "' && bash -c 'ulimit -f 8; \"" MICROSLIP_PROGRAM
                   "\" run scene.toml -q -o out --set response.frequency=[10,31] 2>&1; "
                   "echo code $?' | cat > text")
                      .c_str());
  ASSERT_EQ(WEXITSTATUS(status), 0);
  const std::string text = content_of(path("text"));
  EXPECT_NE(text.find("code 4"), std::string::npos) << text;
  EXPECT_NE(text.find("File too large"), std::string::npos) << text;
  EXPECT_EQ(content_of(path("out/curves/scale_1.csv")), curve) << "what was there is kept";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_NE(entry.path().filename(), ".lock");
  }
}

/// OpenBLAS asks for its buffers for ever where there is no room, in Python as well.
TEST_F(Program, LittleAddressSpaceForPlotsIsNoHang) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes terabytes of address space";
#endif
  write(path("scene.toml"), scene_text);
  for (const char* megabytes : {"200", "300"}) {
    const std::string limit =
        std::string("ulimit -v ") + megabytes + "000; " + with_plots + " timeout -s KILL 60";
    const Outcome outcome = run("run scene.toml -q -j 2 -o out", limit);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << outcome.code << outcome.err;
    if (outcome.code == 0) EXPECT_NE(outcome.err.find("not every plot"), std::string::npos);
  }
}

/// What is drawn has no room: the curves have.
TEST_F(Program, ALimitOfTheFileSizeThatPlotsMeetIsExitFour) {
  write(path("scene.toml"), scene_text);
  const Outcome outcome =
      run("run scene.toml -q -o out",
          std::string("bash -c 'ulimit -f 64; exec \"$0\" \"$@\"'") + " env " + with_plots);
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("ulimit -f"), std::string::npos) << outcome.err;
  EXPECT_EQ(Json::parse(content_of(path("out/summary.json")))["exit_code"], 4);
  EXPECT_TRUE(exists("out/curves/scale_1.csv"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_NE(entry.path().filename(), ".lock");
  }
}

TEST_F(Program, AnInterruptedMesherLeavesNothingBehind) {
  write(path("scene.toml"),
        "[model]\nkind = \"blade\"\nelement_size = \"1.5 mm\"\n[material]\n"
        "youngs_modulus = 2e11\npoissons_ratio = 0.3\ndensity = 7800\n");
  const std::filesystem::path scratch = path("scratch");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"mesh", path("scene.toml"), "-o", path("blade.msh")},
        std::vector<std::string>{"check", path("scene.toml")}}) {
    std::filesystem::create_directory(scratch);
    SCOPED_TRACE(command.front());
    const pid_t child = start(command, scratch);
    ASSERT_GE(child, 0);
    wait_until([&] { return has_child(child); });
    interrupt(child);
    EXPECT_TRUE(std::filesystem::is_empty(scratch));
    EXPECT_FALSE(exists("blade.msh"));
  }
}

/// Names the mesh does not have are told where the scene gives them.
TEST_F(Program, AnUnknownNameIsToldByFileAndLine) {
  const std::string head =
      "[model]\nkind = \"blade\"\nelement_size = \"12 mm\"\n[material]\nyoungs_modulus = 2e11\n"
      "poissons_ratio = 0.3\ndensity = 7800\n";
  write(path("support.toml"), head + "[supports]\nclamped = [\"rot\"]\n");
  expect("check support.toml", 1,
         {"support.toml:9: supports.clamped: nothing is named \"rot\"", "\"root\""});
  write(path("force.toml"),
        head +
            "[supports]\nclamped = [\"root\"]\n[excitation]\n"
            "forces = [ { at = \"C\", direction = [1, 0, 0], amplitude = 1 } ]\n");
  expect("check force.toml", 1,
         {"force.toml:11: excitation.forces.at: nothing is named \"C\"", "\"B\""});
  expect(
      "check force.toml --set excitation.forces=[]"
      " --set supports.clamped='[\"foot\"]'",
      1, {"--set supports.clamped", "nothing is named \"foot\""});
}

TEST_F(Program, APictureOfTheBladeShowsItsPlaces) {
  write(path("blade.toml"),
        "[model]\nkind = \"blade\"\nelement_size = \"15 mm\"\n[material]\nyoungs_modulus = 210\n"
        "poissons_ratio = 0.3\ndensity = 7800\n[supports]\nclamped = [\"root\"]\n[excitation]\n"
        "forces = [ { at = [0, 0.149, 0], direction = [1, 0, 0], amplitude = 1 } ]\n");
  const Outcome drawn = run("check blade.toml --plot blade.png", with_plots);
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("point (0, 0.149, 0): the nearest node"), std::string::npos)
      << drawn.out;
  EXPECT_NE(drawn.out.find("warning: material.youngs_modulus: Young's modulus is 210 Pa"),
            std::string::npos)
      << drawn.out;
  EXPECT_EQ(drawn.out.find("--plot"), std::string::npos) << drawn.out;
  EXPECT_EQ(content_of(path("blade.png")).substr(1, 3), "PNG");
  expect("check blade.toml --plot blade.gif", 1, {"--plot blade.gif", ".png, .svg or .pdf"});
  write(path("scene.toml"), scene_text);
  expect("check scene.toml --plot modal.png", 1, {"--plot", "\"modal\"", "no mesh"});
}

TEST_F(Program, TwoRunsDoNotShareAFolder) {
  write(path("scene.toml"), scene_text);
  ASSERT_EQ(run("run scene.toml -o out").code, 0);
  const std::string before = content_of(path("out/summary.json"));
  const Outcome outcome = run("run scene.toml -o out", "flock out/.lock");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("another run"), std::string::npos) << outcome.err;
  EXPECT_EQ(content_of(path("out/summary.json")), before);
}

}  // namespace
}  // namespace microslip::test_command_line
