#include "contact/band_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "contact/gauss_legendre.hpp"
#include "contact/planar_quadrature.hpp"

namespace microslip::contact {
namespace {

constexpr int n_nodes = 12;
using Points = Eigen::Matrix<double, n_nodes, 1>;

/// On [−1, 1].
struct Panel {
  Points node, weight;
  /// Values → shares of the Legendre polynomials of degree 8 to 11, the lower ones counted less. One degree
  /// alone would miss functions that are even or odd about the middle.
  Eigen::Matrix<double, 4, n_nodes> top;
  Points at_begin, at_end;  ///< values → the polynomial through them at −1 and 1
};

Panel make_panel() {
  const LineRule rule = gauss_legendre(n_nodes);
  Panel panel;
  for (int i = 0; i < n_nodes; ++i) {
    const double x = 2.0 * rule.nodes[i] - 1.0;
    panel.node[i] = x;
    panel.weight[i] = 2.0 * rule.weights[i];
    for (int k = 0; k < 4; ++k) {
      const double counted = std::pow(0.1, 3 - k);
      panel.top(k, i) = counted * (k + n_nodes - 3.5) * panel.weight[i] *
                        std::legendre(static_cast<unsigned>(k + n_nodes - 4), x);
    }
    panel.at_begin[i] = panel.at_end[i] = 0.0;
    for (int k = 0; k < n_nodes; ++k) {
      const double share = (k + 0.5) * panel.weight[i] * std::legendre(static_cast<unsigned>(k), x);
      panel.at_end[i] += share;
      panel.at_begin[i] += k % 2 == 0 ? share : -share;
    }
  }
  return panel;
}

const Panel& panel() {
  static const Panel rule = make_panel();
  return rule;
}

double top_term(const Points& values) { return (panel().top * values).cwiseAbs().maxCoeff(); }

/// What a panel knows at its nodes.
struct PanelNodes {
  std::array<BandInstant, n_nodes> instant;
  Points friction;
  Points load;
  Points coefficient;  // μ
  Eigen::Matrix<double, Eigen::Dynamic, n_nodes> basis;
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
  static PanelNodes& storage() {
    thread_local PanelNodes nodes;
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
    for (int i = 0; i < n_nodes; ++i) {
      visit_(nodes_.instant[static_cast<std::size_t>(i)], nodes_.friction[i], nodes_.basis.col(i),
             half * panel().weight[i]);
    }
  }

  void evaluate(double begin, double half) {
    nodes_.basis.resize(band_.basis_size(), n_nodes);
    for (int i = 0; i < n_nodes; ++i) {
      BandInstant& now = nodes_.instant[static_cast<std::size_t>(i)];
      now = band_.at(begin + half * (1.0 + panel().node[i]));
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
    const auto misses = [&](const Points& row) {
      return std::abs(row.dot(nodes_.coefficient) - at_rest) > allowed;
    };
    return !(turns.begin && misses(panel().at_begin)) && !(turns.end && misses(panel().at_end));
  }

  /// Relative to the sizes of the forces; 0 where these are waves.
  [[nodiscard]] double highest_terms() const {
    if (band_.law().is_smooth() && !band_.law().is_rate_dependent()) return 0.0;
    const double friction = top_term(nodes_.friction);
    const double load = top_term(nodes_.load);
    return std::max(friction > 0.0 ? friction / band_.friction_size() : 0.0,
                    load > 0.0 ? load / band_.load_size() : 0.0);
  }

  SliderBand& band_;
  const BandPiece& piece_;
  const Visit& visit_;
  PanelNodes& nodes_;
};

template <typename Visit>
void visit_piece(SliderBand& band, const BandPiece& piece, int highest, const Visit& visit) {
  PieceVisitor<Visit>(band, piece, visit).visit(highest);
}

double sign_of(const BandPiece& piece) {
  return piece.state == ContactState::positive_slip ? 1.0 : -1.0;
}

}  // namespace

double band_friction(const SliderBand& band, const BandPiece& piece, const BandInstant& now) {
  if (!band.has_spring() || piece.state == ContactState::separated) return 0.0;
  const SurfaceState& y = now.surface;
  if (piece.state != ContactState::stick) {
    return sign_of(piece) * y.friction_coefficient * y.load;
  }
  return band.law().first_stiffness() * y.stiffness_ratio * (now.position - piece.slider);
}

BandWork band_work(SliderBand& band, const BandCycle& cycle) {
  BandWork work;
  if (!band.has_spring()) return work;
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated || piece.state == ContactState::stick) continue;
    const double sign = sign_of(piece);
    visit_piece(band, piece, band.n_harmonics(),
                [&](const BandInstant& now, double friction, const auto&, double weight) {
                  const double way = weight * std::abs(now.velocity - sign * now.reach_rate);
                  work.slip_distance += way;
                  work.normal_slip += way * now.surface.load;
                  work.dissipated_energy += way * std::abs(friction);
                });
  }
  return work;
}

Harmonics band_force(SliderBand& band, const BandCycle& cycle, int n_harmonics) {
  Harmonics force(n_harmonics, n_point_signals);
  const Eigen::Index n = force.rows().rows();
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state == ContactState::separated) continue;
    visit_piece(band, piece, n_harmonics,
                [&](const BandInstant& now, double friction, const auto& basis, double weight) {
                  force.rows().col(0) += (weight * friction) * basis.head(n);
                  force.rows().col(1) += (weight * now.surface.load) * basis.head(n);
                });
  }
  force.rows() /= std::numbers::pi;
  force.rows().row(0) *= 0.5;
  return force;
}

void BandTraction::set(SliderBand& band, const BandCycle& cycle, PointTraction& result) {
  const Eigen::Index n = 2 * band.n_harmonics() + 1;
  sums_.setZero(2 * n - 1, n_sums);
  virgin_.setZero(n);
  frequency_memory_.setZero(n);
  memory_by_u_.setZero(n, n);
  memory_by_v_.setZero(n, n);
  for (const BandPiece& piece : cycle.pieces) {
    if (piece.state != ContactState::separated) add_piece(band, piece);
  }
  result.regime = cycle.regime;
  result.defect = 0.0;
  write(result);
}

void BandTraction::add_piece(SliderBand& band, const BandPiece& piece) {
  piece_.setZero(sums_.rows(), n_sums);
  const double k_u = band.law().first_stiffness();
  const bool rate_dependent = band.law().is_rate_dependent();
  const bool sticks = piece.state == ContactState::stick;
  const double sign = sign_of(piece);
  Eigen::Matrix<double, 1, n_sums> row = Eigen::Matrix<double, 1, n_sums>::Zero();
  visit_piece(band, piece, band.n_harmonics(),
              [&](const BandInstant& now, double force, const auto& basis, double weight) {
                const SurfaceState& y = now.surface;
                row[friction] = force;
                row[load] = y.load;
                row[load_by_v] = y.load_by_approach;
                if (sticks && band.has_spring()) {
                  row[by_u] = k_u * y.stiffness_ratio;
                  row[by_v] = k_u * y.stiffness_ratio_by_approach * (now.position - piece.slider);
                } else if (!sticks) {
                  row[by_v] = sign * y.friction_coefficient * y.load_by_approach;
                }
                if (!sticks && rate_dependent) {
                  const double by_rate = sign * y.load * y.friction_coefficient_by_rate;
                  row[by_velocity] = by_rate * band.frequency() * std::copysign(1.0, now.velocity);
                  row[by_frequency] = by_rate * std::abs(now.velocity);
                }
                for (Eigen::Index j = 0; j < n_sums; ++j) {
                  if (row[j] != 0.0) piece_.col(j) += (weight * row[j]) * basis;
                }
              });
  sums_ += piece_;
  if (sticks && band.has_spring()) add_memory(band, piece);
}

void BandTraction::add_memory(SliderBand& band, const BandPiece& piece) {
  const auto held = piece_.col(by_u).head(virgin_.size());
  if (piece.origin == SliderOrigin::virgin) {
    virgin_ += held;
    return;
  }
  const BandInstant now = piece.stood ? band.at_turn(piece.memory) : band.at(piece.memory);
  const Eigen::VectorXd basis = band.basis().head(virgin_.size());
  basis_rate(basis, basis_rate_);
  double from_velocity = 0.0;
  double from_v = 0.0;
  if (piece.origin == SliderOrigin::touch_down) {
    if (now.approach_rate > 0.0) from_v = -now.velocity / now.approach_rate;
  } else {
    const double sign = piece.origin == SliderOrigin::positive_slip ? 1.0 : -1.0;
    from_v = -sign * now.reach_by_approach;
    if (!piece.stood) {
      const double by_rate = sign * now.reach_by_rate;
      from_velocity = -by_rate * band.frequency() * std::copysign(1.0, now.velocity);
      frequency_memory_ += (by_rate * std::abs(now.velocity)) * held;
    } else if (now.acceleration != 0.0) {
      from_velocity = sign * now.reach_by_approach * now.approach_rate / now.acceleration;
    }
  }
  memory_by_u_.noalias() -= held * (basis + from_velocity * basis_rate_).transpose();
  memory_by_v_.noalias() -= held * (from_v * basis).transpose();
}

void BandTraction::write(PointTraction& result) {
  const Eigen::Index n = virgin_.size();
  const int H = static_cast<int>(n / 2);
  result.force = Harmonics(H, n_point_signals);
  result.jacobian.setZero(n_point_signals * n, n_point_signals * n);
  result.frequency_derivative.setZero(n_point_signals * n);
  const auto norm = [](Eigen::Index i) { return (i == 0 ? 0.5 : 1.0) / std::numbers::pi; };
  for (Eigen::Index i = 0; i < n; ++i) {
    result.force.rows()(i, 0) = norm(i) * sums_(i, friction);
    result.force.rows()(i, 1) = norm(i) * sums_(i, load);
    result.frequency_derivative[3 * i] = norm(i) * (sums_(i, by_frequency) + frequency_memory_[i]);
    for (Eigen::Index j = 1; j < n; ++j)
      result.jacobian(3 * i, 3 * j) = norm(i) * memory_by_u_(i, j);
    result.jacobian(3 * i, 0) = norm(i) * virgin_[i];
    for (Eigen::Index j = 0; j < n; ++j) {
      result.jacobian(3 * i, 3 * j + 1) = norm(i) * memory_by_v_(i, j);
    }
  }
  moments_.reset(2 * H);
  const auto add = [&](Sum sum, Eigen::Index row, Eigen::Index column, Eigen::Index first) {
    moments_.set_sums(sums_.col(sum).data());
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = first; j < n; ++j) {
        result.jacobian(3 * i + row, 3 * j + column) +=
            norm(i) * moments_.product(static_cast<int>(i), static_cast<int>(j));
      }
    }
  };
  add(load_by_v, 1, 1, 0);
  add(by_u, 0, 0, 1);
  add(by_v, 0, 1, 0);
  if (sums_.col(by_velocity).isZero(0.0)) return;
  moments_.set_sums(sums_.col(by_velocity).data());
  for (int i = 0; i < static_cast<int>(n); ++i) {
    for (int j = 1; j < static_cast<int>(n); ++j) {
      const int h = (j + 1) / 2;  // the derivative of the basis is the basis, turned and scaled
      const double product =
          j % 2 == 1 ? h * moments_.product(i, j + 1) : -h * moments_.product(i, j - 1);
      result.jacobian(3 * i, 3 * j) += norm(i) * product;
    }
  }
}

}  // namespace microslip::contact
