// What --resume reads back: exact, and refused where it is another's.
#include "pipelines/files/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "pipelines/files/write_csv.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_checkpoint {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

CurveResult full_curve() {
  CurveResult curve = synthetic::curve("preload_100", 100.0, 305.0, 5e-5, 8.0);
  curve.gap = 0.1 + 0.2;
  curve.curve.points.front().seconds = std::numeric_limits<double>::denorm_min();
  curve.curve.points.front().orders = {1, 3};
  curve.curve.log.push_back({1.5, solver::Remedy::kink_turn});
  curve.curve.detached.push_back({curve.curve.points, true});
  curve.patch_shares.push_back({"contact", {curve.curve.points.front().report}});
  curve.richer = solver::RicherPeak{1.0, 2.0, std::nullopt, 9};
  return curve;
}

TEST(Checkpoint, ACurveIsReadBackBitForBit) {
  const synthetic::Folder folder("checkpoint_curve");
  const CurveResult curve = full_curve();
  Checkpoint(folder.path(), false).begin("title = \"a\"\n");
  Checkpoint(folder.path(), true).keep("curves/preload_100", curve);
  const auto read = Checkpoint(folder.path(), true).find<CurveResult>("curves/preload_100");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(curve_table(read->curve, {}), curve_table(curve.curve, {}));
  EXPECT_EQ(states_table(read->curve, 2), states_table(curve.curve, 2));
  EXPECT_EQ(read->curve.points.front().seconds, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(std::get<double>(read->load), 100.0);
  EXPECT_EQ(read->gap, curve.gap);
  EXPECT_EQ(read->curve.detached.at(0).points.size(), curve.curve.points.size());
  EXPECT_EQ(read->patch_shares.at(0).reports.size(), 1U);
  EXPECT_EQ(read->richer->highest, 9);
  // Every member that is kept: kept again it is the same file.
  Checkpoint(folder.path(), true).keep("curves/again", *read);
  EXPECT_EQ(content_of(folder.path() / "checkpoint/curves/again"),
            content_of(folder.path() / "checkpoint/curves/preload_100"));
}

TEST(Checkpoint, FacesUnderStaticLoadsAreReadBack) {
  const synthetic::Folder folder("checkpoint_static");
  make_folder(folder.path() / "checkpoint");
  StructureModes modes;
  modes.static_face = contact::ElasticFace{Eigen::Matrix2d::Identity(), Eigen::Vector2d(1.0, -2.0)};
  Checkpoint(folder.path(), true).keep("modes", modes);
  const auto read = Checkpoint(folder.path(), true).find<StructureModes>("modes");
  EXPECT_EQ(read->static_face->flexibility, modes.static_face->flexibility);
  EXPECT_EQ(read->static_face->approach, modes.static_face->approach);
}

TEST(Checkpoint, ALimitIsReadBackAsALimit) {
  const synthetic::Folder folder("checkpoint_limit");
  CurveResult curve = full_curve();
  curve.load = LimitName::stuck;
  const Checkpoint checkpoint(folder.path(), true);
  make_folder(folder.path() / "checkpoint");
  checkpoint.keep("limit", curve);
  EXPECT_EQ(std::get<LimitName>(checkpoint.find<CurveResult>("limit")->load), LimitName::stuck);
}

TEST(Checkpoint, ARunThatIsNotResumedFindsNothing) {
  const synthetic::Folder folder("checkpoint_anew");
  Checkpoint checkpoint(folder.path(), false);
  checkpoint.begin("title = \"a\"\n");
  checkpoint.keep("curves/preload_100", full_curve());
  EXPECT_FALSE(checkpoint.find<CurveResult>("curves/preload_100"));
  checkpoint.begin("title = \"b\"\n");
  EXPECT_FALSE(Checkpoint(folder.path(), true).find<CurveResult>("curves/preload_100"))
      << "a new run forgets the parts of the one before";
}

/// The message with which a part is refused; empty: it is not.
std::string complaint(const std::filesystem::path& folder) {
  try {
    static_cast<void>(Checkpoint(folder, true).find<CurveResult>("part"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

// Row 62. Hard: a checkpoint of another version reads as numbers that mean something else.
// Met in: runs resumed by a newer program.
// Right: refused, both versions named.
TEST(Checkpoint, PartsOfAnotherVersionAndDamagedOnesAreRefused) {
  const synthetic::Folder folder("checkpoint_refused");
  const std::filesystem::path file = folder.path() / "checkpoint" / "part";
  make_folder(file.parent_path());
  Checkpoint(folder.path(), true).keep("part", full_curve());
  const std::string whole = content_of(file);
  EXPECT_EQ(complaint(folder.path()), "");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, whole.find('\n') + 3, whole.size() / 2, whole.size() - 1}) {
    write_whole(file, whole.substr(0, size));
    EXPECT_NE(complaint(folder.path()).find("run without --resume"), std::string::npos) << size;
  }
  std::string bent = whole;
  bent[whole.size() / 2] ^= 1;
  write_whole(file, bent);
  EXPECT_NE(complaint(folder.path()).find("damaged"), std::string::npos);
  write_whole(file, "microslip 0.0.1 checkpoint 1.2.3\n" + whole.substr(whole.find('\n') + 1));
  EXPECT_NE(complaint(folder.path()).find("found \"microslip 0.0.1 checkpoint"), std::string::npos);
}

TEST(Checkpoint, AnInputThatHasChangedIsToldByName) {
  const synthetic::Folder folder("checkpoint_input");
  Checkpoint(folder.path(), false).begin("");
  const Checkpoint resumed(folder.path(), true);
  resumed.require_same("mesh", 1, "the mesh");
  EXPECT_NO_THROW(resumed.require_same("mesh", 1, "the mesh"));
  EXPECT_THROW(resumed.require_same("mesh", 2, "the mesh"), SceneError);
}

TEST(Checkpoint, AnotherSceneIsToldByTheKeyThatDiffers) {
  const synthetic::Folder folder("checkpoint_scene");
  EXPECT_THROW(static_cast<void>(ended_run(folder.path(), "")), SceneError) << "no run there";
  Checkpoint(folder.path(), false).begin("[[contact]]\nfit = 1\n[[contact]]\nfit = 2\n");
  EXPECT_FALSE(ended_run(folder.path(), "[[contact]]\nfit = 1\n[[contact]]\nfit = 2\n"));
  try {
    static_cast<void>(ended_run(folder.path(), "[[contact]]\nfit = 1\n[[contact]]\nfit = 3\n"));
    FAIL() << "it is another scene";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("contact[2].fit is 3, but 2 in"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_checkpoint
