#include "contact/numerics/sign_changes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "contact/numerics/vector_lanes.hpp"
#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

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

// Sixteen cells per shortest wave: there the cubic is good to 6e-5 of M / H⁴. A multiple of all
// lanes.
constexpr int cells_per_wave = 16;

// Tables of one thread: made once, and no lock is needed to read them.
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
      const double next = slope != 0.0 ? t - value / slope : low;
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

  [[nodiscard]] double fourth() const { return fourth_; }
  [[nodiscard]] double rounding() const { return rounding_; }

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
    changes_.push_back(
        {root_within(p_, fourth_, 0.0, a.phase, b.phase, positive, start), !positive});
  }

  const TrigonometricPolynomial& p_;
  std::vector<SignChange>& changes_;
  double fourth_;
  double rounding_;
};

// What the sampling of a polynomial reads and writes: directions of n nodes, coefficients of
// harmonics 1 to `order`; n is a multiple of the lanes.
struct Sampling {
  std::size_t n;
  const double* sin_node;
  const double* cos_node;
  int order;
  double mean;
  const double* sin;
  const double* cos;
  double* value;
  double* slope;
};

// W nodes side by side: their sums stay in registers from the highest harmonic to the first.
//   sum ← (sum + s_h + i c_h) e^{iθ}:   p = p₀ + Im Σ C_h z^h,   p' = Re Σ h C_h z^h
template <int W>
MICROSLIP_INLINE void sample_nodes(const Sampling& p) {
  using Vector = typename Lanes<W>::Vector;
  for (std::size_t i = 0; i < p.n; i += W) {
    const Vector sin = lanes_at<W>(p.sin_node + i);
    const Vector cos = lanes_at<W>(p.cos_node + i);
    Vector re{};
    Vector im{};
    Vector re_slope{};
    Vector im_slope{};
    for (int h = p.order; h >= 1; --h) {
      const Vector x = re + p.sin[h - 1];
      const Vector y = im + p.cos[h - 1];
      re = x * cos - y * sin;
      im = x * sin + y * cos;
      const Vector dx = re_slope + h * p.sin[h - 1];
      const Vector dy = im_slope + h * p.cos[h - 1];
      re_slope = dx * cos - dy * sin;
      im_slope = dx * sin + dy * cos;
    }
    put_lanes<W>(p.value + i, im + p.mean);
    put_lanes<W>(p.slope + i, re_slope);
  }
}

struct Sampler {
  void (*sample)(const Sampling&);
};

void sample_plain(const Sampling& p) { sample_nodes<2>(p); }
constexpr Sampler plain{sample_plain};
#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void sample_avx2(const Sampling& p) { sample_nodes<4>(p); }
[[gnu::target("avx512f,fma")]] void sample_avx512(const Sampling& p) { sample_nodes<8>(p); }
constexpr Sampler avx2_sampler{sample_avx2};
constexpr Sampler avx512_sampler{sample_avx512};
constexpr const Sampler* avx2 = &avx2_sampler;
constexpr const Sampler* avx512 = &avx512_sampler;
#else
constexpr const Sampler* avx2 = nullptr;
constexpr const Sampler* avx512 = nullptr;
#endif

const Sampler& fastest_sampler() {
  static const Sampler& fastest = *runnable_kernels(plain, avx2, avx512).back();
  return fastest;
}

// Values and slopes on the grid by Horner's rule, all nodes side by side; the first node stands
// again at the end.
class Samples {
 public:
  void take(const TrigonometricPolynomial& p, int order) {
    const Grid& g = grid(order);
    n_ = g.sin.size();
    value_.resize(n_ + 1);
    slope_.resize(n_ + 1);
    fastest_sampler().sample({n_, g.sin.data(), g.cos.data(), order, p.mean(), p.sines(),
                              p.cosines(), value_.data(), slope_.data()});
    value_[n_] = value_[0];
    slope_[n_] = slope_[0];
  }

  // Marks the cells on which the cubic and its error bound leave the sign open.
  void mark_cells(double fourth) {
    const double width = two_pi / static_cast<double>(n_);
    const double third = width / 3.0;
    const double error = fourth * width * width * width * width / 384.0;
    open_.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      const double a = value_[i];
      const double b = value_[i + 1];
      const double inner_a = a + third * slope_[i];
      const double inner_b = b - third * slope_[i + 1];
      const double low = std::min(std::min(a, b), std::min(inner_a, inner_b));
      const double high = std::max(std::max(a, b), std::max(inner_a, inner_b));
      open_[i] = low > error || high < -error ? 0.0 : 1.0;
    }
  }

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] bool is_open(std::size_t cell) const { return open_[cell] != 0.0; }
  [[nodiscard]] Node node(std::size_t i) const {
    const double phase =
        i < n_ ? two_pi / static_cast<double>(n_) * static_cast<double>(i) : two_pi;
    return {phase, value_[i], slope_[i]};
  }

 private:
  std::size_t n_ = 0;
  std::vector<double> value_;
  std::vector<double> slope_;
  std::vector<double> open_;
};

// A pair between which p is nothing but rounding is none: p touches zero there.
class PairFilter {
 public:
  PairFilter(const TrigonometricPolynomial& p, double rounding) : p_(p), rounding_(rounding) {}

  void apply(std::vector<SignChange>& changes) const {
    std::size_t n = 0;
    for (const SignChange& next : changes) {
      if (n > 0 && is_touch(changes[n - 1].phase, next.phase)) {
        --n;
      } else {
        changes[n++] = next;
      }
    }
    changes.resize(n);
    while (changes.size() > 1 && is_touch(changes.back().phase, changes.front().phase + two_pi)) {
      changes.pop_back();
      changes.erase(changes.begin());
    }
  }

 private:
  [[nodiscard]] bool is_touch(double a, double b) const {
    constexpr double close = 1e-3;  // above the fourth root of rounding
    return b - a < close && std::abs(p_.value(0.5 * (a + b))) <= rounding_;
  }

  const TrigonometricPolynomial& p_;
  double rounding_;
};

}  // namespace

void find_sign_changes(const TrigonometricPolynomial& p, std::vector<SignChange>& changes) {
  changes.clear();
  const int order = p.order();
  if (order == 0 || !std::isfinite(p.bound(4))) {
    return;
  }
  thread_local Samples samples;  // storage, so that a search allocates nothing once it has grown
  samples.take(p, order);
  Isolation isolation(p, changes);
  samples.mark_cells(isolation.fourth());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.is_open(i)) {
      isolation.search(samples.node(i), samples.node(i + 1));
    }
  }
  PairFilter(p, isolation.rounding()).apply(changes);
}

}  // namespace microslip::contact
