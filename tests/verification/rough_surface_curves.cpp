// Figures 2 and 3 of paper B (section 2, eqs 1–5), written as tables and checked: normal force and
// tangential stiffness of rough surfaces, friction loops with and without slip.
//
//   F* = ∫ h* du*,  F*(1) = ½,  F* → u* − ½,  k_T* = h*(u*(F*));     D = 4 μF_N (a − μF_N/k_T)
//
// The integrals are taken here by Gauss's rule, exact for the cubic law.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "contact/line/surface_line_events.hpp"
#include "contact/surface/rough_surface.hpp"

namespace microslip::contact::rough_surface_curves {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double R = 5e-6;

std::ofstream table(const char* name, const char* header) {
  const std::filesystem::path folder = MICROSLIP_FIGURE_FOLDER;
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / name);
  file.precision(15);
  file << header << '\n';
  return file;
}

// ∫ h* from a to b in `pieces` of three Gauss points: exact for polynomials up to degree 5.
double integral_of_share(const RoughSurface& surface, double a, double b, int pieces) {
  const double h = (b - a) / pieces;
  const double side = std::sqrt(0.6);
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = a + (i + 0.5) * h;
    sum += h / 18.0 *
           (8.0 * surface.at(middle).share + 5.0 * surface.at(middle - 0.5 * h * side).share +
            5.0 * surface.at(middle + 0.5 * h * side).share);
  }
  return sum;
}

TEST(FigureTwo, NormalForceIsTheIntegralOfTheContactShare) {
  double largest = 0.0;
  for (const RoughSurface& surface : {RoughSurface::cubic(R), RoughSurface::matching_gaussian(R)}) {
    for (const double x : {0.1, 0.37, 0.5, 0.9, 1.0, 1.7}) {
      // Pieces of R/100, with a joint at u* = 1. The Gaussian holds 1e-34 below u* = −2.
      const double from = surface.law() == HeightLaw::cubic ? 0.0 : -2.0;
      const double to_kink = std::min(x, 1.0);
      const int pieces = static_cast<int>(std::lround((to_kink - from) * 100.0));
      double expected = integral_of_share(surface, from * R, to_kink * R, pieces);
      if (x > 1.0) expected += integral_of_share(surface, R, x * R, 100);
      const double error = std::abs(surface.at(x * R).compression - expected) / R;
      largest = std::max(largest, error);
      // Gauss: 1e-2⁶ times the sixth derivative of Φ over 2e6, up to 20⁴·…, below 1e-12; sums
      // 1e-14.
      EXPECT_LE(error, 1e-12) << x;
    }
  }
  std::printf("F* against the integral of h*: largest error %.1e\n", largest);
}

TEST(FigureTwo, CurvesHaveTheMarksOfThePaper) {
  const RoughSurface cubic = RoughSurface::cubic(R);
  const RoughSurface gaussian = RoughSurface::matching_gaussian(R);
  EXPECT_EQ(cubic.at(0.0).compression, 0.0);
  EXPECT_EQ(cubic.at(R).compression, 0.5 * R);                                // F*(1) = ½
  EXPECT_NEAR(cubic.at(0.5 * R).compression, 3.0 / 32.0 * R, 4.0 * eps * R);  // F*(½) = 3/32
  EXPECT_NEAR(cubic.at(0.5 * R).share, 0.5, 4.0 * eps);
  EXPECT_EQ(cubic.at(cubic.approach(0.5 * R)).share, 1.0);  // k_T* = 1 from F* = ½ on
  EXPECT_NEAR(gaussian.at(0.5 * R).share, 0.5, 4.0 * eps);
  auto file = table("figure_2.csv",
                    "approach,load_cubic,load_gaussian,load,stiffness_cubic,stiffness_gaussian");
  double before = 0.0;
  double apart = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double x = 0.01 * i;  // u* for the first curves, F* for the second
    const RoughState c = cubic.at(cubic.approach(x * R));
    const RoughState g = gaussian.at(gaussian.approach(std::max(x, 1e-12) * R));
    EXPECT_GE(c.share, before);
    before = c.share;
    apart =
        std::max(apart, std::abs(cubic.at(x * R).compression - gaussian.at(x * R).compression) / R);
    file << x << ',' << cubic.at(x * R).compression / R << ',' << gaussian.at(x * R).compression / R
         << ',' << x << ',' << c.share << ',' << g.share << '\n';
  }
  std::printf("cubic and Gaussian F* differ by at most %.4f\n", apart);
  EXPECT_LE(apart,
            0.01);  // "covered rather faithfully by means of the Gauss distribution", section 2.1
  EXPECT_GT(apart, 1e-4);  // and yet they are two laws
  EXPECT_TRUE(file.good());
}

struct Loop {
  std::vector<double> u;
  std::vector<double> f;
  std::vector<double> load;
  double area = 0.0;  // ∮ f du by trapezoids
  PointHistory history;
};

// u = a sin θ, v = b cos θ.
Loop loop(const SurfaceLaw& law, double a, double b) {
  constexpr int n = 4096;
  Harmonics motion(1, n_point_signals);
  motion.rows()(1, 0) = a;
  motion.rows()(2, 1) = b;
  const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(n + 1, 0.0, 2.0 * std::numbers::pi);
  Loop result;
  result.history = SurfaceLineEvents(law).history(motion, 1.0, phases, 1);
  for (const PointInstant& instant : result.history.instants) {
    result.u.push_back(instant.motion[0]);
    result.f.push_back(instant.traction[0]);
    result.load.push_back(instant.traction[1]);
  }
  for (std::size_t i = 1; i < result.u.size(); ++i) {
    result.area += 0.5 * (result.f[i] + result.f[i - 1]) * (result.u[i] - result.u[i - 1]);
  }
  return result;
}

SurfaceLaw surfaces(double preload, const RoughSurface& roughness) {
  return {{1e12, 1e12, 0.4, preload}, 1e12, FrictionLaw::constant(0.4), roughness};
}

TEST(FigureThree, StickIsALineAndSlipALoopOfTheKnownArea) {
  auto file = table("figure_3.csv", "u_stick,f_stick,u_slip,f_slip,u_rough,f_rough");
  const double n = 1e6;
  for (const RoughSurface& surface : {RoughSurface::cubic(0.0), RoughSurface::cubic(R)}) {
    const SurfaceLaw law = surfaces(n, surface);
    const double k = 1e12 * law.at(0.0, 0.0).stiffness_ratio;
    const double limit = 0.4 * n / k;  // half-width of the slider
    const Loop stick = loop(law, 0.8 * limit, 0.0);
    for (std::size_t i = 0; i < stick.u.size(); ++i) {
      EXPECT_NEAR(stick.f[i], k * stick.u[i], 1e-12 * 0.4 * n);  // (a): no loop
    }
    EXPECT_NEAR(stick.area, 0.0, 1e-12 * 0.4 * n * limit);
    const Loop slip = loop(law, 2.5 * limit, 0.0);
    const double expected = 4.0 * 0.4 * n * (2.5 - 1.0) * limit;
    std::printf("h* = %.3f: area of the loop %.8e, 4 μn (a − μn/k) = %.8e\n", k / 1e12, slip.area,
                expected);
    EXPECT_NEAR(slip.area / expected, 1.0, 1e-5);  // O(1/M²) of trapezoids over four corners
    EXPECT_NEAR(slip.history.dissipated_energy / expected, 1.0, 1e-13);
    EXPECT_NEAR(*std::ranges::max_element(slip.f), 0.4 * n, 1e-12 * n);  // flat tops (b)
    EXPECT_NEAR(*std::ranges::min_element(slip.f), -0.4 * n, 1e-12 * n);
    if (surface.height() > 0.0) {
      EXPECT_LT(k, 0.9e12);
      continue;
    }
    const Loop rough = loop(surfaces(n, RoughSurface::cubic(R)), 2.5 * limit, 1.5e-6);
    for (std::size_t i = 0; i < slip.u.size(); i += 8) {
      file << stick.u[i] << ',' << stick.f[i] << ',' << slip.u[i] << ',' << slip.f[i] << ','
           << rough.u[i] << ',' << rough.f[i] << '\n';
    }
  }
  EXPECT_TRUE(file.good());
}

// Rough surfaces under a load that varies: the force never leaves the cone, and separation, stick
// and both slips follow each other in one cycle.
TEST(FigureThree, RoughLoopStaysInItsCone) {
  for (const RoughSurface& surface : {RoughSurface::cubic(R), RoughSurface::matching_gaussian(R)}) {
    const Loop cycle = loop(surfaces(2e5, surface), 2e-6, 3e-6);
    std::array<bool, 4> seen{};
    for (std::size_t i = 0; i < cycle.u.size(); ++i) {
      EXPECT_LE(std::abs(cycle.f[i]), 0.4 * cycle.load[i] * (1.0 + 1e-12) + 1e-9);
      seen.at(static_cast<std::size_t>(cycle.history.instants[i].state)) = true;
    }
    EXPECT_TRUE(seen[0] && seen[1] && seen[2]);
    EXPECT_EQ(seen[3], surface.law() == HeightLaw::cubic);  // Gaussian heights always touch
    EXPECT_GT(cycle.history.dissipated_energy, 0.0);
  }
}

}  // namespace
}  // namespace microslip::contact::rough_surface_curves
