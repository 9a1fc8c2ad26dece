#include "solver/peak.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace microslip::solver {
namespace {

/// Largest amplitude by position on the scale of the parameter.
using PeakFunction = std::function<double(double)>;

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
void minimise(const PeakFunction& f, const Bracket& bracket, double tolerance) {
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

constexpr double as_good = 1.01;  // times the minimum

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
  const auto right = std::find_if(centre, trace.end(), level(as_good));
  const auto left =
      std::find_if(std::make_reverse_iterator(centre), trace.rend(), level(as_good)).base();
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
  const bool positive = options.scale == ParameterScale::linear || options.lower > 0.0;
  if (!positive || !(options.upper > options.lower) || options.n_scan < 3) {
    throw std::invalid_argument("optimum: bounds " + std::to_string(options.lower) + " to " +
                                std::to_string(options.upper) + " with " +
                                std::to_string(options.n_scan) +
                                " scan points; needs lower < upper, 0 < lower on the logarithmic "
                                "scale, and at least 3 points");
  }
}

class Search {
 public:
  Search(const SceneFamily& family, const ContinuationOptions& range, const OptimumOptions& options)
      : options_(options), peaks_(family, range, trace_options(options)) {}

  Optimum run() {
    peaks_.trace();
    const auto followed = [&](double parameter) { return peaks_.highest(parameter).amplitude; };
    const auto on_whole_curves = [&](double parameter) {
      static_cast<void>(peaks_.confirm(parameter));
      return peaks_.highest(parameter).amplitude;
    };
    // A peak that only the curve at the optimum shows is followed from there and the search
    // repeated; each round finds one more.
    constexpr int rounds = 4;
    for (int i = 0; i < rounds; ++i) {
      if (!refine(followed) || peaks_.confirm(result_.best.parameter)) return finished();
    }
    result_.notes.emplace_back(
        "peaks followed kept missing the highest one; search on whole curves");
    static_cast<void>(refine(on_whole_curves));
    return finished();
  }

 private:
  static PeakTraceOptions trace_options(const OptimumOptions& options) {
    return {.lower = options.lower,
            .upper = options.upper,
            .n_values = options.n_scan,
            .n_checks = 3,
            .scale = options.scale};
  }

  [[nodiscard]] double parameter(double position) const {
    return options_.scale == ParameterScale::logarithmic ? std::exp(position) : position;
  }
  [[nodiscard]] double position(double parameter) const {
    return options_.scale == ParameterScale::logarithmic ? std::log(parameter) : parameter;
  }

  static std::vector<PeakOfParameter>::const_iterator lowest(
      const std::vector<PeakOfParameter>& peaks) {
    return std::min_element(peaks.begin(), peaks.end(),
                            [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  }

  using Place = std::vector<PeakOfParameter>::const_iterator;

  /// The minimum between the neighbours of a peak, neither of them lower.
  void search_beside(const std::vector<PeakOfParameter>& peaks, Place place,
                     const PeakFunction& amplitude, double relative_tolerance) {
    if (place == peaks.begin() || place == std::prev(peaks.end())) return;
    const Bracket bracket{position(std::prev(place)->parameter), position(place->parameter),
                          position(std::next(place)->parameter), place->amplitude};
    const bool logarithmic = options_.scale == ParameterScale::logarithmic;
    const double tolerance =
        relative_tolerance * (logarithmic ? 1.0 : options_.upper - options_.lower);
    minimise([&](double at) { return amplitude(parameter(at)); }, bracket, tolerance);
  }

  /// The minimum between the neighbours of the lowest peak known. False: there is none inside.
  bool refine(const PeakFunction& amplitude) {
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    result_.found = false;
    if (peaks.empty()) {
      result_.message = "no peak was found inside the frequency range for any value";
      return false;
    }
    const auto least = lowest(peaks);
    result_.best = *least;
    if (least == peaks.begin() || least == std::prev(peaks.end())) {
      result_.message = sentence("the smallest peak lies at the bound ", least->parameter) + "; " +
                        valley(peaks, *least);
      return false;
    }
    // Other valleys that the scan shows only roughly may be the deeper ones.
    constexpr double rough = 1e-2;
    constexpr double rival = 1.1;
    std::vector<Place> valleys;
    for (auto one = std::next(peaks.begin()); one != std::prev(peaks.end()); ++one) {
      const bool lower =
          one->amplitude < std::prev(one)->amplitude && one->amplitude < std::next(one)->amplitude;
      if (lower && one->amplitude < rival * least->amplitude) valleys.push_back(one);
    }
    if (valleys.size() > 1) {
      for (const Place one : valleys) search_beside(peaks, one, amplitude, rough);
    }
    const std::vector<PeakOfParameter> known = peaks_.result().peaks;
    search_beside(known, lowest(known), amplitude, options_.relative_tolerance);
    const std::vector<PeakOfParameter> all = peaks_.result().peaks;
    result_.best = *lowest(all);
    result_.found = true;
    return true;
  }

  /// Solves for where the peak is 1 % above the minimum, from the last value known to be lower towards
  /// the first known to be higher; nothing to do where no value on that side is higher.
  void search_edge(double direction) {
    constexpr double enough = 2e-3;  // of the scale: an interval is told, not a number
    const std::vector<PeakOfParameter> peaks = peaks_.result().peaks;
    const double limit = as_good * result_.best.amplitude;
    const double best = position(result_.best.parameter);
    double inside = best;
    double outside = direction * std::numeric_limits<double>::infinity();
    for (const PeakOfParameter& peak : peaks) {
      const double at = position(peak.parameter);
      if ((at - best) * direction <= 0.0 || peak.amplitude <= limit) continue;
      if ((outside - at) * direction > 0.0) outside = at;
    }
    if (!std::isfinite(outside)) return;
    for (const PeakOfParameter& peak : peaks) {
      const double at = position(peak.parameter);
      if ((at - inside) * direction > 0.0 && (outside - at) * direction > 0.0) inside = at;
    }
    const bool logarithmic = options_.scale == ParameterScale::logarithmic;
    const double tolerance = enough * (logarithmic ? 1.0 : options_.upper - options_.lower);
    while (std::abs(outside - inside) > tolerance) {
      const double middle = 0.5 * (inside + outside);
      (peaks_.highest(parameter(middle)).amplitude <= limit ? inside : outside) = middle;
    }
  }

  Optimum finished() {
    if (result_.found) {
      for (const double direction : {-1.0, 1.0}) search_edge(direction);
    }
    const PeakTrace trace = peaks_.result();
    result_.trace = trace.peaks;
    result_.notes.insert(result_.notes.begin(), trace.notes.begin(), trace.notes.end());
    result_.n_curves = trace.n_curves;
    result_.iterations = trace.iterations;
    result_.contact_evaluations = trace.contact_evaluations;
    if (result_.found) {
      result_.best = *lowest(result_.trace);
      result_.message = valley(result_.trace, result_.best);
    }
    return std::move(result_);
  }

  OptimumOptions options_;
  PeakFamilies peaks_;
  Optimum result_;
};

}  // namespace

Optimum minimise_peak(const SceneFamily& family, const ContinuationOptions& range,
                      const OptimumOptions& options) {
  check(options);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Optimum optimum = Search(family, range, options).run();
  optimum.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return optimum;
}

}  // namespace microslip::solver
