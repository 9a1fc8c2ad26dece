#include "contact/sampled/slip_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/sampled/step_spline.hpp"

namespace microslip::contact::sampled {
namespace {

double at(const double* column, std::size_t i) { return column[i * block_size]; }

/// 1 along positive friction, −1 against it, 0: the slider rests.
double direction_of(InstantState state) {
  if (state == InstantState::positive_slip) return 1.0;
  return state == InstantState::negative_slip ? -1.0 : 0.0;
}

/// From one instant to the next.
class Step {
 public:
  Step(const SmoothPoint& point, const LineColumns& columns, const double* state, std::size_t now,
       std::size_t n)
      : point_(point),
        columns_(columns),
        now_(now),
        before_((now + n - 1) % n),
        n_(n),
        from_(instant_state(at(state, before_))),
        to_(instant_state(at(state, now_))),
        r_(around_step(columns.closeness, now, n)) {}

  [[nodiscard]] double work() const {
    if (to_ == InstantState::stick) return 0.0;
    const bool was_apart = from_ == InstantState::separated;
    if (was_apart && to_ == InstantState::separated) return 0.0;
    const double direction = last_direction();
    const double old = direction_of(from_);
    double sum = 0.0;
    double begin = 0.0;
    if (was_apart) {
      begin = r_.rise_through_zero(rise_of_load());
    } else if (old != direction) {
      if (old != 0.0 && turns(old)) sum += over(old, 0.0, band_end(old).turn(old));
      begin = meeting(direction);
    }
    return sum + over(direction, begin, end(direction));
  }

 private:
  /// In which the slider moves at the end of the step.
  [[nodiscard]] double last_direction() const {
    if (to_ == InstantState::turned) {
      return at(columns_.slider, now_) == at(columns_.low, now_) ? 1.0 : -1.0;
    }
    if (to_ != InstantState::separated) return direction_of(to_);
    if (direction_of(from_) != 0.0) return direction_of(from_);
    const double u = StepSpline(around_step(columns_.u, now_, n_)).at(opening());
    return u < at(columns_.slider, before_) ? -1.0 : 1.0;
  }

  [[nodiscard]] double end(double direction) const {
    if (to_ == InstantState::turned) return band_end(direction).turn(direction);
    return to_ == InstantState::separated ? opening() : 1.0;
  }

  [[nodiscard]] double opening() const { return r_.negated().rise_through_zero(-rise_of_load()); }

  /// Where the end of the band meets the slider.
  [[nodiscard]] double meeting(double direction) const {
    std::array<double, 4> w = end_of_band(point_, columns_, -direction, now_, n_);
    const double slider = at(columns_.slider, before_);
    for (double& number : w) number = direction * (number - slider);
    const double rise = w[2] - w[1];
    return rise > 0.0 ? StepSpline(w).rise_through_zero(rise) : 0.0;
  }

  [[nodiscard]] bool turns(double direction) const {
    const double turn = at(columns_.turns, now_);
    return turn > 2.5 || turn == (direction > 0.0 ? 1.0 : 2.0);
  }

  [[nodiscard]] double rise_of_load() const {
    return at(columns_.closeness, now_) - at(columns_.closeness, before_);
  }

  [[nodiscard]] StepSpline band_end(double direction) const {
    return StepSpline(end_of_band(point_, columns_, -direction, now_, n_));
  }

  /// Gauss's rule of three points: exact for the product of a cubic and the slope of one.
  [[nodiscard]] double over(double direction, double begin, double end) const {
    if (!(end > begin)) return 0.0;
    constexpr std::array<double, 3> places{-0.7745966692414834, 0.0, 0.7745966692414834};
    constexpr std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const StepSpline w = band_end(direction);
    double sum = 0.0;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const double x = 0.5 * (begin + end) + 0.5 * (end - begin) * places[j];
      sum += weights[j] * std::max(r_.at(x), 0.0) * std::max(direction * w.slope_at(x), 0.0);
    }
    return point_.friction_coefficient * (end - begin) * sum;
  }

  const SmoothPoint& point_;
  const LineColumns& columns_;
  std::size_t now_;
  std::size_t before_;
  std::size_t n_;
  InstantState from_;
  InstantState to_;
  StepSpline r_;
};

}  // namespace

double slip_work(const SmoothPoint& point, const LineColumns& columns, const double* state,
                 std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += Step(point, columns, state, i, n).work();
  return sum;
}

}  // namespace microslip::contact::sampled
