#include "pipelines/files/write_csv.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_write_csv {
namespace {

using Row = std::vector<std::string>;

std::vector<Row> rows_of(std::istream&& text) {
  std::vector<Row> rows;
  for (std::string line; std::getline(text, line);) {
    Row row(1);
    for (const char letter : line) {
      if (letter == ',') {
        row.emplace_back();
      } else {
        row.back() += letter;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<Row> rows_of(const std::string& text) { return rows_of(std::istringstream(text)); }

solver::ResponseCurve three_points() {
  solver::ResponseCurve curve;
  curve.points = {synthetic::point(295.1, 1e-4), synthetic::point(296.2, 2e-4),
                  synthetic::point(295.9, 1.0 / 3e4)};
  curve.points[0].stability = solver::Stability::not_assessed;
  curve.points[1].mark = solver::PointMark::peak;
  curve.points[1].orders = {1, 3, 5};
  curve.points[1].slope = {.amplitude = 3e-5, .phase = -0.4};
  curve.points[2].mark = solver::PointMark::fold;
  curve.points[2].stability = solver::Stability::unstable;
  return curve;
}

TEST(WriteCsv, CurveHasTheColumnsOfTheInterface) {
  const auto rows = rows_of(curve_table(three_points()));
  const Row expected{"frequency_Hz",
                     "amplitude_m",
                     "amplitude_1_m",
                     "mean_m",
                     "phase_deg",
                     "stable",
                     "stick_share",
                     "slip_share",
                     "separated_share",
                     "three_states_share",
                     "residual",
                     "energy_imbalance",
                     "dissipation_mismatch",
                     "mark",
                     "awake_share",
                     "iterations",
                     "harmonics",
                     "amplitude_slope_m_per_Hz",
                     "phase_slope_deg_per_Hz"};
  ASSERT_EQ(rows.size(), 4U);
  for (const Row& row : rows) EXPECT_EQ(row.size(), expected.size());
  EXPECT_EQ(rows[0], expected);
}

TEST(WriteCsv, CurveValuesStandInTheirColumns) {
  const auto rows = rows_of(curve_table(three_points()));
  const Row& first = rows[1];
  EXPECT_DOUBLE_EQ(std::stod(first[0]), 295.1);  // through rad/s and back
  EXPECT_EQ(std::stod(first[1]), 1e-4);
  EXPECT_EQ(std::stod(first[2]), 0.99 * 1e-4);
  EXPECT_EQ(std::stod(first[3]), -0.01 * 1e-4);
  EXPECT_DOUBLE_EQ(std::stod(first[4]), -45.0);
  EXPECT_EQ(Row(first.begin() + 5, first.end()),
            (Row{"-1", "0.5", "0.3", "0.2", "0.125", "1e-13", "2e-13", "3e-13", "", "1", "3", "1",
                 "", ""}));
  // d/dω = 1/2π d/df
  EXPECT_NEAR(std::stod(rows[2][17]), 2.0 * std::numbers::pi * 3e-5, 1e-15);
  EXPECT_DOUBLE_EQ(std::stod(rows[2][18]), -144.0);
  EXPECT_EQ(rows[2][5], "1");
  EXPECT_EQ(rows[2][13], "peak");
  EXPECT_EQ(rows[2][16], "3");  // unknowns beside the mean, not the highest order
  EXPECT_EQ(rows[3][5], "0");
  EXPECT_EQ(rows[3][13], "fold");
  EXPECT_EQ(std::stod(rows[3][1]), 1.0 / 3e4) << "digits are lost";
}

TEST(WriteCsv, StatesListMeansThenSinesThenCosines) {
  const auto rows = rows_of(states_table(three_points(), synthetic::n_modes));
  EXPECT_EQ(rows[0], (Row{"frequency_Hz", "q_mean_1", "q_mean_2", "q_sin1_1", "q_sin1_2",
                          "q_cos1_1", "q_cos1_2"}));
  const contact::Harmonics q = three_points().points[1].q;
  EXPECT_EQ(std::stod(rows[2][2]), q.mean()[1]);
  EXPECT_EQ(std::stod(rows[2][3]), q.sine()[0]);
  EXPECT_EQ(std::stod(rows[2][6]), q.cosine()[1]);
}

TEST(WriteCsv, SecondHarmonicFollowsTheFirst) {
  solver::ResponseCurve curve;
  curve.points.emplace_back();
  curve.points[0].q = contact::Harmonics(2, 1);
  EXPECT_EQ(rows_of(states_table(curve, 1))[0],
            (Row{"frequency_Hz", "q_mean_1", "q_sin1_1", "q_cos1_1", "q_sin2_1", "q_cos2_1"}));
}

TEST(WriteCsv, CurveWithoutPointsKeepsItsHeader) {
  const solver::ResponseCurve empty;
  EXPECT_EQ(rows_of(curve_table(empty)).size(), 1U);
  EXPECT_EQ(rows_of(states_table(empty, 2))[0].size(), 7U);
}

TEST(WriteCsv, BothFilesOfACurveAreNamedForIt) {
  const synthetic::Folder folder("write_csv");
  write_curve(folder.path(), {"preload_1000", 1000.0, three_points(), {}}, synthetic::n_modes);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "curves" / "preload_1000.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "curves" / "preload_1000.states.csv"));
}

TEST(WriteCsv, ModesLeaveUnknownColumnsEmpty) {
  const synthetic::Folder folder("write_modes");
  const ReducedModel model = synthetic::model();
  write_modes_csv(folder.path() / "modes.csv",
                  {model.frequency, {}, model.damping_ratio, model.patches[0].fit_error});
  const auto rows = rows_of(std::ifstream(folder.path() / "modes.csv"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0],
            (Row{"mode", "frequency_Hz", "residual", "damping_ratio", "fit_error", "kind"}));
  EXPECT_EQ(rows[1][0], "1");
  EXPECT_DOUBLE_EQ(std::stod(rows[1][1]), 296.123456789012);
  EXPECT_EQ(rows[2][2], "");
  EXPECT_EQ(rows[2][3], "0.003");
}

TEST(WriteCsv, AttachmentShapesAreToldApartAndHaveNoResidual) {
  const synthetic::Folder folder("write_attachment");
  write_modes_csv(folder.path() / "modes.csv", {Eigen::Vector3d(1.0, 2.0, 9.0),
                                                Eigen::Vector2d(1e-9, 2e-9),
                                                Eigen::Vector3d(0.1, 0.2, 0.2),
                                                {},
                                                1});
  const auto rows = rows_of(std::ifstream(folder.path() / "modes.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2].back(), "free");
  EXPECT_EQ(rows[3].back(), "attachment");
  EXPECT_EQ(rows[2][2], "2e-09");
  EXPECT_EQ(rows[3][2], "");
  EXPECT_EQ(rows[3][3], "0.2");
}

TEST(WriteCsv, OptimumIsMarkedInItsTrace) {
  const synthetic::Folder folder("write_optimum");
  solver::Optimum optimum;
  optimum.trace = {{10.0, 100.0, 3.0}, {20.0, 110.0, 1.0}, {30.0, 120.0, 2.0}};
  optimum.best = optimum.trace[1];
  optimum.found = true;
  write_optimum_csv(folder.path(), {"preload", std::nullopt, 0.0}, optimum);
  const auto rows = rows_of(std::ifstream(folder.path() / "peak_against_preload.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1].back(), "");
  EXPECT_EQ(rows[2].back(), "optimum");
  EXPECT_EQ(rows[2].front(), "20");
}

TEST(WriteCsv, TraceTellsEndsOfTheRangeAndAFlatMinimum) {
  const synthetic::Folder folder("write_flat");
  solver::Optimum optimum;
  optimum.trace = {{10.0, 100.0, 3.0}, {20.0, 110.0, 1.0}, {30.0, 110.0, 1.0}};
  optimum.trace[0].place = solver::PeakPlace::range_end;
  optimum.best = optimum.trace[1];
  optimum.flat = {20.0, 30.0};
  write_optimum_csv(folder.path(), {"contact.friction_coefficient", std::nullopt, 0.0}, optimum);
  const auto rows = rows_of(std::ifstream(folder.path() / "peak_against_parameter.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], (Row{"value", "frequency_Hz", "amplitude_m", "at", "mark"}));
  EXPECT_EQ(rows[1][3], "range_end");
  EXPECT_EQ(rows[1].back(), "");
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(rows[i][3], "peak");
    EXPECT_EQ(rows[i].back(), "flat");
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_write_csv
