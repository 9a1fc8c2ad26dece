/// @file
/// A modal scene as plain numbers, which a test may change, and random ones of every kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/surface/point_parameters.hpp"
#include "solver/scene.hpp"

namespace microslip::tests {

struct SceneNumbers {
  std::string name;
  Eigen::VectorXd frequency, damping, output;
  Eigen::MatrixXd excitation;  ///< rows as those of Harmonics, n_modes columns
  Eigen::VectorXd weights;
  std::vector<contact::PointParameters> points;
  Eigen::MatrixXd u, v, w;        ///< n_points × n_modes; w may be empty: one direction
  double second_stiffness = 1.0;  ///< along w, of that along u
  double begin = 0.0, end = 0.0;  ///< [rad/s]
  int n_harmonics = 1;            ///< of the unknowns

  [[nodiscard]] Eigen::Index n_modes() const { return frequency.size(); }
  [[nodiscard]] bool is_planar() const { return w.size() > 0; }
  /// Forces are sampled in time (contact/contact_force.hpp): they err by their instants.
  [[nodiscard]] bool is_sampled() const;
};

/// @throws std::bad_cast  the contact is not a ReadablePatch.
[[nodiscard]] SceneNumbers numbers_of(std::string name, const solver::Scene& scene, double begin,
                                      double end);

/// With the contact that contact/contact_force.hpp chooses.
[[nodiscard]] solver::Scene scene_of(const SceneNumbers& numbers);

/// Points (random_scene.hpp, modal_scenes.hpp), chains of two to five masses that rub on the ground
/// or on each other, patches with smooth shapes; pressed, or with gaps; one direction or two, one
/// to five harmonics. The same on every machine.
[[nodiscard]] SceneNumbers random_numbers(std::uint64_t seed);

}  // namespace microslip::tests
