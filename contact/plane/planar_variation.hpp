/// @file
/// Derivatives of a planar orbit: slider and force with respect to the harmonics of the motion, the
/// frequency and the slider the period began with.
///
/// Forces are continuous across every event, so that the derivative of a Fourier coefficient is the
/// integral of the derivative of the force; what remains is the slider:
///
///   stick        δs constant
///   slip         the linearised collocation, with its factor at the solution
///   slip begins, or the law has a kink: δs moves along e until it is tangent to the ellipse
///   slip ends    δs unchanged, since s' = 0 there; where the motion along a line turns back and μ
///                rises with the rate, slip stops at a kink: δs + ρe δθ, δθ = −x''·δx'/|x''|²
///   touch-down   δs = δx + (x' − ρe) δθ₂,  δθ₂ = −δv/v'   (ρ = 0 into stick)
///
/// Source: theory sections 6, 9.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "contact/lanes/basis_product.hpp"
#include "contact/plane/planar_corner.hpp"
#include "contact/plane/planar_orbit.hpp"

namespace microslip::contact {

/// Parameters are the harmonics of the motion in the order of Harmonics::vector(), then ω; the
/// slider at the begin of the period follows with two columns.
class OrbitVariation {
 public:
  enum class Columns { slider_only, all };
  /// Columns lie side by side: sums run along them.
  template <int rows>
  using Rows = Eigen::Matrix<double, rows, Eigen::Dynamic, Eigen::RowMajor>;

  OrbitVariation(const PlanarMotion& motion, Columns columns);

  [[nodiscard]] Eigen::Index n_parameters() const { return n_parameters_; }
  [[nodiscard]] Eigen::Index n_columns() const { return n_parameters_ + 2; }

  /// Begins with δs = 0 for the parameters and the identity for the slider.
  void set_free_slider();
  /// Begins with the virgin slider, s = 0, and no freedom.
  void set_virgin_slider();
  /// Begins at rest in a corner, which moves with the motion: ∇G_i · δs = −δG_i.
  void set_corner_slider(const SliderCorner& corner);
  /// Carries δs over one period.
  void carry(const PlanarOrbit& orbit);
  /// The same, and integrates δf: force_p(), force_r().
  void carry_and_integrate(const PlanarOrbit& orbit);

  /// δs / L₀, 2 × n_columns.
  [[nodiscard]] const Rows<2>& slider() const { return slider_; }
  /// δ of the coefficients of f_p or f_r, (2H+1) × n_columns [Pa per unit of the parameter].
  [[nodiscard]] const BasisProduct::Rows& force(std::size_t direction) const {
    return force_[direction];
  }

 private:
  void pass(const PlanarOrbit& orbit);
  void set_parameters(const PlanarInstant& now);
  void set_rate_parameters(const PlanarInstant& now);
  void touch_down(const PlanarPiece& piece);
  /// Where slip stops because x' = 0.
  void stop_at_turn(const SlipStep& slip);
  void begin_slip(const PlanarPiece& piece);
  void step(const SlipStep& step);
  void integrate_stick(const PlanarPiece& piece);
  /// Of friction below rounding: nothing, but where the motion turns back the force jumps by 2 μn
  /// e, and the jump moves by δθ = −e·δx'/|x''|.
  void integrate_lost_stick(const PlanarPiece& piece);
  /// @param stage  of a step whose turn_ is known.
  void integrate_slip(const SlipStep& step, int stage);
  /// Adds force_now_.
  void add_force(double weight);

  const PlanarMotion& motion_;
  Eigen::Index n_parameters_;
  bool integrates_ = false;
  Eigen::VectorXd basis_;
  Eigen::VectorXd basis_rate_;
  Rows<2> position_;              // δx / L₀, 2 × n_parameters
  Eigen::RowVectorXd radius_;     // δr / F₀
  Eigen::RowVectorXd stiffness_;  // δK along r; that along p is constant
  Rows<2> reach_;                 // δ(r/K) / L₀
  Eigen::RowVectorXd ratio_;      // δg
  Rows<2> slider_;
  Rows<2> force_now_;  // δf / F₀
  std::array<Eigen::VectorXd, n_stages> stage_basis_;
  Rows<2 * n_stages> stage_;
  Rows<n_stages> right_;  // of the linearised collocation
  Rows<n_stages> turn_;
  Rows<n_stages> stage_radius_;
  Rows<n_stages> stage_ratio_;
  BasisProduct sum_;  // of both directions, one after the other
  std::array<BasisProduct::Rows, 2> force_;
};

}  // namespace microslip::contact
