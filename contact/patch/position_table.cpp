#include "contact/patch/position_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/numerics/delaunay.hpp"

namespace microslip::contact {
namespace {

std::vector<double> distinct(const Eigen::VectorXd& x) {
  std::vector<double> values(x.begin(), x.end());
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Rows in ascending order of p, then r.
std::vector<int> sorted_rows(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  std::vector<int> rows(static_cast<std::size_t>(p.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::ranges::sort(rows, {}, [&](int i) { return std::pair(p[i], r[i]); });
  return rows;
}

void require_valid(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& values) {
  if (p.size() < 1 || p.size() != r.size() || p.size() != values.size()) {
    throw std::invalid_argument(
        "table of positions: " + std::to_string(p.size()) + " p, " + std::to_string(r.size()) +
        " r and " + std::to_string(values.size()) + " values; as many of each, at least 1");
  }
  if (!p.allFinite() || !r.allFinite() || !values.allFinite()) {
    throw std::invalid_argument("table of positions: a number is not finite");
  }
  const std::vector<int> rows = sorted_rows(p, r);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto [a, b] = std::minmax(rows[i - 1], rows[i]);
    if (p[a] == p[b] && r[a] == r[b]) {
      throw std::invalid_argument("table of positions: rows " + std::to_string(a + 1) + " and " +
                                  std::to_string(b + 1) + " are at the same place");
    }
  }
}

// x between knots[cell] and knots[cell + 1], at `share` of the way; at an end beyond it.
struct Place {
  Eigen::Index cell = 0;
  double share = 0.0;
};

Place place(const std::vector<double>& knots, double x) {
  if (knots.size() < 2) {
    return {};
  }
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
  const auto cell = static_cast<std::size_t>(above - knots.begin()) - 1;
  const double share = (x - knots[cell]) / (knots[cell + 1] - knots[cell]);
  return {static_cast<Eigen::Index>(cell), std::clamp(share, 0.0, 1.0)};
}

}  // namespace

PositionTable::PositionTable(Eigen::VectorXd p, Eigen::VectorXd r, Eigen::VectorXd values)
    : p_(std::move(p)), r_(std::move(r)), values_(std::move(values)) {
  require_valid(p_, r_, values_);
  if (set_grid()) {
    kind_ = Kind::grid;
    return;
  }
  Eigen::MatrixX2d points(p_.size(), 2);
  points << p_, r_;
  Triangulation triangulation = delaunay(points);
  triangles_ = std::move(triangulation.triangles);
  edges_ = std::move(triangulation.hull);
  if (triangles_.empty()) {
    kind_ = Kind::line;
    const std::vector<int> rows = sorted_rows(p_, r_);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      edges_.push_back({rows[i - 1], rows[i]});
    }
  }
}

bool PositionTable::set_grid() {
  grid_p_ = distinct(p_);
  grid_r_ = distinct(r_);
  if (grid_p_.size() * grid_r_.size() != static_cast<std::size_t>(p_.size())) {
    return false;  // as many as the grid has, all different: exactly then every place is taken
  }
  grid_.resize(static_cast<Eigen::Index>(grid_p_.size()),
               static_cast<Eigen::Index>(grid_r_.size()));
  for (Eigen::Index i = 0; i < p_.size(); ++i) {
    const auto row = std::ranges::lower_bound(grid_p_, p_[i]) - grid_p_.begin();
    const auto column = std::ranges::lower_bound(grid_r_, r_[i]) - grid_r_.begin();
    grid_(row, column) = values_[i];
  }
  return true;
}

double PositionTable::on_grid(double p, double r) const {
  const Place i = place(grid_p_, p);
  const Place j = place(grid_r_, r);
  const Eigen::Index next_i = std::min(i.cell + 1, grid_.rows() - 1);
  const Eigen::Index next_j = std::min(j.cell + 1, grid_.cols() - 1);
  return std::lerp(std::lerp(grid_(i.cell, j.cell), grid_(next_i, j.cell), i.share),
                   std::lerp(grid_(i.cell, next_j), grid_(next_i, next_j), i.share), j.share);
}

double PositionTable::on_edges(double p, double r) const {
  const Eigen::Vector2d x(p, r);
  double nearest = std::numeric_limits<double>::infinity();
  double value = values_[0];
  for (const auto& [a, b] : edges_) {
    const Eigen::Vector2d begin(p_[a], r_[a]);
    const Eigen::Vector2d along = Eigen::Vector2d(p_[b], r_[b]) - begin;
    const double share = std::clamp((x - begin).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (x - begin - share * along).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      value = std::lerp(values_[a], values_[b], share);
    }
  }
  return value;
}

double PositionTable::on_triangles(double p, double r) const {
  const Eigen::Vector2d x(p, r);
  const auto corner = [this](int i) { return Eigen::Vector2d(p_[i], r_[i]); };
  const auto area = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  for (const auto& [a, b, c] : triangles_) {
    const Eigen::Vector2d to_a = corner(a) - x;
    const Eigen::Vector2d to_b = corner(b) - x;
    const Eigen::Vector2d to_c = corner(c) - x;
    const Eigen::Vector3d weights(area(to_b, to_c), area(to_c, to_a), area(to_a, to_b));
    if (weights.minCoeff() >= 0.0 && weights.sum() > 0.0) {
      return weights.dot(Eigen::Vector3d(values_[a], values_[b], values_[c])) / weights.sum();
    }
  }
  return on_edges(p, r);
}

Eigen::AlignedBox2d PositionTable::box() const {
  return {Eigen::Vector2d(p_.minCoeff(), r_.minCoeff()),
          Eigen::Vector2d(p_.maxCoeff(), r_.maxCoeff())};
}

Eigen::VectorXd PositionTable::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  Eigen::VectorXd result(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    result[i] = kind_ == Kind::grid   ? on_grid(p[i], r[i])
                : kind_ == Kind::line ? on_edges(p[i], r[i])
                                      : on_triangles(p[i], r[i]);
  }
  return result;
}

}  // namespace microslip::contact
