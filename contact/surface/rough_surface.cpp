#include "contact/surface/rough_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace microslip::contact {
namespace {

constexpr double root_half = 0.5 * std::numbers::sqrt2;
constexpr double root_half_rest = -4.833646656726457e-17;              // what rounding took from it
constexpr double density_at_0 = std::numbers::inv_sqrtpi * root_half;  // φ(0)

[[noreturn]] void refuse(const char* quantity, double value, const char* allowed) {
  std::ostringstream message;
  message.precision(17);
  message << "rough surface: " << quantity << " = " << value << ", must be " << allowed;
  throw std::invalid_argument(message.str());
}

RoughState one_sided_spring(double u) {
  if (u <= 0.0) return {};
  return {u, 1.0, 0.0, u, 1.0};
}

// (2) inside the heights, 0 < x < 1.
RoughState cubic_state(double x, double R) {
  const double rest = 3.0 - 2.0 * x;
  return {R * (x * x * x * (1.0 - 0.5 * x)), x * x * rest, 6.0 * x * (1.0 - x) / R,
          R * (x * (1.0 - 0.5 * x) / rest), (3.0 + x * (x - 3.0)) / (rest * rest)};
}

// (3) with unit deviation and zero mean.
struct NormalState {
  double load;        // J = ζΦ + φ
  double share;       // Φ
  double density;     // φ
  double reach;       // J/Φ
  double reach_rate;  // 1 − Jφ/Φ²
};

// φ(ζ); the rounding of ζ² would cost ζ²/2 units of the last place.
double normal_density(double zeta) {
  const double square = zeta * zeta;
  const double lost = std::fma(zeta, zeta, -square);
  return density_at_0 * std::exp(-0.5 * square) * (1.0 - 0.5 * lost);
}

// ln Φ(−x) for what rounding takes from the argument x/√2 of erfc, with φ/Φ(−x) as derivative; left
// out it would cost x² units of the last place.
double rounding_of_argument(double x, double density_per_share) {
  const double lost = std::fma(x, root_half, -(x * root_half)) + x * root_half_rest;
  return -std::numbers::sqrt2 * density_per_share * lost;
}

// Below ζ = −x, where ζΦ + φ cancels: φ/Φ = x + r and J/Φ = r = 1/(x + t) with the continued
// fraction of the integral of erfc, t = 2/(x + 3/(x + 4/(x + …))). Its tail after k/(x + tail) is
// near the root of tail² + x tail = k; with this start 6 + 110/x terms reach rounding (measured for
// x from 3 to 100 against 60 digits).
NormalState normal_tail(double x) {
  const int n = 6 + static_cast<int>(110.0 / x);
  double t = 2.0 * (n + 0.5) / (x + std::sqrt(x * x + 4.0 * (n + 0.5)));
  if (x > 100.0) {
    for (int k = n; k >= 2; --k) t = k / (x + t);
  } else {
    // As a fraction above/below: one division instead of n, and below stays under 1e60 for these x.
    double below = 1.0;
    for (int k = n; k >= 2; --k) {
      const double next = x * below + t;
      t = k * below;
      below = next;
    }
    t /= below;
  }
  const double r = 1.0 / (x + t);
  const double share = 0.5 * std::erfc(x * root_half) * (1.0 + rounding_of_argument(x, x + r));
  return {share * r, share, share * (x + r), r, r * (t - r)};
}

// r = J/Φ at ζ = −x, 0 ≤ x < 10, from which all the rest follows: polynomials in cells of a
// quarter. Its nearest pole, a zero of Φ, is 3.4 away: degree 9 leaves 1e-17.
class ReachTable {
 public:
  static constexpr double end = 10.0;

  ReachTable() {
    for (std::size_t cell = 0; cell < n_cells; ++cell) cells_[cell] = polynomial(middle_of(cell));
  }

  [[nodiscard]] double at(double x) const {
    const auto cell = static_cast<std::size_t>(x * (1.0 / width));
    const auto& c = cells_[cell];
    const double t = (x - middle_of(cell)) * (2.0 / width);
    const double t2 = t * t;
    const double t4 = t2 * t2;
    const double low = (c[0] + t * c[1]) + t2 * (c[2] + t * c[3]);
    const double high = (c[4] + t * c[5]) + t2 * (c[6] + t * c[7]);
    return low + t4 * (high + t4 * (c[8] + t * c[9]));
  }

 private:
  static constexpr double width = 0.25;
  static constexpr std::size_t n_cells = 40;
  static constexpr std::size_t n = 10;

  static double middle_of(std::size_t cell) { return (static_cast<double>(cell) + 0.5) * width; }

  // φ/Φ − x cancels by 100 at most, which extended precision has to spare.
  static long double reach(long double x) {
    constexpr long double pi = std::numbers::pi_v<long double>;
    const long double density = std::exp(-0.5L * x * x) / std::sqrt(2.0L * pi);
    return density / (0.5L * std::erfc(x / std::sqrt(2.0L))) - x;
  }

  // Through n Chebyshev points: Newton's divided differences, multiplied out.
  static std::array<double, n> polynomial(double middle) {
    std::array<long double, n> t{};
    std::array<long double, n> newton{};
    for (std::size_t i = 0; i < n; ++i) {
      const long double k = static_cast<long double>(i) + 0.5L;
      t[i] = std::cos(std::numbers::pi_v<long double> * k / static_cast<long double>(n));
      newton[i] = reach(middle + t[i] * (0.5L * width));
    }
    for (std::size_t k = 1; k < n; ++k) {
      for (std::size_t i = n - 1; i >= k; --i) {
        newton[i] = (newton[i] - newton[i - 1]) / (t[i] - t[i - k]);
      }
    }
    std::array<long double, n> c{};
    for (std::size_t k = n; k-- > 0;) {  // c ← newton_k + (t − t_k) c
      for (std::size_t i = n - 1; i > 0; --i) c[i] = c[i - 1] - t[k] * c[i];
      c[0] = newton[k] - t[k] * c[0];
    }
    std::array<double, n> rounded{};
    std::transform(c.begin(), c.end(), rounded.begin(),
                   [](long double x) { return static_cast<double>(x); });
    return rounded;
  }

  std::array<std::array<double, n>, n_cells> cells_{};
};

NormalState normal_state(double zeta) {
  static const ReachTable table;
  const double x = std::abs(zeta);
  if (!(x < ReachTable::end)) {
    if (zeta < 0.0) return normal_tail(x);
    const NormalState below = normal_tail(x);
    return {zeta + below.load, 1.0 - below.share, below.density, zeta + below.load,
            1.0 - zeta * below.density};
  }
  const double density = normal_density(zeta);
  const double r = table.at(x);
  const double above = density / (x + r);  // Φ(−|ζ|)
  if (zeta < 0.0) return {above * r, above, density, r, 1.0 - r * (x + r)};
  const double J = zeta + above * r;
  const double share = 1.0 - above;
  const double reach = J / share;
  return {J, share, density, reach, 1.0 - reach * (density / share)};
}

// x³ − x⁴/2 = f for 0 ≤ f ≤ ½. Convex up to x = 1; the start lies above the root, so Newton
// descends to it and rounding alone can turn it round.
double cubic_inverse(double f) {
  double x = std::min(1.0, std::cbrt(2.0 * f));
  for (int i = 0; i < 60; ++i) {
    const double slope = x * x * (3.0 - 2.0 * x);
    if (slope == 0.0) break;
    const double next = x - (x * x * x * (1.0 - 0.5 * x) - f) / slope;
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

// ln J, also where J underflows.
double log_load(double zeta, const NormalState& s) {
  if (zeta >= -3.0) return std::log(s.load);
  return std::log(s.reach / (s.reach - zeta)) - 0.5 * zeta * zeta + std::log(density_at_0);
}

// J(ζ) = f where J is convex and J(f) > f, so Newton descends from f.
double normal_inverse_of_large(double f) {
  double zeta = f;
  for (int i = 0; i < 60; ++i) {
    const NormalState s = normal_state(zeta);
    const double next = zeta - (s.load - f) / s.share;
    if (!(next < zeta)) break;
    zeta = next;
  }
  return zeta;
}

// ln J is concave and the start, φ(ζ) = f, lies below the root, so Newton on ln J ascends.
double normal_inverse_of_small(double f) {
  const double log_f = std::log(f);
  double zeta = -std::sqrt(-2.0 * (log_f - std::log(density_at_0)));
  for (int i = 0; i < 60; ++i) {
    const NormalState s = normal_state(zeta);
    const double next = zeta + (log_f - log_load(zeta, s)) * s.reach;
    if (!(next > zeta)) break;
    zeta = next;
  }
  return zeta;
}

double normal_inverse(double f) {
  if (f > 0.25) return normal_inverse_of_large(f);
  return normal_inverse_of_small(std::max(f, std::numeric_limits<double>::denorm_min()));
}

// Beyond this ζ, J(ζ) − ζ and 1 − Φ(ζ) are below the smallest number.
constexpr double full_contact = 40.0;

}  // namespace

RoughSurface RoughSurface::cubic(double height) {
  if (!(std::isfinite(height) && height >= 0.0)) refuse("height", height, "finite and at least 0");
  return {HeightLaw::cubic, height, 0.5 * height, height / std::sqrt(20.0)};
}

RoughSurface RoughSurface::matching_gaussian(double height) {
  const RoughSurface same = cubic(height);
  return {HeightLaw::gaussian, height, same.mean(), same.deviation()};
}

RoughState RoughSurface::at(double approach) const {
  if (deviation_ == 0.0) return one_sided_spring(approach);
  if (law_ == HeightLaw::gaussian) {
    const double above = approach - mean_;
    if (above > full_contact * deviation_) return {above, 1.0, 0.0, above, 1.0};
    // The floor keeps squares finite; nothing is left of the load there.
    const NormalState s = normal_state(std::max(above / deviation_, -1e150));
    return {deviation_ * s.load, s.share, s.density / deviation_, deviation_ * s.reach,
            s.reach_rate};
  }
  if (approach <= 0.0) return {};
  if (approach >= height_) return {approach - mean_, 1.0, 0.0, approach - mean_, 1.0};
  return cubic_state(approach / height_, height_);
}

double RoughSurface::approach(double compression) const {
  if (deviation_ == 0.0) return compression;
  if (law_ == HeightLaw::gaussian) {
    if (compression == 0.0) return -std::numeric_limits<double>::infinity();
    if (compression > full_contact * deviation_) return compression + mean_;
    return mean_ + deviation_ * normal_inverse(compression / deviation_);
  }
  if (compression >= mean_) return compression + mean_;
  return height_ * cubic_inverse(compression / height_);
}

}  // namespace microslip::contact
