/// @file
/// What must not matter for a whole curve (relations M1 to M16, share/doc/hard_cases.md): peaks,
/// folds and the solutions at fixed frequencies of a scene and of one that was changed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/scene_numbers.hpp"

namespace microslip::tests {

/// What a curve is, whatever steps it was walked in.
struct CurveShape {
  std::vector<std::pair<double, double>> peaks, folds;  ///< frequency, amplitude; by frequency
  std::vector<std::vector<double>> amplitudes;  ///< of all solutions at fixed frequencies, sorted
  double largest = 0.0;
  double first = 0.0, last = 0.0;  ///< amplitude where the walk begins and ends
  bool complete = false, stopped = false;
  std::string said;  ///< diagnosis of the walk, what it was begun anew by
};

/// Shares of the range at which all solutions are asked for.
inline constexpr double fixed_shares[] = {0.13, 0.31, 0.47, 0.59, 0.83};

/// @param seconds  of processor time, after which a walk is stopped; 0: never.
[[nodiscard]] CurveShape shape_of(const SceneNumbers& numbers, double seconds = 0.0);

/// Two walks end their iterations at different residuals of at most 1e-11; next to a fold or
/// resonance of damping 1e-3 the solution moves a thousand times as much.
inline constexpr double walks_differ = 1e-7;

/// What a relation does to frequencies and amplitudes.
struct Factors {
  double frequency = 1.0;
  double amplitude = 1.0;
  double tolerance = walks_differ;  ///< relative: of frequencies, of the largest amplitude
};

struct Comparison {
  double worst = 0.0;   ///< relative difference
  std::string differs;  ///< empty: the same within the tolerance
  bool stopped = false;

  [[nodiscard]] bool holds() const { return differs.empty() && !stopped; }
};

[[nodiscard]] Comparison compared(const CurveShape& now, const CurveShape& before,
                                  const Factors& factors = {});

/// A scene that was walked.
struct Walked {
  SceneNumbers numbers;
  CurveShape shape;
  double seconds = 0.0;  ///< cap of every walk
};

struct Relation {
  const char* name;
  const char* what;
  /// Nothing: says nothing about this scene.
  std::function<std::optional<Comparison>(const Walked&)> of;
};

[[nodiscard]] const std::vector<Relation>& relations();
/// @throws std::out_of_range  there is none of this name.
[[nodiscard]] const Relation& relation(const std::string& name);

}  // namespace microslip::tests
