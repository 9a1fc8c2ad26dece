/// @file
/// The columns of a table of contact points and their motions (interfaces.md section 4): constants
/// of a point, and per signal u, v, w a mean and harmonics,
///
///   u_mean, u_sin, u_cos, u_sin2, u_cos2, …,   v_…,   w_…
///
/// in any order, with gaps; what is missing is 0.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/patch.hpp"
#include "pipelines/text/csv_table.hpp"

namespace microslip::pipelines {

inline constexpr int largest_harmonic = 1000;

class CycleColumns {
 public:
  /// @param table  borrowed.
  /// @throws SceneError  a required column is missing or one is unknown, with its nearest name.
  explicit CycleColumns(const CsvTable& table);

  /// Highest harmonic of any column, ≥ 1.
  [[nodiscard]] int n_harmonics() const { return n_harmonics_; }
  /// Whether the table names w, be it 0.
  [[nodiscard]] bool has_second_direction() const { return has_second_direction_; }
  /// @throws SceneError  a constant out of its range; with line and column.
  [[nodiscard]] contact::PointParameters point(std::size_t row) const;
  /// Along r: the column tangential_stiffness_r, without it that of p.
  /// @throws SceneError  negative; with line and column.
  [[nodiscard]] double second_stiffness(std::size_t row) const;
  /// Signals u, v, w; n_harmonics() harmonics.
  [[nodiscard]] contact::Harmonics motion(std::size_t row) const;

 private:
  struct Place {
    std::size_t column = 0;
    Eigen::Index coefficient = 0;  // row of Harmonics
    Eigen::Index signal = 0;
  };

  const CsvTable& table_;
  std::array<std::size_t, 4> constants_{};
  std::optional<std::size_t> second_stiffness_;
  std::vector<Place> places_;
  int n_harmonics_ = 1;
  bool has_second_direction_ = false;
};

}  // namespace microslip::pipelines
