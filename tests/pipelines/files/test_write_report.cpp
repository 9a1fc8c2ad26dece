#include "pipelines/files/write_report.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipelines/files/columns.hpp"
#include "pipelines/files/write_csv.hpp"
#include "pipelines/files/write_map.hpp"
#include "pipelines/files/write_summary.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_write_report {
namespace {

using namespace std::chrono_literals;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run folder with two curves, the limits and an optimum, and a map where asked.
enum class Maps { none, one };
void write_run(const std::filesystem::path& folder, Maps maps = Maps::none) {
  const ReducedModel model = synthetic::model();
  RunSummary run;
  run.title = "Synthetic";
  run.mesh = MeshSummary{10, 4, 30, 2e-5, 0.16};
  run.modes = summarise_modes(model.frequency, model.damping_ratio, {}, {});
  std::vector<CurveResult> curves{synthetic::curve("free", 0.0, 296.0, 2e-4, 0.0),
                                  synthetic::curve("preload_-50", -50.0, 299.0, 8e-5, -3.0),
                                  synthetic::curve("preload_100", 100.0, 305.0, 5e-5, 8.0),
                                  synthetic::curve("stuck", 0.0, 321.0, 1e-4, 0.0)};
  curves.front().load = LimitName::free;
  curves.back().load = LimitName::stuck;
  if (maps == Maps::one) {
    curves[2].maps.push_back(synthetic::named_map(model, "preload_100_peak"));
    write_map(folder / "maps", model.patches[0], curves[2].maps[0]);
  }
  solver::Optimum optimum;
  optimum.trace = {{100.0, 1900.0, 5e-5}, {200.0, 1950.0, 4e-5}, {400.0, 1990.0, 6e-5}};
  optimum.best = optimum.trace[1];
  optimum.found = true;
  OptimumSummary& found = run.optimum.emplace();
  found.request.key = "preload";
  found.optimum = optimum;
  found.bracket.entries = {{"contact_stiffness", 2.0, optimum, {100.0, 400.0}, false, 3},
                           {"friction_coefficient", 0.5, optimum, {100.0, 800.0}, true}};
  found.bracket.left_out = {"friction_coefficient: friction is a law of the slip speed"};
  write_optimum_csv(folder, found.request, optimum);
  for (const CurveResult& curve : curves) {
    write_curve(folder, curve, synthetic::n_modes);
    run.curves.push_back(summarise(curve));
  }
  write_summary(folder / "summary.json", run);
}

using Warnings = std::vector<std::string>;

/// As `report` does.
Warnings rebuild(const std::filesystem::path& folder) {
  return write_report(folder, folder, read_summary(folder));
}

TEST(WriteReport, PlotsAreMadeInBothFormatsWithoutADisplay) {
  const synthetic::Folder folder("report_plots");
  write_run(folder.path(), Maps::one);
  EXPECT_EQ(rebuild(folder.path()), Warnings{});
  for (const char* stem : {"curves", "peak_against_preload", "map_preload_100_peak"}) {
    const auto file = folder.path() / "plots" / stem;
    EXPECT_EQ(content_of(file.string() + ".png").substr(1, 3), "PNG") << stem;
    EXPECT_NE(content_of(file.string() + ".svg").find("</svg>"), std::string::npos) << stem;
  }
}

TEST(WriteReport, SamePlotsByteForByteTheSecondTime) {
  const synthetic::Folder folder("report_twice");
  write_run(folder.path());
  EXPECT_EQ(rebuild(folder.path()), Warnings{});
  const std::string first = content_of(folder.path() / "plots" / "curves.svg");
  EXPECT_EQ(rebuild(folder.path()), Warnings{});
  EXPECT_EQ(content_of(folder.path() / "plots" / "curves.svg"), first);
}

TEST(WriteReport, ReportTellsPeaksFoldsAndOptimum) {
  const synthetic::Folder folder("report_text");
  write_run(folder.path());
  const std::string report =
      report_text(content_of(folder.path() / "summary.json"), {"curves.svg"});
  EXPECT_NE(report.find("# Synthetic"), std::string::npos);
  EXPECT_NE(report.find("| 100 | 305.0000 | 5e-05 |"), std::string::npos) << report;
  EXPECT_NE(report.find("| free | 296.0000 | 0.0002 |"), std::string::npos) << report;
  EXPECT_NE(report.find("Best preload: 200 N"), std::string::npos) << report;
  EXPECT_NE(report.find("Not varied: friction_coefficient"), std::string::npos) << report;
  EXPECT_NE(report.find("| friction_coefficient × 0.5 (searched wider: 100 … 800) |"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("| contact_stiffness × 2 with 3 harmonics |"), std::string::npos) << report;
  EXPECT_NE(report.find("](plots/curves.svg)"), std::string::npos) << report;
}

TEST(WriteReport, ReportTellsWhichEffectsWereSimulatedAndWhatTheOthersWouldChange) {
  RunSummary run;
  run.effects = {{.name = "normal_motion",
                  .setting = "auto",
                  .simulated = Simulated::yes,
                  .reason = "a reason; switched on after the run",
                  .indicator = std::numeric_limits<double>::infinity(),
                  .threshold = 1e-4},
                 {.name = "second_direction",
                  .setting = "off",
                  .reason = "it is",
                  .indicator = 0.0172,
                  .threshold = 0.03,
                  .bound = 0.031,
                  .objection = "it matters"},
                 {.name = "nonlinearity",
                  .setting = "auto",
                  .simulated = Simulated::undecided,
                  .reason = "later"}};
  const std::string report = report_text(summary_json(run), {});
  for (const char* row : {"| normal_motion | yes | auto | infinite | 0.0001 | – | a reason; "
                          "switched on after the run |",
                          "| second_direction | no | off | 0.017 | 0.03 | 3.1 % | it is; **but it "
                          "matters** |",
                          "| nonlinearity | not decided | auto | – | – | – | later |"}) {
    EXPECT_NE(report.find(row), std::string::npos) << report;
  }
  run.effects.clear();
  EXPECT_EQ(report_text(summary_json(run), {}).find("## Effects"), std::string::npos);
}

TEST(WriteReport, PeaksHaveTheDigitsThatTheirBarAllows) {
  RunSummary run;
  run.curves = {summarise(synthetic::curve("preload_100", 100.0, 305.0, 5e-5, 8.0)),
                summarise(synthetic::curve("preload_200", 200.0, 305.0, 5e-5, 8.0))};
  ASSERT_TRUE(run.curves[0].peak);
  for (CurveSummary& curve : run.curves) {
    curve.peak->frequency = 2.0 * std::numbers::pi * 305.12345678;
    curve.peak->amplitude = 5.12345e-5;
  }
  run.error_budget = {{"preload_100", peak_amplitude_goal, "mesh", 0.3},
                      {"preload_100", peak_frequency_goal, "mesh", 0.02}};
  const std::string report = report_text(summary_json(run), {});
  EXPECT_NE(report.find("| 305 | 0.000051 |"), std::string::npos) << report;
  EXPECT_NE(report.find("| 305.1235 | 5.1234e-05 |"), std::string::npos) << "no bar: " << report;
}

TEST(WriteReport, DamagedCurveCostsThePlotsNotTheRun) {
  const synthetic::Folder folder("report_damaged");
  write_run(folder.path());
  write_whole(folder.path() / "curves" / "free.csv", "frequency_Hz,amplitude_m\nx,y\n");
  const auto warnings = rebuild(folder.path());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("curves/free.csv:1: column \"stable\" is missing"), std::string::npos)
      << warnings[0];
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "report.md"));
}

TEST(WriteReport, FolderWithoutARunIsNamed) {
  const synthetic::Folder folder("report_none");
  EXPECT_THROW(static_cast<void>(rebuild(folder.path())), SceneError);
  write_whole(folder.path() / "summary.json", "{");
  EXPECT_THROW(static_cast<void>(rebuild(folder.path())), SceneError);
  write_whole(folder.path() / "summary.json", "{\"program\": 1}");
  EXPECT_THROW(static_cast<void>(rebuild(folder.path())), SceneError);
}

/// What `report` says of a damaged run folder; nothing where it finds no fault.
std::string complaint_of(const std::filesystem::path& folder) {
  try {
    const Warnings warnings = rebuild(folder);
    if (!warnings.empty()) return warnings.front();
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" lacks " << part;
  }
  for (const char* raw : {"json.exception", "Traceback", "Error:", "Unable to"}) {
    EXPECT_EQ(text.find(raw), std::string::npos) << text;
  }
}

void replace_in(const std::filesystem::path& file, const std::string& old_text,
                const std::string& new_text) {
  std::string text = content_of(file);
  const auto at = text.find(old_text);
  ASSERT_NE(at, std::string::npos) << file;
  write_whole(file, text.replace(at, old_text.size(), new_text));
}

TEST(WriteReport, CellsWithoutANumberAreNamedByFileLineAndColumn) {
  const synthetic::Folder folder("report_cells");
  write_run(folder.path());
  const std::filesystem::path file = folder.path() / "curves" / "preload_100.csv";
  const std::string whole = content_of(file);
  const std::string second = whole.substr(whole.find('\n') + 1);
  const std::string frequency = second.substr(0, second.find(','));
  replace_in(file, "\n" + frequency + ",", "\nnan,");
  expect_parts(complaint_of(folder.path()),
               {"curves/preload_100.csv:2: frequency_Hz: 'nan' is not finite"});
  write_whole(file, whole);
  replace_in(file, "\n" + frequency + ",", "\n,");
  expect_parts(complaint_of(folder.path()),
               {"curves/preload_100.csv:2: frequency_Hz: the value is missing"});
  write_whole(file, whole);
  replace_in(file, "\n" + frequency + ",", "\n");
  expect_parts(complaint_of(folder.path()),
               {fmt::format("curves/preload_100.csv:2: {} values under {} column names",
                            curve_columns().size() - 1, curve_columns().size())});
  replace_in(file, "amplitude_m", "amplitude");
  expect_parts(complaint_of(folder.path()),
               {"curves/preload_100.csv:1: column \"amplitude_m\" is missing"});
  std::filesystem::remove(file);
  expect_parts(complaint_of(folder.path()), {"curves/preload_100.csv is missing"});
}

TEST(WriteReport, MissingAndDamagedMapsAreNamed) {
  const synthetic::Folder folder("report_maps");
  write_run(folder.path(), Maps::one);
  const std::filesystem::path file = folder.path() / "maps" / "preload_100_peak.h5";
  write_whole(file, content_of(file).substr(0, 3000));
  expect_parts(complaint_of(folder.path()),
               {"maps/preload_100_peak.h5: is cut off or no HDF5 file"});
  EXPECT_TRUE(
      std::filesystem::exists(folder.path() / "plots" / "curves.svg"));  // which needs no map
  std::filesystem::remove(file);
  expect_parts(complaint_of(folder.path()), {"missing: maps/preload_100_peak.h5"});
}

TEST(WriteReport, DamagedSummariesAreNamedByPlace) {
  const synthetic::Folder folder("report_summary");
  write_run(folder.path());
  const std::filesystem::path file = folder.path() / "summary.json";
  const std::string whole = content_of(file);
  write_whole(file, whole.substr(0, whole.size() / 2));
  expect_parts(complaint_of(folder.path()), {file.string() + ":", "the file ends too early"});
  write_whole(file, "{\n  \"curves\": nonsense\n}");
  expect_parts(complaint_of(folder.path()), {file.string() + ":2:14: no JSON from here on"});
  write_whole(file, whole);
  replace_in(file, "\"complete\": true", "\"complete\": 7");
  expect_parts(complaint_of(folder.path()),
               {"summary.json: curves[0].complete: expected true or false, found 7"});
  write_whole(file, whole);
  replace_in(file, "\"complete\"", "\"finished\"");
  expect_parts(complaint_of(folder.path()), {"summary.json: curves[0]: \"complete\" is missing"});
  write_whole(file, " \n");
  expect_parts(complaint_of(folder.path()), {"summary.json: empty"});
}

TEST(WriteReport, RunsOfOlderVersionsAreReported) {
  using Json = nlohmann::ordered_json;
  const synthetic::Folder folder("report_older");
  write_run(folder.path());
  const std::filesystem::path file = folder.path() / "summary.json";
  Json run = Json::parse(content_of(file));
  Json& optimum = run["optimum"];
  for (const char* key : {"at", "flat", "objection", "bracket_left_out", "notes", "method"}) {
    optimum.erase(key);
    for (Json& entry : optimum["bracket"]) entry.erase(key);
  }
  write_whole(file, run.dump());
  EXPECT_EQ(complaint_of(folder.path()), "");
  EXPECT_NE(content_of(folder.path() / "report.md").find("Best preload: 200 N, peak 4e-05 m"),
            std::string::npos);
  optimum = {{"preload_N", 200.0}, {"amplitude_m", 4e-5}, {"frequency_Hz", 310.0}};
  for (const char* key :
       {"title", "message", "warnings", "stages", "machine", "libraries", "effects"})
    run.erase(key);
  write_whole(file, run.dump());
  EXPECT_EQ(complaint_of(folder.path()), "");
  EXPECT_NE(content_of(folder.path() / "report.md")
                .find("Best preload: 200 N, peak 4e-05 m at 310.0000 Hz."),
            std::string::npos);
}

TEST(ChildProcess, FailureIsTheLastLineOfItsOutput) {
  const ChildResult result = run_child({"/bin/sh", "-c", "echo a; echo b >&2; exit 3"}, 10s);
  EXPECT_FALSE(result.succeeded);
  EXPECT_EQ(result.message, "b");
}

TEST(ChildProcess, LimitEndsIt) {
  const auto begin = std::chrono::steady_clock::now();
  const ChildResult result = run_child({"/bin/sleep", "30"}, 100ms);
  EXPECT_FALSE(result.succeeded);
  EXPECT_NE(result.message.find("longer than 0.1 s"), std::string::npos) << result.message;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(ChildProcess, SignalAndMissingProgramAreNamed) {
  EXPECT_NE(run_child({"/bin/sh", "-c", "kill -9 $$"}, 10s).message.find("signal 9"),
            std::string::npos);
  EXPECT_NE(run_child({"/no/such/program"}, 10s).message.find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace microslip::pipelines::test_write_report
