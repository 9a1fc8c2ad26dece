/// @file
/// Integrals over the pieces of a cycle in its band (band_walk.hpp): Gauss–Legendre panels of
/// twelve points, halved until what they leave out is rounding. Layers of a coefficient that
/// depends on the rate have pieces of their own, so that no panel steps over one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "contact/line/band_walk.hpp"

namespace microslip::contact {

using BandPoints = Eigen::Array<double, n_band_nodes, 1>;

/// On [−1, 1].
struct BandPanel {
  BandValues node;
  BandPoints weight;
  /// Values → shares of the Legendre polynomials of degree 8 to 11, the lower ones counted less.
  /// One degree alone would miss functions that are even or odd about the middle.
  Eigen::Matrix<double, 4, n_band_nodes> top;
};

[[nodiscard]] const BandPanel& band_panel();

/// f at one instant of a piece [Pa].
[[nodiscard]] double band_friction(const SliderBand& band, const BandPiece& piece,
                                   const BandInstant& now);

/// What panels are halved for. Forces alone: integrals of friction times the rate of the band, in
/// which the coefficient is derived, then err by more than rounding.
enum class BandIntegrals { forces, forces_and_slip };

/// Highest ones: that forces are integrated against, and that the basis has.
struct BandHarmonics {
  int of_forces = 0;
  int of_basis = 0;
};

[[nodiscard]] inline BandPoints points_of(const BandValues& values) {
  return Eigen::Map<const BandPoints>(values.data());
}

/// What a panel knows at its nodes.
struct BandPanelNodes {
  BandInstants instants;
  BandPoints weight;      ///< of the piece [rad]
  BandPoints friction;    ///< f [Pa]
  BandPoints slip_power;  ///< μ n |w'|: friction times the way of a slider that slips, by θ [J/m²]
  std::vector<double> basis;  ///< 1, sin θ, cos θ, …, [2 of_basis + 1][n_band_nodes]
};

/// Calls visit(nodes) for each panel of a piece.
template <typename Visit>
class PieceVisitor {
 public:
  PieceVisitor(SliderBand& band, const BandPiece& piece, BandHarmonics harmonics,
               BandIntegrals wanted, const Visit& visit)
      : band_(band),
        piece_(piece),
        harmonics_(harmonics),
        with_slip_(wanted == BandIntegrals::forces_and_slip),
        visit_(visit),
        nodes_(storage()) {
    nodes_.basis.resize(static_cast<std::size_t>((2 * harmonics.of_basis + 1) * n_band_nodes));
  }

  void visit() {
    // A wave of k oscillations per 2π over a panel of length h errs by 1e-31 (kh/2)²⁴.
    const double longest = 4.4 / std::max(band_.n_harmonics() + harmonics_.of_forces, 2);
    const double begin = piece_.stretch.begin;
    const double length = piece_.stretch.end - begin;
    if (!(length > 0.0)) return;
    const int n = static_cast<int>(std::ceil(length / longest));
    constexpr int deepest = 30;
    for (int i = 0; i < n; ++i) {
      cover(begin + length * i / n, begin + length * (i + 1) / n, deepest);
    }
  }

 private:
  /// Of one thread, so that a panel allocates nothing once it has grown;
  /// an object lives for one cycle.
  static BandPanelNodes& storage() {
    thread_local BandPanelNodes nodes;
    return nodes;
  }

  /// Nodes of one panel if forces are resolved there, else those of its halves.
  /// @param before  highest terms of the panel twice as long.
  void cover(double begin, double end, int depth, double before = INFINITY) {
    const double half = 0.5 * (end - begin);
    evaluate(begin, half);
    const Tail tail = highest_terms();
    // Half the length divides the highest term by 2¹¹, unless it is the rounding of a steep law, of
    // which the integral has the length.
    const double length = end - begin;
    const bool rounded = tail.top > 0.25 * before && tail.top * length <= 1e-16;
    const bool resolved = tail.left_out * std::min(length, 1.0) <= 1e-16 || rounded;
    if (depth > 0 && !resolved) {
      constexpr double far = 1e-6;  // that a halving, by 2⁻²², would not be enough
      const int n = tail.left_out > far ? 4 : 2;
      for (int i = 0; i < n; ++i) {
        cover(begin + length * i / n, begin + length * (i + 1) / n, depth - n / 2, tail.top);
      }
      return;
    }
    nodes_.weight = half * band_panel().weight;
    visit_(nodes_);
  }

  void evaluate(double begin, double half) {
    band_.at({piece_.stretch.anchor, begin + half, half, &band_panel().node}, harmonics_.of_basis,
             nodes_.basis.data(), nodes_.instants);
    const BandInstants& now = nodes_.instants;
    if (!band_.has_spring() || piece_.state == ContactState::separated) {
      nodes_.friction.setZero();
    } else if (piece_.state == ContactState::stick) {
      nodes_.friction = band_.law().first_stiffness() * points_of(now.stiffness_ratio) *
                        (points_of(now.motion.position) - piece_.slider);
    } else {
      nodes_.friction =
          piece_.slip_sign() * points_of(now.friction_coefficient) * points_of(now.load);
    }
    if (!with_slip_) return;
    nodes_.slip_power =
        nodes_.friction.abs() *
        (points_of(now.motion.velocity) - piece_.slip_sign() * points_of(now.reach_rate)).abs();
  }

  /// Relative to the sizes of the forces.
  struct Tail {
    double top = 0.0;
    /// The rule is exact to degree 23. Of forces geometric() tells what is left out. The power of
    /// slip has the derivative of the coefficient in it: the last of it, which varies fast, hides
    /// behind what varies slowly, and no ratio of terms shows it.
    double left_out = 0.0;
  };

  /// None where forces are waves.
  [[nodiscard]] Tail highest_terms() const {
    Tail tail;
    if (band_.law().is_smooth() && !band_.law().is_rate_dependent()) return tail;
    add_tail(nodes_.friction, band_.friction_size(), geometric, tail);
    add_tail(points_of(nodes_.instants.load), band_.load_size(), geometric, tail);
    if (with_slip_) {
      constexpr double hidden = 1e-4;  // of the term of degree 11, of e^−y from 16 to 40: grades
      const double size = band_.friction_size() * band_.rate_size();
      add_tail(
          nodes_.slip_power, size, [](double, const BandPoints&) { return hidden; }, tail);
    }
    return tail;
  }

  /// Terms fall off geometrically: as the one of degree 11 is to the largest value, so is what is
  /// left out to that, and less.
  static double geometric(double top, const BandPoints& values) {
    return top / values.abs().maxCoeff();
  }

  template <typename Share>
  static void add_tail(const BandPoints& values, double size, const Share& share, Tail& tail) {
    const double top = band_panel().top.lazyProduct(values.matrix()).cwiseAbs().maxCoeff();
    if (!(top > 0.0)) return;
    tail.top = std::max(tail.top, top / size);
    tail.left_out = std::max(tail.left_out, (top / size) * share(top, values));
  }

  SliderBand& band_;
  const BandPiece& piece_;
  BandHarmonics harmonics_;
  bool with_slip_;
  const Visit& visit_;
  BandPanelNodes& nodes_;
};

template <typename Visit>
void visit_piece(SliderBand& band, const BandPiece& piece, BandHarmonics harmonics,
                 BandIntegrals wanted, const Visit& visit) {
  PieceVisitor<Visit>(band, piece, harmonics, wanted, visit).visit();
}

}  // namespace microslip::contact
