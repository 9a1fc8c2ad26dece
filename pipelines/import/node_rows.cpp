#include "pipelines/import/node_rows.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

// Results are printed with six digits of each coordinate.
constexpr double node_tolerance = 1e-5;

/// Nodes in the order of their x, to be found by their places.
class NodeFinder {
 public:
  explicit NodeFinder(const Eigen::MatrixX3d& nodes) : nodes_(nodes), order_(nodes.rows()) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
    std::ranges::sort(order_, {}, [&](Eigen::Index i) { return nodes_(i, 0); });
  }

  /// Another node than one, within `distance` of it along every axis; −1: none.
  [[nodiscard]] Eigen::Index twin_of(Eigen::Index node, double distance) const {
    const auto x = [&](Eigen::Index i) { return nodes_(i, 0); };
    const auto first = std::ranges::lower_bound(order_, x(node) - distance, {}, x);
    for (auto i = first; i != order_.end() && x(*i) <= x(node) + distance; ++i) {
      const double away = (nodes_.row(*i) - nodes_.row(node)).cwiseAbs().maxCoeff();
      if (*i != node && away <= distance) return *i;
    }
    return -1;
  }

  /// The node nearest to a place within `distance` along every axis; −1: none.
  [[nodiscard]] Eigen::Index near(const Eigen::RowVector3d& place, double distance) const {
    const auto x = [&](Eigen::Index i) { return nodes_(i, 0); };
    const auto first = std::ranges::lower_bound(order_, place.x() - distance, {}, x);
    Eigen::Index best = -1;
    for (auto i = first; i != order_.end() && x(*i) <= place.x() + distance; ++i) {
      const double away = (nodes_.row(*i) - place).cwiseAbs().maxCoeff();
      if (away > distance) continue;
      distance = away;
      best = *i;
    }
    return best;
  }

 private:
  const Eigen::MatrixX3d& nodes_;
  std::vector<Eigen::Index> order_;
};

std::string extents(const Eigen::MatrixX3d& nodes) {
  const Eigen::RowVector3d size = nodes.colwise().maxCoeff() - nodes.colwise().minCoeff();
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m", size.x(), size.y(), size.z());
}

double tolerance_of(const mesh::Mesh& mesh) {
  return node_tolerance * mesh.nodes().cwiseAbs().maxCoeff();
}

}  // namespace

std::vector<std::array<Eigen::Index, 2>> rows_in_one_place(const mesh::Mesh& mesh,
                                                           const Eigen::MatrixX3d& nodes,
                                                           const std::vector<Eigen::Index>& rows) {
  const NodeFinder finder(nodes);
  std::vector<std::array<Eigen::Index, 2>> pairs;
  for (const Eigen::Index row : rows) {
    const Eigen::Index twin = finder.twin_of(row, tolerance_of(mesh));
    if (twin >= 0) pairs.push_back({row, twin});
  }
  return pairs;
}

std::vector<Eigen::Index> rows_of_nodes(const mesh::Mesh& mesh, const Eigen::MatrixX3d& nodes,
                                        const std::filesystem::path& file,
                                        const std::string& place_of_file) {
  const double tolerance = tolerance_of(mesh);
  const NodeFinder finder(nodes);
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(mesh.n_nodes()));
  Eigen::Index n_missing = 0;
  Eigen::Index missing = 0;
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    rows[static_cast<std::size_t>(i)] = finder.near(mesh.nodes().row(i), tolerance);
    if (rows[static_cast<std::size_t>(i)] >= 0) continue;
    ++n_missing;
    missing = i;
  }
  if (n_missing == 0) return rows;
  const auto place = mesh.nodes().row(missing);
  throw SceneError(fmt::format(
      "{}: {} of the {} nodes of the mesh {} no place in {} (within {:.2g} m), one of them at "
      "({:.6g}, {:.6g}, {:.6g}) m; the mesh measures {}, those nodes {}: give the mesh "
      "they were computed on, in the same unit",
      place_of_file, n_missing, mesh.n_nodes(), n_missing == 1 ? "has" : "have",
      file.filename().string(), tolerance, place.x(), place.y(), place.z(), extents(mesh.nodes()),
      extents(nodes)));
}

}  // namespace microslip::pipelines
