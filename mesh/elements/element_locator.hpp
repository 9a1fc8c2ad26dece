/// @file
/// Which element holds a point: a uniform grid of boxes names the candidates, Newton's method
/// inverts their maps x(ξ) = Σ N_a(ξ) x_a.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/element_block.hpp"

namespace microslip::mesh {

struct ElementReference {
  std::size_t block = 0;
  Eigen::Index element = 0;
  [[nodiscard]] bool operator==(const ElementReference&) const = default;
};

/// A point in an element, or beside it.
struct ElementPlace {
  ElementReference element;
  Eigen::Vector3d xi;  ///< on the reference element
  double depth = 0.0;  ///< inside it, in shares of it; negative outside
};

class ElementLocator {
 public:
  /// Both must outlive it. @param nodes  [m], n × 3.
  ElementLocator(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements);

  /// An element other than `own` that holds x, deeper than 1e-6 of its size.
  [[nodiscard]] std::optional<ElementReference> holder(const Eigen::Vector3d& x,
                                                       const ElementReference& own) const;
  [[nodiscard]] bool holds(const ElementReference& element, const Eigen::Vector3d& x) const;
  /// In the element that x is deepest inside of, or least outside. Empty: none is near.
  [[nodiscard]] std::optional<ElementPlace> deepest(const Eigen::Vector3d& x) const;

 private:
  struct Box {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
  };
  struct Cells {
    std::array<Eigen::Index, 3> first;
    std::array<Eigen::Index, 3> last;
  };

  [[nodiscard]] std::optional<ElementPlace> place_in(const ElementReference& element,
                                                     const Eigen::Vector3d& x) const;
  void choose_grid();
  void fill();
  [[nodiscard]] Box box_of(const ElementReference& element) const;
  [[nodiscard]] Cells cells_of(const Box& box) const;
  [[nodiscard]] std::size_t number(Eigen::Index i, Eigen::Index j, Eigen::Index k) const;

  const Eigen::MatrixX3d& nodes_;
  const std::vector<ElementBlock>& elements_;
  Eigen::Vector3d lower_;
  Eigen::Vector3d cell_;  // edge lengths [m]
  std::array<Eigen::Index, 3> n_cells_{1, 1, 1};
  std::vector<ElementReference> list_;  // all elements
  std::vector<Box> boxes_;              // of each in list_
  std::vector<std::size_t> first_;      // of each cell in members_, one more at the end
  std::vector<std::uint32_t> members_;  // places in list_
};

}  // namespace microslip::mesh
