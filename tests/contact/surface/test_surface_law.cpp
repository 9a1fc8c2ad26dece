#include "contact/surface/surface_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace microslip::contact::test_surface_law {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double R = 4e-6;

PointParameters point_with(double preload) { return {1e12, 2e12, 0.4, preload}; }

SurfaceLaw rough_law(double preload, const RoughSurface& surface,
                     const SeriesCompliance& series = {}) {
  return {point_with(preload), 1.5e12, FrictionLaw::constant(0.4), surface, series};
}

std::vector<SurfaceLaw> rough_laws(double preload) {
  std::vector<SurfaceLaw> laws;
  for (const RoughSurface& surface : {RoughSurface::cubic(R), RoughSurface::matching_gaussian(R)}) {
    for (const SeriesCompliance& series :
         {SeriesCompliance{}, SeriesCompliance{3e-13, 5e-13, 1e-13},
          SeriesCompliance{-3e-13, -2e-13, 4e-13}, SeriesCompliance{1e-9, 1e-9, 1e-9}}) {
      laws.push_back(rough_law(preload, surface, series));
    }
  }
  return laws;
}

template <class Quantity>
double difference(const SurfaceLaw& law, double v, double h, Quantity quantity) {
  const auto f = [&](double x) { return quantity(law.at(x, 0.0)); };
  return (8.0 * (f(v + h) - f(v - h)) - (f(v + 2.0 * h) - f(v - 2.0 * h))) / (12.0 * h);
}

bool near_kink(const SurfaceLaw& law, double v, double distance) {
  return std::ranges::any_of(law.kinks(),
                             [&](double kink) { return std::abs(kink - v) < distance; });
}

TEST(SurfaceLaw, SmoothContactIsTheOneSidedSpring) {
  for (const double preload : {3e5, 0.0, -3e5}) {
    const SurfaceLaw law(point_with(preload), 1.5e12);
    EXPECT_TRUE(law.is_smooth());
    EXPECT_EQ(law.reference_load(), std::max(preload, 0.0));
    EXPECT_EQ(law.kinks(), std::vector<double>{-preload / 2e12});
    for (const double v : {-1e-6, -1e-7, 1e-7, 1e-6}) {
      const SurfaceState s = law.at(v, 0.0);
      EXPECT_EQ(s.load, std::max(0.0, preload + 2e12 * v));
      EXPECT_EQ(s.gap_load, preload + 2e12 * v);
      EXPECT_EQ(s.load_by_approach, s.load > 0.0 ? 2e12 : 0.0);
      EXPECT_EQ(s.stiffness_ratio, 1.0);
      EXPECT_EQ(s.load_per_ratio, s.load);
      EXPECT_EQ(s.friction_coefficient, 0.4);
    }
  }
}

TEST(SurfaceLaw, SmoothContactInSeriesAddsCompliances) {
  const SurfaceLaw law(point_with(3e5), 1.5e12, FrictionLaw::constant(0.4), std::nullopt,
                       {1e-12, 0.5e-12, 0.0});
  // Two roundings.
  EXPECT_NEAR(law.first_stiffness(), 0.5e12, 2.0 * eps * 0.5e12);
  EXPECT_NEAR(law.point().normal_stiffness, 1e12, 2.0 * eps * 1e12);
  EXPECT_EQ(law.second_stiffness(), 1.5e12);
  EXPECT_NEAR(law.at(1e-7, 0.0).load, 4e5, 4.0 * eps * 4e5);
}

TEST(SurfaceLaw, RoughnessWithoutHeightIsSmooth) {
  const SeriesCompliance series{1e-12, 0.5e-12, 0.0};
  const SurfaceLaw smooth(point_with(3e5), 1.5e12, FrictionLaw::constant(0.4), std::nullopt,
                          series);
  const SurfaceLaw flat = rough_law(3e5, RoughSurface::cubic(0.0), series);
  EXPECT_TRUE(flat.is_smooth());
  EXPECT_EQ(flat.at(1e-7, 0.0).load, smooth.at(1e-7, 0.0).load);
}

// Between smooth and rough surfaces of height R the load differs by at most k R/2, wherever v = 0
// is: at the same load or at the same gap.
TEST(SurfaceLaw, ShrinkingHeightTendsToSmooth) {
  const SeriesCompliance series{1e-12, 0.5e-12, 0.0};
  for (const double preload : {3e5, 0.0, -3e5}) {
    const SurfaceLaw smooth(point_with(preload), 1.5e12, FrictionLaw::constant(0.4), std::nullopt,
                            series);
    for (const double height : {1e-8, 1e-10, 1e-13}) {
      for (const RoughSurface& surface :
           {RoughSurface::cubic(height), RoughSurface::matching_gaussian(height)}) {
        const SurfaceLaw law = rough_law(preload, surface, series);
        for (const double v : {-1e-6, 1e-7, 1e-6}) {
          // 1e-9: rounding of loads of 1e6 and what a Gaussian exceeds the cubic by.
          EXPECT_NEAR(law.at(v, 0.0).load, smooth.at(v, 0.0).load, 0.55e12 * height + 1e-9 * 1e6)
              << preload << " " << height << " " << v;
          if (smooth.at(v, 0.0).load > 0.0) {
            EXPECT_NEAR(law.at(v, 0.0).stiffness_ratio, 1.0, 1e-12);
          }
        }
      }
    }
  }
}

TEST(SurfaceLaw, RestCarriesTheAppliedPressure) {
  for (const double preload : {1e-250, 1e-3, 1e3, 3e5, 4e6, 1e9}) {
    for (const SurfaceLaw& law : rough_laws(preload)) {
      EXPECT_FALSE(law.is_smooth());
      EXPECT_EQ(law.at(0.0, 0.0).load, law.reference_load());
      // Conditioning: 3 for the cubic law; ζ² ≤ 1200 in the tail of the Gaussian. Soft bodies add
      // that of closure = u + cN, no more than 3 again.
      // Gaussian heights begin to carry with 1e-20 of k_v times their deviation.
      EXPECT_NEAR(law.reference_load(), preload,
                  (preload < 1.0 ? 5000.0 * eps : 200.0 * eps) * preload + 2e-20 * 2e12 * R)
          << preload;
    }
  }
}

TEST(SurfaceLaw, AGapIsClosedWhereSmoothSurfacesWouldTouch) {
  for (const SeriesCompliance& series : {SeriesCompliance{}, SeriesCompliance{0.0, 5e-13, 0.0}}) {
    const SurfaceLaw law = rough_law(-3e5, RoughSurface::cubic(R), series);
    const double gap = 3e5 * (1.0 / 2e12 + series.q);
    EXPECT_EQ(law.reference_load(), 0.0);
    EXPECT_NEAR(law.kinks().front(), gap, 4.0 * eps * gap);
    EXPECT_EQ(law.at(0.999 * gap, 0.0).load, 0.0);
    EXPECT_LT(law.at(0.999 * gap, 0.0).gap_load, 0.0);
    EXPECT_EQ(law.at(0.999 * gap, 0.0).stiffness_ratio, 0.0);
    EXPECT_GT(law.at(1.001 * gap, 0.0).load, 0.0);
  }
}

TEST(SurfaceLaw, KinksAreFirstTouchAndFullContact) {
  for (const SeriesCompliance& series : {SeriesCompliance{}, SeriesCompliance{3e-13, 5e-13, 1e-13},
                                         SeriesCompliance{0.0, -2e-13, 0.0}}) {
    const SurfaceLaw law = rough_law(3e5, RoughSurface::cubic(R), series);
    const std::vector<double> kinks = law.kinks();
    ASSERT_EQ(kinks.size(), 2U);
    // 1e-10 R beside a kink h* is (3e-20, 3e-20 off 1), and the closure itself is rounded by 1e-16
    // R.
    EXPECT_EQ(law.at(kinks[0] - 1e-10 * R, 0.0).load, 0.0);
    EXPECT_GT(law.at(kinks[0] + 1e-10 * R, 0.0).load, 0.0);
    EXPECT_EQ(law.at(kinks[1] + 1e-10 * R, 0.0).stiffness_ratio, 1.0);
    EXPECT_LT(law.at(kinks[1] - 1e-5 * R, 0.0).stiffness_ratio, 1.0);
    EXPECT_NEAR(law.at(kinks[1], 0.0).load, 2e12 * 0.5 * R, 10.0 * eps * 2e12 * R);  // F*(1) = ½
  }
}

// Theory section 11: loads of a few 1e-300 are not contact.
TEST(SurfaceLaw, GaussianHeightsTouchNineDeviationsFromTheirMean) {
  const RoughSurface surface = RoughSurface::matching_gaussian(R);
  const double deviation = R / std::sqrt(20.0);
  for (const SeriesCompliance& series : {SeriesCompliance{}, SeriesCompliance{3e-13, 5e-13, 1e-13},
                                         SeriesCompliance{0.0, -2e-13, 0.0}}) {
    for (const double preload : {3e5, 0.0, -3e5}) {
      const SurfaceLaw law = rough_law(preload, surface, series);
      const std::vector<double> kinks = law.kinks();
      ASSERT_EQ(kinks.size(), 2U);
      const double aside = 1e-9 * R;
      const SurfaceState open = law.at(kinks[0] - aside, 0.0);
      EXPECT_EQ(open.load, 0.0);
      EXPECT_EQ(open.load_by_approach, 0.0);
      EXPECT_EQ(open.stiffness_ratio, 0.0);
      EXPECT_NEAR(open.gap_load, -law.point().normal_stiffness * aside, 1e-6 * 2e12 * aside);
      const SurfaceState touching = law.at(kinks[0] + aside, 0.0);
      EXPECT_GT(touching.load, 0.0);
      EXPECT_LT(touching.load, 2e-20 * 2e12 * deviation);
      EXPECT_EQ(law.at(kinks[1] + aside, 0.0).stiffness_ratio, 1.0);
      EXPECT_NEAR(law.at(kinks[1], 0.0).load, 2e12 * 9.0 * deviation, 1e-9 * 2e12 * R);
      EXPECT_EQ(law.at(-1.0, 0.0).load, 0.0);
    }
  }
}

// (2) and (3) from their inverse: u → N → v, no equation solved.
TEST(SurfaceLaw, SeriesWithTheBodiesObeysItsEquations) {
  const SeriesCompliance series{3e-13, 5e-13, 1e-13};
  for (const RoughSurface& surface : {RoughSurface::cubic(R), RoughSurface::matching_gaussian(R)}) {
    const SurfaceLaw law = rough_law(0.0, surface, series);
    for (const double x : {0.02, 0.3, 0.7, 0.99, 1.5, 40.0}) {
      const RoughState s = surface.at(x * R);
      const double load = 2e12 * s.compression;
      const SurfaceState state = law.at(x * R + series.q * load, 0.0);
      // v is rounded: 3 units of the load of the cubic law, up to ζ² = 20 of the Gaussian.
      EXPECT_NEAR(state.load / load, 1.0, 50.0 * eps) << x;
      const double along_p = 1.0 / (1.0 / (1e12 * s.share) + series.p);
      const double along_r = 1.0 / (1.0 / (1.5e12 * s.share) + series.r);
      EXPECT_NEAR(law.first_stiffness() * state.stiffness_ratio / along_p, 1.0, 50.0 * eps) << x;
      EXPECT_NEAR(law.second_stiffness() * state.second_stiffness_ratio / along_r, 1.0, 50.0 * eps)
          << x;
      EXPECT_NEAR(state.load_per_ratio * state.stiffness_ratio / load, 1.0, 60.0 * eps) << x;
      EXPECT_NEAR(state.second_load_per_ratio * state.second_stiffness_ratio / load, 1.0,
                  60.0 * eps)
          << x;
    }
  }
}

TEST(SurfaceLaw, DerivativesAreThoseOfTheValues) {
  for (const double preload : {3e5, 0.0, -1e6}) {
    for (const SurfaceLaw& law : rough_laws(preload)) {
      // Over the whole law however soft the bodies: points between and beyond the kinks.
      const double stretch = 2e12 / law.point().normal_stiffness;
      const double h = 1e-3 * R * std::min(stretch, 1.0);
      for (const double x : {-0.3, -0.1, 0.05, 0.2, 0.5, 0.9, 2.0}) {
        const double v = x * R * stretch;
        if (near_kink(law, v, 0.02 * R * stretch)) continue;
        const SurfaceState s = law.at(v, 0.0);
        // h⁴ = 1e-12 times fifth derivatives up to 1e4 near the first touch in series; rounding of
        // v over h, 1e-13 × stretch ≤ 1e-9.
        const double tolerance = 1e-8 * std::max(1.0, stretch / 100.0);
        const auto expect = [&](double derivative, auto quantity, double scale) {
          EXPECT_NEAR(derivative * scale, difference(law, v, h, quantity) * scale, tolerance)
              << preload << " " << x << " " << stretch;
        };
        expect(
            s.load_by_approach, [](const SurfaceState& t) { return t.load; }, 1.0 / 2e12);
        expect(
            s.stiffness_ratio_by_approach, [](const SurfaceState& t) { return t.stiffness_ratio; },
            R);
        expect(
            s.second_stiffness_ratio_by_approach,
            [](const SurfaceState& t) { return t.second_stiffness_ratio; }, R);
        expect(
            s.load_per_ratio_by_approach, [](const SurfaceState& t) { return t.load_per_ratio; },
            1.0 / 2e12);
        expect(
            s.second_load_per_ratio_by_approach,
            [](const SurfaceState& t) { return t.second_load_per_ratio; }, 1.0 / 2e12);
      }
    }
  }
}

// The surfaces are shunted as bodies grow soft: N → v/c, whatever the heights.
TEST(SurfaceLaw, SoftBodiesHideTheRoughness) {
  for (const double c : {1e-6, 1.0, 1e6}) {
    const SurfaceLaw law = rough_law(0.0, RoughSurface::cubic(R), {0.0, c, 0.0});
    const double v = 1e6 * c;  // u = δ⁻¹(1e6/2e12) ~ 1e-6 of v ≥ 1
    EXPECT_NEAR(law.at(v, 0.0).load, 1e6, 1e6 * 1e-5 / v);
    EXPECT_NEAR(law.at(v, 0.0).load_by_approach * c, 1.0, 1e-11 / c + 4.0 * eps);
  }
}

TEST(SurfaceLaw, SeparatedGaussianStaysFinite) {
  for (const SurfaceLaw& law : rough_laws(3e5)) {
    for (const double v : {-1e3, -1.0, -1e-2, -1e-3}) {
      const SurfaceState s = law.at(v, 0.0);
      EXPECT_TRUE(std::isfinite(s.load) && std::isfinite(s.load_per_ratio));
      EXPECT_TRUE(std::isfinite(s.load_per_ratio_by_approach));
      EXPECT_LE(s.load, 1e-100);
    }
  }
}

TEST(SurfaceLaw, FrictionFollowsTheRate) {
  const FrictionLaw friction = FrictionLaw::exponential(0.5, 0.3, 2.0);
  const SurfaceLaw law(point_with(3e5), 1.5e12, friction);
  EXPECT_TRUE(law.is_rate_dependent());
  EXPECT_TRUE(law.is_smooth());
  EXPECT_EQ(law.point().friction_coefficient, 0.5);
  EXPECT_EQ(law.at(0.0, 0.7).friction_coefficient, friction.at(0.7).value);
  EXPECT_EQ(law.at(0.0, 0.7).friction_coefficient_by_rate, friction.at(0.7).by_rate);
  EXPECT_FALSE(SurfaceLaw(point_with(3e5), 1.5e12).is_rate_dependent());
}

TEST(SurfaceLaw, ConstantLoadHasNoKink) {
  const SurfaceLaw law({1e12, 0.0, 0.4, 3e5}, 1e12);
  EXPECT_TRUE(law.kinks().empty());
  EXPECT_EQ(law.at(-1.0, 0.0).load, 3e5);
}

TEST(SurfaceLaw, RefusesWhatHasNoMeaning) {
  const auto message = [](const PointParameters& point,
                          const SeriesCompliance& series) -> std::string {
    try {
      const SurfaceLaw law(point, 1e12, FrictionLaw::constant(0.4), RoughSurface::cubic(R), series);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({1e12, 0.0, 0.4, 3e5}, {}).find("normal stiffness"), std::string::npos);
  EXPECT_NE(message(point_with(1.0), {0.0, -0.5e-12, 0.0}).find("along q = -1"), std::string::npos);
  EXPECT_NE(message(point_with(1.0), {-2e-12, 0.0, 0.0}).find("along p = -2"), std::string::npos);
  EXPECT_NE(message(point_with(1.0), {0.0, 0.0, -2e-12}).find("along r = -2"), std::string::npos);
  EXPECT_NE(message(point_with(std::nan("")), {}).find("preload"), std::string::npos);
}

}  // namespace
}  // namespace microslip::contact::test_surface_law
