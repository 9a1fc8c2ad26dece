#include "contact/patch/position_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "contact/numerics/delaunay.hpp"

namespace microslip::contact::test_position_table {
namespace {

struct Points {
  Eigen::VectorXd p;
  Eigen::VectorXd r;
};

Points random_points(Eigen::Index n, unsigned seed, double low, double high) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(low, high);
  Points points{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    points.p[i] = uniform(random);
    points.r[i] = uniform(random);
  }
  return points;
}

Points grid(int n_p, int n_r) {
  Points points{Eigen::VectorXd(n_p * n_r), Eigen::VectorXd(n_p * n_r)};
  for (int i = 0; i < n_p * n_r; ++i) {
    points.p[i] = 0.1 * (i % n_p);
    points.r[i] = 0.3 * static_cast<double>(i / n_p);
  }
  return points;
}

Eigen::VectorXd linear(const Points& x) { return 2.0 + 3.0 * x.p.array() - x.r.array(); }

double one(const PositionTable& table, double p, double r) {
  return table.at(Eigen::VectorXd::Constant(1, p), Eigen::VectorXd::Constant(1, r))[0];
}

double doubled_area(const Points& x, const std::array<int, 3>& t) {
  const auto& [a, b, c] = t;
  return (x.p[b] - x.p[a]) * (x.r[c] - x.r[a]) - (x.r[b] - x.r[a]) * (x.p[c] - x.p[a]);
}

Eigen::MatrixX2d matrix(const Points& x) {
  Eigen::MatrixX2d points(x.p.size(), 2);
  points << x.p, x.r;
  return points;
}

// Euler: a triangulation of n points with h on the hull has 2n − 2 − h triangles; together with the
// area of the hull this shows that nothing overlaps or is missing.
void expect_triangulation(const Points& x, double area) {
  const Triangulation t = delaunay(matrix(x));
  EXPECT_EQ(static_cast<Eigen::Index>(t.triangles.size() + t.hull.size()), 2 * x.p.size() - 2);
  double sum = 0.0;
  for (const auto& triangle : t.triangles) {
    EXPECT_GT(doubled_area(x, triangle), 0.0);
    sum += 0.5 * doubled_area(x, triangle);
  }
  double hull = 0.0;
  for (const auto& [a, b] : t.hull) {
    hull += 0.5 * (x.p[a] * x.r[b] - x.p[b] * x.r[a]);
  }
  EXPECT_NEAR(sum, hull, 1e-13);
  if (area > 0.0) {
    EXPECT_NEAR(sum, area, 1e-13);
  }
}

TEST(Delaunay, CoversTheHullOnce) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    expect_triangulation(random_points(300, seed, -1.0, 1.0), 0.0);
  }
  // All on circles and lines.
  expect_triangulation(grid(7, 5), 0.6 * 1.2);
  Points circle{Eigen::VectorXd(24), Eigen::VectorXd(24)};
  for (int i = 0; i < 24; ++i) {
    circle.p[i] = std::cos(0.2617993877991494 * i);
    circle.r[i] = std::sin(0.2617993877991494 * i);
  }
  expect_triangulation(circle, 12.0 * std::sin(0.2617993877991494));
}

TEST(Delaunay, HasNoPointInsideACircle) {
  const Points x = random_points(60, 9, 0.0, 1.0);
  for (const auto& t : delaunay(matrix(x)).triangles) {
    const Eigen::Vector2d a(x.p[t[0]], x.r[t[0]]);
    Eigen::Matrix2d M;
    M << x.p[t[1]] - a.x(), x.r[t[1]] - a.y(), x.p[t[2]] - a.x(), x.r[t[2]] - a.y();
    const Eigen::Vector2d to_centre = M.inverse() * (0.5 * M.rowwise().squaredNorm());
    for (Eigen::Index i = 0; i < x.p.size(); ++i) {
      const double distance = (Eigen::Vector2d(x.p[i], x.r[i]) - a - to_centre).norm();
      EXPECT_GE(distance, to_centre.norm() * (1.0 - 1e-9));
    }
  }
}

TEST(Delaunay, HasNothingOnALine) {
  Points line = random_points(6, 4, 0.0, 1.0);
  line.r.setConstant(0.3);
  EXPECT_TRUE(delaunay(matrix(line)).triangles.empty());
}

TEST(PositionTable, HitsValuesAndReproducesLinearFields) {
  const Points inside = random_points(200, 5, 0.05, 0.5);
  for (const Points& x : {grid(7, 5), random_points(400, 6, 0.0, 0.6)}) {
    const PositionTable table(x.p, x.r, linear(x));
    EXPECT_LT((table.at(x.p, x.r) - linear(x)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((table.at(inside.p, inside.r) - linear(inside)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(PositionTable, KnowsAGridWhateverTheOrderOfRows) {
  Points x = grid(4, 3);
  x.p.reverseInPlace();
  x.r.reverseInPlace();
  const Eigen::VectorXd values = x.p.cwiseProduct(x.r);
  const PositionTable table(x.p, x.r, values);
  EXPECT_NEAR(one(table, 0.17, 0.41), 0.17 * 0.41, 1e-15);  // bilinear
  // Without its last row it is no grid: linear in triangles, between the corners of a cell.
  const PositionTable scattered(x.p.head(11), x.r.head(11), values.head(11));
  EXPECT_GT(std::abs(one(scattered, 0.17, 0.41) - 0.17 * 0.41), 1e-3);
}

TEST(PositionTable, TakesTheNearestPlaceOutside) {
  const Points x = grid(7, 5);
  const PositionTable table(x.p, x.r, linear(x));
  EXPECT_NEAR(one(table, -5.0, 0.5), 2.0 - 0.5, 1e-14);
  EXPECT_NEAR(one(table, 9.0, 9.0), 2.0 + 1.8 - 1.2, 1e-14);
  const Points corner{Eigen::Vector3d(0.0, 1.0, 0.0), Eigen::Vector3d(0.0, 0.0, 1.0)};
  const PositionTable triangle(corner.p, corner.r, linear(corner));
  EXPECT_NEAR(one(triangle, 1.0, 1.0), 2.0 + 1.5 - 0.5, 1e-14);  // the middle of the long side
  EXPECT_NEAR(one(triangle, 0.3, -2.0), 2.9, 1e-14);
}

TEST(PositionTable, InterpolatesAlongALineOrFromOnePoint) {
  const Eigen::Vector3d p(0.0, 2.0, 1.0);
  const Eigen::Vector3d r = 0.5 * p;
  const PositionTable line(p, r, Eigen::Vector3d(1.0, 5.0, 2.0));
  EXPECT_NEAR(one(line, 1.5, 0.75), 3.5, 1e-15);
  EXPECT_EQ(one(line, -1.0, -1.0), 1.0);
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 0.4);
  EXPECT_EQ(one(PositionTable(x, x, x), 7.0, 8.0), 0.4);
}

TEST(PositionTable, RefusesTheSamePlaceTwice) {
  const Eigen::Vector3d p(0.0, 1.0, 0.0);
  const Eigen::Vector3d r(0.0, 0.0, 0.0);
  try {
    const PositionTable table(p, r, p);
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rows 1 and 3"), std::string::npos) << error.what();
  }
  EXPECT_THROW(PositionTable(p, r, Eigen::VectorXd::Zero(2)), std::invalid_argument);
  EXPECT_THROW(PositionTable(p, r, Eigen::Vector3d(0.0, NAN, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_position_table
