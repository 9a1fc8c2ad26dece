#include "pipelines/record/progress.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <thread>

#include "pipelines/system/scene_error.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_progress {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t n_lines(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(Progress, StagesAreTimedInOrderAndMeasured) {
  std::ostringstream out;
  Progress progress(out, false, Verbosity::normal);
  progress.stage("mesh");
  progress.stage("modes");
  std::vector<char> block(200'000'000, 1);  // 200 MB, touched
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  block = {};
  progress.stage("curves");
  const auto stages = progress.stages();
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0].name, "mesh");
  EXPECT_EQ(stages[1].name, "modes");
  EXPECT_GE(stages[1].seconds, 0.02);
  EXPECT_LT(stages[1].seconds, 10.0);
  EXPECT_GT(stages[1].peak_memory_mb, 200.0);
  EXPECT_EQ(stages[2].name, "curves");
}

TEST(Progress, AStageThatSaysNothingTellsWhatIsLeft) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("modes");
  progress.expect(60.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  progress.stage("optimum");
  progress.expect(0.6);
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  progress.finish();
  const std::regex left("modes  [1-2] s, some 5[89] s left");
  const std::regex over("optimum  [1-2] s, where 1 s were expected: how much is left is not known");
  EXPECT_TRUE(std::regex_search(out.str(), left)) << out.str();
  EXPECT_TRUE(std::regex_search(out.str(), over)) << out.str();
}

TEST(Progress, BeyondAForecastWhatItMayBeWrongByIsLeft) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("curves");
  progress.expect(0.9);  // less than when it first speaks, more than half of what it waits
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  progress.finish();
  const std::regex over("curves  [1-2] s, where 1 s were expected: [01] s more at most");
  EXPECT_TRUE(std::regex_search(out.str(), over)) << out.str();
}

// A finer mesh within the stage that tells errors.
TEST(Progress, APartOfAStageTellsWhatIsLeftOfIt) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("accuracy");
  progress.expect(0.1);
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const Progress::Part part = progress.part("finer mesh and its modes");
  progress.expect(60.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  progress.expect(0.0);
  progress.point("preload_6", {}, 0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  progress.expect(60.0);
  progress.point("preload_7", {}, 1.0);
  progress.finish();
  const std::regex whole(
      "accuracy  [1-2] s: finer mesh and its modes, some (5[89]|1 min 00) s left");
  EXPECT_TRUE(std::regex_search(out.str(), whole)) << out.str();
  for (const char* done : {"preload_6 .*  0 s left", "preload_7 .*  0 s left"}) {
    EXPECT_TRUE(std::regex_search(out.str(), std::regex(done))) << out.str();
  }
}

TEST(Progress, AStageWithoutAForecastTellsWhatIsBeingDone) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("contact");
  {
    const Progress::Part part = progress.part("linear limits of 900 modes");
    std::this_thread::sleep_for(std::chrono::milliseconds(1700));
    progress.stage("report");
    std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  }
  progress.finish();
  const std::regex told("contact  [1-2] s: linear limits of 900 modes");
  EXPECT_TRUE(std::regex_search(out.str(), told)) << out.str();
  EXPECT_FALSE(std::regex_search(out.str(), std::regex("report  [1-2] s:"))) << out.str();
}

// The search of the best value goes on when the maps beside it are drawn.
TEST(Progress, WhatIsDoneIsNoLongerTold) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("optimum");
  {
    const Progress::Part first = progress.part("maps of preload_1");
    {
      const Progress::Part second = progress.part("maps of preload_2");
      std::this_thread::sleep_for(std::chrono::milliseconds(1700));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  progress.finish();
  EXPECT_TRUE(std::regex_search(
      out.str(), std::regex("optimum  1 s: maps of preload_2[^]*optimum  [2-3] s: maps of "
                            "preload_1[^]*optimum  [3-5] s[^:]*$")))
      << out.str();
}

TEST(Progress, ACurveWhosePointsTakeLongTellsWhatIsLeft) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("curves");
  progress.point("preload_6", {}, 0.25);
  std::this_thread::sleep_for(std::chrono::milliseconds(3700));
  progress.finish();
  EXPECT_TRUE(std::regex_search(out.str(), std::regex("curves  [34] s, some (9|1[0-2]) s left")))
      << out.str();
}

// The first of a curve that is solved for with few harmonics before: its forecast is what is known.
TEST(Progress, APointAtTheBeginningOfAStageTellsTheForecast) {
  const auto told = [](double expected) {
    std::ostringstream out;
    Progress progress(out, true, Verbosity::normal);
    progress.stage("curves");
    progress.expect(expected);
    progress.point("preload_6", {}, 0.0);
    progress.finish();
    return out.str();
  };
  EXPECT_TRUE(std::regex_search(told(40.0), std::regex("  (39|40) s left"))) << told(40.0);
  EXPECT_EQ(told(0.0).find("left"), std::string::npos) << "nothing is known";
}

// Fractions count frequency: before a resonance, where points are few, the pace alone would tell
// 1 s, beyond it too much.
TEST(Progress, ThePaceIsBelievedAsFarAsItHasCome) {
  const auto left_after = [](double fraction) {
    std::ostringstream out;
    Progress progress(out, true, Verbosity::normal);
    progress.stage("curves");
    progress.expect(40.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    progress.point("preload_6", {}, fraction);
    progress.finish();
    const std::regex left(R"(  (\d+) s left)");
    std::smatch found;
    const std::string text = out.str();
    return std::regex_search(text, found, left) ? std::stoi(found[1]) : -1;
  };
  const int early = left_after(0.1);
  EXPECT_GE(early, 20);
  EXPECT_LE(early, 36);
  EXPECT_LE(left_after(0.9), 1);
}

TEST(Progress, HistoryGrowsWithEveryPoint) {
  const synthetic::Folder folder("progress_history");
  std::ostringstream out;
  Progress progress(out, false, Verbosity::quiet);
  progress.keep_in(folder.path());
  progress.stage("curves");
  progress.point("preload_1", synthetic::point(295.5, 1e-4), 0.1);
  EXPECT_EQ(n_lines(content_of(folder.path() / "history.csv")), 2U);
  progress.point("preload_1", synthetic::point(296.5, 2e-4), 0.2);
  const std::string history = content_of(folder.path() / "history.csv");
  EXPECT_EQ(n_lines(history), 3U);
  EXPECT_NE(history.find("\npreload_1,295.5,"), std::string::npos) << history;
}

// A sweep that was given up for one from the other end leaves no lines.
TEST(Progress, HistoryHoldsOnlyWhatAFinishedCurveHolds) {
  const synthetic::Folder folder("progress_settle");
  std::ostringstream out;
  Progress progress(out, false, Verbosity::quiet);
  progress.keep_in(folder.path());
  progress.stage("curves");
  const std::vector<solver::ResponsePoint> kept{synthetic::point(297.5, 3e-4),
                                                synthetic::point(296.5, 2e-4)};
  progress.point("preload_1", synthetic::point(295.5, 1e-4), 0.1);
  progress.point("preload_10", synthetic::point(295.5, 1e-4), 0.1);
  for (const auto& point : kept) progress.point("preload_1", point, 0.2);
  progress.settle("preload_1", kept);
  progress.point("preload_10", synthetic::point(298.5, 1e-4), 0.1);
  const std::string history = content_of(folder.path() / "history.csv");
  EXPECT_EQ(n_lines(history), 5U) << history;
  EXPECT_EQ(history.find("\npreload_1,295.5,"), std::string::npos) << history;
  for (const char* line : {"curve,", "\npreload_1,297.5,", "\npreload_1,296.5,",
                           "\npreload_10,295.5,", "\npreload_10,298.5,"}) {
    EXPECT_NE(history.find(line), std::string::npos) << line << history;
  }
}

TEST(Progress, LogHoldsWhatWasSaidBeforeItExisted) {
  const synthetic::Folder folder("progress_log");
  std::ostringstream out;
  Progress progress(out, false, Verbosity::quiet);
  progress.info("mesh has 7 nodes");
  progress.warning("degree {} lowered");  // braces are text, not a format
  progress.keep_in(folder.path());
  progress.error("no more disk");
  const std::string log = content_of(folder.path() / "log.txt");
  EXPECT_NE(log.find("info: mesh has 7 nodes"), std::string::npos) << log;
  EXPECT_NE(log.find("warning: degree {} lowered"), std::string::npos) << log;
  EXPECT_NE(log.find("error: no more disk"), std::string::npos) << log;
  EXPECT_EQ(out.str(), "warning: degree {} lowered\n") << "quiet prints warnings only";
  EXPECT_EQ(progress.warnings().size(), 1U);
}

TEST(Progress, TerminalGetsOneLiveLineThatIsClearedAtTheEnd) {
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.stage("curves");
  progress.point("preload_1", synthetic::point(295.5, 1e-4), 0.5);
  EXPECT_EQ(n_lines(out.str()), 0U);
  EXPECT_NE(out.str().find("curves  preload_1  295.5 Hz"), std::string::npos) << out.str();
  // On a narrow one the shares of stick, slip and separation would push it over the edge.
  EXPECT_TRUE(out.str().ends_with("  0 s left")) << out.str();
  progress.finish();
  EXPECT_EQ(out.str().back(), '\n');
  EXPECT_NE(out.str().find("\r\033[Kcurves "), std::string::npos);
}

TEST(Progress, OutsideATerminalAStageSpeaksAfterTwoSeconds) {
  std::ostringstream out;
  Progress progress(out, false, Verbosity::normal);
  progress.stage("modes");
  progress.expect(60.0);
  progress.point("preload_6", {}, 0.5);
  EXPECT_EQ(out.str(), "") << "its first moment";
  std::this_thread::sleep_for(std::chrono::milliseconds(3200));
  progress.finish();
  const std::regex once("modes  [23] s, some [0-9]+ s left\n");
  EXPECT_TRUE(std::regex_search(out.str(), once)) << out.str();
}

TEST(Progress, OutsideATerminalThereAreNoControlCharacters) {
  std::ostringstream out;
  {
    Progress progress(out, false, Verbosity::verbose);
    progress.stage("curves");
    progress.point("preload_1", synthetic::point(295.5, 1e-4), 0.5);
  }
  EXPECT_EQ(out.str().find_first_of("\r\033"), std::string::npos);
  EXPECT_EQ(n_lines(out.str()), 2U) << out.str();
}

TEST(Progress, PointsFromSeveralThreadsAreAllKept) {
  const synthetic::Folder folder("progress_threads");
  std::ostringstream out;
  Progress progress(out, true, Verbosity::normal);
  progress.keep_in(folder.path());
  progress.stage("curves");
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&progress, i] {
      for (int k = 0; k < 50; ++k) {
        progress.point("curve_" + std::to_string(i), synthetic::point(300.0, 1e-4), 0.5);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(n_lines(content_of(folder.path() / "history.csv")), 201U);
}

TEST(Progress, MissingRunFolderIsReported) {
  std::ostringstream out;
  Progress progress(out, false, Verbosity::normal);
  // A file in place of the folder: spdlog would create a missing one.
  EXPECT_THROW(progress.keep_in("/proc/version"), ExhaustedError);
}

}  // namespace
}  // namespace microslip::pipelines::test_progress
