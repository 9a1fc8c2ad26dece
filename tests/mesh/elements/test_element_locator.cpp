#include "mesh/elements/element_locator.hpp"

#include <random>

#include <gtest/gtest.h>

#include "mesh/shape_functions.hpp"
#include "tests/mesh/given_mesh.hpp"
#include "tests/mesh/sample_meshes.hpp"

namespace microslip::mesh {
namespace {

constexpr ElementReference nobody{.block = 99, .element = 0};

// Points are made from ξ, so that inside and outside are known without inverting anything.
TEST(ElementLocator, TellsInsideFromOutsideInCurvedElements) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.3, 1.3);
  for (const ElementType type : {ElementType::tet10, ElementType::hex20}) {
    const auto element = tests::curved_element(type);
    std::vector<Eigen::Index> all;
    for (Eigen::Index a = 0; a < element.nodes.rows(); ++a) all.push_back(a);
    const std::vector<ElementBlock> blocks{tests::block_of(type, {all}, 1)};
    const ElementLocator locator(element.nodes, blocks);
    int n_inside = 0;
    for (int i = 0; i < 2000; ++i) {
      Eigen::Vector3d xi(place(random), place(random), place(random));
      if (type == ElementType::tet10) xi = (0.5 * xi.array() + 0.25).matrix();
      const double depth = type == ElementType::tet10 ? std::min(xi.minCoeff(), 1.0 - xi.sum())
                                                      : 1.0 - xi.cwiseAbs().maxCoeff();
      if (std::abs(depth) < 1e-5) continue;
      const Eigen::Vector3d x = element.nodes.transpose() * shapes(type, xi).values;
      EXPECT_EQ(locator.holder(x, nobody).has_value(), depth > 0.0) << name(type) << xi.transpose();
      n_inside += depth > 0.0 ? 1 : 0;
    }
    EXPECT_GT(n_inside, 100);
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
}  // namespace microslip::mesh
