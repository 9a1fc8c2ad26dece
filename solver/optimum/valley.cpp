#include "solver/optimum/valley.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace microslip::solver {

std::array<Place, 2> below(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& best,
                           double limit) {
  const auto above = [limit](const PeakOfParameter& one) { return one.amplitude > limit; };
  const auto centre = std::find_if(trace.begin(), trace.end(), [&](const PeakOfParameter& one) {
    return one.parameter == best.parameter;
  });
  const auto left = std::find_if(std::make_reverse_iterator(centre), trace.rend(), above).base();
  return {left, std::find_if(centre, trace.end(), above)};
}

std::string valley(const std::vector<PeakOfParameter>& trace, const PeakOfParameter& best) {
  const auto [left, right] = below(trace, best, as_good * best.amplitude);
  std::ostringstream text;
  text.precision(4);
  text << "as good to 1 % from " << left->parameter << " to " << std::prev(right)->parameter;
  for (auto one = trace.begin(); one != trace.end(); ++one) {
    const bool elsewhere = one < left || one >= right;
    const bool lowest =
        (one == trace.begin() || std::prev(one)->amplitude > one->amplitude) &&
        (std::next(one) == trace.end() || std::next(one)->amplitude > one->amplitude);
    if (elsewhere && lowest && one->amplitude <= nearly_as_low * best.amplitude) {
      text << "; another minimum of nearly the same height near " << one->parameter;
    }
  }
  return text.str();
}

std::string lowest_so_far(const PeakOfParameter& best) {
  std::ostringstream text;
  text.precision(4);
  text << "the lowest so far at " << best.parameter;
  return text.str();
}

std::string sentence(const char* text, double value) {
  std::ostringstream stream;
  stream.precision(6);
  stream << text << value;
  return stream.str();
}

double on_scale(const OptimumOptions& options, double share) {
  return share *
         (options.scale == ParameterScale::logarithmic ? 1.0 : options.upper - options.lower);
}

}  // namespace microslip::solver
