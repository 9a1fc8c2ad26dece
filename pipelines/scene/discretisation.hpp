/// @file
/// How finely a scene is solved: what trades accuracy for time and changes nothing of what is simulated. A richer
/// model of the same scene is the same description with other settings (model/model_family.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace microslip::pipelines {

/// What stands for the modes left out (theory 14, 14.1).
enum class ResidualKind : std::uint8_t { none, stiffness, attachment };

/// Of kinds with a mesh.
struct BasisSettings {
  int n_modes = 10;
  ResidualKind residual = ResidualKind::attachment;
  std::optional<int> attachment_degree{};  ///< of the tractions; without value: chosen
  [[nodiscard]] bool operator==(const BasisSettings&) const = default;
};

/// Of one patch of a meshed scene.
struct PatchSettings {
  enum class Fit : std::uint8_t { automatic, degree, none } fit = Fit::automatic;
  int fit_degree = 0;
  int n_points = 300;  ///< at least so many contact points
};

struct HarmonicSettings {
  int highest = 1;            ///< with a tolerance the highest that may be added
  std::vector<int> orders{};  ///< the only ones; empty: 1 … highest
  double tolerance = 0.0;     ///< above 0: chosen, see solver::ContinuationOptions
  bool checked = true;        ///< given ones are checked with more at the peaks
  [[nodiscard]] bool chosen() const { return tolerance > 0.0; }
};

/// Of the accuracy asked for: what chosen harmonics may leave out.
inline constexpr double share_of_harmonics = 0.5;

/// Highest harmonic that "auto" may add.
inline constexpr int most_automatic_harmonics = 31;

struct Discretisation {
  BasisSettings basis;
  std::vector<PatchSettings> patches;  ///< one per contact of a meshed scene
  HarmonicSettings harmonics;
  enum class Choice : std::uint8_t { automatic, on, off } second_direction = Choice::automatic;
};

}  // namespace microslip::pipelines
