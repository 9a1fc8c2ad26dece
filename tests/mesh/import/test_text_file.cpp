// Files of text that hold a byte of value 0: the line is told, and nothing behind it is read.
#include "mesh/text_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "mesh/mesh_error.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/step_geometry.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::mesh::test_text_file {
namespace {

namespace fs = std::filesystem;

class File : public testing::Test {
 protected:
  /// A begin, and zeros behind it: a gigabyte that takes no room.
  [[nodiscard]] fs::path holding(const std::string& begin, std::uintmax_t size) const {
    const fs::path file = folder_.path() / "file";
    std::ofstream(file, std::ios::binary) << begin;
    fs::resize_file(file, size);
    return file;
  }

  template <typename Read>
  static std::string complaint(const Read& read) {
    try {
      static_cast<void>(read());
    } catch (const MeshError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(File, TheFirstZeroByteIsFound) {
  EXPECT_FALSE(first_zero_byte(holding("a\nb\n", 4)));
  EXPECT_FALSE(first_zero_byte(holding("", 0)));
  const auto zero = first_zero_byte(holding("a\nb\n", 1U << 30U));
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->offset, 4U);
  EXPECT_EQ(zero->line, 3U);
}

TEST_F(File, LinesAreCountedOverBlocks) {
  const std::string lines(3U << 20U, '\n');
  const auto zero = first_zero_byte(holding(lines, lines.size() + 1));
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->offset, lines.size());
  EXPECT_EQ(zero->line, lines.size() + 1);
}

// Row 55. Hard: a right begin, then a gigabyte of zeros.
// Met in: 1 GB of zeros, which took 13 to 54 s.
// Right: refused with the line, memory bounded by a block.
TEST_F(File, ZerosBehindARightBeginAreRefusedUnread) {
  for (const char* begin : {"$MeshFormat\n", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n"}) {
    const std::string message =
        complaint([&] { return read_gmsh(holding(begin, 1U << 30U), 1.0); });
    EXPECT_NE(message.find("a byte of value 0"), std::string::npos) << begin << message;
  }
  const std::string message =
      complaint([&] { return step_length_units(holding("ISO-10303-21;\n", 1U << 30U)); });
  EXPECT_NE(message.find("file:2: a byte of value 0"), std::string::npos) << message;
}

TEST_F(File, ZerosInABinaryMeshAreRefusedUnread) {
  for (const std::string version : {"2.2", "4.1"}) {
    const std::string format =
        "$MeshFormat\n" + version + " 1 8\n" + std::string("\1\0\0\0\n", 5) + "$EndMeshFormat\n";
    const auto complaint_behind = [&](const std::string& begin) {
      return complaint([&] { return read_gmsh(holding(begin, 1U << 30U), 1.0); });
    };
    const std::string message = complaint_behind(format);
    const std::string place = "byte " + std::to_string(format.size()) + ": expected a section";
    EXPECT_NE(message.find(place), std::string::npos) << message;
    for (const char* begun :
         {"$Nodes\n", "$Nodes\n30000000\n", "$Entities\n", "$PhysicalNames\n"}) {
      const std::string cut = complaint_behind(format + begun);
      EXPECT_NE(cut.find("byte 1073741824: expected the $End"), std::string::npos) << begun << cut;
    }
  }
}

TEST_F(File, WhatDoesNotBeginAsStepIsNotReadWhole) {
  const std::string message = complaint([&] { return step_length_units(holding("", 1U << 30U)); });
  EXPECT_NE(message.find("not a STEP file"), std::string::npos) << message;
}

}  // namespace
}  // namespace microslip::mesh::test_text_file
