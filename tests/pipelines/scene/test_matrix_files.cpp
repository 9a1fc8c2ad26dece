#include "pipelines/scene/matrix_files.hpp"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "pipelines/system/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_matrix_files {
namespace {

Eigen::MatrixXd read(const std::string& text) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "K.mtx";
  std::ofstream(file) << text;
  return read_matrix_market(file);
}

/// What is said of a file, behind its name.
std::string refusal(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const SceneError& error) {
    const std::string message = error.what();
    return message.substr(message.find("K.mtx"));
  }
  return "accepted";
}

const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";

TEST(MatrixMarket, HalfASymmetricMatrixIsTheWholeOne) {
  Eigen::Matrix3d expected;
  expected << 4, -1, 0, -1, 3, 0.5, 0, 0.5, 2;
  const std::string lower = "% a comment\n\n3 3 5\n1 1 4\n2 1 -1\n2 2 3\n3 2 5e-1\n3 3 2\n";
  const std::string upper = "3 3 5\n1 1 4\n1 2 -1\n2 2 3\n2 3 .5\n3 3 2\n";
  EXPECT_EQ(read(symmetric + lower), expected);
  EXPECT_EQ(read(symmetric + upper), expected);
  EXPECT_EQ(
      read("%%MatrixMarket MATRIX Coordinate Real General\n3 3 7\n1 1 4\n1 2 -1\n2 1 -1\n2 2 3\n"
           "2 3 .5\n3 2 .5\n3 3 2\n"),
      expected);
}

TEST(MatrixMarket, EntriesThatStandTwiceAreSummed) {
  Eigen::Matrix2d expected;
  expected << 4, -3, -3, 3;
  EXPECT_EQ(read(symmetric + "2 2 5\n1 1 3\n2 1 -1\n1 1 1\n2 1 -2\n2 2 3\n"), expected);
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real general\n2 2 5\n1 1 4\n1 2 -3\n2 1 -1\n"
                 "2 1 -2\n2 2 3\n"),
            expected);
}

// Row 57. Hard: matrices of another code that are asymmetric, of another size, numbered from 0.
// Met in: exports of other codes.
// Right: refused with the line; mended only where it can mean one thing.
TEST(MatrixMarket, WhatIsWrongIsToldWithItsLine) {
  EXPECT_EQ(refusal(""), "K.mtx: the file ends at line 0; expected a header");
  EXPECT_NE(
      refusal("%%MatrixMarket matrix array real general\n").find("K.mtx:1: expected \"%%Matrix"),
      std::string::npos);
  EXPECT_EQ(refusal(symmetric + "2 3 1\n"), "K.mtx:2: 2 rows, 3 columns: not square");
  EXPECT_EQ(refusal(symmetric + "3000000000 3000000000 5\n1 1 4\n"),
            "K.mtx:2: 3000000000 rows, 5 entries: there are rows without any");
  EXPECT_EQ(refusal(symmetric + "2 2 2\n1 1 4\n"),
            "K.mtx: the file ends at line 3; expected more entries, as the size says");
  EXPECT_EQ(refusal(symmetric + "2 2 2\n1 3 4\n"),
            "K.mtx:3: entry (1, 3) lies outside of 2 rows and columns");
  for (const char* entry : {"1 1 x", "1 1 1.9D+07", "1 1 1,9", "1 1 4 7", "1.5 1 4"}) {
    EXPECT_EQ(refusal(symmetric + "2 2 2\n" + entry + "\n"),
              std::string("K.mtx:3: expected row, column and a finite number, as 1 1 1.9e7; "
                          "found \"") +
                  entry + "\"");
  }
  EXPECT_EQ(refusal(symmetric + "2 2 2.5\n"),
            "K.mtx:2: expected numbers of rows, columns and entries");
  EXPECT_EQ(refusal("%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 4\n1 2 1\n2 2 4\n"),
            "K.mtx: the matrix is not symmetric: entry (1, 2) is 1, (2, 1) is 0");
  EXPECT_EQ(
      refusal(symmetric + "2 2 4\n1 1 4\n2 1 1\n1 2 1\n2 2 4\n"),
      "K.mtx: the matrix is symmetric, and entries (1, 2) and (2, 1) are both there; write one");
  EXPECT_EQ(refusal(symmetric + "2 2 2\n1 1 4\n2 2 4\n\n2 1 1\n"),
            "K.mtx:6: expected no more than 2 entries, as the size says");
}

}  // namespace
}  // namespace microslip::pipelines::test_matrix_files
