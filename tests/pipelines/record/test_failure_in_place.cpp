// A summary that has no room to be written anew still says how the run ended.
#include "pipelines/record/failure_in_place.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "pipelines/files/write_summary.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_failure_in_place {
namespace {

using Json = nlohmann::json;

class Summary : public testing::Test {
 protected:
  void write(int code, std::string_view message) const {
    std::ofstream(file()) << Json{{"exit_code", code}, {"message", message}, {"title", "é"}}.dump(
        2);
  }
  [[nodiscard]] std::string text() const {
    std::ifstream in(file());
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "summary.json"; }

  test::TemporaryFolder folder_;
};

TEST_F(Summary, CodeAndMessageAreWrittenOverThoseOfAnUnfinishedRun) {
  write(3, unfinished_message);
  const std::size_t size = text().size();
  tell_failure_in_place(file(), ExitCode::exhausted);
  EXPECT_EQ(text().size(), size);
  const Json summary = Json::parse(text());
  EXPECT_EQ(summary["exit_code"], 4);
  EXPECT_NE(summary["message"].get<std::string>().find("room"), std::string::npos);
  EXPECT_EQ(summary["title"], "é");
}

TEST_F(Summary, WhatSaysHowItEndedIsLeftAsItIs) {
  write(2, "why");
  const std::string before = text();
  tell_failure_in_place(file(), ExitCode::exhausted);
  EXPECT_EQ(text(), before);
  std::filesystem::remove(file());
  tell_failure_in_place(file(), ExitCode::exhausted);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

// Row 59. Hard: a full disk has no room for the summary that would say so.
// Met in: runs on full disks.
// Right: the code is written in place, into blanks kept for it.
TEST_F(Summary, ARunThatFindsNoRoomIsToldInTheBlanks) {
  RunSummary ended;
  ended.exit_code = ExitCode::incomplete;
  ended.message = "stopped, \"here\"";
  write_summary(file(), ended);
  const Json before = Json::parse(text());
  const std::size_t size = text().size();
  for (int run = 0; run < 2; ++run) {  // the second finds what the first has said
    tell_failed_start_in_place(file());
    EXPECT_EQ(text().size(), size);
    Json after = Json::parse(text());
    EXPECT_EQ(after["exit_code"], 4);
    EXPECT_NE(after["message"].get<std::string>().find("ended with exit code 3"),
              std::string::npos);
    EXPECT_EQ(after["earlier"], (Json{{"exit_code", 3}, {"message", ended.message}}));
    after.erase("earlier");
    after["exit_code"] = before["exit_code"];
    after["message"] = before["message"];
    EXPECT_EQ(after, before);
  }
}

TEST_F(Summary, WithoutBlanksTheExitCodeAlone) {
  write(0, "");
  tell_failed_start_in_place(file());
  EXPECT_EQ(Json::parse(text()), (Json{{"exit_code", 4}, {"message", ""}, {"title", "é"}}));
}

}  // namespace
}  // namespace microslip::pipelines::test_failure_in_place
