/// @file
/// How finely a scene is solved: what trades accuracy for time and changes nothing of what is
/// simulated. A richer model of the same scene is the same description with other settings
/// (effects/model_family.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fem/solver_kind.hpp"

namespace microslip::pipelines {

/// What stands for the modes left out (theory 14, 14.1).
enum class ResidualKind : std::uint8_t { none, stiffness, attachment };

/// Of kinds with a mesh.
struct BasisSettings {
  int n_modes = 10;
  double reach = 0.0;  ///< ω [rad/s]: more modes where n_modes end below it
  ResidualKind residual = ResidualKind::attachment;
  std::optional<int> attachment_degree{};  ///< of the tractions; without value: chosen
  fem::SolverKind solver = fem::SolverKind::direct;
  [[nodiscard]] bool operator==(const BasisSettings&) const = default;
};

/// Of one patch of a meshed scene.
struct PatchSettings {
  enum class Fit : std::uint8_t { automatic, degree, none } fit = Fit::automatic;
  int fit_degree = 0;
  std::optional<int> n_points{};  ///< at least so many contact points; none: contact_points()
};

struct HarmonicSettings {
  int highest = 1;            ///< with a tolerance the highest that may be added
  std::vector<int> orders{};  ///< the only ones; empty: 1 … highest
  double tolerance = 0.0;     ///< above 0: chosen, see solver::ContinuationOptions
  bool checked = true;        ///< given ones are checked with more at the peaks
  /// Of a run that begins with them for want of time: a curve that is not at its end by the end of
  /// its share of the budget is solved with one (stages/first_settings.hpp).
  bool or_one = false;
  [[nodiscard]] bool chosen() const { return tolerance > 0.0; }
};

/// Of the accuracy asked for: what chosen harmonics may leave out.
inline constexpr double share_of_harmonics = 0.5;

/// Chosen closer than this, harmonics beyond the modes kept matter (theory section 22).
inline constexpr double close_choice = 0.01;

/// Highest harmonic that "auto" may add.
inline constexpr int most_automatic_harmonics = 30;
inline constexpr int most_close_harmonics = 40;

/// Chosen to a tolerance.
[[nodiscard]] inline HarmonicSettings automatic_harmonics(double tolerance) {
  const bool close = tolerance < close_choice;
  return {.highest = close ? most_close_harmonics : most_automatic_harmonics,
          .orders = {},
          .tolerance = tolerance};
}

struct Discretisation {
  BasisSettings basis;
  std::vector<PatchSettings> patches;  ///< one per contact of a meshed scene
  HarmonicSettings harmonics;
  enum class Choice : std::uint8_t { automatic, on, off } second_direction = Choice::automatic;
  double force_tolerance = 0.0;  ///< of forces sampled in time; 0: as harmonics are chosen

  /// What forces sampled in time may err by, of theirs: where harmonics are chosen a tenth of what
  /// they may leave out.
  [[nodiscard]] double tolerance_of_forces() const {
    constexpr double usual = 1e-3;
    constexpr double share = 0.1;
    if (force_tolerance > 0.0) return force_tolerance;
    return harmonics.chosen() ? std::min(usual, share * harmonics.tolerance) : usual;
  }
};

/// Contact points of a picture.
inline constexpr int points_of_maps = 300;

/// At least so many in a patch. Those of several harmonics cost time:
/// 96 err by 0.14 % of a peak on the default blade, n by
/// 0.13/n, which may be a seventh of the tolerance of chosen harmonics.
[[nodiscard]] inline int contact_points(const Discretisation& settings, std::size_t patch) {
  if (settings.patches[patch].n_points) return *settings.patches[patch].n_points;
  const HarmonicSettings& harmonics = settings.harmonics;
  if (!harmonics.chosen() && harmonics.highest == 1) return points_of_maps;
  constexpr double per_tolerance = 0.9;
  constexpr double fewest = 90.0;  // fewer are kinks, not a smooth sum
  constexpr double most = 4800.0;
  const double wanted = harmonics.chosen() ? per_tolerance / harmonics.tolerance : fewest;
  return static_cast<int>(std::clamp(wanted, fewest, most));
}

}  // namespace microslip::pipelines
