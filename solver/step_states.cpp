#include "solver/step_states.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace microslip::solver {
namespace {

constexpr double largest_share = 0.2;  // (1)
constexpr double share_wanted = 0.15;  // of the next step: most stay below (1) then
// Of more points each is a small part of the force: their changes together are a smooth curve.
constexpr std::size_t most_seen = 32;
constexpr double largest_turn = 0.25;  // of the period of one of them
constexpr std::size_t handful = 8;

// In scaled variables, of the amplitude or the width of a resonance: what is shorter shows on no curve.
constexpr double shortest_cut = 1e-3;
constexpr int most_in_a_row = 10;  // cuts at full resolution; so many points may follow one another
constexpr int n_bisections = 6;

}  // namespace

bool StepStates::is_few() const { return before_.size() <= handful; }

bool StepStates::exceeds(const contact::StateChange& change, Bound bound) const {
  if (change.share > largest_share && !is_few()) return true;
  if (before_.size() > most_seen) return false;
  if (change.largest > largest_turn && bound == Bound::wanted) return true;
  return is_few() && change.n_regimes > (bound == Bound::wanted ? 0 : 1);
}

double StepStates::first_cut(const WalkerPoint& from, const WalkerPoint& to, double length) {
  return cut(from, to, length, Bound::wanted);
}

double StepStates::next_cut(const WalkerPoint& from, const WalkerPoint& to, double length) {
  return cut(from, to, length, Bound::bearable);
}

double StepStates::cut(const WalkerPoint& from, const WalkerPoint& to, double length, Bound bound) {
  if (!read_) return 1.0;
  read_ends(from.solution.point, to.solution.point);
  if (before_.empty()) return 1.0;
  change_ = contact::state_change(before_, after_);
  const double share = located(from, to, bound);
  constexpr double rest = 0.98;  // the end of the step is as good a place
  const double shortest = std::max(shortest_cut, least_) / length;
  if (share < rest && shortest < rest) {
    count_cut(share, length);
    return std::max(share, shortest);
  }
  if (bound == Bound::bearable) return 1.0;
  if (share >= 1.0) {
    n_in_a_row_ = 0;
    least_ = 0.0;
  } else if (exceeds(change_, Bound::bearable)) {
    ++n_forced_;
  }
  return 1.0;
}

/// A step begins where the one before ended.
void StepStates::read_ends(const BranchVector& from, const BranchVector& to) {
  const auto is = [](const BranchVector& a, const BranchVector& b) {
    return a.parameter == b.parameter && a.x.size() == b.x.size() && a.x == b.x;
  };
  if (is(from, after_at_)) {
    std::swap(before_, after_);
  } else if (!is(from, before_at_)) {
    read_(from, before_);
  }
  before_at_ = from;
  read_(to, after_);
  after_at_ = to;
}

void StepStates::forget() {
  before_at_ = {};
  after_at_ = {};
}

void StepStates::count_cut(double share, double length) {
  ++n_cuts_;
  if (++n_in_a_row_ <= most_in_a_row) return;
  least_ = 2.0 * std::max({least_, shortest_cut, share * length});
}

double StepStates::located(const WalkerPoint& from, const WalkerPoint& to, Bound bound) {
  const Scaling& scaling = from.scaling;
  BranchVector chord = difference(to.solution.point, from.solution.point, scaling);
  const double size = length(chord);
  if (size == 0.0) return 1.0;
  chord.x /= size;
  chord.parameter /= size;
  const Knot a(from, chord, size, scaling);
  const Knot b(to, chord, size, scaling);
  bool kink = false;
  const auto is_beyond = [&](double share) {
    if (share == 1.0) {
      kink = change_.n_regimes > 0;
      return exceeds(change_, bound);
    }
    read_(cubic_between(a, b, share, 1.0), between_);
    const contact::StateChange change = contact::state_change(before_, between_);
    kink = change.n_regimes > 0;
    return exceeds(change, bound);
  };
  // A point of a few may change and change back.
  constexpr std::array shares{0.25, 0.5, 0.75, 1.0};
  const bool looks_inside = before_.size() <= most_seen && bound == Bound::wanted;
  double good = 0.0;
  double bad = 0.0;
  bool ends_at_kink = false;
  for (const double share : shares) {
    if (share < 1.0 && !looks_inside) continue;
    if (is_beyond(share)) {
      bad = share;
      ends_at_kink = kink;
      break;
    }
    good = share;
  }
  if (bad == 0.0) return 1.0;
  for (int i = 0; i < n_bisections; ++i) {
    const double middle = 0.5 * (good + bad);
    if (is_beyond(middle)) {
      bad = middle;
      ends_at_kink = kink;
    } else {
      good = middle;
    }
  }
  // Beyond a kink, so that the next step begins on its other side.
  return is_few() && ends_at_kink ? bad + (bad - good) : good;
}

double StepStates::growth() const {
  const bool is_bound = read_ && !is_few() && change_.share > 0.5 * share_wanted;
  return is_bound ? share_wanted / change_.share : std::numeric_limits<double>::infinity();
}

}  // namespace microslip::solver
