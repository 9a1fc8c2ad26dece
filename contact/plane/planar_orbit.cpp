#include "contact/plane/planar_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/plane/planar_reversal.hpp"
#include "contact/plane/planar_stick.hpp"

namespace microslip::contact {
namespace {

using Eigen::Vector2d;

/// Shortest advance of a walk that would otherwise not move: what it skips is below rounding.
constexpr double shortest_step = 1e-11;

/// Length of a step for a tolerance. The share of the highest polynomial falls as εⁿ with its
/// degree n, so that the error of a step, of degree nine, is its power 9/5; 3/2 leaves room.
double allowed_top_term(double tolerance) { return std::pow(tolerance, 1.0 / 1.5); }

/// The rule of Radau integrates a wave of k oscillations per 2π over a length h with an error of
/// about 1e-8 (kh/2)⁹; 2 is where the shape of a step would be lost.
double longest_step_length(const OrbitOptions& options) {
  return std::min(2.0, 2.0 * std::pow(1e8 * options.tolerance, 1.0 / 9.0)) /
         options.highest_harmonic;
}

class Walk {
 public:
  Walk(const PlanarMotion& motion, const OrbitOptions& options, PlanarOrbit& orbit)
      : motion_(motion),
        tolerance_(options.tolerance),
        allowed_(allowed_top_term(options.tolerance)),
        longest_(longest_step_length(options)),
        next_length_(std::min(0.6 / motion.n_harmonics(), longest_)),
        left_(options.most_steps + 200.0 * options.highest_harmonic),
        orbit_(orbit) {}

  void start(const Vector2d& slider) { slider_ = slider; }

  void cross(const PlanarInterval& interval, bool first) {
    if (!interval.in_contact) {
      slipping_ = false;
      orbit_.separates = true;
      PlanarPiece open;
      open.state = ContactState::separated;
      open.begin = interval.begin;
      open.end = interval.end;
      orbit_.pieces.push_back(std::move(open));
      return;
    }
    interval_ = &interval;
    time_ = interval.begin;
    enter(first);
    int idle = 0;
    while (time_ < interval.end) {
      const double before = time_;
      if (left_ <= 0.0) return finish_roughly();
      slipping_ ? slip() : stick();
      idle = time_ > before ? 0 : idle + 1;
      if (idle > 3) creep();
    }
  }

  [[nodiscard]] const Vector2d& slider() const { return slider_; }

 private:
  void open_piece(ContactState state, PlanarEntry entry, const PlanarInstant& now) {
    PlanarPiece piece;
    piece.state = state;
    piece.entry = entry;
    piece.begin = time_;
    piece.end = time_;
    piece.at_begin = now;
    piece.slider = slider_;
    orbit_.pieces.push_back(std::move(piece));
    left_ -= 1.0;
    if (state == ContactState::slip) orbit_.slips = true;
  }

  /// State at the begin of an interval in contact.
  void enter(bool first) {
    const PlanarInstant& now = interval_->grid.front();
    entry_ = PlanarEntry::continued;
    // Load that only grazes zero wipes the memory as well.
    heading_.setZero();
    if (interval_->touches_down || (!first && now.radius <= stick_slack)) {
      slider_ = now.position;
      entry_ = PlanarEntry::touch_down;
      // Gaussian heights begin to touch with a load of nothing, but not with a radius of nothing.
      slipping_ = false;
      if (now.radius > stick_slack) return;
      const Vector2d pull = now.stiffness.cwiseProduct(now.velocity);
      slipping_ = pull.norm() > now.radius_rate;
      if (slipping_) heading_ = returned_force(pull, now.stiffness, now.radius_rate);
      return;
    }
    if (first) return_slider(now);
    if (slipping_) {
      const Vector2d force = now.force(slider_);
      const double size = force.norm();
      slipping_ = size <= 0.0 || slip_rate(now, force / size) > 0.0;
    }
  }

  /// The slider a period begins with may lie outside its ellipse: virgin, or proposed by Newton.
  void return_slider(const PlanarInstant& now) {
    const Vector2d trial = now.force(slider_);
    const double excess = trial.norm() - now.radius;
    constexpr double on_edge = 1e-12;  // closer than this it is taken to rest on the edge
    slipping_ = excess > -on_edge;
    if (excess <= stick_slack) return;
    const Vector2d before = slider_;
    const Vector2d force = returned_force(trial, now.stiffness, now.radius);
    slider_ = now.position - force.cwiseQuotient(now.stiffness);
    open_piece(ContactState::slip, PlanarEntry::returned, now);
    orbit_.pieces.back().before = before;
  }

  void stick() {
    const PlanarInstant now =
        time_ == interval_->begin ? interval_->grid.front() : motion_.at(time_);
    open_piece(ContactState::stick, entry_, now);
    entry_ = PlanarEntry::continued;
    time_ = end_of_stick(motion_, *interval_, slider_, now);
    slipping_ = time_ < interval_->end;
    orbit_.pieces.back().end = time_;
  }

  void slip() {
    const PlanarInstant now =
        time_ == interval_->begin ? interval_->grid.front() : motion_.at(time_);
    open_piece(ContactState::slip, entry_, now);
    entry_ = PlanarEntry::continued;
    here_ = now;
    while (slipping_ && time_ < interval_->end && left_ > 0.0) {
      left_ -= 1.0;
      SlipStep step = longest_step();
      const double fraction = first_reversal(motion_, *interval_, step);
      if (fraction <= 1.0) {
        finish_slip(step, fraction);
        slipping_ = false;
        if (step.length <= shortest_step) break;
      }
      time_ = step.end() >= interval_->end ? interval_->end : step.end();
      slider_ = step.end_slider();
      here_ = step.instant.back();
      orbit_.pieces.back().steps.push_back(step);
    }
    orbit_.pieces.back().end = time_;
  }

  bool solve(SlipStep& step, double length) const {
    step.begin = time_;
    step.slider = slider_;
    step.length = length;
    const bool last = time_ + length >= interval_->end;
    const std::vector<SlipStep>& done = orbit_.pieces.back().steps;
    const SlipStep* before = done.empty() ? nullptr : &done.back();
    return solve_slip(motion_, last ? -interval_->nudge() : 0.0, step, before);
  }

  /// How much longer a step may be.
  [[nodiscard]] double growth_of(const SlipStep& step) const {
    const double by_top = std::pow(allowed_ / std::max(step.top_term, 1e-300), 0.2);
    if (step.rest <= tolerance_) return 0.9 * by_top;
    return 0.9 * std::min(by_top, std::pow(tolerance_ / step.rest, 1.0 / 9.0));
  }

  /// The longest step from here within the tolerance.
  SlipStep longest_step() {
    SlipStep step;
    const double left = interval_->end - time_;
    double length = std::min(next_length_, left);
    if (length < left && length > 0.6 * left) length = 0.6 * left;
    for (;;) {
      const bool solved = solve(step, length) && turns_slowly(step);
      const double factor = solved ? growth_of(step) : 0.25;
      const bool good = solved && step.top_term <= allowed_ && step.rest <= tolerance_;
      if (good || length <= shortest_step) {
        next_length_ = std::min(longest_, length * std::clamp(factor, 0.3, 4.0));
        return step;
      }
      length *= std::clamp(factor, 0.1, 0.8);
    }
  }

  /// Whether no two neighbouring stages differ by more than 60 degrees: else slip may have ended
  /// and begun again between them.
  [[nodiscard]] bool turns_slowly(const SlipStep& step) const {
    const Vector2d begin = here_.force(step.slider);
    constexpr double has_direction = 1e-11;  // below it rounding turns the force
    const bool touches = time_ == interval_->begin && begin.norm() <= has_direction;
    const Vector2d along = touches ? heading_ : begin;
    const double size = along.norm();
    if ((touches || size > has_direction) && along.dot(step.direction.col(0)) < 0.5 * size) {
      return false;
    }
    for (int i = 1; i < n_stages; ++i) {
      if (step.direction.col(i - 1).dot(step.direction.col(i)) < 0.5) return false;
    }
    return true;
  }

  /// Solves for the length of a step that ends where the slip rate is 0.
  void finish_slip(SlipStep& step, double fraction) const {
    constexpr double delta = 1e-4;
    const double slope = (slip_rate_at(motion_, step, fraction) -
                          slip_rate_at(motion_, step, std::max(fraction - delta, 0.0))) /
                         (step.length * std::min(delta, fraction));
    double length = fraction * step.length;
    double before = 0.0;
    double rate_before = 0.0;
    for (int i = 0; i < 8; ++i) {
      if (length <= shortest_step || !solve(step, length)) break;
      const double rate = step.rate(n_stages - 1);
      // The slider misses its end by the square of this, far below rounding.
      if (std::abs(rate) <= 1e-12) break;
      const double secant = i == 0 ? slope : (rate - rate_before) / (length - before);
      before = length;
      rate_before = rate;
      if (!(secant < 0.0)) break;
      const double next = std::clamp(length - rate / secant, 0.5 * length, 1.5 * length);
      if (next == length || time_ + next > interval_->end) break;
      length = next;
    }
    if (length <= shortest_step) step.length = length;
  }

  /// A walk that does not get on takes one shortest step by the return alone.
  void creep() {
    time_ = std::min(time_ + shortest_step, interval_->end);
    const PlanarInstant now = motion_.at(time_);
    const Vector2d force = returned_force(now.force(slider_), now.stiffness, now.radius);
    slider_ = now.position - force.cwiseQuotient(now.stiffness);
    slipping_ = false;
  }

  /// The rest of an interval in slip, by steps that nothing controls. Both the force and what it
  /// should be lie in the disc of friction: their coefficients differ by at most 8/π of its radius.
  void finish_roughly() {
    double limit = 0.0;
    for (const PlanarInstant& now : interval_->grid) limit = std::max(limit, now.limit);
    orbit_.defect = std::max(orbit_.defect, 8.0 / std::numbers::pi * limit);
    open_piece(ContactState::slip, PlanarEntry::continued, motion_.at(time_));
    const double length = 0.1 / motion_.n_harmonics();
    while (time_ < interval_->end) {
      const double left = interval_->end - time_;
      SlipStep step;
      // What does not converge is a solution of first order, by successive returns.
      static_cast<void>(solve(step, std::min(length, left)));
      time_ = left <= length ? interval_->end : step.end();
      slider_ = step.end_slider();
      orbit_.pieces.back().steps.push_back(step);
    }
    orbit_.pieces.back().end = time_;
    slipping_ = true;
  }

  const PlanarMotion& motion_;
  double tolerance_;
  double allowed_;
  double longest_;
  double next_length_;
  double left_;  // pieces and steps
  PlanarOrbit& orbit_;
  const PlanarInterval* interval_ = nullptr;
  double time_ = 0.0;
  PlanarInstant here_;  // where the next step of slip begins
  Vector2d slider_ = Vector2d::Zero();
  Vector2d heading_ =
      Vector2d::Zero();  // direction of slip, any length, where contact begins in slip
  PlanarEntry entry_ = PlanarEntry::continued;
  bool slipping_ = false;
};

}  // namespace

PlanarOrbit walk_orbit(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
                       const Eigen::Vector2d& slider, const OrbitOptions& options) {
  PlanarOrbit orbit;
  orbit.begin = slider;
  Walk walk(motion, options, orbit);
  walk.start(slider);
  bool first = true;
  for (const PlanarInterval& interval : intervals) {
    walk.cross(interval, first);
    first = false;
  }
  orbit.end = walk.slider();
  return orbit;
}

}  // namespace microslip::contact
