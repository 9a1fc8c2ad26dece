#include "pipelines/cycle/cycle_columns.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "contact/point_cycle.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::array<std::string_view, 4> constants{"tangential_stiffness", "normal_stiffness",
                                                    "friction_coefficient", "preload"};
constexpr std::array<std::string_view, 5> required{"u_sin", "u_cos", "v_mean", "v_sin", "v_cos"};
constexpr std::string_view along_r = "tangential_stiffness_r";
constexpr std::array<std::string_view, 10> optional_columns{
    "id", "u_mean", "u_sin2", "u_cos2", "v_sin2", "v_cos2", "w_mean", "w_sin", "w_cos", along_r};
constexpr std::string_view signals = "uvw";

/// h of "", "2", "3", …; none for "0", "1", "02" or what is no number.
std::optional<int> harmonic_of(std::string_view number) {
  if (number.empty()) return 1;
  int h = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), h);
  const bool whole = error == std::errc() && end == number.data() + number.size();
  if (!whole || number.front() == '0' || h < 2 || h > largest_harmonic) return std::nullopt;
  return h;
}

struct Coefficient {
  Eigen::Index row = 0;
  Eigen::Index signal = 0;
};

/// Where the value of a column such as u_sin2 goes, if it is one.
std::optional<Coefficient> coefficient_of(std::string_view name) {
  const std::size_t signal = name.size() < 5 ? std::string_view::npos : signals.find(name.front());
  if (signal == std::string_view::npos || name[1] != '_') return std::nullopt;
  const auto s = static_cast<Eigen::Index>(signal);
  const std::string_view rest = name.substr(2);
  if (rest == "mean") return Coefficient{0, s};
  const bool sine = rest.starts_with("sin");
  if (!sine && !rest.starts_with("cos")) return std::nullopt;
  const std::optional<int> h = harmonic_of(rest.substr(3));
  if (!h) return std::nullopt;
  return Coefficient{2 * *h - (sine ? 1 : 0), s};
}

std::vector<std::string_view> known_columns() {
  std::vector<std::string_view> known;
  known.reserve(constants.size() + required.size() + optional_columns.size());
  std::copy(constants.begin(), constants.end(), std::back_inserter(known));
  std::copy(required.begin(), required.end(), std::back_inserter(known));
  std::copy(optional_columns.begin(), optional_columns.end(), std::back_inserter(known));
  return known;
}

}  // namespace

CycleColumns::CycleColumns(const CsvTable& table) : table_(table) {
  for (std::size_t i = 0; i < constants.size(); ++i) constants_[i] = table.require(constants[i]);
  for (const std::string_view name : required) static_cast<void>(table.require(name));
  const std::vector<std::string_view> known = known_columns();
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    const std::string& name = table.columns()[column];
    if (const std::optional<Coefficient> to = coefficient_of(name)) {
      places_.push_back({column, to->row, to->signal});
      has_second_direction_ = has_second_direction_ || to->signal == 2;
      n_harmonics_ = std::max(n_harmonics_, static_cast<int>((to->row + 1) / 2));
    } else if (name == along_r) {
      second_stiffness_ = column;
    } else if (name != "id" &&
               std::find(constants.begin(), constants.end(), name) == constants.end()) {
      throw SceneError(unknown_column(table, name, known));
    }
  }
}

contact::PointParameters CycleColumns::point(std::size_t row) const {
  const auto get = [&](std::size_t i) { return table_.at(row, constants_[i]); };
  for (std::size_t i = 0; i < 3; ++i) {
    if (get(i) < 0.0) {
      throw SceneError(table_.place(row, constants_[i]) + fmt::format("{:g} is negative", get(i)));
    }
  }
  return {get(0), get(1), get(2), get(3)};
}

double CycleColumns::second_stiffness(std::size_t row) const {
  const std::size_t column = second_stiffness_.value_or(constants_.front());
  const double stiffness = table_.at(row, column);
  if (stiffness < 0.0) {
    throw SceneError(table_.place(row, column) + fmt::format("{:g} is negative", stiffness));
  }
  return stiffness;
}

contact::Harmonics CycleColumns::motion(std::size_t row) const {
  contact::Harmonics motion(n_harmonics_, contact::n_point_signals);
  for (const Place& place : places_) {
    motion.rows()(place.coefficient, place.signal) = table_.at(row, place.column);
  }
  return motion;
}

}  // namespace microslip::pipelines
