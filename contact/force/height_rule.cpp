#include "contact/force/height_rule.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "contact/numerics/gauss_legendre.hpp"

namespace microslip::contact {
namespace {

// Breaks closer than this are one: what lies between weighs no more than rounding of the whole.
constexpr double smallest_distance = 1e-12;

struct Crossing {
  double eta;
  int guard;
};

// The line ξ = const with all zeros on it, grouped by guard, ascending within a group.
struct Column {
  double xi;
  double weight;
  std::vector<Crossing> zeros;
};

using Columns = std::vector<Column>;

class HeightRule {
 public:
  HeightRule(const std::vector<ChebyshevSurface>& surfaces, const std::vector<int>& crossing,
             const std::vector<GuardLine>& lines, const FittedRuleOptions& options)
      : surfaces_(surfaces),
        crossing_(crossing),
        lines_(lines),
        tolerance_(options.line_tolerance),
        noise_(std::max(1e-16, 1e-5 * options.line_tolerance)),
        merge_distance_(std::max(smallest_distance, options.line_tolerance)),
        line_rule_(gauss_legendre(options.order)),
        // A graded rule needs degree 2 for its weights to sum to 1, degree 5 for those of a cell.
        graded_rule_(gauss_legendre(std::max(options.order, 3))) {
    find_events();
  }

  [[nodiscard]] std::size_t n_events() const { return events_.size(); }

  [[nodiscard]] SquareRule rule() {
    std::vector<Interval> intervals;
    double begin = -1.0;
    bool begin_is_event = false;
    for (const double event : events_) {
      const GradedEnds ends{begin_is_event, true};
      intervals.push_back(interval(begin, event, ends, columns(begin, event, ends)));
      begin = event;
      begin_is_event = true;
    }
    const GradedEnds ends{begin_is_event, false};
    intervals.push_back(interval(begin, 1.0, ends, columns(begin, 1.0, ends)));
    refine(intervals);
    for (const Interval& part : intervals) {
      std::ranges::for_each(part.whole, [this](const Column& column) { add_column(column); });
    }
    return std::move(rule_);
  }

 private:
  [[nodiscard]] const ChebyshevSurface& surface(int guard) const {
    return surfaces_[static_cast<std::size_t>(guard)];
  }

  [[nodiscard]] bool counts(int guard, double xi, double eta) const {
    const GuardLine& line = lines_[static_cast<std::size_t>(guard)];
    return line.domain < 0 || surface(line.domain).value(xi, eta) * line.domain_sign >= 0.0;
  }

  // The same with a margin: where a line meets the end of its domain must not be lost to rounding.
  [[nodiscard]] bool may_count(int guard, double xi, double eta) const {
    const GuardLine& line = lines_[static_cast<std::size_t>(guard)];
    if (line.domain < 0) {
      return true;
    }
    const ChebyshevSurface& domain = surface(line.domain);
    return domain.value(xi, eta) * line.domain_sign >=
           -1e-6 * domain.coefficients().cwiseAbs().sum();
  }

  void add_event(double xi, double eta, int guard) {
    if (std::abs(xi) < 1.0 - merge_distance_ && std::abs(eta) <= 1.0 + smallest_distance &&
        may_count(guard, xi, eta)) {
      events_.push_back(xi);
    }
  }

  void find_events() {
    for (const int guard : crossing_) {
      const ChebyshevSurface& g = surface(guard);
      const ChebyshevSurface turned = g.transposed();
      for (const double side : {-1.0, 1.0}) {
        for (const double xi : chebyshev_roots(turned.column(side))) {
          add_event(xi, side, guard);
        }
      }
      const ChebyshevSurface slope = g.derivative_y();
      // A guard that does not depend on η has no turning points, only noise.
      if (slope.coefficients().cwiseAbs().sum() > 1e-11 * g.coefficients().cwiseAbs().sum()) {
        for (const Eigen::Vector2d& root : common_roots(g, slope)) {
          add_event(root[0], root[1], guard);
        }
      }
    }
    for (std::size_t i = 0; i < crossing_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (const Eigen::Vector2d& root :
             common_roots(surface(crossing_[i]), surface(crossing_[j]))) {
          if (may_count(crossing_[j], root[0], root[1])) {
            add_event(root[0], root[1], crossing_[i]);
          }
        }
      }
    }
    std::ranges::sort(events_);
    // An event that is missed costs its distance times a line that ends there.
    const double same = std::max(smallest_distance, 1e-3 * tolerance_);
    const auto is_near = [same](double a, double b) { return b - a < same; };
    events_.erase(std::unique(events_.begin(), events_.end(), is_near), events_.end());
  }

  [[nodiscard]] std::vector<Crossing> zeros_at(double xi) const {
    std::vector<Crossing> zeros;
    for (const int guard : crossing_) {
      for (const double eta : chebyshev_roots(surface(guard).column(xi), noise_)) {
        if (std::abs(eta) < 1.0 && counts(guard, xi, eta)) {
          zeros.push_back({eta, guard});
        }
      }
    }
    return zeros;
  }

  [[nodiscard]] Columns columns(double begin, double end, GradedEnds ends) const {
    const bool is_graded = ends.begin || ends.end;
    const LineRule rule = graded(is_graded ? graded_rule_ : line_rule_, ends);
    Columns result;
    for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
      const double xi = begin + (end - begin) * rule.nodes[i];
      result.push_back({xi, (end - begin) * rule.weights[i], zeros_at(xi)});
    }
    return result;
  }

  // ∫ sign(g) dη and ∫ sign(g) 2η dη of each guard over a column: what the lines do to a smooth
  // integrand. A pair of zeros that appears changes them continuously, so that zeros lost to
  // rounding do not count.
  [[nodiscard]] Eigen::ArrayXd signed_moments(const Column& column) const {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(2 * static_cast<Eigen::Index>(crossing_.size()));
    auto zero = column.zeros.cbegin();
    for (std::size_t k = 0; k < crossing_.size(); ++k) {
      // A line that ends at its domain says nothing about the sign elsewhere.
      const bool ends_inside = lines_[static_cast<std::size_t>(crossing_[k])].domain >= 0;
      double sign = ends_inside || surface(crossing_[k]).value(column.xi, -1.0) > 0.0 ? 1.0 : -1.0;
      double begin = -1.0;
      const auto add_to = [&](double end) {
        sum[2 * static_cast<Eigen::Index>(k)] += sign * (end - begin);
        sum[2 * static_cast<Eigen::Index>(k) + 1] += sign * (end - begin) * (end + begin);
        begin = end;
        sign = -sign;
      };
      for (; zero != column.zeros.cend() && zero->guard == crossing_[k]; ++zero) {
        add_to(zero->eta);
      }
      add_to(1.0);
    }
    return sum;
  }

  [[nodiscard]] Eigen::ArrayXd moments(const Columns& columns) const {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(2 * static_cast<Eigen::Index>(crossing_.size()));
    for (const Column& column : columns) {
      sum += column.weight * signed_moments(column);
    }
    return sum;
  }

  // An interval with its rule and those of its halves; their difference estimates the error.
  struct Interval {
    double begin;
    double end;
    GradedEnds ends;
    Columns whole;
    Columns left;
    Columns right;
    double error;
    [[nodiscard]] double middle() const { return 0.5 * (begin + end); }
    bool operator<(const Interval& other) const { return error < other.error; }
  };

  [[nodiscard]] Interval interval(double begin, double end, GradedEnds ends, Columns whole) const {
    const double middle = 0.5 * (begin + end);
    Interval result{begin,
                    end,
                    ends,
                    std::move(whole),
                    columns(begin, middle, {ends.begin, false}),
                    columns(middle, end, {false, ends.end}),
                    0.0};
    result.error =
        (moments(result.whole) - moments(result.left) - moments(result.right)).abs().sum();
    return result;
  }

  // Halves the worst interval until all together are good enough, and leaves them in order.
  void refine(std::vector<Interval>& heap) const {
    // More than kinks and near tangents need; at a cusp of a line zeros come and go by rounding,
    // and halving would never end.
    const auto max_halvings = static_cast<int>(2000 / line_rule_.nodes.size());
    // A quarter of what the square, of area 4, may err: the difference of two rules is only an
    // estimate.
    const double allowed = tolerance_;
    const auto total = [&heap] {
      return std::accumulate(heap.begin(), heap.end(), 0.0,
                             [](double sum, const Interval& part) { return sum + part.error; });
    };
    std::ranges::make_heap(heap, std::less<>());
    for (int k = 0; k < max_halvings && total() > allowed; ++k) {
      std::ranges::pop_heap(heap, std::less<>());
      Interval worst = std::move(heap.back());
      heap.pop_back();
      const double middle = worst.middle();
      heap.push_back(interval(worst.begin, middle, {worst.ends.begin, false}, worst.left));
      std::ranges::push_heap(heap, std::less<>());
      heap.push_back(interval(middle, worst.end, {false, worst.ends.end}, worst.right));
      std::ranges::push_heap(heap, std::less<>());
    }
    std::ranges::sort(heap, {}, &Interval::begin);
  }

  // Whether the integrand has a root at one of the breaks in [first, last) when seen from η =
  // inside.
  [[nodiscard]] bool is_rooted(std::vector<Crossing>::const_iterator first,
                               std::vector<Crossing>::const_iterator last, double xi,
                               double inside) const {
    return std::any_of(first, last, [&](const Crossing& zero) {
      return lines_[static_cast<std::size_t>(zero.guard)].is_graded &&
             surface(zero.guard).value(xi, inside) > 0.0;
    });
  }

  void add_piece(const Column& column, double begin, double end, GradedEnds ends) {
    const bool is_graded = ends.begin || ends.end;
    const LineRule rule = graded(is_graded ? graded_rule_ : line_rule_, ends);
    for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
      rule_.xi.push_back(column.xi);
      rule_.eta.push_back(begin + (end - begin) * rule.nodes[i]);
      rule_.weights.push_back(column.weight * (end - begin) * rule.weights[i]);
    }
  }

  void add_column(Column column) {
    auto& zeros = column.zeros;
    std::ranges::sort(zeros, {}, &Crossing::eta);
    // Zeros closer than the merge distance are one break, with the sides of the square as well.
    const auto group_end = [&](std::vector<Crossing>::const_iterator from, double eta) {
      return std::find_if(from, zeros.cend(),
                          [&](const Crossing& zero) { return zero.eta - eta >= merge_distance_; });
    };
    double begin = -1.0;
    auto first = zeros.cbegin();  // zeros of the break at `begin`: [first, last)
    auto last = group_end(first, begin);
    while (begin < 1.0) {
      const bool is_last = last == zeros.cend() || last->eta > 1.0 - merge_distance_;
      const double end = is_last ? 1.0 : last->eta;
      const auto next_last = is_last ? zeros.cend() : group_end(last, end);
      const double inside = 0.5 * (begin + end);
      add_piece(column, begin, end,
                {is_rooted(first, last, column.xi, inside),
                 is_rooted(last, next_last, column.xi, inside)});
      begin = end;
      first = last;
      last = next_last;
    }
  }

  const std::vector<ChebyshevSurface>& surfaces_;
  const std::vector<int>& crossing_;
  const std::vector<GuardLine>& lines_;
  double tolerance_;
  double noise_;           // of coefficients, well below what lines may be off
  double merge_distance_;  // lines are no better known than their tolerance
  LineRule line_rule_;
  LineRule graded_rule_;
  std::vector<double> events_;
  SquareRule rule_;
};

double total_slope(const std::vector<ChebyshevSurface>& surfaces,
                   const std::vector<int>& crossing) {
  double sum = 0.0;
  for (const int guard : crossing) {
    const ChebyshevSurface& g = surfaces[static_cast<std::size_t>(guard)];
    sum += std::abs(g.coefficients()(0, 1)) / g.coefficients().cwiseAbs().sum();
  }
  return sum;
}

}  // namespace

SquareRule height_rule(const std::vector<ChebyshevSurface>& surfaces,
                       const std::vector<int>& crossing, const std::vector<GuardLine>& lines,
                       const FittedRuleOptions& options) {
  std::vector<ChebyshevSurface> turned;
  turned.reserve(surfaces.size());
  for (const ChebyshevSurface& surface : surfaces) {
    turned.push_back(surface.transposed());
  }
  HeightRule upright(surfaces, crossing, lines, options);
  HeightRule sideways(turned, crossing, lines, options);
  const bool is_upright = upright.n_events() != sideways.n_events()
                              ? upright.n_events() < sideways.n_events()
                              : total_slope(surfaces, crossing) >= total_slope(turned, crossing);
  if (is_upright) {
    return upright.rule();
  }
  SquareRule rule = sideways.rule();
  std::swap(rule.xi, rule.eta);
  return rule;
}

}  // namespace microslip::contact
