#include "mesh/elements/element_locator.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

constexpr double margin =
    1e-6;  // of an element, far above rounding: a point on a face is in neither

/// Places of the nodes of a straight element between its corners, n_nodes × n_corners.
Eigen::MatrixXd straight_places(ElementType type) {
  const Eigen::MatrixX3d xi = reference_nodes(type);
  Eigen::MatrixXd places(n_nodes(type), n_corners(type));
  for (Eigen::Index a = 0; a < places.rows(); ++a) {
    places.row(a) = shapes(linear(type), xi.row(a).transpose()).values.transpose();
  }
  return places;
}

/// Σ|N_a| over the nodes on edges at most: each moves the element off its straight shape by that
/// share.
double reach_of_edge_nodes(ElementType type) {
  switch (solid(type)) {
    case Solid::tetrahedron:
      return 1.5;
    case Solid::hexahedron:
      return 3.0;
    case Solid::wedge:
      return 7.0 / 3.0;  // 4/3 of the edges of the triangles, 1 of those between them
    case Solid::pyramid:
      return 2.0;
  }
  return 0.0;
}

/// How deep ξ is inside the reference element, in shares of it; negative outside.
double depth(ElementType type, const Eigen::Vector3d& xi) {
  switch (solid(type)) {
    case Solid::tetrahedron:
      return std::min(xi.minCoeff(), 1.0 - xi.sum());
    case Solid::hexahedron:
      return 0.5 * (1.0 - xi.cwiseAbs().maxCoeff());
    case Solid::wedge:
      return std::min({xi[0], xi[1], 1.0 - xi[0] - xi[1], 0.5 * (1.0 - std::abs(xi[2]))});
    case Solid::pyramid:
      return std::min(xi[2], 0.5 * (1.0 - xi[2] - xi.head<2>().cwiseAbs().maxCoeff()));
  }
  return 0.0;
}

Eigen::Vector3d middle(ElementType type) {
  return reference_nodes(linear(type)).colwise().mean().transpose();
}

/// The map of a pyramid has a corner at the apex and is another beyond it: steps stay before it.
double length_of_step(ElementType type, const Eigen::Vector3d& xi, const Eigen::Vector3d& move) {
  const double to_apex = 1.0 - xi[2];
  const bool beyond = solid(type) == Solid::pyramid && move[2] >= to_apex;
  return beyond ? 0.75 * to_apex / move[2] : 1.0;
}

/// ξ of a point by Newton's method; empty where it is lost, as far outside.
/// Sound: x(ξ) = x proves it, whatever the path was.
std::optional<Eigen::Vector3d> inverse_map(ElementType type, const Eigen::MatrixX3d& nodes,
                                           const Eigen::Vector3d& x) {
  constexpr int max_steps = 20;
  constexpr double converged = 1e-9;  // of the element, far below the margin
  constexpr double lost = -2.0;       // that far outside, no step of a valid element comes back
  Eigen::Vector3d xi = middle(type);
  for (int step = 0; step < max_steps; ++step) {
    const ElementShapes s = shapes(type, xi);
    const Eigen::Vector3d rest = x - nodes.transpose() * s.values;
    const Eigen::Matrix3d J = nodes.transpose() * s.gradients;
    if (!(J.determinant() > 0.0)) return std::nullopt;
    const Eigen::Vector3d move = J.inverse() * rest;
    xi += length_of_step(type, xi, move) * move;
    if (depth(type, xi) < lost) return std::nullopt;
    if (move.cwiseAbs().maxCoeff() < converged || type == ElementType::tet4) return xi;
  }
  return std::nullopt;
}

}  // namespace

ElementLocator::ElementLocator(const Eigen::MatrixX3d& nodes,
                               const std::vector<ElementBlock>& elements)
    : nodes_(nodes), elements_(elements) {
  for (std::size_t b = 0; b < elements.size(); ++b) {
    for (Eigen::Index e = 0; e < elements[b].connectivity.rows(); ++e) list_.push_back({b, e});
  }
  boxes_.reserve(list_.size());
  for (const ElementReference& element : list_) boxes_.push_back(box_of(element));
  choose_grid();
  fill();
}

/// Holds the element with its bulges: corners, and the edge nodes' distance from straight edges.
ElementLocator::Box ElementLocator::box_of(const ElementReference& element) const {
  static const auto places = [] {
    std::array<Eigen::MatrixXd, all_element_types.size()> all;
    for (const ElementType type : all_element_types) {
      all[static_cast<std::size_t>(type)] = straight_places(type);
    }
    return all;
  }();
  const ElementBlock& block = elements_[element.block];
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_element_nodes, 3> own(block.connectivity.cols(),
                                                                         3);
  for (Eigen::Index a = 0; a < own.rows(); ++a)
    own.row(a) = nodes_.row(block.connectivity(element.element, a));
  const auto corners = own.topRows(n_corners(block.type));
  Box box{corners.colwise().minCoeff().transpose(), corners.colwise().maxCoeff().transpose()};
  if (is_quadratic(block.type)) {
    const Eigen::MatrixX3d off = own - places[static_cast<std::size_t>(block.type)] * corners;
    const Eigen::Vector3d pad =
        reach_of_edge_nodes(block.type) * off.cwiseAbs().colwise().maxCoeff().transpose();
    box.lower -= pad;
    box.upper += pad;
  }
  return box;
}

/// About as many cells as elements, cubes as nearly as they fit.
void ElementLocator::choose_grid() {
  lower_ = nodes_.colwise().minCoeff().transpose();
  const Eigen::Vector3d extent = nodes_.colwise().maxCoeff().transpose() - lower_;
  const double edge = std::cbrt(extent.prod() / static_cast<double>(list_.size()));
  constexpr double most = 200.0;  // per direction
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<Eigen::Index>(std::clamp(std::floor(extent[d] / edge), 1.0, most));
    n_cells_[static_cast<std::size_t>(d)] = n;
    cell_[d] = extent[d] / static_cast<double>(n);
  }
}

std::size_t ElementLocator::number(Eigen::Index i, Eigen::Index j, Eigen::Index k) const {
  return static_cast<std::size_t>((k * n_cells_[1] + j) * n_cells_[0] + i);
}

ElementLocator::Cells ElementLocator::cells_of(const Box& box) const {
  Cells cells{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto at = static_cast<Eigen::Index>(d);
    const auto place = [&](double x) {
      const double cell = std::floor((x - lower_[at]) / cell_[at]);
      return static_cast<Eigen::Index>(std::clamp(cell, 0.0, static_cast<double>(n_cells_[d] - 1)));
    };
    cells.first[d] = place(box.lower[at]);
    cells.last[d] = place(box.upper[at]);
  }
  return cells;
}

/// Counts, then fills: members of all cells in one array.
void ElementLocator::fill() {
  first_.assign(number(0, 0, n_cells_[2]) + 1, 0);
  const auto for_each_cell = [&](const Box& box, const auto& act) {
    const Cells c = cells_of(box);
    for (Eigen::Index k = c.first[2]; k <= c.last[2]; ++k) {
      for (Eigen::Index j = c.first[1]; j <= c.last[1]; ++j) {
        for (Eigen::Index i = c.first[0]; i <= c.last[0]; ++i) act(number(i, j, k));
      }
    }
  };
  for (const Box& box : boxes_) for_each_cell(box, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  members_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    for_each_cell(boxes_[e], [&](std::size_t cell) {
      members_[next[cell]++] = static_cast<std::uint32_t>(e);
    });
  }
}

std::optional<ElementPlace> ElementLocator::place_in(const ElementReference& element,
                                                     const Eigen::Vector3d& x) const {
  const ElementBlock& block = elements_[element.block];
  Eigen::MatrixX3d own(block.connectivity.cols(), 3);
  for (Eigen::Index a = 0; a < own.rows(); ++a)
    own.row(a) = nodes_.row(block.connectivity(element.element, a));
  const std::optional<Eigen::Vector3d> xi = inverse_map(block.type, own, x);
  if (!xi) return std::nullopt;
  return ElementPlace{element, *xi, depth(block.type, *xi)};
}

bool ElementLocator::holds(const ElementReference& element, const Eigen::Vector3d& x) const {
  const std::optional<ElementPlace> place = place_in(element, x);
  return place && place->depth > margin;
}

std::optional<ElementPlace> ElementLocator::deepest(const Eigen::Vector3d& x) const {
  constexpr double beside = 0.5;  // of the size of an element: how far its box is looked at
  std::optional<ElementPlace> best;
  const Eigen::Vector3d pad = beside * cell_;
  const Cells cells = cells_of({x - pad, x + pad});
  std::vector<std::uint32_t> near;
  for (Eigen::Index k = cells.first[2]; k <= cells.last[2]; ++k) {
    for (Eigen::Index j = cells.first[1]; j <= cells.last[1]; ++j) {
      for (Eigen::Index i = cells.first[0]; i <= cells.last[0]; ++i) {
        const std::size_t cell = number(i, j, k);
        near.insert(near.end(), members_.begin() + static_cast<std::ptrdiff_t>(first_[cell]),
                    members_.begin() + static_cast<std::ptrdiff_t>(first_[cell + 1]));
      }
    }
  }
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const std::uint32_t e : near) {
    const Box& box = boxes_[e];
    const Eigen::Array3d own = beside * (box.upper - box.lower).array();
    if ((x.array() < box.lower.array() - own).any()) continue;
    if ((x.array() > box.upper.array() + own).any()) continue;
    const std::optional<ElementPlace> place = place_in(list_[e], x);
    if (place && (!best || place->depth > best->depth)) best = place;
  }
  return best;
}

std::optional<ElementReference> ElementLocator::holder(const Eigen::Vector3d& x,
                                                       const ElementReference& own) const {
  const Cells at = cells_of({x, x});
  const std::size_t cell = number(at.first[0], at.first[1], at.first[2]);
  for (std::size_t m = first_[cell]; m < first_[cell + 1]; ++m) {
    const Box& box = boxes_[members_[m]];
    if ((x.array() < box.lower.array()).any() || (x.array() > box.upper.array()).any()) continue;
    const ElementReference& element = list_[members_[m]];
    if (!(element == own) && holds(element, x)) return element;
  }
  return std::nullopt;
}

}  // namespace microslip::mesh
