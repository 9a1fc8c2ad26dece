// A summary that has no room to be written anew still says how the run ended.
#include "pipelines/record/failure_in_place.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace microslip::pipelines::test_failure_in_place
