#include "contact/numerics/smooth_signs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include "contact/bracketed_root.hpp"

namespace microslip::contact {
namespace {

constexpr int n_nodes = n_smooth_nodes;
using Series = Eigen::Matrix<double, n_nodes, 1>;
using Square = Eigen::Matrix<double, n_nodes, n_nodes>;

/// What does not depend on the functions.
struct Tables {
  SmoothValues node;    // zeros of T_n
  Square coefficients;  // values → c
  Square left;          // c → those on [−1, 0], scaled to [−1, 1]
  Square right;
};

double value(const Series& c, double x) {
  double next = 0.0;
  double after = 0.0;
  for (int k = n_nodes - 1; k > 0; --k) {
    const double now = 2.0 * x * next - after + c[k];
    after = next;
    next = now;
  }
  return x * next - after + c[0];
}

Tables make_tables() {
  Tables t;
  std::array<Square, 2> half_values;
  for (int i = 0; i < n_nodes; ++i) {
    const double x = -std::cos(std::numbers::pi * (i + 0.5) / n_nodes);
    t.node[static_cast<std::size_t>(i)] = x;
    for (int k = 0; k < n_nodes; ++k) {
      const double T = std::cos(k * std::acos(x));
      t.coefficients(k, i) = (k == 0 ? 1.0 : 2.0) / n_nodes * T;
      half_values[0](i, k) = std::cos(k * std::acos(0.5 * (x - 1.0)));
      half_values[1](i, k) = std::cos(k * std::acos(0.5 * (x + 1.0)));
    }
  }
  t.left = t.coefficients * half_values[0];
  t.right = t.coefficients * half_values[1];
  return t;
}

const Tables& tables() {
  static const Tables t = make_tables();
  return t;
}

/// Σ_{k>0} |c_k|.
double variation(const Series& c) { return c.tail<n_nodes - 1>().cwiseAbs().sum(); }

Series derivative(const Series& c) {
  Series d = Series::Zero();
  for (int k = n_nodes - 1; k > 0; --k)
    d[k - 1] = (k + 1 < n_nodes ? d[k + 1] : 0.0) + 2.0 * k * c[k];
  d[0] *= 0.5;
  return d;
}

/// Walks from cell to cell with the sign of both functions so far.
class Search {
 public:
  Search(const SmoothFunctions& functions, double size, std::vector<SmoothSign>& found)
      : functions_(functions), size_(size), found_(found) {}

  /// @param before  tails of the cell twice as long.
  void cover(double begin, double end, int depth, double before = INFINITY) {
    const double half = 0.5 * (end - begin);
    std::array<SmoothValues, 2> at_nodes;
    functions_.over_cell(begin + half, half, tables().node, at_nodes);
    const Eigen::Map<const Eigen::Matrix<double, n_nodes, 2>> values(at_nodes[0].data());
    const Eigen::Matrix<double, n_nodes, 2> c = tables().coefficients.lazyProduct(values);
    std::array<bool, 2> resolved{};
    bool settled = true;
    double top = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double tail = c.col(column).tail<2>().cwiseAbs().sum();
      resolved[i] =
          is_resolved(tail, values.col(column).cwiseAbs().maxCoeff(), end - begin, before);
      settled = settled && (resolved[i] || is_clear(c.col(column), tail));
      top = std::max(top, tail);
    }
    if (!settled && depth > 0) {
      cover(begin, begin + half, depth - 1, top);
      cover(begin + half, end, depth - 1, top);
      return;
    }
    constexpr double narrowest = 1e-7;  // what w turns back by inside is its cube
    for (std::size_t i = 0; i < 2; ++i) {
      accurate_ = resolved[i];
      isolate(c.col(static_cast<Eigen::Index>(i)), begin, end,
              narrowest * std::min(1.0, end - begin), static_cast<int>(i));
    }
  }

 private:
  /// @param before  tails of the cell twice as long.
  [[nodiscard]] bool is_resolved(double tail, double largest, double length, double before) const {
    // Integrals of f between its sign changes, which is what a slider moves by, err by its power
    // 3/2.
    constexpr double tolerance = 1e-10;
    if (tail <= std::max(tolerance * size_, 0.1 * tolerance * largest)) return true;
    // Half the length divides a tail by 2¹⁰, unless it is the rounding of a steep function.
    const bool small = tail <= 1e-9 * largest || tail * length <= 1e-16 * size_;
    return tail > 0.25 * before && small;
  }

  /// Whether f keeps its sign, or has one change at most and none near the ends,
  /// whatever the next terms are.
  static bool is_clear(const Series& c, double tail) {
    constexpr double margin = 30.0;  // of terms that fall off slowly
    if (std::abs(c[0]) > variation(c) + margin * tail) return true;
    const Series d = derivative(c);
    const double ends = std::min(std::abs(value(c, -1.0)), std::abs(value(c, 1.0)));
    return ends > margin * tail &&
           std::abs(d[0]) > variation(d) + margin * n_nodes * n_nodes * tail;
  }

  void isolate(const Series& c, double begin, double end, double narrowest, int function) {
    const double spread = variation(c);
    constexpr double rounding = 1e-15;
    if (std::abs(c[0]) + spread <= rounding * size_) return;
    if (std::abs(c[0]) > spread) {
      pass(begin, c[0] > 0.0, function);
      return;
    }
    const Series d = derivative(c);
    if (std::abs(d[0]) > variation(d) || end - begin <= narrowest) {
      cross(c, begin, end, function);
      return;
    }
    const double middle = 0.5 * (begin + end);
    isolate(tables().left.lazyProduct(c), begin, middle, narrowest, function);
    isolate(tables().right.lazyProduct(c), middle, end, narrowest, function);
  }

  /// One change at most.
  void cross(const Series& c, double begin, double end, int function) {
    const double at_begin = value(c, -1.0);
    const double at_end = value(c, 1.0);
    pass(begin, at_begin > 0.0, function);
    if ((at_begin > 0.0) == (at_end > 0.0)) return;
    const auto f = [&](double x) { return value(c, x); };
    double x = bracketed_root(f, -1.0, 1.0, at_begin, at_end);
    if (!accurate_) x = polished(c, begin, 0.5 * (end - begin), x, function);
    pass(begin + 0.5 * (end - begin) * (1.0 + x), at_end > 0.0, function);
  }

  /// Newton's method with the slope of the series, which is as good as a thirtieth at least.
  double polished(const Series& c, double begin, double half, double x, int function) {
    const double slope = value(derivative(c), x);
    for (int i = 0; i < 8; ++i) {
      const double f = functions_.at(begin + half * (1.0 + x))[static_cast<std::size_t>(function)];
      const double step = f / slope;
      x = std::clamp(x - step, -1.0, 1.0);
      if (std::abs(step) <= 1e-7) break;  // the next one would be 1e-9
    }
    return x;
  }

  void pass(double phase, bool positive, int function) {
    int& before = sign_[static_cast<std::size_t>(function)];
    const int now = positive ? 1 : -1;
    if (before == -now) found_.push_back({phase, function});
    before = now;
  }

  const SmoothFunctions& functions_;
  double size_;
  std::vector<SmoothSign>& found_;
  std::array<int, 2> sign_{0, 0};
  bool accurate_ = true;  // whether the series of the cell is the function
};

}  // namespace

void add_smooth_signs(const SmoothFunctions& functions, double begin, double end, double cell,
                      double size, std::vector<SmoothSign>& found) {
  const double length = end - begin;
  if (!(length > 0.0)) return;
  constexpr int deepest =
      30;  // halvings; what changes within 1e-9 of a cell is not told from a jump
  Search search(functions, size, found);
  const int n_cells = static_cast<int>(std::ceil(length / cell));
  for (int i = 0; i < n_cells; ++i) {
    search.cover(begin + length * i / n_cells, begin + length * (i + 1) / n_cells, deepest);
  }
}

void add_smooth_signs(const SmoothPair& functions, double begin, double end, double cell,
                      double size, std::vector<SmoothSign>& found) {
  const auto node_by_node = [&](double middle, double half, const SmoothValues& shares,
                                std::array<SmoothValues, 2>& values) {
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const std::array<double, 2> f = functions(middle + half * shares[i]);
      values[0][i] = f[0];
      values[1][i] = f[1];
    }
  };
  add_smooth_signs(SmoothFunctions{functions, node_by_node}, begin, end, cell, size, found);
}

}  // namespace microslip::contact
