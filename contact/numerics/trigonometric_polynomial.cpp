#include "contact/numerics/trigonometric_polynomial.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace microslip::contact {
namespace {

// Step to the root of the cubic of a Taylor expansion, by Newton's method from its linear part.
struct TaylorStep {
  TaylorStep(const TrigonometricPolynomial::Taylor& t, double rounding) : step(-t.value / t.slope) {
    for (int i = 0; i < 6 && !converged; ++i) {
      const double value =
          t.value + step * (t.slope + step * (t.second / 2.0 + step * t.third / 6.0));
      slope = t.slope + step * (t.second + step * t.third / 2.0);
      const double correction = value / slope;
      step -= correction;
      converged = std::abs(correction) <= rounding;
    }
  }
  double step;
  double slope = 0.0;  // of the cubic near its root
  bool converged = false;
};

}  // namespace

void TrigonometricPolynomial::reset(int degree) {
  mean_ = 0.0;
  sin_.assign(static_cast<std::size_t>(degree), 0.0);
  cos_.assign(static_cast<std::size_t>(degree), 0.0);
}

void TrigonometricPolynomial::set(int h, double sin, double cos) {
  sin_[static_cast<std::size_t>(h) - 1] = sin;
  cos_[static_cast<std::size_t>(h) - 1] = cos;
}

int TrigonometricPolynomial::order() const {
  int h = degree();
  while (h > 0 && sin(h) == 0.0 && cos(h) == 0.0) {
    --h;
  }
  return h;
}

double TrigonometricPolynomial::bound(int power) const {
  double sum = 0.0;
  for (int h = 1; h <= degree(); ++h) {
    double weight = 1.0;
    for (int i = 0; i < power; ++i) {
      weight *= h;
    }
    sum += weight * (std::abs(sin(h)) + std::abs(cos(h)));
  }
  return sum;
}

double TrigonometricPolynomial::value(double phase) const {
  const double s = std::sin(phase);
  const double c = std::cos(phase);
  double re = 0.0;
  double im = 0.0;
  for (std::size_t i = sin_.size(); i-- > 0;) {
    const double x = re + sin_[i];
    const double y = im + cos_[i];
    re = x * c - y * s;
    im = x * s + y * c;
  }
  return mean_ + im;
}

TrigonometricPolynomial::Jet TrigonometricPolynomial::jet(double phase) const {
  const double s = std::sin(phase);
  const double c = std::cos(phase);
  double re = 0.0;
  double im = 0.0;
  double re_slope = 0.0;
  double im_slope = 0.0;
  for (std::size_t i = sin_.size(); i-- > 0;) {
    const auto h = static_cast<double>(i + 1);
    const double x = re + sin_[i];
    const double y = im + cos_[i];
    re = x * c - y * s;
    im = x * s + y * c;
    const double dx = re_slope + h * sin_[i];
    const double dy = im_slope + h * cos_[i];
    re_slope = dx * c - dy * s;
    im_slope = dx * s + dy * c;
  }
  return {mean_ + im, re_slope};
}

TrigonometricPolynomial::Taylor TrigonometricPolynomial::taylor(double phase) const {
  const double s = std::sin(phase);
  const double c = std::cos(phase);
  std::array<double, 4> re{};
  std::array<double, 4> im{};
  for (std::size_t i = sin_.size(); i-- > 0;) {
    double weight = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = re[k] + weight * sin_[i];
      const double y = im[k] + weight * cos_[i];
      re[k] = x * c - y * s;
      im[k] = x * s + y * c;
      weight *= static_cast<double>(i + 1);
    }
  }
  return {mean_ + im[0], re[1], -im[2], -re[3]};
}

void TrigonometricPolynomial::set_derivative(const TrigonometricPolynomial& other) {
  reset(other.degree());
  for (int h = 1; h <= degree(); ++h) {
    set(h, -h * other.cos(h), h * other.sin(h));
  }
}

double root_within(const TrigonometricPolynomial& p, double fourth, double level, double low,
                   double high, bool low_positive, double x) {
  constexpr int most = 200;  // bisection alone takes 60
  for (int i = 0; i < most; ++i) {
    TrigonometricPolynomial::Taylor now = p.taylor(x);
    now.value -= level;
    ((now.value > 0.0) == low_positive ? low : high) = x;
    const double rounding = std::numeric_limits<double>::epsilon() * (1.0 + std::abs(x));
    const TaylorStep taylor(now, rounding);
    const double next = x + taylor.step;
    if (taylor.converged && next >= low && next <= high) {
      const double square = taylor.step * taylor.step;
      if (fourth * square * square <= 24.0 * rounding * std::abs(taylor.slope)) {
        return next;
      }
    }
    if (high - low <= rounding) {
      return 0.5 * (low + high);
    }
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}

double crossing(const TrigonometricPolynomial& p, double level, double low, double high,
                double at_low, double at_high) {
  const double start = low + (high - low) * (at_low / (at_low - at_high));
  const bool inside = start > low && start < high;
  return root_within(p, p.bound(4), level, low, high, at_low > 0.0,
                     inside ? start : 0.5 * (low + high));
}

}  // namespace microslip::contact
