#include "pipelines/files/columns.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace microslip::pipelines::test_columns {
namespace {

TEST(Columns, TheListInTheDocumentationIsTheOneOfTheProgram) {
  std::ifstream in(MICROSLIP_COLUMNS);
  const std::string written{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(written, columns_text()) << "write it anew: microslip columns -o " << MICROSLIP_COLUMNS;
}

TEST(Columns, EveryOneSaysWhatItIs) {
  std::set<std::string> names;
  for (const auto& column : curve_columns()) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_FALSE(std::string(column.doc).empty()) << column.name;
  }
  for (const auto& array : cycle_arrays()) EXPECT_FALSE(std::string(array.doc).empty());
  for (const auto& array : instant_arrays()) EXPECT_FALSE(std::string(array.doc).empty());
}

// The order that scripts lean on (interfaces.md, section 3).
TEST(Columns, CurvesBeginAsTheyAlwaysDid) {
  EXPECT_EQ(header_of(curve_columns())
                .find("frequency_Hz,amplitude_m,amplitude_1_m,mean_m,phase_deg,stable,stick_share,"
                      "slip_share,separated_share,three_states_share,residual,energy_imbalance,"
                      "dissipation_mismatch,mark"),
            0U);
}

}  // namespace
}  // namespace microslip::pipelines::test_columns
