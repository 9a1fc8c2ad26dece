#include "fem/memory_forecast.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fem/assembly/edge_nodes.hpp"

namespace microslip::fem {
namespace {

/// A node and the elements around it, as far as a piece of the mesh has them.
struct BorderNode {
  Eigen::Index node;
  int n_elements;
};

using Border = std::vector<BorderNode>;  // ascending

enum class ElementNodes : std::uint8_t { all, corners };

struct Element {
  const mesh::ElementBlock* block;
  Eigen::Index row;
  Eigen::Index n;  ///< of its nodes, those that count

  [[nodiscard]] auto nodes() const { return block->connectivity.row(row).head(n); }
};

class Dissection {
 public:
  Dissection(const mesh::Mesh& mesh, ElementNodes which)
      : around_(static_cast<std::size_t>(mesh.n_nodes()), 0), mark_(around_.size(), 0) {
    centres_.resize(mesh.n_elements(), 3);
    Eigen::Index element = 0;
    for (const mesh::ElementBlock& block : mesh.elements()) {
      for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e, ++element) {
        const auto nodes = block.connectivity.row(e);
        centres_.row(element) = mesh.nodes()(nodes.transpose(), Eigen::all).colwise().mean();
        const Eigen::Index n =
            which == ElementNodes::all ? nodes.size() : mesh::n_corners(block.type);
        elements_.push_back({&block, e, n});
        for (const auto node : nodes.head(n)) ++around_[static_cast<std::size_t>(node)];
      }
    }
  }

  double size() {
    std::vector<Eigen::Index> all(elements_.size());
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    dissect(all);
    return factor_;
  }

 private:
  // Few enough that how they are ordered does not matter to the sum.
  static constexpr std::size_t leaf = 4;

  Border dissect(std::span<Eigen::Index> elements) {
    if (elements.size() <= leaf) return border_of_elements(elements);
    const std::size_t middle = divide(elements, best_cut(elements));
    const Border first = dissect(elements.first(middle));
    return eliminate(joined(first, dissect(elements.subspan(middle))));
  }

  struct Cut {
    Eigen::Index axis = 0;
    double share = 0.5;  ///< of the elements, in the first part
  };

  /// Orders the elements so that those of the first part come first. @return  how many.
  [[nodiscard]] std::size_t divide(std::span<Eigen::Index> elements, const Cut& cut) const {
    const auto first =
        static_cast<std::ptrdiff_t>(cut.share * static_cast<double>(elements.size()));
    std::nth_element(elements.begin(), elements.begin() + first, elements.end(),
                     [&](Eigen::Index a, Eigen::Index b) {
                       const double x = centres_(a, cut.axis);
                       const double y = centres_(b, cut.axis);
                       return x < y || (x == y && a < b);
                     });
    return static_cast<std::size_t>(first);
  }

  /// Nodes that both parts have.
  std::size_t n_common(std::span<const Eigen::Index> elements, std::size_t n_first) {
    ++stamp_;
    std::size_t n = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (const auto node : elements_[static_cast<std::size_t>(elements[i])].nodes()) {
        int& mark = mark_[static_cast<std::size_t>(node)];
        if (i < n_first) {
          mark = 2 * stamp_;
        } else if (mark == 2 * stamp_) {
          mark = 2 * stamp_ + 1;
          ++n;
        }
      }
    }
    return n;
  }

  /// The plane across one of the axes with few nodes on it for the parts it leaves: through the
  /// middle of a blade's elements may go the plane of its platform.
  Cut best_cut(std::span<Eigen::Index> elements) {
    constexpr std::size_t few = 100;  // the longest side will do
    if (elements.size() < few) return {longest_side(elements), 0.5};
    Cut best;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9}) {
        const Cut cut{axis, share};
        const auto nodes = static_cast<double>(n_common(elements, divide(elements, cut)));
        const double cost = nodes / (share * (1.0 - share));
        if (cost >= least) continue;
        least = cost;
        best = cut;
      }
    }
    return best;
  }

  [[nodiscard]] Eigen::Index longest_side(std::span<const Eigen::Index> elements) const {
    Eigen::RowVector3d lower = centres_.row(elements.front());
    Eigen::RowVector3d upper = lower;
    for (const Eigen::Index e : elements) {
      lower = lower.cwiseMin(centres_.row(e));
      upper = upper.cwiseMax(centres_.row(e));
    }
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    return axis;
  }

  Border border_of_elements(std::span<const Eigen::Index> elements) {
    std::vector<Eigen::Index> nodes;
    for (const Eigen::Index e : elements) {
      const auto own = elements_[static_cast<std::size_t>(e)].nodes();
      nodes.insert(nodes.end(), own.begin(), own.end());
    }
    std::sort(nodes.begin(), nodes.end());
    Border counted;
    for (const Eigen::Index node : nodes) {
      if (counted.empty() || counted.back().node != node) counted.push_back({node, 0});
      ++counted.back().n_elements;
    }
    return eliminate(std::move(counted));
  }

  static Border joined(const Border& a, const Border& b) {
    Border both;
    both.reserve(a.size() + b.size());
    std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both),
               [](const BorderNode& x, const BorderNode& y) { return x.node < y.node; });
    std::size_t n = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
      if (n > 0 && both[n - 1].node == both[i].node) {
        both[n - 1].n_elements += both[i].n_elements;
      } else {
        both[n++] = both[i];
      }
    }
    both.resize(n);
    return both;
  }

  /// Equation (1): nodes with all their elements in the piece go.
  Border eliminate(Border nodes) {
    const auto n_before = static_cast<double>(nodes.size());
    std::erase_if(nodes, [&](const BorderNode& at) {
      return at.n_elements == around_[static_cast<std::size_t>(at.node)];
    });
    const auto b = static_cast<double>(nodes.size());
    const double s = n_before - b;
    factor_ += 9.0 * (0.5 * s * (s + 1.0) + s * b);
    return nodes;
  }

  Eigen::MatrixX3d centres_;
  std::vector<Element> elements_;
  std::vector<int> around_;
  std::vector<int> mark_;  // of the nodes: which cut has met them last, and in which part
  int stamp_ = 0;
  double factor_ = 0.0;
};

constexpr double megabytes = 1e-6;

/// Blocks of three in the upper half of K. A pair of nodes of one element is a pair of two others',
/// near enough.
double n_blocks(const mesh::Mesh& mesh) {
  constexpr double times = 0.55;
  auto n = static_cast<double>(mesh.n_nodes());
  for (const mesh::ElementBlock& block : mesh.elements()) {
    const auto nodes = static_cast<double>(block.connectivity.cols());
    n += times * 0.5 * nodes * (nodes - 1.0) * static_cast<double>(block.connectivity.rows());
  }
  return n;
}

/// Matrices, and the vectors of some modes and static shapes.
double matrices_mb(const mesh::Mesh& mesh, double per_block) {
  constexpr double vectors = 150.0;  // of eight bytes, three numbers a node
  return megabytes *
         (per_block * n_blocks(mesh) + 24.0 * vectors * static_cast<double>(mesh.n_nodes()));
}

double factor_mb(double size) {
  constexpr double asked = 1.4;  // by MUMPS for a nonzero: its stack, its reserve of 30 %
  return megabytes * 8.0 * asked * size;
}

}  // namespace

double factor_size(const mesh::Mesh& mesh) { return Dissection(mesh, ElementNodes::all).size(); }

MemoryForecast direct_memory(const mesh::Mesh& mesh) {
  constexpr double per_block = 520.0;  // K, M, K − σM, and the lists MUMPS is given of two of them
  return {matrices_mb(mesh, per_block), factor_mb(factor_size(mesh))};
}

MemoryForecast iterative_memory(const mesh::Mesh& mesh) {
  constexpr double per_block = 152.0;   // K and M
  constexpr double aggregates = 600.0;  // both halves of K, its coarse levels, how they are joined
  constexpr double corners = 300.0;     // a copy of K, both halves of it for a while
  const double matrices = matrices_mb(mesh, per_block);
  if (!has_edge_nodes(mesh)) return {matrices, megabytes * aggregates * n_blocks(mesh)};
  return {matrices, megabytes * corners * n_blocks(mesh) +
                        factor_mb(Dissection(mesh, ElementNodes::corners).size())};
}

}  // namespace microslip::fem
