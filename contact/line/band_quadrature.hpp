/// @file
/// Integrals over the pieces of a cycle in its band (band_walk.hpp): Gauss–Legendre panels of
/// twelve points, halved until what they leave out is rounding. Layers of a coefficient that
/// depends on the rate have pieces of their own, so that no panel steps over one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "contact/line/band_walk.hpp"

namespace microslip::contact {

inline constexpr int n_band_nodes = 12;
using BandPoints = Eigen::Matrix<double, n_band_nodes, 1>;

/// On [−1, 1].
struct BandPanel {
  BandPoints node, weight;
  /// Values → shares of the Legendre polynomials of degree 8 to 11, the lower ones counted less.
  /// One degree alone would miss functions that are even or odd about the middle.
  Eigen::Matrix<double, 4, n_band_nodes> top;
};

[[nodiscard]] const BandPanel& band_panel();

/// f at one instant of a piece [Pa].
[[nodiscard]] double band_friction(const SliderBand& band, const BandPiece& piece,
                                   const BandInstant& now);

/// μ n |w'|: friction times the way of a slider that slips, by θ [J/m²].
[[nodiscard]] double band_slip_power(const BandPiece& piece, const BandInstant& now,
                                     double friction);

/// What panels are halved for. Forces alone: integrals of friction times the rate of the band, in
/// which the coefficient is derived, then err by more than rounding.
enum class BandIntegrals { forces, forces_and_slip };

/// What a panel knows at its nodes.
struct BandPanelNodes {
  std::array<BandInstant, n_band_nodes> instant;
  BandPoints friction;
  BandPoints load;
  BandPoints slip_power;
  Eigen::Matrix<double, Eigen::Dynamic, n_band_nodes> basis;
};

/// Calls visit(instant, friction, basis, weight) at the nodes of a piece.
template <typename Visit>
class PieceVisitor {
 public:
  PieceVisitor(SliderBand& band, const BandPiece& piece, BandIntegrals wanted, const Visit& visit)
      : band_(band),
        piece_(piece),
        with_slip_(wanted == BandIntegrals::forces_and_slip),
        visit_(visit),
        nodes_(storage()) {}

  /// For products with harmonics up to `highest`.
  void visit(int highest) {
    // A wave of k oscillations per 2π over a panel of length h errs by 1e-31 (kh/2)²⁴.
    const double longest = 4.4 / (band_.n_harmonics() + highest);
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
    for (int i = 0; i < n_band_nodes; ++i) {
      visit_(nodes_.instant[static_cast<std::size_t>(i)], nodes_.friction[i], nodes_.basis.col(i),
             half * band_panel().weight[i]);
    }
  }

  void evaluate(double begin, double half) {
    nodes_.basis.resize(band_.basis_size(), n_band_nodes);
    for (int i = 0; i < n_band_nodes; ++i) {
      BandInstant& now = nodes_.instant[static_cast<std::size_t>(i)];
      now = band_.at(BandPlace{piece_.stretch.anchor, begin + half * (1.0 + band_panel().node[i])});
      nodes_.basis.col(i) = band_.basis();
      nodes_.friction[i] = band_friction(band_, piece_, now);
      nodes_.load[i] = now.surface.load;
      if (with_slip_) nodes_.slip_power[i] = band_slip_power(piece_, now, nodes_.friction[i]);
    }
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
    add_tail(nodes_.load, band_.load_size(), geometric, tail);
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
    return top / values.cwiseAbs().maxCoeff();
  }

  template <typename Share>
  static void add_tail(const BandPoints& values, double size, const Share& share, Tail& tail) {
    const double top = (band_panel().top * values).cwiseAbs().maxCoeff();
    if (!(top > 0.0)) return;
    tail.top = std::max(tail.top, top / size);
    tail.left_out = std::max(tail.left_out, (top / size) * share(top, values));
  }

  SliderBand& band_;
  const BandPiece& piece_;
  bool with_slip_;
  const Visit& visit_;
  BandPanelNodes& nodes_;
};

/// @param highest  harmonic that forces are integrated against.
template <typename Visit>
void visit_piece(SliderBand& band, const BandPiece& piece, int highest, BandIntegrals wanted,
                 const Visit& visit) {
  PieceVisitor<Visit>(band, piece, wanted, visit).visit(highest);
}

}  // namespace microslip::contact
