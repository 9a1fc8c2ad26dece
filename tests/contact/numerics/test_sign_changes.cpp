#include "contact/numerics/sign_changes.hpp"
#include "tests/support/floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace microslip::contact::test_sign_changes {
namespace {

constexpr double pi = std::numbers::pi;

/// Π sin((θ − r)/2) over an even number of roots, by its values at 2H+1 phases in extended
/// precision.
TrigonometricPolynomial with_roots(const std::vector<double>& roots, double factor = 1.0) {
  const int H = static_cast<int>(roots.size()) / 2;
  const int n = 2 * H + 1;
  TrigonometricPolynomial p;
  p.reset(H);
  const auto project = [&](int h, bool sine) {
    long double sum = 0.0L;
    for (int i = 0; i < n; ++i) {
      const long double phase = 2.0L * std::numbers::pi_v<long double> * i / n;
      long double value = factor;
      for (const double root : roots) value *= std::sin(0.5L * (phase - root));
      sum += value * (sine ? std::sin(h * phase) : std::cos(h * phase));
    }
    return static_cast<double>(sum / n);
  };
  p.set_mean(project(0, false));
  for (int h = 1; h <= H; ++h) p.set(h, 2.0 * project(h, true), 2.0 * project(h, false));
  return p;
}

std::vector<SignChange> changes_of(const TrigonometricPolynomial& p) {
  std::vector<SignChange> changes;
  find_sign_changes(p, changes);
  return changes;
}

void expect_roots(std::vector<double> roots, double tolerance) {
  std::sort(roots.begin(), roots.end());
  const auto changes = changes_of(with_roots(roots));
  ASSERT_EQ(changes.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_NEAR(changes[i].phase, roots[i], tolerance) << i;
    EXPECT_EQ(changes[i].rising, i % 2 == 1) << i;  // positive before the first root
  }
}

TEST(SignChanges, AConstantHasNone) {
  TrigonometricPolynomial p;
  p.reset(4);
  p.set_mean(1.0);
  EXPECT_TRUE(changes_of(p).empty());
  p.set_mean(0.0);
  EXPECT_TRUE(changes_of(p).empty());
}

// Roots of a sine and a cosine lie on the nodes of the grid.
TEST(SignChanges, RootsAtNodesAreFoundOnce) {
  for (int h = 1; h <= 12; ++h) {
    for (const bool sine : {true, false}) {
      TrigonometricPolynomial p;
      p.reset(h + 2);
      p.set(h, sine ? 1.0 : 0.0, sine ? 0.0 : 1.0);
      const auto changes = changes_of(p);
      ASSERT_EQ(changes.size(), 2 * static_cast<std::size_t>(h)) << h << sine;
      for (std::size_t i = 0; i < changes.size(); ++i) {
        // Phases up to 2π are rounded at 4.4e-16, and so is what is made of them.
        EXPECT_LT(std::abs(p.value(changes[i].phase)), 2e-15 * (h + 1)) << i;
        EXPECT_NE(changes[i].rising, changes[(i + 1) % changes.size()].rising);
      }
    }
  }
}

// 1 − cos hθ touches zero on nodes, one of them at the seam of the period.
TEST(SignChanges, TouchingIsNotChanging) {
  for (int h = 1; h <= 4; ++h) {
    for (const double sign : {1.0, -1.0}) {
      TrigonometricPolynomial p;
      p.reset(h);
      p.set_mean(sign);
      p.set(h, 0.0, -sign);
      EXPECT_TRUE(changes_of(p).empty()) << h;
    }
  }
}

TEST(SignChanges, WhatIsNotFiniteHasNone) {
  const tests::UntrappedFloatingPoint infinity_is_meant;
  TrigonometricPolynomial p;
  p.reset(2);
  p.set(1, std::nan(""), 1.0);
  EXPECT_TRUE(changes_of(p).empty());
  p.set(1, 1e308, 1e308);
  p.set(2, 1e308, 1e308);
  EXPECT_TRUE(changes_of(p).empty());
}

// A root of multiplicity one errs by rounding of p over its slope; the slope of a product of 2H
// factors ≤ 1 with roots 0.1 apart or more is above 1e-10 for ten roots, and p is summed to 1e-16.
TEST(SignChanges, AllRootsOfAProductAreFound) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> step(0.1, 1.0);
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<double> roots;
    double at = 0.3 * step(random);
    while (at < 2.0 * pi - 0.1 && roots.size() < 10) {
      roots.push_back(at);
      at += step(random);
    }
    if (roots.size() % 2 == 1) roots.pop_back();
    expect_roots(roots, 1e-6);
  }
}

// Two roots a distance d apart: p between them is −d²/16, so the pair is told from rounding down to
// d ≈ 1e-7, and each is exact to 1e-16/d.
TEST(SignChanges, ClosePairsAreNotMissed) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 3000; ++trial) {
    const double d = std::pow(10.0, -6.0 + 5.0 * uniform(random));
    const double at = 0.2 + 2.0 * uniform(random);
    expect_roots({at, at + d, 4.0, 5.5}, 1e-14 / d);
  }
}

TEST(SignChanges, PairsAboutANodeAreNotMissed) {
  for (int node = 1; node < 32; ++node) {  // order 2: 32 cells
    const double at = 2.0 * pi * node / 32.0;
    expect_roots({at - 1e-5, at + 1e-5}, 1e-10);
    expect_roots({at - 0.02, at - 0.01, at + 0.01, at + 0.03}, 1e-8);
  }
}

// Four roots so close that p is rounding between them: the count is not defined, but it stays
// small.
TEST(SignChanges, RoundingIsNotTakenApart) {
  for (int node = 1; node < 32; ++node) {
    const double at = 2.0 * pi * node / 32.0;
    const auto changes = changes_of(with_roots({at - 1e-5, at - 1e-6, at + 1e-6, at + 1e-5}));
    EXPECT_LT(changes.size(), 20U) << node;
    for (const SignChange& change : changes) EXPECT_NEAR(change.phase, at, 2e-3);  // (1e-16)^¼
  }
}

TEST(SignChanges, TheAnswerDoesNotDependOnSize) {
  const std::vector<double> roots{0.5, 0.9, 2.0, 2.1, 3.0, 6.0};
  const auto plain = changes_of(with_roots(roots));
  for (const double factor : {0x1p-200, 0x1p-600, 0x1p300}) {
    const auto scaled = changes_of(with_roots(roots, factor));
    ASSERT_EQ(scaled.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(scaled[i].phase, plain[i].phase);
  }
}

TEST(SignChanges, HighHarmonicsAreServed) {
  TrigonometricPolynomial p;
  p.reset(300);
  p.set(1, 1.0, 0.0);
  p.set(300, 0.0, 0.5);
  std::vector<SignChange> changes = changes_of(p);
  // sin θ + ½ cos 300 θ changes sign about 300 · (2/π) asin(½) times around each zero of the sine.
  EXPECT_NEAR(static_cast<double>(changes.size()), 200.0, 6.0);
  for (const SignChange& change : changes) EXPECT_LT(std::abs(p.value(change.phase)), 1e-12);
}

}  // namespace
}  // namespace microslip::contact::test_sign_changes
