#include "solver/peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

/// Golden section with parabolic steps (Brent) until the bracket is below the tolerance.
double minimise(PeakFunction& f, const Bracket& bracket, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double a = bracket.a;
  double c = bracket.c;
  double x = bracket.b;
  double w = x;
  double v = x;
  double fx = bracket.value;
  double fw = fx;
  double fv = fx;
  double step = 0.0;
  double before = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (a + c);
    if (std::abs(x - middle) + 0.5 * (c - a) <= 2.0 * tolerance) break;
    const double r = (x - w) * (fx - fv);
    const double q0 = (x - v) * (fx - fw);
    double p = (x - v) * q0 - (x - w) * r;
    double q = 2.0 * (q0 - r);
    if (q > 0.0) p = -p;
    q = std::abs(q);
    const bool parabola =
        std::abs(p) < std::abs(0.5 * q * before) && p > q * (a - x) && p < q * (c - x);
    before = parabola ? step : (x < middle ? c - x : a - x);
    step = parabola ? p / q : golden * before;
    const double u = std::abs(step) >= tolerance ? x + step : x + std::copysign(tolerance, step);
    const double fu = f(u);
    if (fu <= fx) {
      (u < x ? c : a) = x;
      v = w, fv = fw;
      w = x, fw = fx;
      x = u, fx = fu;
      continue;
    }
    (u < x ? a : c) = u;
    if (fu <= fw || w == x) {
      v = w, fv = fw;
      w = u, fw = fu;
    } else if (fu <= fv || v == x || v == w) {
      v = u, fv = fu;
    }
  }
  return x;
}

std::string sentence(const char* text, double value) {
  std::ostringstream stream;
  stream.precision(6);
  stream << text << value;
  return stream.str();
}

void check(const OptimumOptions& options) {
  if (!(options.lower > 0.0) || !(options.upper > options.lower) || options.n_scan < 3) {
    throw std::invalid_argument(
        "optimum: bounds " + std::to_string(options.lower) + " to " +
        std::to_string(options.upper) + " with " + std::to_string(options.n_scan) +
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
  for (int i = 0; i < options.n_scan; ++i) values.push_back(peak(low + spacing * i));
  const auto least = std::min_element(values.begin(), values.end());
  const auto index = static_cast<int>(least - values.begin());
  if (!std::isfinite(*least)) {
    result.message = "no peak was found inside the frequency range for any preload";
    return result;
  }
  if (index == 0 || index == options.n_scan - 1) {
    result.message = sentence("the smallest peak lies at the bound ", std::exp(low + spacing * index));
  } else {
    const Bracket bracket{low + spacing * (index - 1), low + spacing * index,
                          low + spacing * (index + 1), *least};
    minimise(peak, bracket, options.relative_tolerance);
    result.found = true;
  }
  result.best = *std::min_element(
      result.trace.begin(), result.trace.end(),
      [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  std::sort(result.trace.begin(), result.trace.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  return result;
}

}  // namespace microslip::solver
