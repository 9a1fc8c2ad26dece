#include "contact/patch/preload_equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/numerics/plane_hull.hpp"
#include "contact/surface/surface_law.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_preload_equilibrium {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// 16 cells of weight 1 on 0.1 × 0.1 m, k_N = 40 kN/m in all (theory 20.5).
ContactArea square_area() {
  PlanarCells cells = rectangle_cells(0.1, 0.1, 4, 4);
  cells.weights.setOnes();
  return ContactArea(cells);
}

CellSprings square_springs() { return one_sided_springs(Eigen::VectorXd::Constant(16, 40e3 / 16)); }

PreloadEquilibrium square_preload(double force, double moment_y, double moment_z = 0.0) {
  return preload_equilibrium(square_area(), square_springs(), {force, moment_y, moment_z});
}

// (2) recomputed from the pressures alone, relative.
double imbalance(const ContactArea& area, const Eigen::VectorXd& pressures,
                 const PreloadRequest& request) {
  const PlanarCells& cells = area.cells();
  const Eigen::VectorXd loads = cells.weights.cwiseProduct(pressures);
  const double radius = std::max(cells.y.cwiseAbs().maxCoeff(), cells.z.cwiseAbs().maxCoeff());
  return std::max({std::abs(loads.sum() - request.force),
                   std::abs(cells.z.dot(loads) - request.moment_y) / radius,
                   std::abs(-cells.y.dot(loads) - request.moment_z) / radius}) /
         request.force;
}

constexpr double six_digits = 5e-6;  // of numbers in messages

double number_before(const std::string& text, const std::string& words) {
  const std::string until = text.substr(0, text.find(words));
  return std::stod(until.substr(until.rfind(' ') + 1));
}

TEST(PreloadEquilibrium, LoadedCellsFollowTheLinearFormula) {
  const PlanarCells cells = square_area().cells();
  const PreloadEquilibrium at_rest = square_preload(100.0, 1.0, -0.4);
  for (Eigen::Index i = 0; i < 16; ++i) {
    const double expected = 100.0 / 16 + 1.0 * cells.z[i] / cells.z.squaredNorm() +
                            0.4 * cells.y[i] / cells.y.squaredNorm();
    EXPECT_NEAR(at_rest.pressures[i], expected, 1e-12 * expected);  // one solve of three equations
  }
  EXPECT_EQ(at_rest.n_loaded, 16);
}

// Theory 20.5: M_y = 1 N m lifts the first row off at 48 N, and tips the bodies over at 26.7 N.
TEST(PreloadEquilibrium, SquareLosesItsFirstRowAt48Newton) {
  EXPECT_EQ(square_preload(48.0001, 1.0).n_loaded, 16);
  EXPECT_EQ(square_preload(47.9999, 1.0).n_loaded, 12);
}

TEST(PreloadEquilibrium, SquareTipsOverBelowTwentySevenNewton) {
  const double limit = 1.0 / 0.0375;
  EXPECT_EQ(square_preload(limit * 1.0001, 1.0).n_loaded, 8);
  for (const double force : {limit, limit * 0.9999, 10.0}) {
    try {
      (void)square_preload(force, 1.0);
      ADD_FAILURE() << force;
    } catch (const PreloadError& error) {
      const std::string message = error.what();
      // Moments as scenes give them: [about p, about r].
      EXPECT_NE(message.find("with moments 0 and 1 N m about p and r"), std::string::npos)
          << message;
      EXPECT_NEAR(number_before(message, " N with"), force, six_digits * force);
      EXPECT_NEAR(number_before(message, " m, r ="), 1.0 / force, six_digits / force);
      const double outside = 1.0 / force - 0.0375;
      EXPECT_NEAR(number_before(message, " m outside the hull"), outside,
                  1e-15 + six_digits * outside);
      EXPECT_NE(message.find("these moments need more than 26.6667 N"), std::string::npos)
          << message;
    }
  }
}

// Row 22. Hard: a moment beyond the kern: an edge lifts off, which rows is not known before.
// Met in: paper B, figure 10.
// Right: force and moments balance over the rows that stay; tipping is refused.
//
// Three rows of the four carry: two equations for the two unknowns of the tilt, by hand.
TEST(PreloadEquilibrium, LiftedRowsLeaveTheOthersInEquilibrium) {
  const PreloadEquilibrium at_rest = square_preload(40.0, 1.0);
  ASSERT_EQ(at_rest.n_loaded, 12);
  // Rows at z = −12.5, 12.5, 37.5 mm, four cells each.
  const double middle = 0.0125;
  const double spread = 4.0 * 2.0 * 0.025 * 0.025;
  for (Eigen::Index i = 0; i < 16; ++i) {
    const double z = square_area().cells().z[i];
    const double expected =
        z < -0.03 ? 0.0 : 40.0 / 12 + (1.0 - 40.0 * middle) * (z - middle) / spread;
    EXPECT_NEAR(at_rest.pressures[i], expected, 1e-12 * 40.0) << z;
  }
}

// Random planes, weights, laws and resultants anywhere inside the hull, close to its edge included.
TEST(PreloadEquilibrium, BalancesForceAndMoments) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int lifted = 0;
  for (int sample = 0; sample < 300; ++sample) {
    const Eigen::Index n = 4 + static_cast<Eigen::Index>(40.0 * uniform(random));
    const auto draw = [&] {
      return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(random); }).eval();
    };
    const ContactArea area({0.2 * draw(), 0.1 * draw(), 1e-4 * draw()});
    const RoughSurface surface = sample % 3 == 0   ? RoughSurface::cubic(0.0)
                                 : sample % 3 == 1 ? RoughSurface::cubic(1e-6)
                                                   : RoughSurface::matching_gaussian(1e-6);
    const SurfaceLaw surfaces({1e12, 1e12, 0.4, 0.0}, 1e12, FrictionLaw::constant(0.4), surface,
                              {0.0, sample % 2 == 0 ? 0.0 : 1e-12, 0.0});
    const CellSprings springs = [&](Eigen::Index, double u) {
      const SurfaceState s = surfaces.at(u, 0.0);
      return NormalResponse{s.load, s.load_by_approach};
    };
    const PlaneHull hull(
        (Eigen::Matrix2Xd(2, n) << area.cells().y.transpose(), area.cells().z.transpose())
            .finished());
    // Between the mean of the corners and one of them, up to 1e-4 of the way from it.
    const double towards = sample % 5 == 0 ? 0.9999 : 0.9 * uniform(random);
    const Eigen::Vector2d at = (1.0 - towards) * hull.corners().rowwise().mean() +
                               towards * hull.corners().col(sample % hull.corners().cols());
    const double force = std::pow(10.0, 6.0 * uniform(random) - 3.0);
    const PreloadRequest request{force, force * at.y(), -force * at.x()};
    const PreloadEquilibrium at_rest = preload_equilibrium(area, springs, request);
    lifted += at_rest.n_loaded < n ? 1 : 0;
    ASSERT_LE(imbalance(area, at_rest.pressures, request), 1e-11) << sample;  // asked for: 1e-8
    ASSERT_GE(at_rest.pressures.minCoeff(), 0.0);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double u = at_rest.approach + area.cells().z[i] * at_rest.rotation_y -
                       area.cells().y[i] * at_rest.rotation_z;
      // Rounding of a tilt over the patch.
      const double size =
          std::abs(at_rest.approach) + std::abs(at_rest.rotation_y) + std::abs(at_rest.rotation_z);
      ASSERT_NEAR(u, at_rest.approaches[i], 10.0 * eps * size);
    }
  }
  EXPECT_GT(lifted, 100);
}

TEST(PreloadEquilibrium, DoesNotDependOnUnits) {
  const PreloadEquilibrium metres = square_preload(35.0, 1.0, 0.1);
  for (const double length : {1e-9, 1e-3, 1e6}) {
    for (const double force : {1e-12, 1e9}) {
      PlanarCells cells = square_area().cells();
      cells.y *= length;
      cells.z *= length;
      const PreloadEquilibrium scaled =
          preload_equilibrium(ContactArea(cells), square_springs(),
                              {35.0 * force, force * length, 0.1 * force * length});
      // Both are balanced to rounding; the pressures follow with the conditioning of the tilt.
      EXPECT_LE((scaled.pressures / force - metres.pressures).norm(),
                1e-11 * metres.pressures.norm());
      EXPECT_EQ(scaled.n_loaded, metres.n_loaded);
    }
  }
}

TEST(PreloadEquilibrium, RoughCellsUnderTheirMeanLoadComeBackToIt) {
  const RoughSurface surface = RoughSurface::matching_gaussian(1e-6);
  const ContactArea area(rectangle_cells(0.1, 0.1, 4, 4));
  const CellSprings springs = [&](Eigen::Index, double u) {
    const RoughState s = surface.at(u);
    return NormalResponse{1e12 * s.compression, 1e12 * s.share};
  };
  for (const double pressure : {1e-6, 1.0, 1e5, 1e9}) {
    const PreloadEquilibrium at_rest =
        preload_equilibrium(area, springs, {0.01 * pressure, 0.0, 0.0});
    const double expected = surface.approach(pressure / 1e12);
    // Both are inverses of one function; its slope against ln load is 1/|ζ| of the deviation or
    // more.
    EXPECT_LE((at_rest.approaches.array() - expected).abs().maxCoeff(),
              1e-12 * (1e-6 + std::abs(expected)));
  }
}

TEST(PreloadEquilibrium, CellsOnALineTakeMomentsAlongItOnly) {
  const Eigen::VectorXd along = Eigen::VectorXd::LinSpaced(5, -0.1, 0.1);
  const ContactArea area({std::cos(0.7) * along, std::sin(0.7) * along, Eigen::VectorXd::Ones(5)});
  const CellSprings springs = one_sided_springs(Eigen::VectorXd::Constant(5, 1e6));
  for (const double at : {0.0, 0.03, 0.08}) {
    const PreloadRequest request{10.0, 10.0 * at * std::sin(0.7), -10.0 * at * std::cos(0.7)};
    EXPECT_LE(imbalance(area, preload_equilibrium(area, springs, request).pressures, request),
              1e-12);
  }
  EXPECT_THROW((void)preload_equilibrium(area, springs, {10.0, 0.3, 0.0}), PreloadError);
  EXPECT_THROW(
      (void)preload_equilibrium(area, springs, {10.0, 1.5 * std::sin(0.7), -1.5 * std::cos(0.7)}),
      PreloadError);
}

// A strip that is 1e7 times longer than wide still resists tilts about its long axis.
TEST(PreloadEquilibrium, FlatAreasBalanceBothMoments) {
  PlanarCells cells = square_area().cells();
  cells.z *= 1e-7;
  const double moment = 30.0 * 0.03e-7;
  const PreloadEquilibrium at_rest =
      preload_equilibrium(ContactArea(cells), square_springs(), {30.0, moment, 0.2});
  EXPECT_LE(at_rest.imbalance, 1e-12);
  EXPECT_NEAR(cells.z.dot(at_rest.pressures), moment, 1e-12 * moment);
  EXPECT_NEAR(-cells.y.dot(at_rest.pressures), 0.2, 1e-12 * 0.2);
}

// Row 15. Hard: an area of one cell: no lever for a moment.
// Met in: contact areas cut to a single point.
// Right: the cell carries the force.
TEST(PreloadEquilibrium, OneCellCarriesItAll) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  const ContactArea area({0.2 * one, 0.0 * one, 2.0 * one});
  const CellSprings springs = one_sided_springs(1e6 * one);
  EXPECT_NEAR(preload_equilibrium(area, springs, {10.0, 0.0, -2.0}).pressures[0], 5.0, 1e-12);
  EXPECT_THROW((void)preload_equilibrium(area, springs, {10.0, 0.0, 0.0}), PreloadError);
}

TEST(PreloadEquilibrium, CellsWithoutWeightHoldNothing) {
  PlanarCells cells = square_area().cells();
  for (Eigen::Index i = 0; i < 16; ++i) {
    if (cells.z[i] > 0.03) cells.weights[i] = 0.0;
  }
  // The hull ends at z = 12.5 mm now.
  EXPECT_THROW((void)preload_equilibrium(ContactArea(cells), square_springs(), {40.0, 0.6, 0.0}),
               PreloadError);
  EXPECT_NO_THROW(
      (void)preload_equilibrium(ContactArea(cells), square_springs(), {60.0, 0.6, 0.0}));
}

TEST(PreloadEquilibrium, WithoutForceNothingIsLoaded) {
  const PreloadEquilibrium nothing = square_preload(0.0, 0.0);
  EXPECT_EQ(nothing.n_loaded, 0);
  EXPECT_TRUE(nothing.pressures.isZero(0.0));
  EXPECT_THROW((void)square_preload(0.0, 1e-9), PreloadError);
  EXPECT_THROW((void)square_preload(-5.0, 0.0), PreloadError);
  EXPECT_THROW((void)square_preload(std::nan(""), 0.0), std::invalid_argument);
}

TEST(PreloadEquilibrium, RefusesALawThatEndsBelowTheForce) {
  const tests::UntrappedFloatingPoint the_search_goes_to_infinity;
  const CellSprings weak = [](Eigen::Index, double u) {
    return NormalResponse{u > 0.0 ? u / (1.0 + u) : 0.0,
                          u > 0.0 ? 1.0 / ((1.0 + u) * (1.0 + u)) : 0.0};
  };
  EXPECT_THROW((void)preload_equilibrium(square_area(), weak, {100.0, 0.0, 0.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_preload_equilibrium
