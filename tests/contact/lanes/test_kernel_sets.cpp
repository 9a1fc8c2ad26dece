// Kernels are compiled for several instruction sets with vectors of another length each: all that
// this machine can run answer alike, but for the rounding of fused products.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "contact/lanes/block_size.hpp"
#include "contact/lanes/line_kernels.hpp"
#include "contact/lanes/plane_kernels.hpp"

namespace microslip::contact::sampled {
namespace {

constexpr std::size_t n_instants = 37;  // no multiple of a tile
constexpr std::size_t n_rows = 7;
constexpr std::size_t n_numbers = n_instants * block_size;
constexpr double rounding = 1e-13;

using Numbers = std::vector<double>;

Numbers random_numbers(std::size_t n, double low, double high, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> any(low, high);
  Numbers numbers(n);
  std::ranges::generate(numbers, [&] { return any(engine); });
  return numbers;
}

/// A motion of every point that turns some times in the period.
Numbers motion(double size, unsigned seed) {
  const Numbers phase = random_numbers(block_size, 0.0, 6.0, seed);
  Numbers values(n_numbers);
  for (std::size_t i = 0; i < n_instants; ++i) {
    const double t = 6.283185307179586 * static_cast<double>(i) / n_instants;
    for (std::size_t k = 0; k < block_size; ++k) {
      values[i * block_size + k] =
          size * (std::sin(t + phase[k]) + 0.4 * std::cos(3.0 * t - phase[k]));
    }
  }
  return values;
}

void expect_alike(const Numbers& a, const Numbers& b, double scale) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], rounding * scale) << i;
}

struct LineCycle {
  Numbers u = motion(1.0, 1), v = motion(1.0, 2);
  Numbers closeness = Numbers(n_numbers), normal = closeness, half_width = closeness;
  Numbers low = closeness, high = closeness, turns = closeness, landed = closeness;
  Numbers slider = closeness, state = closeness, friction = closeness;
  Numbers least = Numbers(block_size), most = least;
};

/// Points that open and close while they rub.
LineCycle marched(const LineKernels& kernels) {
  const Numbers rest = random_numbers(block_size, 0.2, 0.8, 3);
  const Numbers ones(block_size, 1.0);
  const Numbers ratio(block_size, 0.5);
  const SmoothArrays constants{rest.data(), ones.data(), ratio.data(), ones.data()};
  LineCycle c;
  kernels.load(n_instants, constants, c.v.data(), c.closeness.data(), c.normal.data(),
               c.half_width.data());
  kernels.turning_band(n_instants, constants, c.u.data(), c.closeness.data(), c.half_width.data(),
                       {c.low.data(), c.high.data(), c.turns.data(), c.landed.data()}, true);
  kernels.march(
      {n_instants, c.u.data(), c.closeness.data(), c.low.data(), c.high.data(), c.half_width.data(),
       c.turns.data(), c.landed.data(), c.slider.data(), c.state.data()},
      true);
  kernels.friction(n_instants, constants, c.u.data(), c.slider.data(), c.friction.data());
  kernels.range(n_instants, c.friction.data(), c.least.data(), c.most.data());
  return c;
}

struct PlaneCycle {
  Numbers state = Numbers(n_state_numbers * block_size), slips = Numbers(block_size);
  Numbers slider_p = Numbers(n_numbers), slider_r = slider_p, pull_p = slider_p, pull_r = slider_p;
  Numbers states = slider_p, entry = slider_p;
  Numbers turns = Numbers(n_numbers * n_turn_numbers);
};

PlaneCycle linearised(const PlaneKernels& kernels, bool equal) {
  const Numbers u = motion(1.0, 4), w = motion(0.7, 5), closeness = motion(1.0, 6);
  Numbers width_p(n_numbers), width_r(n_numbers), inverse_p(n_numbers), inverse_r(n_numbers);
  for (std::size_t i = 0; i < n_numbers; ++i) {
    width_p[i] = 0.4 * std::max(closeness[i], 0.0);
    width_r[i] = (equal ? 1.0 : 1.7) * width_p[i];
  }
  kernels.invert(n_instants, width_p.data(), inverse_p.data());
  kernels.invert(n_instants, width_r.data(), inverse_r.data());
  PlaneCycle c;
  const PlaneArrays arrays{n_instants,        u.data(),          w.data(),         closeness.data(),
                           width_p.data(),    width_r.data(),    inverse_p.data(), inverse_r.data(),
                           c.slider_p.data(), c.slider_r.data(), c.pull_p.data(),  c.pull_r.data(),
                           c.states.data(),   c.entry.data(),    c.turns.data()};
  kernels.start(arrays, c.state.data());
  kernels.march(arrays, equal, c.state.data(), c.slips.data());
  kernels.linearise(arrays, equal, c.state.data(), c.slips.data());
  return c;
}

TEST(KernelSets, SeriesAreSummedAsOneByOne) {
  const Numbers basis = random_numbers(n_instants * n_rows, -1.0, 1.0, 7);
  const Numbers coefficients = random_numbers(n_rows * block_size, -1.0, 1.0, 8);
  Numbers expected(n_numbers), back(n_rows * block_size);
  for (std::size_t i = 0; i < n_instants; ++i) {
    for (std::size_t l = 0; l < n_rows; ++l) {
      for (std::size_t k = 0; k < block_size; ++k) {
        expected[i * block_size + k] += basis[i * n_rows + l] * coefficients[l * block_size + k];
      }
    }
  }
  for (std::size_t i = 0; i < n_instants; ++i) {
    for (std::size_t l = 0; l < n_rows; ++l) {
      for (std::size_t k = 0; k < block_size; ++k) {
        back[l * block_size + k] += basis[i * n_rows + l] * expected[i * block_size + k];
      }
    }
  }
  for (const LineKernels* kernels : runnable_line_kernels()) {
    Numbers values(n_numbers), sums(n_rows * block_size);
    kernels->synthesize(n_instants, n_rows, basis.data(), coefficients.data(), values.data());
    expect_alike(values, expected, n_rows);
    kernels->analyze(n_instants, n_rows, n_rows, basis.data(), expected.data(), sums.data());
    expect_alike(sums, back, n_instants * n_rows);
  }
}

TEST(KernelSets, MarchAlikeAlongALine) {
  const LineCycle plain = marched(*runnable_line_kernels().front());
  // Nothing is proved by a cycle without events.
  for (const double state : {0.0, 1.0, 2.0, 3.0, 5.0}) {
    EXPECT_GT(std::ranges::count(plain.state, state), 0) << state;
  }
  for (const LineKernels* kernels : runnable_line_kernels()) {
    const LineCycle other = marched(*kernels);
    EXPECT_EQ(other.state, plain.state);
    EXPECT_EQ(other.turns, plain.turns);
    expect_alike(other.slider, plain.slider, 1.0);
    expect_alike(other.friction, plain.friction, 1.0);
    expect_alike(other.least, plain.least, 1.0);
    expect_alike(other.most, plain.most, 1.0);
  }
}

TEST(KernelSets, MarchAlikeInAPlane) {
  for (const bool equal : {true, false}) {
    const PlaneCycle plain = linearised(*runnable_plane_kernels().front(), equal);
    for (const double state : {0.0, 3.0, 4.0}) {
      EXPECT_GT(std::ranges::count(plain.states, state), 0) << state;
    }
    for (const PlaneKernels* kernels : runnable_plane_kernels()) {
      const PlaneCycle other = linearised(*kernels, equal);
      EXPECT_EQ(other.states, plain.states);
      EXPECT_EQ(other.slips, plain.slips);
      expect_alike(other.slider_p, plain.slider_p, 1.0);
      expect_alike(other.slider_r, plain.slider_r, 1.0);
      expect_alike(other.pull_p, plain.pull_p, 10.0);
      expect_alike(other.pull_r, plain.pull_r, 10.0);
      for (std::size_t i = 0; i < n_numbers; ++i) {
        // Written where the point slips and has not touched down.
        const bool touches_down = plain.entry[i] == static_cast<double>(SlipEntry::touches_down);
        if (plain.states[i] != 4.0 || touches_down) continue;
        const std::size_t instant = i / block_size;
        for (std::size_t k = 0; k < n_turn_numbers; ++k) {
          const std::size_t at = (instant * n_turn_numbers + k) * block_size + i % block_size;
          EXPECT_NEAR(other.turns[at], plain.turns[at], 1e-9 * (1.0 + std::abs(plain.turns[at])));
        }
      }
    }
  }
}

}  // namespace
}  // namespace microslip::contact::sampled
