#include "solver/peak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace microslip::solver {
namespace {

/// Highest solved peak of each parameter asked for, remembered in order.
class PeakFunction {
 public:
  PeakFunction(const std::function<Scene(double)>& family, const ContinuationOptions& range,
               Optimum& result)
      : family_(family), range_(range), result_(result) {}

  /// Largest amplitude at exp(log_parameter); infinity where no peak was found.
  double operator()(double log_parameter) {
    const double parameter = std::exp(log_parameter);
    const ResponseCurve curve = trace_response(family_(parameter), range_);
    result_.iterations += curve.iterations;
    result_.contact_evaluations += curve.contact_evaluations;
    const ResponsePoint* highest = nullptr;
    for (const ResponsePoint& point : curve.points) {
      if (point.mark != PointMark::peak) continue;
      if (highest == nullptr || point.amplitude > highest->amplitude) highest = &point;
    }
    if (!curve.complete || highest == nullptr) return std::numeric_limits<double>::infinity();
    result_.trace.push_back({parameter, highest->frequency, highest->amplitude});
    return highest->amplitude;
  }

 private:
  const std::function<Scene(double)>& family_;
  const ContinuationOptions& range_;
  Optimum& result_;
};

/// A minimum inside (a, c): f(b) ≤ f(a), f(c).
struct Bracket {
  double a, b, c;
  double value;
};

/// The minimum of a parabola through three points, relative to the first; NaN where they lie on a line.
double parabola_step(const std::array<double, 3>& at, const std::array<double, 3>& value) {
  const double r = (at[0] - at[1]) * (value[0] - value[2]);
  const double q = (at[0] - at[2]) * (value[0] - value[1]);
  return -0.5 * ((at[0] - at[2]) * q - (at[0] - at[1]) * r) / (q - r);
}

/// Golden section with parabolic steps (Brent 1973, chapter 5) until the bracket is below the tolerance.
void minimise(PeakFunction& f, const Bracket& bracket, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double a = bracket.a;
  double c = bracket.c;
  std::array<double, 3> x{bracket.b, bracket.b, bracket.b};  // best, second, third
  std::array<double, 3> value{bracket.value, bracket.value, bracket.value};
  double last = c - a;
  double before_last = last;
  while (c - a > 4.0 * tolerance) {
    const double middle = 0.5 * (a + c);
    double step = parabola_step(x, value);
    // A parabola that leaves the bracket or does not halve the step before last is not trusted.
    const bool trusted = x[0] + step > a && x[0] + step < c && std::abs(step) < 0.5 * before_last;
    if (!trusted) step = golden * ((x[0] < middle ? c : a) - x[0]);
    if (std::abs(step) < tolerance) step = std::copysign(tolerance, middle - x[0]);
    before_last = trusted ? last : std::abs(step) / golden;
    last = std::abs(step);
    const double here = x[0] + step;
    const double found = f(here);
    if (found < value[0]) {
      (step > 0.0 ? a : c) = x[0];
      x = {here, x[0], x[1]};
      value = {found, value[0], value[1]};
    } else {
      (step > 0.0 ? c : a) = here;
      const bool second = found < value[1] || x[1] == x[0];
      x = second ? std::array{x[0], here, x[1]} : std::array{x[0], x[1], here};
      value =
          second ? std::array{value[0], found, value[1]} : std::array{value[0], value[1], found};
    }
  }
}

std::string sentence(const char* text, double value) {
  std::ostringstream stream;
  stream.precision(6);
  stream << text << value;
  return stream.str();
}

/// How well the minimum is determined: the interval about it that is as good to 1 %, and other minima as
/// good to 2 %. `trace` is sorted by parameter.
std::string valley(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& best) {
  const auto level = [&](double factor) {
    return [limit = factor * best.amplitude](const PeakOfParameter& one) {
      return one.amplitude > limit;
    };
  };
  const auto centre = std::find_if(trace.begin(), trace.end(), [&](const PeakOfParameter& one) {
    return one.parameter == best.parameter;
  });
  const auto right = std::find_if(centre, trace.end(), level(1.01));
  const auto left =
      std::find_if(std::make_reverse_iterator(centre), trace.rend(), level(1.01)).base();
  std::ostringstream text;
  text.precision(6);
  text << "as good to 1 % from " << left->parameter << " to " << std::prev(right)->parameter;
  for (auto one = trace.begin(); one != trace.end(); ++one) {
    const bool elsewhere = one < left || one >= right;
    const bool lowest =
        (one == trace.begin() || std::prev(one)->amplitude > one->amplitude) &&
        (std::next(one) == trace.end() || std::next(one)->amplitude > one->amplitude);
    if (elsewhere && lowest && !level(1.02)(*one)) {
      text << "; another minimum of nearly the same height near " << one->parameter;
    }
  }
  return text.str();
}

void check(const OptimumOptions& options) {
  if (!(options.lower > 0.0) || !(options.upper > options.lower) || options.n_scan < 3) {
    throw std::invalid_argument("optimum: bounds " + std::to_string(options.lower) + " to " +
                                std::to_string(options.upper) + " with " +
                                std::to_string(options.n_scan) +
                                " scan points; needs 0 < lower < upper and at least 3 points");
  }
}

}  // namespace

Optimum minimise_peak(const std::function<Scene(double)>& family, const ContinuationOptions& range,
                      const OptimumOptions& options) {
  check(options);
  Optimum result;
  PeakFunction peak(family, range, result);
  const double low = std::log(options.lower);
  const double spacing = (std::log(options.upper) - low) / (options.n_scan - 1);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(options.n_scan));
  for (int i = 0; i < options.n_scan; ++i) values.push_back(peak(low + spacing * i));
  const auto least = std::min_element(values.begin(), values.end());
  const auto index = static_cast<int>(least - values.begin());
  if (!std::isfinite(*least)) {
    result.message = "no peak was found inside the frequency range for any preload";
    return result;
  }
  if (index == 0 || index == options.n_scan - 1) {
    result.message =
        sentence("the smallest peak lies at the bound ", std::exp(low + spacing * index));
  } else {
    const Bracket bracket{low + spacing * (index - 1), low + spacing * index,
                          low + spacing * (index + 1), *least};
    minimise(peak, bracket, options.relative_tolerance);
    result.found = true;
  }
  result.best =
      *std::min_element(result.trace.begin(), result.trace.end(),
                        [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  std::sort(result.trace.begin(), result.trace.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  if (result.found) result.message = valley(result.trace, result.best);
  return result;
}

}  // namespace microslip::solver
