#include "contact/patch/elastic_rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>

#include "contact/patch/preload_equilibrium.hpp"

namespace microslip::contact::test_elastic_rest {
namespace {

/// n points that are freedoms themselves.
ContactLayer layer_of(Eigen::Index n, double stiffness) {
  ContactLayer layer;
  layer.to_points.resize(n, n);
  layer.to_points.setIdentity();
  layer.weights = Eigen::VectorXd::Constant(n, 1e-4);
  layer.stiffness = Eigen::VectorXd::Constant(n, stiffness);
  layer.gap = Eigen::VectorXd::Zero(n);
  return layer;
}

/// Approach of the points at rest.
Eigen::VectorXd rest_of(const ElasticFace& face, const ContactLayer& layer) {
  const ElasticRest rest = elastic_rest(face, layer);
  EXPECT_EQ(rest.approach, layer.to_points * rest.displacement - layer.gap);
  return rest.approach;
}

Eigen::VectorXd pressures(const ContactLayer& layer, const Eigen::VectorXd& approach) {
  return layer.stiffness.cwiseProduct(approach.cwiseMax(0.0));
}

TEST(ElasticRest, OnePointSharesTheLoadWithTheBody) {
  const ContactLayer layer = layer_of(1, 1e10);  // 1e6 N/m
  const Eigen::MatrixXd C = Eigen::MatrixXd::Constant(1, 1, 1.0 / 3e6);
  const auto rest = [&](double free) {
    return rest_of({C, Eigen::VectorXd::Constant(1, free)}, layer)[0];
  };
  EXPECT_NEAR(rest(4e-6), 3e-6, 1e-18);  // free motion times 3e6/(1e6 + 3e6)
  EXPECT_EQ(rest(-4e-6), -4e-6);         // open, nothing acts
}

TEST(ElasticRest, AGapIsClosedFirstAndInterferencePresses) {
  ContactLayer layer = layer_of(1, 1e10);
  const ElasticFace face{Eigen::MatrixXd::Constant(1, 1, 1.0 / 3e6),
                         Eigen::VectorXd::Constant(1, 4e-6)};
  layer.gap[0] = 1e-6;
  EXPECT_NEAR(rest_of(face, layer)[0], 0.75 * 3e-6, 1e-18);
  layer.gap[0] = 5e-6;
  EXPECT_NEAR(rest_of(face, layer)[0], -1e-6, 1e-18);
  layer.gap[0] = -4e-6;
  EXPECT_NEAR(rest_of(face, layer)[0], 0.75 * 8e-6, 1e-18);
}

// A stiff body on a support that hardly resists: the pressures are those of preload_equilibrium(),
// whose closed form while all points are loaded is N/n + M z/Σz². The support takes 1e-7 of force
// and moment.
TEST(ElasticRest, AStiffBodyTiltsUntilTheLoadedPointsCarryForceAndMoment) {
  const PlanarCells grid = rectangle_cells(0.1, 0.1, 8, 8);
  const ContactArea area(grid);
  const Eigen::Index n = grid.y.size();
  ContactLayer layer = layer_of(n, 1e10);
  layer.weights = grid.weights;
  Eigen::MatrixX3d arms(n, 3);
  arms << Eigen::VectorXd::Ones(n), grid.z, -grid.y;
  const double soft = 1e7 / (1e10 * grid.weights.sum());  // of the support [m/N]
  const Eigen::Matrix3d support = Eigen::Vector3d(soft, soft / 1e-3, soft / 1e-3).asDiagonal();
  for (const double moment : {0.5, 2.0, 4.0}) {  // of 100 N: closed, then open by parts
    const Eigen::Vector3d load(100.0, moment, -0.3 * moment);
    const ElasticFace face{arms * support * arms.transpose(), arms * (support * load)};
    const Eigen::VectorXd found = pressures(layer, rest_of(face, layer));
    const PreloadEquilibrium stiff = preload_equilibrium(area, one_sided_springs(layer.stiffness),
                                                         {100.0, moment, -0.3 * moment});
    EXPECT_EQ((found.array() > 0.0).count(), stiff.n_loaded) << moment;
    EXPECT_LT((found - stiff.pressures).norm(), 2e-5 * stiff.pressures.norm()) << moment;
    if (moment < 1.0) {
      EXPECT_EQ(stiff.n_loaded, n);
    } else {
      EXPECT_LT(stiff.n_loaded, n);
    }
  }
}

/// Random elastic faces, wildly scaled: stiffness over five decades,
/// loads that press here and lift there.
TEST(ElasticRest, ForcesAreInBalanceAndOpenPointsCarryNothing) {
  std::mt19937 random(20260101);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index n = 12;
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    ContactLayer layer = layer_of(n, 1.0);
    layer.to_points = Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(30, n, [&] {
                        return normal(random);
                      })).sparseView();
    layer.weights = Eigen::VectorXd::Ones(30);
    layer.stiffness = Eigen::VectorXd::NullaryExpr(
        30, [&] { return std::pow(10.0, 2.5 * std::tanh(normal(random))); });
    layer.gap = Eigen::VectorXd::NullaryExpr(30, [&] { return normal(random); });
    const ElasticFace face{root * root.transpose(),
                           Eigen::VectorXd::NullaryExpr(n, [&] { return 3.0 * normal(random); })};
    const Eigen::VectorXd approach = rest_of(face, layer);
    // From the forces of the points back to their approach.
    const Eigen::VectorXd forces = pressures(layer, approach);
    const Eigen::VectorXd v =
        face.approach - face.flexibility * (layer.to_points.transpose() * forces);
    const Eigen::VectorXd again = layer.to_points * v - layer.gap;
    EXPECT_LT((again - approach).norm(), 1e-8 * (1.0 + face.approach.norm())) << trial;
  }
}

TEST(ElasticRest, WithoutGapItGrowsAsTheLoad) {
  const ContactLayer layer = layer_of(3, 1e10);
  Eigen::MatrixXd C(3, 3);
  C << 3, 1, 0, 1, 3, 1, 0, 1, 3;
  C *= 1e-7;
  const Eigen::VectorXd free = Eigen::Vector3d(2e-6, 1e-6, -1e-6);
  const Eigen::VectorXd one = rest_of({C, free}, layer);
  EXPECT_LT(one[2], 0.0);
  EXPECT_LT((rest_of({C, 7.0 * free}, layer) - 7.0 * one).norm(), 1e-12 * one.norm());
}

/// n freedoms of a half space under them, 1 mm apart: E/(1 − ν²) = 2e11 Pa, a point load at r moves
/// it by (1 − ν²)/(πE r); under itself as a disc of its area does.
Eigen::MatrixXd half_space(Eigen::Index n) {
  constexpr double E = 2e11;
  constexpr double pi = 3.14159265358979;
  constexpr double spacing = 1e-3;
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double r = spacing * static_cast<double>(std::abs(i - j));
      C(i, j) = i == j ? 2.0 / (std::sqrt(pi) * E * spacing) : 1.0 / (pi * E * r);
    }
  }
  return C;
}

/// f_i ≥ 0 with f_i = force(i, v_i), v = v⁰ − C f: one point after the other, the others held,
/// until nothing moves.
template <typename ForceOfRest>
Eigen::VectorXd one_by_one(const ElasticFace& face, const ForceOfRest& force) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(face.approach.size());
  for (int sweep = 0; sweep < 2000; ++sweep) {
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      const double c = face.flexibility(i, i);
      const double alone = face.approach[i] - face.flexibility.row(i).dot(f) + c * f[i];
      f[i] = force(i, alone, c);
    }
  }
  return f;
}

/// Pressed in the middle, lifted at one end, with a hollow.
Eigen::VectorXd uneven_approach(Eigen::Index n) {
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n, -1.0, 1.0);
  return 1e-6 * (1.5 - 2.0 * x - 3.0 * (-20.0 * (x + 0.5).square()).exp());
}

TEST(ElasticRest, RoughSurfacesAreThoseFoundPointByPoint) {
  const Eigen::Index n = 24;
  const ElasticFace face{half_space(n), uneven_approach(n)};
  for (const RoughSurface& surface :
       {RoughSurface::cubic(2e-6), RoughSurface::matching_gaussian(2e-6), RoughSurface::cubic(1e-7),
        RoughSurface::cubic(0.0)}) {
    ContactLayer layer = layer_of(n, 1e14);
    layer.weights.setConstant(1e-6);
    layer.gap.setConstant(0.2e-6);
    layer.surfaces.assign(static_cast<std::size_t>(n), surface);
    const ElasticRest rest = elastic_rest(face, layer);
    // a + c w k δ(a) = alone − g by bisection: the left side never falls.
    const Eigen::VectorXd f = one_by_one(face, [&](Eigen::Index i, double alone, double c) {
      double low = -1e-3;
      double high = 1e-3;
      for (int step = 0; step < 80; ++step) {
        const double a = 0.5 * (low + high);
        const double left = a + c * 1e-6 * 1e14 * surface.at(a).compression;
        (left > alone - layer.gap[i] ? high : low) = a;
      }
      return 1e-6 * 1e14 * surface.at(low).compression;
    });
    EXPECT_LT((layer.weights.cwiseProduct(rest.pressure) - f).norm(), 1e-8 * f.norm());
    EXPECT_GT((rest.approach.array() < 0.0).count(), 2);  // some are open, some are not
    EXPECT_GT((rest.approach.array() > 0.0).count(), 8);
  }
}

TEST(ElasticRest, SizesMustFit) {
  ContactLayer layer = layer_of(3, 1e10);
  layer.gap.resize(2);
  try {
    static_cast<void>(rest_of({Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()}, layer));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("2 gaps"), std::string::npos);
  }
}

}  // namespace
}  // namespace microslip::contact::test_elastic_rest
