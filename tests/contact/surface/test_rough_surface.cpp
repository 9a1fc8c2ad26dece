#include "contact/surface/rough_surface.hpp"
#include "tests/support/floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace microslip::contact::test_rough_surface {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

// Fourth-order difference of a quantity of the state, step h.
template <class Quantity>
double difference(const RoughSurface& surface, double u, double h, Quantity quantity) {
  const auto f = [&](double x) { return quantity(surface.at(x)); };
  return (8.0 * (f(u + h) - f(u - h)) - (f(u + 2.0 * h) - f(u - 2.0 * h))) / (12.0 * h);
}

void expect_derivatives(const RoughSurface& surface, double u, double tolerance) {
  const RoughState s = surface.at(u);
  const double h = 1e-3 * surface.height();
  const double length = surface.height();
  EXPECT_NEAR(s.share, difference(surface, u, h, [](const auto& t) { return t.compression; }),
              tolerance);
  EXPECT_NEAR(s.share_by_approach * length,
              difference(surface, u, h, [](const auto& t) { return t.share; }) * length, tolerance);
  EXPECT_NEAR(s.reach_by_approach, difference(surface, u, h, [](const auto& t) { return t.reach; }),
              tolerance);
}

TEST(RoughSurface, CubicLawIsThatOfThePaper) {
  const double R = 4e-6;
  const RoughSurface surface = RoughSurface::cubic(R);
  for (const double x : {0.05, 0.3, 0.5, 0.99}) {
    const RoughState s = surface.at(x * R);
    // Products of a few factors: some units of the last place.
    EXPECT_NEAR(s.compression, R * (x * x * x - 0.5 * x * x * x * x), 4.0 * eps * R);
    EXPECT_NEAR(s.share, 3.0 * x * x - 2.0 * x * x * x, 4.0 * eps);
    EXPECT_NEAR(s.reach * s.share, s.compression, 4.0 * eps * R);
  }
  EXPECT_EQ(surface.at(-1e-9).compression, 0.0);
  EXPECT_EQ(surface.at(0.0).share, 0.0);
  EXPECT_EQ(surface.at(3.0 * R).compression, 3.0 * R - 0.5 * R);
  EXPECT_EQ(surface.at(3.0 * R).share, 1.0);
}

TEST(RoughSurface, CubicLawIsContinuousAcrossItsKinks) {
  const double R = 4e-6;
  const RoughSurface surface = RoughSurface::cubic(R);
  const RoughState before = surface.at(R * (1.0 - eps));
  const RoughState after = surface.at(R * (1.0 + eps));
  // The slopes at u* = 1 are 1, 0 (share), and 1 (reach): changes of the order of the distance.
  EXPECT_NEAR(before.compression, after.compression, 4.0 * eps * R);
  EXPECT_NEAR(before.share, after.share, 4.0 * eps);
  EXPECT_NEAR(before.share_by_approach * R, after.share_by_approach * R, 20.0 * eps);
  EXPECT_NEAR(before.reach, after.reach, 8.0 * eps * R);
  EXPECT_NEAR(before.reach_by_approach, after.reach_by_approach, 20.0 * eps);
  EXPECT_EQ(surface.at(R).compression, 0.5 * R);  // F*(1) = ½
  const RoughState start = surface.at(1e-12 * R);
  EXPECT_LE(start.compression, 1e-36 * R);
  EXPECT_LE(start.share, 3e-24);
  EXPECT_NEAR(start.reach, 1e-12 * R / 3.0, 1e-24 * R);  // F*/h* → u*/3
  EXPECT_NEAR(start.reach_by_approach, 1.0 / 3.0, 1e-12);
}

TEST(RoughSurface, DerivativesAreThoseOfTheValues) {
  for (const RoughSurface& surface :
       {RoughSurface::cubic(4e-6), RoughSurface::matching_gaussian(4e-6)}) {
    for (const double x : {0.01, 0.2, 0.5, 0.8, 0.98, 1.5}) {
      // Step 1e-3 R: h⁴ = 1e-12 times fifth derivatives up to 1e3 of the Gaussian, rounding 1e-13.
      expect_derivatives(surface, x * surface.height(), 2e-9);
    }
  }
  for (const double x : {-1.5, -0.5, -0.18}) {  // ζ from −9 to −3
    expect_derivatives(RoughSurface::matching_gaussian(4e-6), 4e-6 * x, 2e-9);
  }
}

// ζ, ζΦ + φ, Φ, (ζΦ + φ)/Φ, its derivative: mpmath with 50 digits.
constexpr std::array<std::array<double, 5>, 13> normal_table = {
    {{-37.0, 1.5451991905122024593e-301, 5.7255712225245768227e-300, 0.026987686126990096026,
      0.0007272780988775133429},
     {-20.0, 1.3700124947295799431e-90, 2.7536241186062336951e-89, 0.049753068527850542214,
      0.0024632616150521635997},
     {-8.0, 7.5502624119464989137e-17, 6.2209605742717841235e-16, 0.12136811223611268065,
      0.014324883443340910176},
     {-3.0000001, 0.0003821541820579428128, 0.0013498975884453205359, 0.2830986478745179973,
      0.070559183638200933581},
     {-3.0, 0.00038215431704772359565, 0.0013498980316300945267, 0.28309865493043650693,
      0.070559186785268116862},
     {-2.9, 0.00054167384866214392137, 0.001865813300384038479, 0.29031513954298199972,
      0.073803215077491115841},
     {-1.5, 0.029306793762604628607, 0.066807201268858066004, 0.43867716662254318945,
      0.14954659355020269531},
     {-0.25, 0.286344698223580138, 0.40129367431707627576, 0.71355397941640390687,
      0.31245222360491325288},
     {0.0, 0.39894228040143267794, 0.5, 0.79788456080286535588, 0.36338022763241865692},
     {0.5, 0.69779655740130602959, 0.69146246127401310364, 1.0091604338370334858,
      0.48617543569636710323},
     {2.5, 2.5020041371791281994, 0.99379033467422386483, 2.5176378254869167348,
      0.95559434339480123348},
     {6.0, 6.0000000001563569796, 0.99999999901341235496, 6.0000000060758828558,
      0.99999996354470282818},
     {9.0, 9.0, 0.99999999999999999989, 9.000000000000000001, 0.99999999999999999075}}};

TEST(RoughSurface, GaussianLoadIsAccurateIntoTheTail) {
  const RoughSurface surface = RoughSurface::matching_gaussian(std::sqrt(20.0));
  ASSERT_EQ(surface.deviation(), 1.0);
  for (const auto& [zeta, load, share, reach, rate] : normal_table) {
    const double approach = surface.mean() + zeta;
    ASSERT_EQ(approach - surface.mean(), zeta);  // no ζ of the table is rounded on its way
    const RoughState s = surface.at(approach);
    // ζΦ + φ cancels by up to 12 at ζ = −3.
    const double tolerance = 12.0 * eps;
    EXPECT_NEAR(s.compression / load, 1.0, tolerance) << zeta;
    EXPECT_NEAR(s.share / share, 1.0, tolerance) << zeta;
    EXPECT_NEAR(s.reach / reach, 1.0, tolerance) << zeta;
    // 1 − Jφ/Φ² ≈ 0.07 at ζ = −3 from numbers of size one, one of them wrong by 12 units.
    EXPECT_NEAR(s.reach_by_approach / rate, 1.0, 12.0 / 0.07 * eps) << zeta;
  }
}

TEST(RoughSurface, GaussianStaysFiniteForAnyApproach) {
  const RoughSurface surface = RoughSurface::matching_gaussian(2e-6);
  for (const double u : {-1e300, -1e10, -1.0, -1e-3, 1e-3, 1.0, 1e10, 1e300}) {
    const RoughState s = surface.at(u);
    EXPECT_TRUE(std::isfinite(s.compression) && std::isfinite(s.share) && std::isfinite(s.reach));
    EXPECT_TRUE(std::isfinite(s.share_by_approach) && std::isfinite(s.reach_by_approach));
    EXPECT_EQ(s.compression, u > 0.0 ? u - 1e-6 : 0.0);
  }
}

TEST(RoughSurface, BothLawsShareMeanVarianceAndAsymptote) {
  const double R = 4e-6;
  const RoughSurface gaussian = RoughSurface::matching_gaussian(R);
  EXPECT_EQ(gaussian.mean(), 0.5 * R);
  EXPECT_NEAR(gaussian.deviation() * gaussian.deviation(), R * R / 20.0, 4.0 * eps * R * R / 20.0);
  for (const double x : {4.0, 10.0, 1e6}) {
    // Φ(−ζ) is below 1e-50 at x = 4.
    EXPECT_EQ(RoughSurface::cubic(R).at(x * R).compression, x * R - 0.5 * R);
    EXPECT_NEAR(gaussian.at(x * R).compression, x * R - 0.5 * R, 2.0 * eps * x * R);
  }
}

TEST(RoughSurface, WithoutHeightIsTheOneSidedSpring) {
  for (const RoughSurface& surface :
       {RoughSurface::cubic(0.0), RoughSurface::matching_gaussian(0.0)}) {
    EXPECT_EQ(surface.at(-1e-6).compression, 0.0);
    EXPECT_EQ(surface.at(-1e-6).share, 0.0);
    EXPECT_EQ(surface.at(1e-6).compression, 1e-6);
    EXPECT_EQ(surface.at(1e-6).share, 1.0);
    EXPECT_EQ(surface.at(1e-6).reach, 1e-6);
    EXPECT_EQ(surface.approach(1e-6), 1e-6);
  }
  for (const double R : {1e-9, 1e-12, 1e-15}) {  // the limit, with error R/2 in the load
    EXPECT_LE(std::abs(RoughSurface::cubic(R).at(1e-6).compression - 1e-6), 0.5000001 * R);
    EXPECT_EQ(RoughSurface::cubic(R).at(1e-6).share, 1.0);
    EXPECT_EQ(RoughSurface::matching_gaussian(R).at(-1e-6).compression, 0.0);
  }
}

TEST(RoughSurface, ApproachInvertsTheLoadOverSixHundredDecades) {
  const tests::UntrappedFloatingPoint loads_over_deviations_overflow;
  for (const double R : {1e-9, 1e-5, 1.0, 1e3}) {
    for (int decade = -300; decade <= 300; decade += 3) {
      const double load = 1.7 * std::pow(10.0, decade);
      const double cubic =
          RoughSurface::cubic(R).at(RoughSurface::cubic(R).approach(load)).compression;
      // d ln F*/d ln u* ≤ 3, and a few roundings in F*.
      EXPECT_NEAR(cubic / load, 1.0, 10.0 * eps) << R << " " << load;
      const RoughSurface gaussian = RoughSurface::matching_gaussian(R);
      const double u = gaussian.approach(load);
      const double zeta = (u - gaussian.mean()) / gaussian.deviation();
      if (load / gaussian.deviation() < 1e-305) continue;  // δ/s is denormal
      // ζ is known to a few roundings, d ln J/dζ ≈ |ζ| in the tail.
      EXPECT_NEAR(gaussian.at(u).compression / load, 1.0,
                  eps * (12.0 + 4.0 * (zeta < 0.0 ? zeta * zeta : 0.0)))
          << R << " " << load;
    }
  }
  EXPECT_EQ(RoughSurface::cubic(1.0).approach(0.0), 0.0);
  EXPECT_EQ(RoughSurface::cubic(1.0).approach(0.5), 1.0);
  EXPECT_EQ(RoughSurface::matching_gaussian(1.0).approach(0.0), -infinity);
}

TEST(RoughSurface, LoadAndShareNeverFall) {
  for (const RoughSurface& surface :
       {RoughSurface::cubic(1.0), RoughSurface::matching_gaussian(1.0)}) {
    RoughState before = surface.at(-3.0);
    for (int i = 1; i <= 4000; ++i) {
      const RoughState now = surface.at(-3.0 + 0.0015 * i);
      ASSERT_GE(now.compression, before.compression);
      ASSERT_GE(now.share, before.share * (1.0 - 2.0 * eps));  // erfc may waver in its last place
      ASSERT_GE(now.reach, before.reach);
      before = now;
    }
  }
}

TEST(RoughSurface, RefusesValuesOutOfRange) {
  EXPECT_THROW((void)RoughSurface::cubic(-1e-6), std::invalid_argument);
  EXPECT_THROW((void)RoughSurface::cubic(infinity), std::invalid_argument);
  EXPECT_THROW((void)RoughSurface::matching_gaussian(std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)RoughSurface::matching_gaussian(infinity), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_rough_surface
