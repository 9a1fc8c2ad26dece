/// @file
/// Steady cycles of a block of points along one direction: motion in, Fourier sums of friction and
/// load, states and derivatives out (lanes/line_kernels.hpp, line_point.hpp).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/force/sleeping_set.hpp"
#include "contact/lanes/line_kernels.hpp"
#include "contact/sampled/instants.hpp"
#include "contact/sampled/line_point.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact::sampled {

class LineBlock {
 public:
  /// @param points  1 to block_size of them.
  /// @param of_motion, of_force  as many instants, the harmonics of each.
  /// @param surfaces, motion  of all points of the patch.
  void evaluate(const std::vector<SurfaceLaw>& surfaces, const PatchMotion& motion,
                std::span<const Eigen::Index> points, double frequency, const Instants& of_motion,
                const Instants& of_force);

  /// Σ_i f_i T_k(θ_i), [row of of_force][point].
  [[nodiscard]] const double* friction_sums() const { return friction_sums_.data(); }
  [[nodiscard]] const double* normal_sums() const { return normal_sums_.data(); }
  /// Of the point in this place of the block.
  [[nodiscard]] const std::vector<Run>& runs(std::size_t place) const { return runs_[place]; }
  /// ∫ μ n |ds| over the period [J/m²].
  [[nodiscard]] double slip_work(std::size_t place) const;
  /// Good until the next call.
  [[nodiscard]] const LineDerivatives& derivatives(std::size_t place);

 private:
  void resize(const Instants& of_motion, const Instants& of_force);
  void load_motion(const PatchMotion& motion, std::span<const Eigen::Index> points);
  void smooth_constants(std::span<const Eigen::Index> points);
  void march_smooth();
  void mend_kinks(std::size_t n_points);
  [[nodiscard]] LineArrays arrays();
  [[nodiscard]] SmoothPoint smooth_point(std::size_t place) const;
  void ask_surfaces(std::span<const Eigen::Index> points);
  [[nodiscard]] bool touches();
  [[nodiscard]] LineColumns columns(std::size_t place) const;

  const std::vector<SurfaceLaw>* surfaces_ = nullptr;
  std::span<const Eigen::Index> points_;
  const Instants* instants_ = nullptr;
  double frequency_ = 0.0;
  bool simple_ = true;  // smooth surfaces, constant coefficient
  std::vector<double> coefficients_;
  std::vector<double> u_, v_, rate_, closeness_, half_width_, normal_, low_, high_, turns_, landed_,
      slider_, friction_, state_;
  std::vector<double> friction_sums_, normal_sums_;
  std::array<double, block_size> rest_load_{}, normal_stiffness_{}, compliant_friction_{},
      stiffness_{}, coefficient_{}, closeness_by_approach_{};
  std::array<std::vector<InstantSlopes>, block_size> slopes_;
  std::array<std::vector<Run>, block_size> runs_;
  std::array<Kinks, block_size> kinks_;
  LineDerivatives derivatives_;
};

}  // namespace microslip::contact::sampled
