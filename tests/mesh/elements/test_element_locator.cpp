#include "mesh/elements/element_locator.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mesh/shape_functions.hpp"
#include "tests/mesh/given_mesh.hpp"
#include "tests/mesh/sample_meshes.hpp"

namespace microslip::mesh::test_element_locator {
namespace {

constexpr ElementReference nobody{.block = 99, .element = 0};

/// Above 0 inside.
double depth(ElementType type, const Eigen::Vector3d& xi) {
  const double across = std::max(std::abs(xi[0]), std::abs(xi[1]));
  switch (solid(type)) {
    case Solid::tetrahedron:
      return std::min(xi.minCoeff(), 1.0 - xi.sum());
    case Solid::hexahedron:
      return 1.0 - xi.cwiseAbs().maxCoeff();
    case Solid::wedge:
      return std::min({xi[0], xi[1], 1.0 - xi[0] - xi[1], 1.0 - std::abs(xi[2])});
    case Solid::pyramid:
      return std::min(xi[2], 1.0 - xi[2] - across);
  }
  return 0.0;
}

// Points are made from ξ, so that inside and outside are known without inverting anything.
TEST(ElementLocator, TellsInsideFromOutsideInCurvedElements) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.3, 1.3);
  for (const ElementType type : all_element_types) {
    const double reach = solid(type) == Solid::hexahedron ? 1.0 : 0.5;
    const auto element = tests::curved_element(type);
    std::vector<Eigen::Index> all;
    for (Eigen::Index a = 0; a < element.nodes.rows(); ++a) all.push_back(a);
    const std::vector<ElementBlock> blocks{tests::block_of(type, {all}, 1)};
    const ElementLocator locator(element.nodes, blocks);
    int n_inside = 0;
    for (int i = 0; i < 2000; ++i) {
      Eigen::Vector3d xi(place(random), place(random), place(random));
      xi = (reach * xi.array() + 0.5 * (1.0 - reach)).matrix();
      if (solid(type) == Solid::pyramid && xi[2] >= 1.0) continue;  // no map beyond the apex
      const double inside = depth(type, xi);
      if (std::abs(inside) < 1e-5) continue;
      const Eigen::Vector3d x = element.nodes.transpose() * shapes(type, xi).values;
      EXPECT_EQ(locator.holder(x, nobody).has_value(), inside > 0.0)
          << name(type) << xi.transpose();
      n_inside += inside > 0.0 ? 1 : 0;
    }
    EXPECT_GT(n_inside, 100);
  }
}

// A pyramid on a kite, leaning: the map has a corner at the apex.
TEST(ElementLocator, FindsPointsNearTheApexOfAPyramid) {
  Eigen::MatrixX3d nodes(5, 3);
  nodes << 0, 0, 0, 2, 0.3, 0, 3, 2, 0.2, 0.1, 1, 0, 0.2, 0.1, 1.5;
  const std::vector<ElementBlock> blocks{
      tests::block_of(ElementType::pyramid5, {{0, 1, 2, 3, 4}}, 1)};
  const ElementLocator locator(nodes, blocks);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.99, 0.99);
  for (const double below : {0.5, 0.1, 1e-2, 1e-3, 1e-4}) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d xi(below * place(random), below * place(random), 1.0 - below);
      const Eigen::Vector3d x = nodes.transpose() * shapes(ElementType::pyramid5, xi).values;
      EXPECT_TRUE(locator.holder(x, nobody).has_value()) << xi.transpose();
      const Eigen::Vector3d apex = nodes.row(4).transpose();
      EXPECT_FALSE(locator.holder(2.0 * apex - x, nobody).has_value()) << "beyond the apex";
    }
  }
}

TEST(ElementLocator, NamesTheElementOfAGrid) {
  constexpr Eigen::Index n = 4;
  Eigen::MatrixX3d nodes((n + 1) * (n + 1) * (n + 1), 3);
  std::vector<std::vector<Eigen::Index>> rows;
  const auto at = [](Eigen::Index i, Eigen::Index j, Eigen::Index k) {
    return (k * (n + 1) + j) * (n + 1) + i;
  };
  for (Eigen::Index k = 0; k <= n; ++k) {
    for (Eigen::Index j = 0; j <= n; ++j) {
      for (Eigen::Index i = 0; i <= n; ++i) {
        nodes.row(at(i, j, k)) << 0.01 * double(i), 3.0 * double(j), double(k * k);
        if (i == n || j == n || k == n) continue;
        rows.push_back({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                        at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1),
                        at(i, j + 1, k + 1)});
      }
    }
  }
  const std::vector<ElementBlock> blocks{tests::block_of(ElementType::hex8, rows, 1)};
  const ElementLocator locator(nodes, blocks);
  for (Eigen::Index e = 0; e < std::ssize(rows); ++e) {
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (const Eigen::Index node : rows[static_cast<std::size_t>(e)])
      middle += nodes.row(node) / 8.0;
    EXPECT_EQ(locator.holder(middle.transpose(), nobody), (ElementReference{0, e}));
    EXPECT_FALSE(locator.holder(middle.transpose(), {0, e}).has_value())
        << "the own element does not count";
  }
  EXPECT_FALSE(locator.holder({1.0, 1.0, 1.0}, nobody).has_value());
}

}  // namespace
}  // namespace microslip::mesh::test_element_locator
