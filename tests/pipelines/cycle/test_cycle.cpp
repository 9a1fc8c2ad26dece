#include "pipelines/cycle/cycle_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/line/line_events.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/mutated_text.hpp"

namespace microslip::pipelines::test_cycle {
namespace {

using Json = nlohmann::json;

constexpr double pi = std::numbers::pi;
const std::string header =
    "tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_sin,u_cos,v_mean,v_sin,"
    "v_cos\n";

Json cycles(const std::string& table, std::optional<int> n_harmonics = std::nullopt) {
  return Json::parse(cycles_as_json(CsvTable::parse(table, "points.csv"), n_harmonics));
}

/// Message of the SceneError; empty when the table is taken.
std::string complaint(const std::string& table) {
  try {
    static_cast<void>(cycles(table));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

void expect_complaint(const std::string& table, const std::vector<std::string>& parts) {
  const std::string message = complaint(table);
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" lacks " << part;
  }
}

TEST(CycleTable, EveryRowHasExactlyTheKeysOfItsInterface) {
  const Json list = cycles(header + "1,1,0.5,1,3,0,0,0.2,0.1\n");
  ASSERT_TRUE(list.is_array());
  ASSERT_EQ(list.size(), 1U);
  std::vector<std::string> keys;
  for (const auto& [key, value] : list[0].items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"dissipated_energy", "friction", "id", "jacobian",
                                            "normal", "regime", "segments", "slip_distance"}));
  for (const char* force : {"friction", "normal"}) {
    EXPECT_EQ(list[0][force].size(), 3U);
    EXPECT_TRUE(list[0][force]["mean"].is_number());
    EXPECT_EQ(list[0][force]["sin"].size(), 1U);
    EXPECT_EQ(list[0][force]["cos"].size(), 1U);
  }
  ASSERT_EQ(list[0]["jacobian"].size(), 6U);
  for (const Json& row : list[0]["jacobian"]) EXPECT_EQ(row.size(), 5U);
  double length = 0.0;
  double last = -1.0;
  for (const Json& segment : list[0]["segments"]) {
    EXPECT_EQ(segment.size(), 3U);
    const double start = segment["start"].get<double>();
    EXPECT_GT(start, last);
    EXPECT_LT(start, 2.0 * pi);
    last = start;
    length += segment["length"].get<double>();
  }
  EXPECT_NEAR(length, 2.0 * pi, 1e-14);  // a few roundings of numbers up to 2π
}

TEST(CycleTable, TheJacobianLeavesOutTheMeanOfU) {
  const contact::PointParameters point{1.0, 0.8, 0.5, 1.0};
  const contact::PointMotion motion{0.0, 3.0, 0.4, 0.1, 0.2, -0.3};
  const auto cycle = contact::friction_cycle(point, motion);
  const Json jacobian = cycles(header + "1,0.8,0.5,1,3,0.4,0.1,0.2,-0.3\n")[0]["jacobian"];
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_EQ(jacobian[i][j].get<double>(),
                cycle.jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j) + 1));
    }
  }
}

// D = 4 μ n₀ (a − μ n₀ / k_u) for constant load (theory section 7); slip distance 4 (a − μ n₀ /
// k_u).
TEST(CycleTable, ConstantLoadDissipatesTheClosedForm) {
  const Json row = cycles(header + "2e6,0,0.4,1000,1e-3,0,0,0,0\n")[0];
  const double slip = 4.0 * (1e-3 - 400.0 / 2e6);
  EXPECT_EQ(row["regime"], "stick_slip");
  EXPECT_NEAR(row["dissipated_energy"].get<double>(), 400.0 * slip, 1e-13);  // ~10 roundings of 1
  EXPECT_NEAR(row["slip_distance"].get<double>(), slip, 1e-17);
  EXPECT_EQ(row["normal"]["mean"].get<double>(), 1000.0);
}

TEST(CycleTable, RegimesHaveTheirNames) {
  const Json list = cycles(header +
                           "1,1,0.5,10,1,0,0,0,0\n"    // bound 5 never reached
                           "1,1,0.5,1,3,0,0,0.2,0\n"   // slides, always loaded
                           "1,1,0.5,1,3,0,0,2,0\n"     // lifts off
                           "1,1,0.5,-3,3,0,0,2,0\n");  // never touches
  EXPECT_EQ(list[0]["regime"], "full_stick");
  EXPECT_EQ(list[1]["regime"], "stick_slip");
  EXPECT_EQ(list[2]["regime"], "separation");
  EXPECT_EQ(list[3]["regime"], "separated");
  EXPECT_EQ(list[3]["segments"].size(), 1U);
  EXPECT_EQ(list[3]["segments"][0]["state"], "separated");
  EXPECT_EQ(list[3]["friction"]["sin"][0].get<double>(), 0.0);
}

TEST(CycleTable, ColumnsMayStandInAnyOrderAndRowsKeepTheirs) {
  const Json list = cycles(
      "v_cos,id,preload,u_sin,u_cos,v_mean,u_mean,v_sin,normal_stiffness,tangential_stiffness,"
      "friction_coefficient\n0.1,b,1,3,0,0,0,0.2,1,1,0.5\n0.1,\"a, no\",1,3,0,0,0,0.2,1,1,0.5\n");
  const Json plain = cycles(header + "1,1,0.5,1,3,0,0,0.2,0.1\n");
  EXPECT_EQ(list[0]["id"], "b");
  EXPECT_EQ(list[1]["id"], "a, no");
  EXPECT_EQ(list[0]["friction"], plain[0]["friction"]);
  EXPECT_EQ(list[0]["jacobian"], plain[0]["jacobian"]);
  EXPECT_EQ(plain[0]["id"], "1");
}

// Motion along r alone under another stiffness there is the cycle of one direction with that
// stiffness.
TEST(CycleTable, TheSecondDirectionHasItsOwnStiffness) {
  const std::string columns = header.substr(0, header.size() - 1);
  const Json row = cycles(
      columns + ",w_sin,w_cos,tangential_stiffness_r\n1,0.8,0.5,1,0,0,0,0.2,0.1,3,0.4,2.5\n")[0];
  const Json plain = cycles(header + "2.5,0.8,0.5,1,3,0.4,0,0.2,0.1\n")[0];
  const double scale = 2.5 * 3.1 + 0.5;
  for (const char* part : {"sin", "cos"}) {
    EXPECT_NEAR(row["friction_w"][part][0].get<double>(), plain["friction"][part][0].get<double>(),
                1e-11 * scale);
    EXPECT_NEAR(row["friction"][part][0].get<double>(), 0.0, 1e-11 * scale);
  }
  EXPECT_THROW(static_cast<void>(cycles(columns + ",tangential_stiffness_r\n"
                                                  "1,1,0.5,1,3,0,0,0,0,-1\n")),
               SceneError);
}

// A circle of radius 1 (theory section 9): force μn, of which ρ = μn / k is in phase with the
// displacement and √(1 − ρ²) against the velocity. Next to the onset of slip, ρ = 1, a slider comes
// to its circle slowly: the force is as good as the root of rounding there, and a search that ends
// before its tolerance says so.
TEST(CycleTable, CirclesNextToTheOnsetOfSlipAreThoseOfTheFormula) {
  const std::string columns = header.substr(0, header.size() - 1) + ",w_sin,w_cos\n";
  constexpr double root_of_rounding = 1e-9;  // √ε · k a, with a margin of 15 below it
  int n_told = 0;
  for (int k = 1; k <= 13; ++k) {
    const std::string preload = fmt::format("{:.17g}", 1.0 - std::pow(10.0, -k));
    const Json row = cycles(columns + "1,0,1," + preload + ",1,0,0,0,0,0,1\n")[0];
    const double rho = std::stod(preload);
    const double across = rho * std::sqrt((1.0 - rho) * (1.0 + rho));
    EXPECT_NEAR(row["friction"]["sin"][0].get<double>(), rho * rho, root_of_rounding) << preload;
    EXPECT_NEAR(row["friction"]["cos"][0].get<double>(), across, root_of_rounding) << preload;
    if (!row.contains("defect")) continue;
    ++n_told;
    EXPECT_GT(row["defect"].get<double>(), 0.0) << preload;
    EXPECT_LE(row["defect"].get<double>(), root_of_rounding) << preload;
  }
  EXPECT_LT(n_told, 6);  // those within 1e-9 of the onset at most
  EXPECT_FALSE(cycles(header + "1,1,0.5,1,3,0,0,0.2,0.1\n")[0].contains("defect"));
}

TEST(CycleTable, TheMeanOfUPushesAStuckPoint) {
  const std::string columns = header.substr(0, header.size() - 1) + ",u_mean\n";
  EXPECT_DOUBLE_EQ(
      cycles(columns + "2,1,0.5,10,1,0,0,0,0,0.5\n")[0]["friction"]["mean"].get<double>(),
      1.0);  // k_u u₀: within the band
}

TEST(CycleTable, NumbersReadBackToTheSameDoubles) {
  const contact::PointParameters point{1.0 / 3.0, 0.7, 0.3, 1.0 / 7.0};
  const contact::PointMotion motion{0.0, 1.1, 1e-17, 0.1, 0.2, 0.3};
  const auto cycle = contact::friction_cycle(point, motion);
  const Json row =
      cycles(header + "0.33333333333333331,0.7,0.3,0.14285714285714285,1.1,1e-17,0.1,0.2,0.3\n")[0];
  EXPECT_EQ(row["friction"]["sin"][0].get<double>(), cycle.friction.sin);
  EXPECT_EQ(row["friction"]["cos"][0].get<double>(), cycle.friction.cos);
  EXPECT_EQ(row["dissipated_energy"].get<double>(), cycle.dissipated_energy);
}

TEST(CycleTable, AHeaderWithoutRowsIsAnEmptyList) { EXPECT_TRUE(cycles(header).empty()); }

TEST(CycleTable, WindowsFilesAreTheSame) {
  const std::string rows = "1,1,0.5,1,3,0,0,0.2,0.1\n";
  std::string windows = header + rows;
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) {
    windows.insert(at, 1, '\r');
  }
  EXPECT_EQ(cycles(windows), cycles(header + rows));
}

// ---- higher harmonics

/// The same integrals by the trapezoidal rule over 2^17 instants of at_phase(): f has kinks, so the
/// error is of second order in the step, below 1e-8 of the force.
TEST(CycleHarmonics, AreTheIntegralsOfTheForcesOverThePeriod) {
  constexpr int n = 1 << 17;
  constexpr int n_harmonics = 7;
  const std::array<contact::PointParameters, 5> points{{{1.0, 0.0, 0.5, 1.0},
                                                        {1.0, 1.0, 0.5, 1.0},
                                                        {1.0, 1.0, 0.5, -0.5},
                                                        {1.0, 1.0, 0.5, 9.0},
                                                        {1.0, 1.0, 0.0, 1.0}}};
  const contact::PointMotion motion{0.2, 2.5, -0.7, 0.1, 1.5, 0.4};
  for (const auto& point : points) {
    const auto cycle = contact::friction_cycle(point, motion);
    const Json row = cycles(header.substr(0, header.size() - 1) + ",u_mean\n" +
                                std::to_string(point.tangential_stiffness) + "," +
                                std::to_string(point.normal_stiffness) + "," +
                                std::to_string(point.friction_coefficient) + "," +
                                std::to_string(point.rest_load) + ",2.5,-0.7,0.1,1.5,0.4,0.2\n",
                            n_harmonics)[0];
    for (std::size_t h = 1; h <= n_harmonics; ++h) {
      std::array<double, 4> sums{};
      for (int i = 0; i < n; ++i) {
        const double phase = 2.0 * pi * i / n;
        const auto now = contact::at_phase(cycle, point, motion, phase);
        const double s = std::sin(static_cast<double>(h) * phase) * 2.0 / n;
        const double c = std::cos(static_cast<double>(h) * phase) * 2.0 / n;
        sums[0] += now.friction * s;
        sums[1] += now.friction * c;
        sums[2] += now.normal * s;
        sums[3] += now.normal * c;
      }
      const Json& friction = row["friction"];
      const Json& normal = row["normal"];
      EXPECT_NEAR(friction["sin"][h - 1].get<double>(), sums[0], 1e-8) << point.rest_load << h;
      EXPECT_NEAR(friction["cos"][h - 1].get<double>(), sums[1], 1e-8) << point.rest_load << h;
      EXPECT_NEAR(normal["sin"][h - 1].get<double>(), sums[2], 1e-8) << point.rest_load << h;
      EXPECT_NEAR(normal["cos"][h - 1].get<double>(), sums[3], 1e-8) << point.rest_load << h;
    }
  }
}

/// Constant load: f(θ + π) = −f(θ), so even harmonics vanish and odd ones do not.
TEST(CycleHarmonics, EvenOnesVanishUnderConstantLoad) {
  const Json row = cycles(header + "1,0,0.5,1,3,0.3,0,0,0\n", 9)[0];
  ASSERT_EQ(row["friction"]["sin"].size(), 9U);
  for (std::size_t h = 2; h <= 9; ++h) {
    const double size = std::hypot(row["friction"]["sin"][h - 1].get<double>(),
                                   row["friction"]["cos"][h - 1].get<double>());
    if (h % 2 == 0) {
      EXPECT_LT(size, 1e-15);  // rounding of four segments of size 0.5
    } else {
      EXPECT_GT(size, 1e-3);
    }
    EXPECT_LT(std::abs(row["normal"]["cos"][h - 1].get<double>()), 1e-15);
  }
}

TEST(CycleHarmonics, TheFirstDoesNotDependOnHowManyAreAsked) {
  const std::string table = header + "1,1,0.5,1,3,0.3,0,2,0.1\n";
  EXPECT_EQ(cycles(table, 5)[0]["friction"]["sin"][0], cycles(table)[0]["friction"]["sin"][0]);
  EXPECT_EQ(cycles(table, 5)[0]["jacobian"], cycles(table)[0]["jacobian"]);
  EXPECT_THROW(static_cast<void>(cycles(table, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(cycles(table, largest_harmonic + 1)), std::invalid_argument);
}

// ---- motion of many harmonics

std::string with_columns(const std::string& columns, const std::string& values) {
  return header.substr(0, header.size() - 1) + "," + columns + "\n1,1,0.5,1,3,0.3,0,0.2,0.1," +
         values + "\n";
}

TEST(CycleOfManyHarmonics, IsThatOfTheLineEvents) {
  const Json row = cycles(with_columns("u_sin2,v_cos3,u_cos3,u_mean", "0.7,-0.4,1.1,0.3"))[0];
  contact::Harmonics motion(3, 3);
  motion.rows().col(0) << 0.3, 3.0, 0.3, 0.7, 0.0, 0.0, 1.1;
  motion.rows().col(1) << 0.0, 0.2, 0.1, 0.0, 0.0, 0.0, -0.4;
  const auto history = contact::LineEvents({1.0, 1.0, 0.5, 1.0}).history(motion, 0.0, {}, 3);
  EXPECT_EQ(row["dissipated_energy"].get<double>(), history.dissipated_energy);
  EXPECT_EQ(row["slip_distance"].get<double>(), history.slip_distance);
  EXPECT_EQ(row["segments"].size(), history.segments.size());
  EXPECT_EQ(row["friction"]["mean"].get<double>(), history.force.mean()[0]);
  for (int h = 1; h <= 3; ++h) {
    const auto i = static_cast<std::size_t>(h - 1);
    EXPECT_EQ(row["friction"]["sin"][i].get<double>(), history.force.sine(h)[0]);
    EXPECT_EQ(row["friction"]["cos"][i].get<double>(), history.force.cosine(h)[0]);
    EXPECT_EQ(row["normal"]["sin"][i].get<double>(), history.force.sine(h)[1]);
    EXPECT_EQ(row["normal"]["cos"][i].get<double>(), history.force.cosine(h)[1]);
  }
  EXPECT_FALSE(row.contains("jacobian"));  // single-harmonic motion only
}

TEST(CycleOfManyHarmonics, AsManyArePutOutAsTheTableHas) {
  for (const char* force : {"friction", "normal"}) {
    EXPECT_EQ(cycles(with_columns("u_sin7", "0.1"))[0][force]["sin"].size(), 7U);
    EXPECT_EQ(cycles(with_columns("v_cos4", "0.1"))[0][force]["cos"].size(), 4U);
    EXPECT_EQ(cycles(with_columns("v_cos4", "0.1"), 2)[0][force]["cos"].size(), 2U);
    EXPECT_EQ(cycles(with_columns("v_cos4", "0.1"), 9)[0][force]["cos"].size(), 9U);
  }
}

TEST(CycleOfManyHarmonics, ZerosAreMotionOfOneHarmonic) {
  const Json plain = cycles(header + "1,1,0.5,1,3,0.3,0,0.2,0.1\n")[0];
  const Json zeros = cycles(with_columns("u_sin2,v_cos5", "0,0"), 1)[0];
  EXPECT_EQ(zeros, plain);
}

// A motion of only the second harmonic runs through two cycles of the first: same forces, twice the
// work.
TEST(CycleOfManyHarmonics, AMotionTwiceAsFastIsTheSameCycleTwice) {
  const Json once = cycles(header + "1,1,0.5,1,3,0.3,0,0.2,1.5\n")[0];
  const Json twice = cycles(header.substr(0, header.size() - 1) +
                            ",u_sin2,u_cos2,v_sin2,v_cos2\n1,1,0.5,1,0,0,0,0,0,3,0.3,0.2,1.5\n")[0];
  const double rounding = 1e-14;  // some ten roundings of forces of size 3, twice the phases
  EXPECT_NEAR(twice["friction"]["sin"][1].get<double>(), once["friction"]["sin"][0].get<double>(),
              rounding);
  EXPECT_NEAR(twice["normal"]["mean"].get<double>(), once["normal"]["mean"].get<double>(),
              rounding);
  EXPECT_NEAR(twice["friction"]["cos"][0].get<double>(), 0.0, rounding);
  EXPECT_NEAR(twice["dissipated_energy"].get<double>(),
              2.0 * once["dissipated_energy"].get<double>(), 10.0 * rounding);
  EXPECT_EQ(twice["segments"].size(), 2 * once["segments"].size());
}

// ---- two tangential directions

TEST(CycleInTwoDirections, NamesBothForces) {
  const Json row = cycles(with_columns("w_sin,w_cos2", "0.4,0.2"))[0];
  std::vector<std::string> keys;
  for (const auto& [key, value] : row.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"dissipated_energy", "friction", "friction_w", "id",
                                            "normal", "regime", "segments", "slip_distance"}));
  EXPECT_EQ(row["friction_w"]["sin"].size(), 2U);
}

// Circular motion under constant load (theory section 9): |f| = μ n, D = 2π μ n √(a² − (μn/k)²).
TEST(CycleInTwoDirections, ACircleDissipatesTheClosedForm) {
  const std::string columns = header.substr(0, header.size() - 1) + ",w_sin,w_cos\n";
  const Json row = cycles(columns + "2,0,0.5,1.2,0,1,0,0,0,1,0\n")[0];
  const double work = 2.0 * pi * 0.6 * std::sqrt(1.0 - 0.09);
  const double tolerance = 1e-11;  // the law is asked for 1e-12 of forces of size 2
  EXPECT_NEAR(row["dissipated_energy"].get<double>(), work, 10.0 * tolerance);
  const double f =
      std::hypot(row["friction"]["sin"][0].get<double>(), row["friction"]["cos"][0].get<double>());
  EXPECT_NEAR(f, 0.6, tolerance);
  EXPECT_EQ(row["segments"][0]["state"], "slip");
}

// Row 12c. Hard: a straight motion oblique to p: friction along p alone drops a part of it.
// Met in: patches whose slip direction is guessed.
// Right: the cycle along the line, turned.
//
// Along a line planar events is the other one, turned.
TEST(CycleInTwoDirections, AStraightObliqueMotionIsTheOtherOneTurned) {
  const Json straight = cycles(header + "1,1,0.5,1,5,0,0,0.2,0.1\n")[0];
  const std::string columns = header.substr(0, header.size() - 1) + ",w_sin,w_cos\n";
  const Json oblique = cycles(columns + "1,1,0.5,1,3,0,0,0.2,0.1,4,0\n")[0];
  const double f = straight["friction"]["sin"][0].get<double>();
  const double tolerance = 5e-11;  // 1e-12 of a force scale of 5, in both
  EXPECT_NEAR(oblique["friction"]["sin"][0].get<double>(), 0.6 * f, tolerance);
  EXPECT_NEAR(oblique["friction_w"]["sin"][0].get<double>(), 0.8 * f, tolerance);
  EXPECT_NEAR(oblique["dissipated_energy"].get<double>(),
              straight["dissipated_energy"].get<double>(), 10.0 * tolerance);
}

TEST(CycleInTwoDirections, ZerosAreMotionAlongP) {
  const std::string columns = header.substr(0, header.size() - 1) + ",w_sin\n";
  Json row = cycles(columns + "1,1,0.5,1,3,0.3,0,0.2,0.1,0\n")[0];
  EXPECT_EQ(row["friction_w"]["sin"][0].get<double>(), 0.0);
  row.erase("friction_w");
  EXPECT_EQ(row, cycles(header + "1,1,0.5,1,3,0.3,0,0.2,0.1\n")[0]);
}

// ---- bad tables

TEST(BadCycleTable, ValuesAreToldWithLineAndColumn) {
  expect_complaint(header + "1,1,0.5,1,3,0,0,0.2,0\n-1,1,0.5,1,3,0,0,0.2,0\n",
                   {"points.csv:3: tangential_stiffness: ", "-1 is negative"});
  expect_complaint("# c\n\n" + header + "1,-2,0.5,1,3,0,0,0.2,0\n",
                   {"points.csv:4: normal_stiffness: ", "negative"});
  expect_complaint(header + "1,1,-0.5,1,3,0,0,0.2,0\n", {"points.csv:2: friction_coefficient: "});
  expect_complaint(header + "1,1,0.5,nan,3,0,0,0.2,0\n", {"points.csv:2: preload: ", "finite"});
  expect_complaint(header + "1,1,0.5,1,-inf,0,0,0.2,0\n", {"points.csv:2: u_sin: ", "finite"});
  expect_complaint(header + "1,1,0.5,1,3,0,0,0.2,x\n", {"points.csv:2: v_cos: ", "\"x\""});
  expect_complaint(header + "1,1,0.5,1,3,0,0,0.2,1e400\n", {"points.csv:2: v_cos: ", "range"});
  expect_complaint(header + "1,1,0.5,1,3,0,0,0.2\n", {"points.csv:2: ", "8 values under 9"});
  expect_complaint(header + "1,1,0.5,1,3,0,0,0.2,0,0\n", {"points.csv:2: ", "10 values under 9"});
}

TEST(BadCycleTable, ColumnsAreTold) {
  expect_complaint("id,u_sin\n1,2\n", {"points.csv:1: ", "tangential_stiffness", "missing"});
  const auto with = [](const std::string& column, const std::string& value) {
    return header.substr(0, header.size() - 1) + "," + column + "\n1,1,0.5,1,3,0,0,0.2,0," + value +
           "\n";
  };
  expect_complaint(with("v_sinn", "0"), {"unknown column \"v_sinn\"", "did you mean \"v_sin\"?"});
  expect_complaint(with("zzzzzzzzzzzzzzzz", "0"), {"known: ", "u_mean"});
  expect_complaint(with("u_sin", "0"), {"\"u_sin\" stands twice"});
  expect_complaint("preload;u_sin\n1,5;3\n",
                   {"points.csv:1: columns are separated by semicolons; expected commas"});
  expect_complaint("preload\tu_sin\n1\t3\n", {"points.csv:1: ", "by tabs"});
  expect_complaint(with("", "0"), {"column 10 has no name"});
  expect_complaint("", {"empty"});
}

TEST(BadCycleTable, HarmonicsHaveOneNameEach) {
  for (const char* column : {"u_sin1", "u_sin0", "u_sin02", "u_sin1001", "u_sin2x", "u_sin-2",
                             "u_sin 2", "u_mean2", "x_sin2", "usin2", "u_", "u_si"}) {
    expect_complaint(with_columns(column, "0"), {"points.csv:1: ", "unknown column", column});
  }
  EXPECT_EQ(complaint(with_columns("u_sin1000", "0")), "");
}

TEST(BadCycleTable, ForcesBeyondDoublePrecisionAreNotWrittenAsNull) {
  expect_complaint(header + "1e300,1,0.5,1e300,1e300,0,0,0.2,0\n", {"points.csv:2: ", "range"});
}

TEST(BadCycleTable, AnIdOutsideUtf8IsNamed) {
  expect_complaint("id," + header + "\xFF,1,1,0.5,1,3,0,0,0.2,0\n", {"points.csv:2: ", "UTF-8"});
}

/// A table with bytes changed, swapped or cut ends in JSON without null, or in a SceneError.
TEST(BadCycleTable, AnyMutationEndsInJsonOrAnError) {
  const std::string table =
      "id,u_sin3,v_cos2," + header + "a,1e-4,0,1e6,2e6,0.4,100,1e-3,0,0,2e-5,1e-6\n" +
      "b,0,1e-5,1e6,0,0.4,-100,1e-3,1e-4,0,2e-5,1e-6\n\n" + "c,0,0,0,1,0,0,0,0,0,0,0\n";
  constexpr char all_bytes[] =
      ",\n\r\" \t#0123459.+-eEnaif_uvw\0\xFF\xC3";  // a zero byte is among them
  test::MutatedText mutated(11, {all_bytes, sizeof(all_bytes) - 1});
  int n_taken = 0;
  constexpr int n_trials = 5000;
  for (int i = 0; i < n_trials; ++i) {
    const std::string text = mutated.of(table, 3, 5, 30);
    try {
      const std::string json = cycles_as_json(CsvTable::parse(text, "points.csv"));
      EXPECT_EQ(json.find("null"), std::string::npos) << text;
      ++n_taken;
    } catch (const SceneError&) {  // any other exception ends the test
    }
  }
  EXPECT_GT(n_taken, 0);
  EXPECT_LT(n_taken, n_trials);
}

}  // namespace
}  // namespace microslip::pipelines::test_cycle
