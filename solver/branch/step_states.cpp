#include "solver/branch/step_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace microslip::solver {
namespace {

constexpr double largest_share = 0.2;  // (1)
constexpr double share_wanted = 0.15;  // of the next step: most stay below (1) then
// Of more points each is a small part of the force: their changes together are a smooth curve.
constexpr std::size_t most_seen = 32;
constexpr double largest_turn = 0.25;  // of the period of one of them
constexpr std::size_t handful = 8;

// In scaled variables, of the amplitude or the width of a resonance: what is shorter shows on no
// curve.
constexpr double shortest_cut = 1e-3;
// Where more than (1) changes within the shortest, it changes at once: a step across.
constexpr double step_across = 0.02;
// A step to be cut counts 2, another takes 1 back: beyond the patience the least length doubles
// with each. Ten changes may follow one another closely; states that chatter at every third step
// run the patience out.
constexpr int patience = 20;
constexpr int most_impatient = 40;
constexpr int n_bisections = 6;
constexpr double nearly_all = 0.98;  // of a step: its end is as good a place to end it

/// The cubic through both ends of a step.
class Way {
 public:
  Way(const WalkerPoint& from, const WalkerPoint& to)
      : chord_(difference(to.solution.point, from.solution.point, from.scaling)),
        size_(normalise(chord_)),
        from_(from, chord_, size_, from.scaling),
        to_(to, chord_, size_, from.scaling) {}

  [[nodiscard]] BranchVector at(double share) const {
    return cubic_between(from_, to_, share, 1.0);
  }

 private:
  static double normalise(BranchVector& chord) {
    const double size = length(chord);
    if (size == 0.0) return size;
    chord.x /= size;
    chord.parameter /= size;
    return size;
  }

  BranchVector chord_;
  double size_;
  Knot from_;
  Knot to_;
};

bool is_same(const BranchVector& a, const BranchVector& b) {
  return a.parameter == b.parameter && a.x.size() == b.x.size() && a.x == b.x;
}

}  // namespace

bool StepStates::is_few() const { return before_.size() <= handful; }

bool StepStates::exceeds(const contact::StateChange& change, Bound bound) const {
  if (change.share > largest_share && !is_few()) return true;
  if (before_.size() > most_seen) return false;
  if (change.largest > largest_turn && bound == Bound::wanted) return true;
  return is_few() && change.n_regimes > (bound == Bound::wanted ? 0 : 1);
}

void StepStates::read(const BranchVector& at, contact::ContactStates& result) {
  reader_(at, result);
  ++n_readings_;
}

/// A step begins where the one before ended.
void StepStates::read_ends(const BranchVector& from, const BranchVector& to) {
  if (is_same(from, after_at_)) {
    std::swap(before_, after_);
  } else if (!is_same(from, before_at_)) {
    read(from, before_);
  }
  before_at_ = from;
  read(to, after_);
  after_at_ = to;
}

double StepStates::first_cut(const WalkerPoint& from, const WalkerPoint& to, double length) {
  if (!reader_) return 1.0;
  const double share = located(from, to, Bound::wanted);
  is_at_once_ = share < 1.0 && !is_few() && share * length < shortest_cut;
  n_forced_ += is_at_once_ ? 1 : 0;
  impatience_ = std::clamp(impatience_ + (share < 1.0 ? 2 : -1), 0, most_impatient);
  return cut(share, length);
}

double StepStates::next_cut(const WalkerPoint& from, const WalkerPoint& to, double length) {
  if (!reader_) return 1.0;
  return cut(located(from, to, Bound::bearable), length);
}

double StepStates::least_length(double patient) const {
  return std::ldexp(patient, std::max(impatience_ - patience, 0));
}

double StepStates::cut(double share, double length) {
  const double least = least_length(is_at_once_ ? step_across : shortest_cut);
  if (share >= nearly_all || least >= nearly_all * length) return 1.0;
  ++n_cuts_;
  return std::max(share, least / length);
}

double StepStates::located(const WalkerPoint& from, const WalkerPoint& to, Bound bound) {
  read_ends(from.solution.point, to.solution.point);
  change_ = contact::state_change(before_, after_);
  if (before_.empty() || is_same(before_at_, after_at_)) return 1.0;
  const Way way(from, to);
  // A point of a few may change and change back.
  constexpr std::array inside{0.25, 0.5, 0.75};
  const bool looks_inside = before_.size() <= most_seen && bound == Bound::wanted;
  double good = 0.0;
  Place bad{1.0, change_};
  for (const double share : inside) {
    if (!looks_inside) break;
    if (const Place place = look(way.at(share), share); exceeds(place.change, bound)) {
      bad = place;
      break;
    }
    good = share;
  }
  if (!exceeds(bad.change, bound)) return 1.0;
  for (int i = 0; i < n_bisections; ++i) {
    const double middle = 0.5 * (good + bad.share);
    const Place place = look(way.at(middle), middle);
    if (exceeds(place.change, bound)) {
      bad = place;
    } else {
      good = middle;
    }
  }
  // Beyond a kink, so that the next step begins on its other side.
  return is_few() && bad.change.n_regimes > 0 ? 2.0 * bad.share - good : good;
}

StepStates::Place StepStates::look(const BranchVector& at, double share) {
  read(at, between_);
  return {share, contact::state_change(before_, between_)};
}

double StepStates::next_length(double length) const {
  const bool is_bound = reader_ && !is_few() && !is_at_once_ && change_.share > 0.5 * share_wanted;
  if (!is_bound) return std::numeric_limits<double>::infinity();
  return std::max(share_wanted / change_.share * length, least_length(step_across));
}

}  // namespace microslip::solver
