/// @file
/// Random numbers of tests, the same on every machine: no distribution of the standard library.
#pragma once

#include <cmath>
#include <cstdint>

namespace microslip::tests {

/// splitmix64 (Steele, Lea & Flood 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t operator()() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

/// @tparam Engine  gives 64 random bits a call.
template <typename Engine>
class DrawFrom {
 public:
  explicit DrawFrom(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int whole(int low, int high) { return low + static_cast<int>(uniform(0.0, high - low + 1.0)); }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }

 private:
  Engine engine_;
};

using Draw = DrawFrom<SplitMix64>;

}  // namespace microslip::tests
