// A run folder: what stands there stays until its successor is whole, and what no run has written
// stays.
#include "pipelines/record/run_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_run_folder {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::string text(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void stage(const RunFolder& run, const std::string& file, const std::string& content) {
    make_folder((run.staged() / file).parent_path());
    write_whole(run.staged() / file, content);
  }
  /// A run that has written two curves and its summary.
  void earlier_run() const {
    RunFolder run(folder_.path(), RunStart::anew);
    stage(run, "curves/a.csv", "old a");
    stage(run, "curves/b.csv", "old b");
    stage(run, "maps/a.vtp", "old map");
    run.publish();
    run.remove_earlier();
    write_whole(path("summary.json"), "{}");
  }

  test::TemporaryFolder folder_;
};

TEST_F(Folder, ResultsStayUntilTheirSuccessorsArePublished) {
  earlier_run();
  RunFolder run(folder_.path(), RunStart::anew);
  stage(run, "curves/a.csv", "new a");
  EXPECT_TRUE(run.would_replace());
  EXPECT_EQ(text("curves/a.csv"), "old a");
  run.publish();
  run.remove_superseded();
  EXPECT_EQ(text("curves/a.csv"), "new a");
  EXPECT_FALSE(fs::exists(path("curves/b.csv"))) << "it would stand beside a curve of another run";
  EXPECT_EQ(text("maps/a.vtp"), "old map") << "its stage has not ended";
  run.remove_earlier();
  EXPECT_FALSE(fs::exists(path("maps")));
}

// Row 75. Hard: a file of the user's own in a folder that a run fills anew.
// Met in: runs over earlier ones, which deleted foreign files in `curves/` and `plots/`.
// Right: kept: a run removes what runs have written.
TEST_F(Folder, WhatNoRunHasWrittenIsKept) {
  earlier_run();
  write_whole(path("curves/mine.csv"), "mine");
  write_whole(path("curves/c.csv"), "mine too");
  RunFolder run(folder_.path(), RunStart::anew);
  stage(run, "curves/c.csv", "new c");
  run.publish();
  run.remove_earlier();
  EXPECT_EQ(text("curves/mine.csv"), "mine");
  EXPECT_EQ(text("curves/c.csv"), "new c");
  EXPECT_EQ(text("curves/c.csv.kept"), "mine too");
}

TEST_F(Folder, ARunThatIsResumedKnowsItsOwnFiles) {
  earlier_run();
  {
    RunFolder killed(folder_.path(), RunStart::anew);
    stage(killed, "curves/a.csv", "new a");
    killed.publish();
    killed.remove_superseded();
  }
  RunFolder run(folder_.path(), RunStart::resumed);
  stage(run, "curves/a.csv", "new a");
  EXPECT_FALSE(run.would_replace());
  run.remove_earlier();
  EXPECT_EQ(text("curves/a.csv"), "new a");
  EXPECT_FALSE(fs::exists(path("maps/a.vtp")));
}

TEST_F(Folder, LeftoversOfAKilledRunGo) {
  earlier_run();
  write_whole(path(".summary.json.1.2.part"), "torn");
  make_folder(path("checkpoint/staged"));
  write_whole(path("checkpoint/staged/x.csv"), "torn");
  const RunFolder run(folder_.path(), RunStart::anew);
  EXPECT_FALSE(fs::exists(path(".summary.json.1.2.part")));
  EXPECT_TRUE(fs::is_empty(run.staged()));
}

TEST_F(Folder, AFolderOfAVersionThatKeptNoListLosesNothingOfAnotherName) {
  make_folder(path("curves"));
  for (const char* file : {"scene.toml", "log.txt", "summary.json", "curves/a.csv", "curves/b.csv"})
    write_whole(path(file), "old");
  RunFolder run(folder_.path(), RunStart::anew);
  stage(run, "curves/a.csv", "new");
  EXPECT_TRUE(run.would_replace());
  run.publish();
  run.remove_earlier();
  EXPECT_EQ(text("curves/a.csv"), "new");
  EXPECT_EQ(text("curves/b.csv"), "old");
  EXPECT_FALSE(fs::exists(path("curves/a.csv.kept")));
}

TEST_F(Folder, ThatIsToBeFilledGoesAgainWhereNothingWasWritten) {
  fs::create_directory(path("own"));
  { const FolderToFill unfilled(path("own/made/deep")); }
  EXPECT_TRUE(fs::exists(path("own")));
  EXPECT_FALSE(fs::exists(path("own/made")));
  {
    const FolderToFill filled(path("made/deep"));
    write_whole(path("made/result"), "a result");
  }
  EXPECT_EQ(text("made/result"), "a result");
  EXPECT_FALSE(fs::exists(path("made/deep")));
}

TEST_F(Folder, IsLockedAndUnlocked) {
  {
    const RunFolder run(folder_.path(), RunStart::anew);
    EXPECT_THROW(RunFolder(folder_.path(), RunStart::anew), ExhaustedError);
    EXPECT_TRUE(fs::exists(path(".lock"))) << "a run that is refused leaves the lock of the other";
  }
  EXPECT_FALSE(fs::exists(path(".lock")));
}

}  // namespace
}  // namespace microslip::pipelines::test_run_folder
