#include "contact/trigonometric_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
using Jet = TrigonometricPolynomial::Jet;

struct Node {
  double phase;
  double value;
  double slope;
};

// Directions of equally spaced phases, the same for all polynomials of one order.
struct Grid {
  explicit Grid(int cells)
      : sin(static_cast<std::size_t>(cells)), cos(static_cast<std::size_t>(cells)) {
    for (std::size_t i = 0; i < sin.size(); ++i) {
      const double phase = two_pi * static_cast<double>(i) / static_cast<double>(cells);
      sin[i] = std::sin(phase);
      cos[i] = std::cos(phase);
    }
  }
  std::vector<double> sin;
  std::vector<double> cos;
};

// Sixteen cells per shortest wave: there the cubic is good to 6e-5 of M / H⁴.
constexpr int cells_per_wave = 16;

const Grid& grid(int order) {
  thread_local std::vector<std::unique_ptr<Grid>> grids;
  const auto i = static_cast<std::size_t>(order);
  if (grids.size() <= i) {
    grids.resize(i + 1);
  }
  if (!grids[i]) {
    grids[i] = std::make_unique<Grid>(cells_per_wave * order);
  }
  return *grids[i];
}

// Newton's method from `x`, kept inside a bracket; p − level > 0 at its lower end if
// `low_positive`.
double refine(const TrigonometricPolynomial& p, double level, double low, double high,
              bool low_positive, double x) {
  constexpr int most = 200;  // bisection alone takes 60
  for (int i = 0; i < most; ++i) {
    const Jet now = p.jet(x);
    const double value = now.value - level;
    ((value > 0.0) == low_positive ? low : high) = x;
    double next = x - value / now.slope;
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    const double rounding = std::numeric_limits<double>::epsilon() * (1.0 + std::abs(x));
    if (std::abs(next - x) <= rounding || high - low <= rounding) {
      return next;
    }
    x = next;
  }
  return x;
}

// Cubic Hermite interpolation on a cell, as Bernstein coefficients, with its error bounds.
class Cell {
 public:
  Cell(const Node& a, const Node& b, double fourth)
      : a_(a), b_(b), width_(b.phase - a.phase), fourth_(fourth) {
    inner_a_ = a.value + a.slope * width_ / 3.0;
    inner_b_ = b.value - b.slope * width_ / 3.0;
  }

  [[nodiscard]] bool changes() const { return (a_.value > 0.0) != (b_.value > 0.0); }

  [[nodiscard]] bool keeps_sign() const {
    const double error = fourth_ * width_ * width_ * width_ * width_ / 384.0;
    const auto [low, high] = std::minmax({a_.value, inner_a_, inner_b_, b_.value});
    return low > error || high < -error;
  }

  [[nodiscard]] bool is_monotone() const {
    const double error = 0.00802 * fourth_ * width_ * width_ * width_;  // √3/216
    const double middle = 3.0 * (inner_b_ - inner_a_) / width_;
    const auto [low, high] = std::minmax({a_.slope, middle, b_.slope});
    return low > error || high < -error;
  }

  // Nothing but rounding.
  [[nodiscard]] bool is_flat(double rounding) const {
    const auto [low, high] = std::minmax({a_.value, inner_a_, inner_b_, b_.value});
    return low > -rounding && high < rounding;
  }

  // +1 convex, −1 concave, 0 not known.
  [[nodiscard]] int curvature() const {
    const double error = fourth_ * width_ * width_ / 12.0;
    const double chord = 6.0 * (b_.value - a_.value) / width_;
    const double at_a = (chord - 4.0 * a_.slope - 2.0 * b_.slope) / width_;
    const double at_b = (2.0 * a_.slope + 4.0 * b_.slope - chord) / width_;
    if (std::min(at_a, at_b) > error) {
      return 1;
    }
    return std::max(at_a, at_b) < -error ? -1 : 0;
  }

  // Root of the cubic, for a cell whose ends differ in sign: a start good to the error bounds.
  [[nodiscard]] double cubic_root() const {
    double low = 0.0;
    double high = 1.0;
    double t = a_.value / (a_.value - b_.value);
    for (int i = 0; i < 3; ++i) {
      const double s = 1.0 - t;
      const double value =
          s * s * (s * a_.value + 3.0 * t * inner_a_) + t * t * (3.0 * s * inner_b_ + t * b_.value);
      const double slope =
          3.0 * (s * s * (inner_a_ - a_.value) + 2.0 * s * t * (inner_b_ - inner_a_) +
                 t * t * (b_.value - inner_b_));
      ((value > 0.0) == (a_.value > 0.0) ? low : high) = t;
      const double next = t - value / slope;
      t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return a_.phase + t * width_;
  }

 private:
  const Node& a_;
  const Node& b_;
  double width_;
  double fourth_;
  double inner_a_;
  double inner_b_;
};

class Isolation {
 public:
  Isolation(const TrigonometricPolynomial& p, std::vector<SignChange>& changes)
      : p_(p),
        changes_(changes),
        fourth_(p.bound(4)),
        rounding_(4.0 * std::numeric_limits<double>::epsilon() *
                  (std::abs(p.mean()) + p.bound(0))) {}

  void search(const Node& a, const Node& b, int depth = 0) {
    const Cell cell(a, b, fourth_);
    if (!cell.changes() && cell.keeps_sign()) {
      return;
    }
    if (cell.is_monotone()) {
      if (cell.changes()) {
        add(a, b, cell.cubic_root());
      }
      return;
    }
    const int curvature = cell.curvature();
    if (curvature != 0) {
      search_bowl(a, b, cell, curvature);
    } else if (depth < deepest && !cell.is_flat(rounding_)) {
      const Node middle = node(0.5 * (a.phase + b.phase));
      search(a, middle, depth + 1);
      search(middle, b, depth + 1);
    } else if (cell.changes()) {
      add(a, b, middle_of(a, b));
    }
  }

 private:
  // A cell narrower than 2π 2⁻²⁴ of the shortest wave: p varies by less than rounding unless its
  // curvature is felt, and then the cell has been settled before.
  static constexpr int deepest = 20;

  static double middle_of(const Node& a, const Node& b) { return 0.5 * (a.phase + b.phase); }

  [[nodiscard]] Node node(double phase) const {
    const Jet jet = p_.jet(phase);
    return {phase, jet.value, jet.slope};
  }

  // One sign of curvature: one change, or a pair about the extremum, or none.
  void search_bowl(const Node& a, const Node& b, const Cell& cell, int curvature) {
    if (cell.changes()) {
      add(a, b, cell.cubic_root());
      return;
    }
    const bool faces_zero = (a.value > 0.0) == (curvature > 0);
    if (!faces_zero || (a.slope > 0.0) == (b.slope > 0.0)) {
      return;
    }
    const Node bottom = node(extremum(a, b));
    if ((bottom.value > 0.0) != (a.value > 0.0)) {
      add(a, bottom, middle_of(a, bottom));
      add(bottom, b, middle_of(bottom, b));
    }
  }

  [[nodiscard]] double extremum(const Node& a, const Node& b) const {
    double low = a.phase;
    double high = b.phase;
    for (int i = 0; i < 60 && high > low; ++i) {  // down to rounding
      const double middle = 0.5 * (low + high);
      ((p_.jet(middle).slope > 0.0) == (a.slope > 0.0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  void add(const Node& a, const Node& b, double start) {
    const bool positive = a.value > 0.0;
    changes_.push_back({refine(p_, 0.0, a.phase, b.phase, positive, start), !positive});
  }

  const TrigonometricPolynomial& p_;
  std::vector<SignChange>& changes_;
  double fourth_;
  double rounding_;
};

// Values and slopes on the grid by Horner's rule, all nodes side by side.
void sample(const TrigonometricPolynomial& p, int order, std::vector<double>& value,
            std::vector<double>& slope) {
  const Grid& g = grid(order);
  const std::size_t n = g.sin.size();
  thread_local std::vector<double> work;
  work.resize(2 * n);
  value.resize(n);
  slope.resize(n);
  double* __restrict re = value.data();
  double* __restrict im = work.data();
  double* __restrict re_slope = slope.data();
  double* __restrict im_slope = work.data() + n;
  const double* __restrict sin = g.sin.data();
  const double* __restrict cos = g.cos.data();
  std::fill_n(re, n, 0.0);
  std::fill_n(im, n, 0.0);
  std::fill_n(re_slope, n, 0.0);
  std::fill_n(im_slope, n, 0.0);
  for (int h = order; h >= 1; --h) {
    const double s = p.sin(h);
    const double c = p.cos(h);
    const double hs = h * s;
    const double hc = h * c;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = re[i] + s;
      const double y = im[i] + c;
      re[i] = x * cos[i] - y * sin[i];
      im[i] = x * sin[i] + y * cos[i];
      const double dx = re_slope[i] + hs;
      const double dy = im_slope[i] + hc;
      re_slope[i] = dx * cos[i] - dy * sin[i];
      im_slope[i] = dx * sin[i] + dy * cos[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    re[i] = p.mean() + im[i];
  }
}

// Changes at one and the same phase are none.
void drop_empty_pairs(std::vector<SignChange>& changes) {
  std::size_t n = 0;
  for (const SignChange& next : changes) {
    if (n > 0 && changes[n - 1].phase == next.phase) {
      --n;
    } else {
      changes[n++] = next;
    }
  }
  changes.resize(n);
}

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

Jet TrigonometricPolynomial::jet(double phase) const {
  const double s = std::sin(phase);
  const double c = std::cos(phase);
  double re = 0.0;
  double im = 0.0;
  double re_slope = 0.0;
  double im_slope = 0.0;
  for (std::size_t i = sin_.size(); i-- > 0;) {
    const double h = static_cast<double>(i + 1);
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

void TrigonometricPolynomial::set_derivative(const TrigonometricPolynomial& other) {
  reset(other.degree());
  for (int h = 1; h <= degree(); ++h) {
    set(h, -h * other.cos(h), h * other.sin(h));
  }
}

void find_sign_changes(const TrigonometricPolynomial& p, std::vector<SignChange>& changes) {
  changes.clear();
  const int order = p.order();
  if (order == 0) {
    return;
  }
  thread_local std::vector<double> value;
  thread_local std::vector<double> slope;
  sample(p, order, value, slope);
  Isolation isolation(p, changes);
  const std::size_t n = value.size();
  const double width = two_pi / static_cast<double>(n);
  Node a{0.0, value[0], slope[0]};
  for (std::size_t i = 1; i <= n; ++i) {
    const std::size_t j = i < n ? i : 0;
    const Node b{i < n ? width * static_cast<double>(i) : two_pi, value[j], slope[j]};
    isolation.search(a, b);
    a = b;
  }
  drop_empty_pairs(changes);
}

double crossing(const TrigonometricPolynomial& p, double level, double low, double high) {
  const double at_low = p.value(low) - level;
  const double at_high = p.value(high) - level;
  const double start = low + (high - low) * (at_low / (at_low - at_high));
  const bool inside = start > low && start < high;
  return refine(p, level, low, high, at_low > 0.0, inside ? start : 0.5 * (low + high));
}

}  // namespace microslip::contact
