// Damaged tables for `cycle`: whatever is read ends in JSON or in a message with its place, nothing
// else.
//
// Each of 40 000 seeds damages a good table a few times: bytes changed, cut, repeated or moved,
// cells replaced by what spreadsheets and other programs write; every second table only has numbers
// of any size exchanged. Seeds are the loop's numbers, so that a failure names its own.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipelines/cycle/cycle_table.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::pipelines::test_cycle_fuzz {
namespace {

const std::array<std::string, 2> good_tables{
    "id,tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_sin,u_cos,v_mean,v_"
    "sin,v_cos\n"
    "a,1,1,0.5,1,2,0,0,0.5,0.25\n"
    "b,1e9,0,0.3,100,1e-6,2e-6,0,0,0\n"
    "c,2,3,0,-1,1,1,0.5,1,1\n",
    "tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_mean,u_sin,u_cos,v_mean,"
    "v_sin,"
    "v_cos,u_sin2,u_cos2,v_sin2,v_cos2\n"
    "1,1,0.5,1,0.1,2,0,0,0.5,0.25,0.3,0.1,0,0.2\n"
    "5,0,0.4,0.2,0,1,0,0,0,0,0.5,0,0,0\n"};

const std::array<std::string, 24> oddities{
    "",         "nan",          "-inf", "1e999", "1e-999", "0x1p3", "1,5", "\"1\"", "\"",
    "=A1",      " 1 ",          "١",    "+1",    "--1",    "1e",    ".",   "\r",    "\0",
    "\xff\xfe", "\xef\xbb\xbf", ";",    "\t",    "1e308",  "5e-324"};

class Damage {
 public:
  explicit Damage(std::uint32_t seed) : random_(seed) {}

  void once(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min<std::size_t>(below(12), text.size() - at);
    switch (below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 2:
        text.insert(at, text.substr(below(text.size() + 1), 1 + below(80)));
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, oddities.at(below(oddities.size())));
        break;
      default:
        replace_cell(text, false);
        break;
    }
  }

  /// Another number in a row below the header.
  void number(std::string& text) { replace_cell(text, true); }

  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

 private:
  std::string any_number() {
    std::uniform_real_distribution<double> exponent(-320.0, 308.0);
    const bool mild = below(2) == 0;
    const double size = std::pow(10.0, mild ? exponent(random_) / 100.0 : exponent(random_));
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", below(2) == 0 ? size : -size);
    return text.data();
  }

  void replace_cell(std::string& text, bool by_number) {
    if (text.empty()) return;
    const std::size_t begin = text.find_last_of(",\n", below(text.size()));
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_of(",\n", begin + 1), text.size());
    text.replace(begin + 1, end - begin - 1,
                 by_number ? any_number() : oddities.at(below(oddities.size())));
  }

  std::mt19937 random_;
};

/// False where a number is missing: JSON has no NaN.
bool all_numbers(const nlohmann::json& value) {
  if (value.is_null()) return false;
  return !value.is_structured() || std::all_of(value.begin(), value.end(), all_numbers);
}

TEST(CycleFuzz, DamagedTablesAreReadOrRefusedWithTheirPlace) {
  int n_read = 0;
  int n_refused = 0;
  const int n_tables = tests::campaign_size(40'000);
  for (int seed = 0; seed < n_tables; ++seed) {
    Damage damage(static_cast<std::uint32_t>(seed));
    std::string text = good_tables.at(damage.below(good_tables.size()));
    for (std::size_t i = 0; i <= damage.below(4); ++i) {
      seed % 2 == 0 ? damage.once(text) : damage.number(text);
    }
    try {
      const std::string json = cycles_as_json(CsvTable::parse(text, "points.csv"));
      ASSERT_TRUE(all_numbers(nlohmann::json::parse(json))) << seed << "\n" << text;
      ++n_read;
    } catch (const SceneError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("points.csv"))
          << seed << ": " << error.what();
      ++n_refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << seed << ": " << error.what() << "\n" << text;
    }
  }
  std::printf("%d read, %d refused\n", n_read, n_refused);
  EXPECT_GT(n_read, n_tables / 20);
  EXPECT_GT(n_refused, n_tables / 3);
}

}  // namespace
}  // namespace microslip::pipelines::test_cycle_fuzz
