/// @file
/// What curves are expected to cost, by the method of their contact points. Processor seconds of
/// one core of this machine; medians of what scenes took (share/doc/costs.md), right to a factor of
/// two for most.
#pragma once

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// What decides how many unknowns and points there are, and by which method the points are
/// evaluated (contact::method_for).
struct CurveEffects {
  bool second_direction = false;
  bool normal_motion = true;  ///< loads vary where the scene has what varies them
  bool mean = true;           ///< of the motion: an unknown of every coordinate
  bool several_harmonics = false;
  bool chosen_harmonics = false;
  bool roughness = false;
  bool rate_dependence = false;
  bool areas = true;     ///< contact acts on areas where the scene has any; else on points
  bool residual = true;  ///< the modes have those shapes for omitted ones that the scene has
  bool stability = true;
  std::optional<double> free_modes{};  ///< where they are known
  int linear_curves = 0;               ///< that cannot slip, open or close, as far as is known
  /// Of the curves, those beside which other solutions are searched without having been asked for;
  /// empty: not known yet.
  std::optional<double> searched_share{};
};

/// Its contact has displacements along r.
[[nodiscard]] bool can_move_along_r(const SceneDescription& scene);

/// What a scene has. @param second_direction  as decided.
[[nodiscard]] CurveEffects curve_effects(const SceneDescription& scene, bool second_direction);

/// Stages of a run [s].
struct ResponseSeconds {
  double curves = 0.0;  ///< traced, or integrated in time
  /// Of the curves, and what the effects that are left out would change, on the modes at hand:
  /// other meshes and modes are no part of it.
  double errors = 0.0;
  double best_value = 0.0;  ///< the search for it
  double bracket = 0.0;     ///< the same with uncertain numbers multiplied
  [[nodiscard]] double total() const { return curves + errors + best_value + bracket; }
};

/// How many harmonics the curves are expected to have: those given, or what a choice usually ends
/// with.
[[nodiscard]] int usual_harmonics(const SceneDescription& scene);

/// @param scene  with [response].
[[nodiscard]] ResponseSeconds response_seconds(const SceneDescription& scene,
                                               const CurveEffects& effects);

/// A part of a curve [s], where machine_slowness() is 1, from what was done of it.
[[nodiscard]] double begun_seconds(const SceneDescription& scene, const CurveEffects& effects,
                                   long n_evaluations, long n_points);

/// Times as long a search takes beside a curve with so many folds: it looks on either side of each.
[[nodiscard]] double search_beside_folds(double n_folds);

/// A search for other solutions with a curve [s], where machine_slowness() is 1: whether it is made
/// hangs on it, which no machine decides. @param n_starts  per frequency.
[[nodiscard]] double search_of_a_curve(const SceneDescription& scene, const CurveEffects& effects,
                                       int n_starts);

/// With every curve.
[[nodiscard]] double search_seconds(const SceneDescription& scene, const CurveEffects& effects,
                                    int n_starts);

}  // namespace microslip::pipelines
