/// @file
/// Integrals of sines and cosines over parts of a period, and from them those of products of two:
/// what Fourier coefficients of a force that is a trigonometric polynomial on each phase are made
/// of.
///
///   C_m = ∫ cos mθ dθ,   S_m = ∫ sin mθ dθ,   ∫ sin aθ cos bθ = ½ (S_{a+b} + S_{a−b}), …    (1)
///   C_m = 2 cos m m̂ sin(m d/2)/m,   S_m = 2 sin m m̂ sin(m d/2)/m                             (2)
///
/// (2) is one piece of length d about m̂, and does not cancel for short pieces. Weighted sums over
/// samples serve as well as integrals.
///
/// Source: theory section 5, for any harmonic.
#pragma once

#include <cstddef>
#include <vector>

namespace microslip::contact {

/// Functions of the Fourier convention by index: 0 is 1, 2h − 1 is sin hθ, 2h is cos hθ.
/// @param values  written whole: those functions at `phase` up to harmonic n_harmonics.
void set_basis(double phase, int n_harmonics, std::vector<double>& values);

class TrigonometricMoments {
 public:
  /// Zero, up to the highest m; storage is used again.
  void reset(int highest);
  /// Becomes (2) of one piece. @param length [rad], ≥ 0.
  void set_piece(double begin, double length);
  /// Becomes (2) of the whole period, without rounding.
  void set_period();
  /// Adds `factor` times another one of the same size.
  void add(double factor, const TrigonometricMoments& other);
  /// From sums in the order of the basis, 2 highest + 1 of them: [C_0, S_1, C_1, S_2, …].
  void set_sums(const double* sums);

  /// ∫ of one function of the basis.
  [[nodiscard]] double single(int i) const {
    return i == 0 ? cos_[0] : (i % 2 == 1 ? sin_[index(i)] : cos_[index(i)]);
  }
  /// ∫ of the product of two functions of the basis; their harmonics add up to `highest` at most.
  [[nodiscard]] double product(int i, int j) const;
  /// ∫ of the four products of two harmonics a, b ≥ 1 at once: half the work of product().
  struct Products {
    double sin_sin, sin_cos, cos_sin, cos_cos;  ///< first of a, second of b
  };
  [[nodiscard]] Products products(std::size_t a, std::size_t b) const {
    const bool first = a >= b;
    const std::size_t difference = first ? a - b : b - a;
    const double cos = cos_[difference];
    const double cos_sum = cos_[a + b];
    const double sin = first ? sin_[difference] : -sin_[difference];
    const double sin_sum = sin_[a + b];
    return {0.5 * (cos - cos_sum), 0.5 * (sin_sum + sin), 0.5 * (sin_sum - sin),
            0.5 * (cos + cos_sum)};
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>((i + 1) / 2); }

  std::vector<double> cos_;
  std::vector<double> sin_;
};

}  // namespace microslip::contact
