#include "solver/time/periodicity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace microslip::solver {
namespace {

constexpr std::size_t n_rates = 6;       // changes that ρ is taken from, one period apart each
constexpr double largest_factor = 0.99;  // of ρ: rounding does not decay at all
constexpr double clearly_apart = 1e3;    // tolerances

double ratio(double change, double size) { return change > 0.0 ? change / size : 0.0; }

double change_between(const PeriodState& a, const PeriodState& b) {
  return std::max({ratio((b.q - a.q).norm(), b.displacement_size),
                   ratio((b.velocity - a.velocity).norm(), b.velocity_size),
                   ratio((b.contact_force - a.contact_force).norm(), b.force_size)});
}

}  // namespace

void PeriodicityTest::add(PeriodState state) {
  states_.push_back(std::move(state));
  for (std::size_t m = 1; m <= largest_multiple && m < states_.size(); ++m) {
    auto& changes = changes_[m - 1];
    changes.push_back(change_between(states_[states_.size() - 1 - m], states_.back()));
    if (changes.size() > n_rates) changes.pop_front();
  }
  if (states_.size() > largest_multiple + 1) states_.pop_front();
}

double PeriodicityTest::distance(std::size_t multiple) const {
  const auto& changes = changes_[multiple - 1];
  if (changes.size() < 2) return std::numeric_limits<double>::infinity();
  if (changes.back() == 0.0) return 0.0;
  const auto periods = static_cast<double>(changes.size() - 1);
  const double per_period = std::pow(changes.back() / changes.front(), 1.0 / periods);
  const double decay =
      std::clamp(std::pow(per_period, static_cast<double>(multiple)), 0.0, largest_factor);
  return changes.back() / (1.0 - decay);
}

int PeriodicityTest::multiple(double tolerance) const {
  std::array<double, largest_multiple + 1> d{};
  for (std::size_t m = 1; m <= largest_multiple; ++m) d[m] = distance(m);
  if (d[1] <= tolerance) return 1;
  for (std::size_t m = 2; m <= largest_multiple; ++m) {
    bool is_new = d[m] <= tolerance;
    for (std::size_t divisor = 1; divisor < m; ++divisor) {
      is_new = is_new && (m % divisor != 0 || d[divisor] > clearly_apart * tolerance);
    }
    if (is_new) return static_cast<int>(m);
  }
  return 0;
}

}  // namespace microslip::solver
