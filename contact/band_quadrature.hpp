/// @file
/// Integrals over the pieces of a cycle in its band (band_walk.hpp): Gauss–Legendre panels of twelve points,
/// halved until the highest terms of the forces are resolved, and where the coefficient has a layer next to
/// u' = 0 until the points see it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "contact/band_walk.hpp"

namespace microslip::contact {

inline constexpr int n_band_nodes = 12;
using BandPoints = Eigen::Matrix<double, n_band_nodes, 1>;

/// On [−1, 1].
struct BandPanel {
  BandPoints node, weight;
  /// Values → shares of the Legendre polynomials of degree 8 to 11, the lower ones counted less. One degree
  /// alone would miss functions that are even or odd about the middle.
  Eigen::Matrix<double, 4, n_band_nodes> top;
  BandPoints at_begin, at_end;  ///< values → the polynomial through them at −1 and 1
};

[[nodiscard]] const BandPanel& band_panel();

/// f at one instant of a piece [Pa].
[[nodiscard]] double band_friction(const SliderBand& band, const BandPiece& piece,
                                   const BandInstant& now);

/// What a panel knows at its nodes.
struct BandPanelNodes {
  std::array<BandInstant, n_band_nodes> instant;
  BandPoints friction;
  BandPoints load;
  BandPoints coefficient;  // μ
  Eigen::Matrix<double, Eigen::Dynamic, n_band_nodes> basis;
};

/// Calls visit(instant, friction, basis, weight) at the nodes of a piece.
template <typename Visit>
class PieceVisitor {
 public:
  PieceVisitor(SliderBand& band, const BandPiece& piece, const Visit& visit)
      : band_(band), piece_(piece), visit_(visit), nodes_(storage()) {}

  /// For products with harmonics up to `highest`.
  void visit(int highest) {
    // A wave of k oscillations per 2π over a panel of length h errs by 1e-31 (kh/2)²⁴.
    const double longest = 4.4 / (band_.n_harmonics() + highest);
    const double length = piece_.end - piece_.begin;
    const int n = static_cast<int>(std::ceil(length / longest));
    constexpr int deepest = 30;  // of a layer that depends on the rate: to 1e-9 of a panel
    for (int i = 0; i < n; ++i) {
      cover(piece_.begin + length * i / n, piece_.begin + length * (i + 1) / n, deepest,
            {i == 0 && piece_.begins_at_turn, i + 1 == n && piece_.ends_at_turn});
    }
  }

 private:
  static BandPanelNodes& storage() {
    thread_local BandPanelNodes nodes;
    return nodes;
  }

  /// Whether u' = 0 at the ends of a panel.
  struct Turns {
    bool begin;
    bool end;
  };

  /// Nodes of one panel if forces are resolved there, else those of its halves.
  /// @param before  highest terms of the panel twice as long.
  void cover(double begin, double end, int depth, Turns turns, double before = INFINITY) {
    const double half = 0.5 * (end - begin);
    evaluate(begin, half);
    const double top = highest_terms();
    // The rule is exact to degree 23: what is left out is about the square of the term of
    // degree 11. Half the length divides that by 2¹¹, unless it is the rounding of a steep
    // coefficient.
    constexpr double small = 1e-10;
    const bool resolved = top <= small || (top > 0.25 * before && top <= 1e-6);
    if (depth > 0 && !(resolved && sees_layers(turns))) {
      cover(begin, begin + half, depth - 1, {turns.begin, false}, top);
      cover(begin + half, end, depth - 1, {false, turns.end}, top);
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
      now = band_.at(begin + half * (1.0 + band_panel().node[i]));
      nodes_.basis.col(i) = band_.basis();
      nodes_.friction[i] = band_friction(band_, piece_, now);
      nodes_.load[i] = now.surface.load;
      nodes_.coefficient[i] = now.surface.friction_coefficient;
    }
  }

  /// Whether the coefficient between the nodes and u' = 0 is the one that the nodes foretell: else it has a
  /// layer there that is too thin for them.
  [[nodiscard]] bool sees_layers(Turns turns) const {
    if (piece_.state == ContactState::stick) return true;
    const double at_rest = band_.law().friction().at_rest();
    constexpr double foretold = 1e-7;  // a layer of that height adds less by its width
    const double allowed = foretold * std::max(at_rest, nodes_.coefficient.maxCoeff());
    const auto misses = [&](const BandPoints& row) {
      return std::abs(row.dot(nodes_.coefficient) - at_rest) > allowed;
    };
    return !(turns.begin && misses(band_panel().at_begin)) &&
           !(turns.end && misses(band_panel().at_end));
  }

  /// Relative to the sizes of the forces; 0 where these are waves.
  [[nodiscard]] double highest_terms() const {
    if (band_.law().is_smooth() && !band_.law().is_rate_dependent()) return 0.0;
    const double friction = top_term(nodes_.friction);
    const double load = top_term(nodes_.load);
    return std::max(friction > 0.0 ? friction / band_.friction_size() : 0.0,
                    load > 0.0 ? load / band_.load_size() : 0.0);
  }

  static double top_term(const BandPoints& values) {
    return (band_panel().top * values).cwiseAbs().maxCoeff();
  }

  SliderBand& band_;
  const BandPiece& piece_;
  const Visit& visit_;
  BandPanelNodes& nodes_;
};

/// @param highest  harmonic that forces are integrated against.
template <typename Visit>
void visit_piece(SliderBand& band, const BandPiece& piece, int highest, const Visit& visit) {
  PieceVisitor<Visit>(band, piece, visit).visit(highest);
}

}  // namespace microslip::contact
