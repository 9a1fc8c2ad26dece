#include "pipelines/cycle/cycle_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipelines/cycle/cycle_table.hpp"
#include "pipelines/system/exit_code.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_cycle_plot {
namespace {

using Json = nlohmann::json;

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double k = 1e12;  // of every point below
constexpr double mu = 0.4;
const std::string header =
    "id,tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_sin,u_cos,v_mean,"
    "v_sin,v_cos,u_sin3,w_sin,w_cos\n";
const std::string points = header +
                           "stuck,1e12,1e12,0.4,1e6,1e-7,0,0,1e-7,1e-7,0,0,0\n"
                           "constant,1e12,0,0.4,1e6,1e-6,0,0,0,0,0,0,0\n"
                           "slip,1e12,1e12,0.4,2e6,3e-6,0,0,5e-7,3e-7,0,0,0\n"
                           "lift,1e12,1e12,0.4,1e6,3e-6,1e-6,0,2e-6,2e-6,0,0,0\n"
                           "apart,1e12,1e12,0.4,-1e6,3e-6,1e-6,0,2e-7,2e-7,0,0,0\n"
                           "third,1e12,1e12,0.4,1e6,3e-6,1e-6,0,2e-7,2e-6,2e-6,0,0\n"
                           "plane,1e12,1e12,0.4,1e6,1e-6,3e-7,0,2e-7,1.4e-6,0,4e-7,-8e-7\n";

CsvTable table_of(const std::string& text) { return CsvTable::parse(text, "points.csv"); }

/// The sampled cycle of one row, as a reader of the file sees it.
struct Samples {
  std::string name;
  std::vector<std::vector<double>> rows;  // phase, u, v, w, f_p, n, f_r, slip_p, slip_r
  std::vector<std::string> states;
};

Samples read_samples(const CyclePlot& plot) {
  Samples samples{plot.name, {}, {}};
  std::istringstream text(plot.csv);
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line,
            "phase_deg,u_m,v_m,w_m,friction_Pa,normal_Pa,friction_w_Pa,slip_m,slip_w_m,state");
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::vector<double> row;
    while (row.size() < 9 && std::getline(cells, cell, ',')) row.push_back(std::stod(cell));
    std::getline(cells, cell);
    samples.rows.push_back(row);
    samples.states.push_back(cell);
  }
  return samples;
}

std::vector<Samples> all_samples() {
  std::vector<Samples> all;
  for (const CyclePlot& plot : cycle_plots(table_of(points))) all.push_back(read_samples(plot));
  return all;
}

/// Displacements, forces and sliders of these points are of the order of a few µm and k times that.
double scale_of(std::size_t column) { return column >= 4 && column <= 6 ? k * 1e-5 : 1e-5; }

TEST(CyclePlot, LoopsCloseAndPhasesRise) {
  for (const Samples& cycle : all_samples()) {
    ASSERT_GT(cycle.rows.size(), 720U);
    EXPECT_EQ(cycle.rows.front()[0], 0.0);
    EXPECT_EQ(cycle.rows.back()[0], 360.0);
    EXPECT_EQ(cycle.states.front(), cycle.states.back());
    for (std::size_t i = 1; i < cycle.rows.size(); ++i) {
      EXPECT_GE(cycle.rows[i][0], cycle.rows[i - 1][0]);
    }
    for (std::size_t column = 1; column < 9; ++column) {
      // Rounding of the event law, 1e-12 of the force scale for the planar one.
      EXPECT_NEAR(cycle.rows.back()[column], cycle.rows.front()[column], 2e-12 * scale_of(column))
          << cycle.name << ", column " << column;
    }
  }
}

TEST(CyclePlot, StatesAreThoseOfTheSegments) {
  const Json list = Json::parse(cycles_as_json(table_of(points)));
  const std::vector<Samples> all = all_samples();
  ASSERT_EQ(list.size(), all.size());
  for (std::size_t row = 0; row < all.size(); ++row) {
    EXPECT_EQ(list[row]["id"], all[row].name);
    std::map<std::string, double> expected;
    for (const Json& segment : list[row]["segments"]) {
      expected[segment["state"].get<std::string>()] += segment["length"].get<double>();
    }
    std::map<std::string, double> sampled;
    for (std::size_t i = 0; i + 1 < all[row].rows.size(); ++i) {
      sampled[all[row].states[i]] +=
          (all[row].rows[i + 1][0] - all[row].rows[i][0]) * two_pi / 360.0;
    }
    ASSERT_EQ(sampled.size(), expected.size()) << all[row].name;
    for (const auto& [state, length] : expected) {
      EXPECT_NEAR(sampled[state], length, 1e-11) << all[row].name << ", " << state;  // 800 sums
    }
  }
}

/// What an interval's state says about the samples at its ends, without knowing how it was found.
void expect_state_is_obeyed(const Samples& cycle, std::size_t i) {
  const std::vector<double>& a = cycle.rows[i];
  const std::vector<double>& b = cycle.rows[i + 1];
  const std::string& state = cycle.states[i];
  const double force = 2e-12 * scale_of(4);
  const double length = 2e-12 * scale_of(7);
  const double gap = mu * b[5] - std::hypot(b[4], b[6]);  // the end belongs to it by continuity
  EXPECT_GE(gap, -force);
  if (state == "separated") {
    EXPECT_NEAR(b[5], 0.0, force);
  } else if (state == "stick") {
    EXPECT_NEAR(b[7], a[7], length);
    EXPECT_NEAR(b[8], a[8], length);
  } else {
    EXPECT_NEAR(gap, 0.0, force);
    EXPECT_NEAR(k * (b[1] - b[7]), b[4], force);
    const double forth = state == "negative_slip" ? -1.0 : 1.0;
    if (state != "slip") {
      EXPECT_GT(forth * (b[7] - a[7]), -length);
    }
  }
}

TEST(CyclePlot, SamplesObeyTheStateOfTheirInterval) {
  std::map<std::string, int> seen;
  for (const Samples& cycle : all_samples()) {
    SCOPED_TRACE(cycle.name);
    for (std::size_t i = 0; i + 1 < cycle.rows.size(); ++i) {
      expect_state_is_obeyed(cycle, i);
      ++seen[cycle.states[i]];
    }
  }
  EXPECT_EQ(seen.size(), 5U);  // every state stands in one of the rows
}

// Trapezoids over smooth arcs with their corners sampled: |error| ≤ h²/12 ∮ |f'u'' − f''u'| dθ with
// |f'u'' − f''u'| ≤ 2 H³ F a; F: force scale, a: amplitude. Two directions: twice.
TEST(CyclePlot, AreaOfTheLoopIsTheDissipatedEnergy) {
  const Json list = Json::parse(cycles_as_json(table_of(points)));
  const std::vector<Samples> all = all_samples();
  for (std::size_t row = 0; row < all.size(); ++row) {
    const auto& at = all[row].rows;
    double area = 0.0;
    double a = 0.0;
    double F = 0.0;
    for (std::size_t i = 1; i < at.size(); ++i) {
      area += 0.5 * (at[i][4] + at[i - 1][4]) * (at[i][1] - at[i - 1][1]) +
              0.5 * (at[i][6] + at[i - 1][6]) * (at[i][3] - at[i - 1][3]);
      a = std::max({a, std::abs(at[i][1]), std::abs(at[i][3])});
      F = std::max(F, mu * at[i][5]);
    }
    const double H3 = all[row].name == "third" ? 27.0 : 1.0;
    const double h = two_pi / 720.0;
    const double bound = 2.0 * h * h / 12.0 * two_pi * 2.0 * H3 * (F + k * a) * a;
    const double energy = list[row]["dissipated_energy"].get<double>();
    std::printf("%-8s ∮ f du %.8e, dissipated %.8e, error %.1e, bound %.1e\n",
                all[row].name.c_str(), area, energy, std::abs(area - energy), bound);
    EXPECT_NEAR(area, energy, bound) << all[row].name;
    if (energy > 0.0) {
      EXPECT_NEAR(area / energy, 1.0, 1e-4) << all[row].name;  // h² and little more
    }
  }
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(cycle_plots(table_of(text)));
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(CyclePlot, RefusesTablesItCannotNameOrDraw) {
  const std::string rest = ",1,1,0.5,1,3,0,0,0.2,0,0,0,0\n";
  std::string many = header;
  for (std::size_t i = 1; i <= largest_plotted_table; ++i) many += std::to_string(i) + rest;
  EXPECT_EQ(refusal(many), "");
  EXPECT_NE(refusal(many + "last" + rest).find("points.csv: 201 rows; --plot draws at most 200"),
            std::string::npos);
  const std::string twice = refusal(header + "a" + rest + "b" + rest + "a" + rest);
  EXPECT_NE(twice.find("points.csv:4: id: \"a\" stands at points.csv:2 already"), std::string::npos)
      << twice;
  for (const std::string& id :
       {std::string("../a"), std::string(".hidden"), std::string(201, 'x')}) {
    EXPECT_NE(refusal(header + id + rest).find("points.csv:2: id: "), std::string::npos) << id;
  }
  EXPECT_NE(refusal(header + "2" + rest + rest).find("already"),
            std::string::npos);  // row 2 is "2"
}

TEST(CyclePlot, DrawsBothFormatsBesideTheSamples) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "below" / "loops";
  const std::vector<CyclePlot> plots = cycle_plots(
      table_of(header + "a $b,1e12,1e12,0.4,1e6,1e-6,3e-7,0,2e-7,1.4e-6,0,4e-7,-8e-7\n" +
               ",0,0,0,0,0,0,0,0,0,0,0,0\n"));
  write_cycle_plots(plots, folder);
  draw_cycle_plots(plots, folder);
  for (const char* stem : {"a $b", "2"}) {
    for (const char* extension : {".csv", ".svg", ".png"}) {
      const std::filesystem::path file = folder / (std::string(stem) + extension);
      ASSERT_TRUE(std::filesystem::exists(file)) << file;
      EXPECT_GT(std::filesystem::file_size(file), 1000U) << file;
    }
  }
}

TEST(CyclePlot, AFolderThatCannotBeMadeIsExitFour) {
  const test::TemporaryFolder temporary;
  std::ofstream(temporary.path() / "file") << "in the way";
  try {
    write_cycle_plots({}, temporary.path() / "file");
    FAIL() << "a file is no folder";
  } catch (const std::exception& error) {
    EXPECT_EQ(exit_code_of(error), ExitCode::exhausted);
    EXPECT_NE(std::string(error.what()).find("file"), std::string::npos);
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_cycle_plot
