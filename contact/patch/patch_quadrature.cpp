#include "contact/patch/patch_quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "contact/numerics/gauss_legendre.hpp"

namespace microslip::contact {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Below this share of its squared size a cell has no area: sixteen digits cannot tell it from a
// line.
constexpr double no_area = 1e-14;

std::array<Eigen::Vector2d, 4> corners_of(const PatchCells& cells, Eigen::Index cell) {
  std::array<Eigen::Vector2d, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const bool collapsed = k == 3 && cells.corners(cell, 3) < 0;
    const Eigen::Index vertex = cells.corners(cell, collapsed ? 0 : k);
    if (vertex < 0 || vertex >= cells.vertices.rows()) {
      throw std::invalid_argument("patch cell " + std::to_string(cell + 1) + ": vertex index " +
                                  std::to_string(vertex) + ", must be 0 to " +
                                  std::to_string(cells.vertices.rows() - 1));
    }
    corners[static_cast<std::size_t>(k)] = cells.vertices.row(vertex);
    if (!corners[static_cast<std::size_t>(k)].allFinite()) {
      throw std::invalid_argument("patch cell " + std::to_string(cell + 1) + ": vertex " +
                                  std::to_string(vertex) + " is not finite");
    }
  }
  return corners;
}

// Mean over the cell of position: ∫ x |∂x| / ∫ |∂x|, exact with two points per direction.
Eigen::Vector2d centroid(const PatchCell& cell) {
  static const double gauss = 1.0 / std::sqrt(3.0);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const double xi : {-gauss, gauss}) {
    for (const double eta : {-gauss, gauss}) {
      sum += cell.density(xi, eta) * cell.at(xi, eta);
    }
  }
  return sum / cell.area();
}

PatchRule empty_rule(std::size_t n_points) {
  const auto n = static_cast<Eigen::Index>(n_points);
  return {Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), 0};
}

}  // namespace

PatchCell::PatchCell(const std::array<Eigen::Vector2d, 4>& corners)
    : centre_(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])),
      by_xi_(0.25 * (corners[1] - corners[0] + corners[2] - corners[3])),
      by_eta_(0.25 * (corners[3] - corners[0] + corners[2] - corners[1])),
      by_both_(0.25 * (corners[0] - corners[1] + corners[2] - corners[3])),
      density_(cross(by_xi_, by_eta_)),
      density_by_xi_(cross(by_xi_, by_both_)),
      density_by_eta_(cross(by_both_, by_eta_)),
      size_squared_(0.0) {
  if (density_ < 0.0) {  // clockwise
    density_ = -density_;
    density_by_xi_ = -density_by_xi_;
    density_by_eta_ = -density_by_eta_;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      size_squared_ = std::max(size_squared_, (corners[i] - corners[j]).squaredNorm());
    }
  }
}

double PatchCell::density(double xi, double eta) const {
  return std::max(0.0, density_ + density_by_xi_ * xi + density_by_eta_ * eta);
}

double PatchCell::smallest_density() const {
  return density_ - std::abs(density_by_xi_) - std::abs(density_by_eta_);
}

std::vector<PatchCell> patch_cells(const PatchCells& cells) {
  std::vector<PatchCell> result;
  result.reserve(static_cast<std::size_t>(cells.corners.rows()));
  for (Eigen::Index i = 0; i < cells.corners.rows(); ++i) {
    const PatchCell cell(corners_of(cells, i));
    if (cell.area() <= no_area * cell.size_squared()) {
      continue;
    }
    // At the collapsed corner of a triangle the density is 0 up to rounding.
    if (cell.smallest_density() < -no_area * cell.size_squared()) {
      throw std::invalid_argument("patch cell " + std::to_string(i + 1) +
                                  " is not convex; cut it into triangles");
    }
    result.push_back(cell);
  }
  if (result.empty()) {
    throw std::invalid_argument("patch of " + std::to_string(cells.corners.rows()) +
                                " cells: none has an area");
  }
  return result;
}

PatchRule midpoint_rule(const PatchCells& cells) {
  const std::vector<PatchCell> patch = patch_cells(cells);
  PatchRule rule = empty_rule(patch.size());
  rule.n_dropped_cells = cells.corners.rows() - rule.n_points();
  for (Eigen::Index i = 0; i < rule.n_points(); ++i) {
    const PatchCell& cell = patch[static_cast<std::size_t>(i)];
    const Eigen::Vector2d x = centroid(cell);
    rule.p[i] = x[0];
    rule.r[i] = x[1];
    rule.weights[i] = cell.area();
  }
  return rule;
}

PatchRule gauss_rule(const PatchCells& cells, int order) {
  const LineRule line = gauss_legendre(order);
  const std::vector<PatchCell> patch = patch_cells(cells);
  const auto n = static_cast<std::size_t>(order);
  PatchRule rule = empty_rule(patch.size() * n * n);
  rule.n_dropped_cells = cells.corners.rows() - static_cast<Eigen::Index>(patch.size());
  Eigen::Index point = 0;
  for (const PatchCell& cell : patch) {
    for (Eigen::Index i = 0; i < order; ++i) {
      for (Eigen::Index j = 0; j < order; ++j, ++point) {
        const double xi = 2.0 * line.nodes[i] - 1.0;
        const double eta = 2.0 * line.nodes[j] - 1.0;
        const Eigen::Vector2d x = cell.at(xi, eta);
        rule.p[point] = x[0];
        rule.r[point] = x[1];
        rule.weights[point] = 4.0 * line.weights[i] * line.weights[j] * cell.density(xi, eta);
      }
    }
  }
  return rule;
}

PatchCells rectangle_cells(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, int n_p,
                           int n_r) {
  if (n_p < 1 || n_r < 1) {
    throw std::invalid_argument("rectangle of " + std::to_string(n_p) + " x " +
                                std::to_string(n_r) + " cells; at least 1 x 1");
  }
  PatchCells cells{Eigen::MatrixX2d((n_p + 1) * (n_r + 1), 2), Eigen::MatrixX4i(n_p * n_r, 4)};
  for (int j = 0; j <= n_r; ++j) {
    for (int i = 0; i <= n_p; ++i) {
      const Eigen::Array2d share(static_cast<double>(i) / n_p, static_cast<double>(j) / n_r);
      cells.vertices.row(j * (n_p + 1) + i) =
          (begin.array() * (1.0 - share) + end.array() * share).matrix().transpose();
    }
  }
  for (int j = 0; j < n_r; ++j) {
    for (int i = 0; i < n_p; ++i) {
      const int first = j * (n_p + 1) + i;
      cells.corners.row(j * n_p + i) << first, first + 1, first + n_p + 2, first + n_p + 1;
    }
  }
  return cells;
}

}  // namespace microslip::contact
