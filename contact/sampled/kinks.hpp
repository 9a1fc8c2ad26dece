/// @file
/// Kinks of the sampled force of a point with a smooth surface. Behind a kink at x, in instants
/// from the one before, a signal goes on by c(t) more than it would have, c(x) = 0. The sum over
/// instants, h = 2π/n apart, errs by (Euler and Maclaurin; derivatives by instants, B the
/// polynomials of Bernoulli)
///
///   Σ f_i T(θ_i) − ∮ f T dθ/h = Σ_kinks Σ_m β_m (c T)^(m)(x)                              (1)
///   β_m = (−1)^m B_{m+1}(x)/(m+1)!
///
///   slip begins              c = −k_u (w − s)            w = u ∓ g, which meets the slider
///   slip ends, w turns       c = k_u (w − w(x))          w' = 0 there
///   contact closes, opens    c = ±r of the load; of friction ±μ r where it slips, k_u (u − u(x))
///                            where it sticks
///
/// u and r are cubics from one instant to the next (step_spline.hpp), so that c is one, and T is
/// taken for the cubic through the four instants around: (1) is then exact, however close kinks
/// follow each other. Taking it off these samples leaves a force whose error falls with n³, also
/// where a stick is shorter than a step, and which does not jump where a kink passes an instant.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/sampled/instants.hpp"
#include "contact/sampled/runs.hpp"
#include "contact/sampled/step_spline.hpp"

namespace microslip::contact::sampled {

/// Constants of smooth surfaces; k_u = 0 and μ = 0 both where there is no friction.
struct SmoothPoint {
  double tangential_stiffness = 0.0;
  double normal_stiffness = 0.0;
  double friction_coefficient = 0.0;

  /// g/n.
  [[nodiscard]] double compliance() const {
    return tangential_stiffness > 0.0 ? friction_coefficient / tangential_stiffness : 0.0;
  }
};

/// The march of one point, columns of a block (lanes/line_kernels.hpp).
struct LineColumns {
  const double* u = nullptr;
  const double* closeness = nullptr;
  const double* low = nullptr;
  const double* high = nullptr;
  const double* turns = nullptr;  ///< null: of any surface
  const double* slider = nullptr;
};

/// u + side g at the four instants around the step that ends at `now`, extended by r < 0.
/// @param side  −1 w, 1 W.
[[nodiscard]] std::array<double, 4> end_of_band(const SmoothPoint& point,
                                                const LineColumns& columns, double side,
                                                std::size_t now, std::size_t n);

/// The slopes of a cubic at one place: first, second and third derivative, by instants.
using Slopes = std::array<double, 3>;

struct Kink {
  /// `passes`: an instant within a stick shorter than a step, where two splines meet.
  enum class Kind : std::int8_t { slips, ends_slip, closes, opens, passes };
  /// What left the slider where it is met as slip begins.
  enum class Slider : std::int8_t { run, turn, landing };

  Kind kind = Kind::slips;
  Slider slider = Slider::run;
  std::size_t now = 0;  ///< the instant behind
  double share = 0.0;   ///< x in [0, 1]
  /// Of the limit μn along which friction leaves or meets the kink, 1 or −1; 0: it sticks, closing.
  double side = 0.0;
  Slopes friction{};  ///< of c of f_p [N/m²]
  Slopes load{};      ///< of n
  double turn = 0.0;  ///< x of the end of slip that left the slider
};

/// Of one point, in order of time.
struct Kinks {
  std::vector<Kink> all;
  std::vector<std::size_t> first;  ///< by run, and their number; none where there is one run

  /// In the step in which a run ends.
  [[nodiscard]] std::span<const Kink> at_end_of(std::size_t run) const {
    if (first.empty()) return {};
    return {all.data() + first[run], all.data() + first[run + 1]};
  }
};

/// (1) by c', c'', c''' (columns) and T, T', T'', T''' (rows): C(i+l, l) β_{i+l}.
using KinkMoments = std::array<std::array<double, 3>, 4>;
[[nodiscard]] KinkMoments kink_moments(double x);

/// @param n  instants.   @param kinks  written whole.
void find_kinks(const SmoothPoint& point, const std::vector<Run>& runs, const LineColumns& columns,
                std::size_t n, Kinks& kinks);

/// Those of the load alone. @param closeness  column of a block: the load where it is positive.
void find_load_kinks(const double* closeness, std::size_t n, Kinks& kinks);

/// What mend() does to the moments of dn/dv of a point that opens or closes: for the instants that
/// the sums count too much or too little. The antisymmetric part, of second order, has no place
/// there. @param moments  those of Instants, added to.
void add_load_moments(const Kink& kink, double normal_stiffness, const Instants& instants,
                      std::vector<double>& moments);

/// Takes (1) off the samples. @param friction, normal  columns of a block, n instants.
void mend(const Kinks& kinks, std::size_t n, double* friction, double* normal);

}  // namespace microslip::contact::sampled
