// Tables of numbers (csv_table.hpp): headers that are comments, pipes.
#include "pipelines/text/csv_table.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* table = "x,y\n1,2\n3,4\n";

TEST(CsvTable, ReadsAHeaderThatNumpyHasWrittenAsAComment) {
  const CsvTable plain = CsvTable::parse(table, "t.csv");
  const CsvTable commented = CsvTable::parse("# made by a script\n# x,y\n1,2\n3,4\n", "t.csv");
  EXPECT_EQ(commented.columns(), plain.columns());
  EXPECT_EQ(commented.n_rows(), 2U);
  EXPECT_EQ(commented.at(1, 1), 4.0);
  EXPECT_EQ(commented.header_place(), "t.csv:2");
}

TEST(CsvTable, TakesNoCommentForTheHeaderOfATableThatHasOne) {
  const CsvTable read = CsvTable::parse(std::string("# a,b\n") + table, "t.csv");
  EXPECT_EQ(read.columns(), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(read.n_rows(), 2U);
  // Of another number of columns: the row is taken for a header, whose names are missing then.
  EXPECT_THROW(static_cast<void>(CsvTable::parse("# a,b,c\n1,2\n3,4\n", "t.csv").require("a")),
               SceneError);
}

class Pipe : public testing::Test {
 protected:
  Pipe() : file_(std::filesystem::path(testing::TempDir()) / "microslip_test_pipe.csv") {
    std::filesystem::remove(file_);
    EXPECT_EQ(mkfifo(file_.c_str(), 0600), 0);
  }
  ~Pipe() override { std::filesystem::remove(file_); }

  std::filesystem::path file_;
};

TEST_F(Pipe, IsReadToItsEnd) {
  const std::string rows(100'000, '\n');  // more than a pipe holds
  std::thread writer([&] { std::ofstream(file_) << table << rows << "5,6\n"; });
  const CsvTable read = CsvTable::read(file_);
  writer.join();
  EXPECT_EQ(read.n_rows(), 3U);
  EXPECT_EQ(read.at(2, 1), 6.0);
}

TEST_F(Pipe, WithoutAWriterIsNotWaitedFor) {
  try {
    static_cast<void>(CsvTable::read(file_));
    FAIL() << "a table was read";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.what(), file_.string() + ": a pipe that nobody writes to");
  }
}

}  // namespace
}  // namespace microslip::pipelines
