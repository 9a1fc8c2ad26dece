/// @file
/// Which choices of the discretisation are refined so that the error of every peak becomes what was
/// asked for.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

inline constexpr int most_cuts = 3;  // of the elements of a file, as model.refinement takes

/// A scene with finer settings.
struct Refinement {
  SceneDescription scene;
  std::string text;                ///< what is refined, for the log
  bool new_mesh = false;           ///< mesh and modes are solved for again
  bool only_harmonics = false;     ///< curves that are exact enough may stay
  double seconds = 0.0;            ///< about, of the round; 0: not known
  double structure_seconds = 0.0;  ///< of those, of mesh and modes
  double curve_seconds = 0.0;      ///< of its curves, without their errors
  double until_end = 0.0;          ///< by the clock: the round, and what follows the curves with it
};

/// What a scene has cost so far.
struct SpentSeconds {
  double structure = 0.0;  ///< mesh and modes
  double curves = 0.0;
  double errors = 0.0;  ///< of the curves, told
  /// Of the curves that are not exact enough yet: these alone are solved again where only harmonics
  /// change. Empty: all.
  std::optional<double> inexact_curves{};
  std::optional<double> inexact_errors{};
  bool extrapolated = false;  ///< the modes: the error of the mesh falls faster
  bool linear_elements = false;
  int cuts_in_memory = most_cuts;  ///< of the elements of a file, beyond those that are made
  int jobs = 1;                    ///< cores that share curves and their errors
  /// By the clock: maps and the search for a best value, with the curves as they are.
  double after = 0.0;
  double available = std::numeric_limits<double>::infinity();  ///< time there is for all of it
};

/// The largest bar of these goals of all budgets; infinite where one has none, or there is none.
[[nodiscard]] double largest_bar(const std::vector<CurveBudget>& budgets,
                                 const std::vector<std::string>& goals = AccuracyRequest{}.goals);

/// A linear limit, or within the tolerance.
[[nodiscard]] bool is_exact(const CurveBudget& budget, const AccuracyRequest& accuracy);

/// The error of a mesh of a file is in no bar, and other elements of it would tell it.
[[nodiscard]] bool has_mesh_to_tell(const SceneDescription& scene,
                                    const std::vector<CurveBudget>& budgets);

/// Sources that one of the bars leaves out, named once.
[[nodiscard]] std::vector<std::string> not_in_bars(const std::vector<CurveBudget>& budgets);

/// Of all ways to refine the sources, alone and together, the cheapest that should bring every bar
/// below the tolerance: errors of cells fall as their number grows, of the mesh with its size, of
/// fit and directions altogether, of harmonics to the tolerance of their choice. Where none does,
/// the cheapest that comes as near as can be. A mesh whose error is not known is refined until it
/// is.
/// @return empty: nothing worth a round can be refined; `left` names sources that cannot,
///         though they matter.
[[nodiscard]] std::optional<Refinement> refinement(const SceneDescription& scene,
                                                   const std::vector<CurveBudget>& budgets,
                                                   double tolerance, const SpentSeconds& spent,
                                                   std::string& left);

}  // namespace microslip::pipelines
