#include "pipelines/files/write_summary.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_write_summary {
namespace {

using nlohmann::json;

RunSummary small_run() {
  RunSummary run;
  run.version = "0.1.0";
  run.scene = "blade.toml";
  run.exit_code = ExitCode::incomplete;
  run.machine = describe_machine();
  run.libraries = library_versions();
  run.stages = {{"mesh", 1.5, 120.0}};
  run.mesh = MeshSummary{10, 4, 30, 2e-5, 0.16};
  const ReducedModel model = synthetic::model();
  run.modes = summarise_modes(model.frequency, model.damping_ratio, {}, model.patches[0].fit_error);
  run.curves = {summarise(synthetic::curve("preload_1000", 1000.0, 300.0, 1e-4, 8.0)),
                summarise({"free", LimitName::free, {}, {}})};
  solver::Optimum optimum;
  optimum.best = {5e4, 2.0 * std::numbers::pi * 310.0, 3e-5};
  optimum.trace = {optimum.best};
  optimum.found = true;
  run.optimum.emplace();
  run.optimum->request.key = "preload";
  run.optimum->optimum = optimum;
  return run;
}

TEST(WriteSummary, HasTheKeysOfTheInterface) {
  const json run = json::parse(summary_json(small_run()));
  for (const char* key :
       {"program", "version", "machine", "libraries", "scene", "exit_code", "stages", "mesh",
        "modes", "curves", "optimum", "effects", "error_budget", "accuracy"}) {
    EXPECT_TRUE(run.contains(key)) << key;
  }
  EXPECT_EQ(run["program"], "microslip");
  EXPECT_EQ(run["exit_code"], 3);
  EXPECT_EQ(run["stages"][0],
            (json{{"name", "mesh"}, {"seconds", 1.5}, {"peak_memory_MB", 120.0}}));
  EXPECT_EQ(run["mesh"], (json{{"nodes", 10},
                               {"elements", 4},
                               {"degrees_of_freedom", 30},
                               {"volume_m3", 2e-5},
                               {"mass_kg", 0.16}}));
  EXPECT_DOUBLE_EQ(run["modes"][0]["frequency_Hz"], 296.123456789012);
  EXPECT_TRUE(run["modes"][0]["residual"].is_null()) << "given modes have no eigenpair residual";
}

TEST(WriteSummary, AValueThatIsNotANumberIsTheLargest) {
  for (const std::size_t where : {0U, 1U, 2U}) {
    CurveResult result = synthetic::curve("preload_1000", 1000.0, 300.0, 1e-4, 8.0);
    ASSERT_GT(result.curve.points.size(), 2U);
    for (solver::ResponsePoint& point : result.curve.points) point.energy_imbalance = 1e-12;
    result.curve.points[where].energy_imbalance = std::nan("");
    RunSummary run = small_run();
    run.curves = {summarise(result)};
    EXPECT_TRUE(std::isnan(run.curves[0].largest_energy_imbalance)) << where;
    const json written = json::parse(summary_json(run));
    EXPECT_TRUE(written["curves"][0]["largest_energy_imbalance"].is_null()) << where;
    EXPECT_TRUE(written["curves"][0]["largest_residual"].is_number()) << where;
  }
}

TEST(WriteSummary, CurveTellsItsPeakAndFoldsInHertz) {
  const json run = json::parse(summary_json(small_run()));
  const json& curve = run["curves"][0];
  EXPECT_EQ(curve["name"], "preload_1000");
  EXPECT_EQ(curve["preload_N"], 1000.0);
  EXPECT_DOUBLE_EQ(curve["peak"]["frequency_Hz"], 300.0);
  EXPECT_EQ(curve["peak"]["amplitude_m"], 1e-4);
  EXPECT_EQ(curve["folds_Hz"].size(), 2U);
  EXPECT_EQ(curve["points"], 241);
  EXPECT_EQ(curve["iterations"], 700);
  EXPECT_EQ(curve["contact_evaluations"], 900);
  EXPECT_EQ(run["curves"][1]["preload_N"], "free");
  EXPECT_TRUE(run["curves"][1]["peak"].is_null()) << "no point, no peak";
  EXPECT_EQ(run["curves"][1]["complete"], false);
}

// A source that could not be told may err by more than all that could.
TEST(WriteSummary, DigitsAreFewWhereABarDoesNotCountAll) {
  RunSummary run = small_run();
  run.error_budget = {{"preload_1000", peak_amplitude_goal, "basis", 2e-2},
                      {"preload_1000", peak_frequency_goal, "basis", 6e-6}};
  EXPECT_EQ(json::parse(summary_json(run))["curves"][0]["digits"]["peak_frequency"], 6);
  run.curves[0].not_in_bar = {"cells"};
  const json digits = json::parse(summary_json(run))["curves"][0]["digits"];
  EXPECT_EQ(digits["peak_frequency"], 3);
  EXPECT_EQ(digits["peak_amplitude"], 2);
}

TEST(WriteSummary, PeakIsTheHighestSolvedOneNotTheHighestPoint) {
  CurveResult result;
  result.curve.points = {synthetic::point(290, 1e-4), synthetic::point(295, 3e-4),
                         synthetic::point(300, 2e-4), synthetic::point(305, 9e-4)};
  result.curve.points[0].mark = solver::PointMark::peak;
  result.curve.points[2].mark = solver::PointMark::peak;
  const CurveSummary summary = summarise(result);
  EXPECT_EQ(summary.peaks.size(), 2U);
  ASSERT_TRUE(summary.peak.has_value());
  EXPECT_EQ(summary.peak->amplitude, 2e-4);
}

TEST(WriteSummary, OptimumIsNullUnlessAskedFor) {
  RunSummary run = small_run();
  EXPECT_EQ(json::parse(summary_json(run))["optimum"]["preload_N"], 5e4);
  run.optimum.reset();
  EXPECT_TRUE(json::parse(summary_json(run))["optimum"].is_null());
}

TEST(WriteSummary, OneLineForStandardOutput) {
  EXPECT_EQ(summary_json(small_run(), -1).find('\n'), std::string::npos);
}

TEST(WriteSummary, MachineIsDescribedWithoutItsName) {
  const Machine machine = describe_machine();
  EXPECT_GE(machine.cores, 1U);
  EXPECT_GT(machine.memory_mb, 100.0);
  EXPECT_FALSE(machine.processor.empty());
  EXPECT_FALSE(machine.blas.empty());
}

}  // namespace
}  // namespace microslip::pipelines::test_write_summary
