/// @file
/// The linear algebra behind attachment shapes (equations in fem/attachment.hpp): rows of this rank
/// only, every function collective over PETSC_COMM_WORLD.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "fem/assembly/fe_system.hpp"
#include "fem/attachment.hpp"

namespace microslip::fem {

/// Loads and what the modes leave out of their static answer.
struct StaticShapes {
  Eigen::MatrixXd loads;   ///< F, local rows × m
  Eigen::MatrixXd shapes;  ///< Ψ, local rows × m, M-orthogonal to the modes
  /// Local contact stiffness along each traction [N/m³], m; none for other loads.
  Eigen::VectorXd stiffness{};

  void append(const StaticShapes& more);
};

/// Ritz vectors of a set of shapes: M-orthonormal, diagonal in K.
struct RitzShapes {
  Eigen::VectorXd frequency;  ///< ω̃ [rad/s], ascending
  Eigen::MatrixXd shapes;     ///< local rows × at most m
};

/// Columns of a set that are independent, by pivoted Gram–Schmidt in the energy ½ΨᵀKΨ: a column of
/// which less than `tolerance` of its own energy norm is new is left out.
/// Then Ritz vectors of what is left.
/// @param modes  M-orthonormal, local rows × n: the result is made orthogonal to them.
[[nodiscard]] RitzShapes ritz_shapes(const FeSystem& system, const StaticShapes& set,
                                     const Eigen::MatrixXd& modes, double tolerance = 1e-6);

/// Largest share of the flexibility of the last tractions that the others miss
/// (fem/attachment.hpp).
/// @param flexibility  C = FᵀΨ [m³/N], (n_lower + n_last)², orthonormal tractions.
/// @param local_stiffness  along each [N/m³]; 0: no force can arise there, which misses nothing.
/// @return s, 0 … 1.
[[nodiscard]] double missed_share(const Eigen::MatrixXd& flexibility, Eigen::Index n_lower,
                                  const Eigen::VectorXd& local_stiffness);

/// Solves for the tractions of exactly one degree.
using ShapesOfDegree = std::function<StaticShapes(int degree)>;

/// Shapes of all tractions up to the degree in use.
struct AttachmentSet {
  StaticShapes shapes;
  int degree = 0;
  double missed_share = 0.0;  ///< NaN where the degree was given
  StaticShapes richer{};      ///< of one degree more; empty where the degree was given
};

/// All tractions up to the degree given, or up to the lowest that misses little enough.
/// @throws std::invalid_argument  a degree < 0.
[[nodiscard]] AttachmentSet attachment_set(const ShapesOfDegree& solve,
                                           const AttachmentOptions& options);

}  // namespace microslip::fem
