#include "solver/branch/branch_walker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/balance/few_jacobians.hpp"

namespace microslip::solver {
namespace {

// Lengths in scaled variables: a share of the amplitude, or of the width of the nearest resonance.
constexpr double longest_step = 0.2;
// The same with several harmonics, each of which may have a resonance near by that moves little:
// what bends is seen by the angle.
constexpr double longest_learned_step = 0.5;
constexpr double longest_leap = 0.05;  // over a kink; farther on may be another branch
constexpr double shortest_step = 1e-7;
// Below this a sharp turn is taken for a kink of the branch, not for a step that was too long.
constexpr double kink_step = 2e-4;
// Below this what runs the other way right beside the branch is reached only at a tip of it.
constexpr double tip_step = 1e-5;
// Where the branch turns back the part ahead may catch Newton's method before the kink is there.
constexpr double turning_step = 1e-6;
constexpr double kink_correction =
    10.0;                              // of the step: a turn by 84°; beyond, it is another branch
constexpr double cosine_limit = 0.93;  // 21.5°: beyond, the curve would look angular
constexpr double least_bent = 0.5;     // 60°: beyond, a branch that crosses another is not told
constexpr double angle_wanted = 0.13;  // rad per step
// Where the predictor has learned the bend, and a plot as well.
constexpr double learned_angle = 0.2;
constexpr double correction_limit = 0.3;  // of the step: beyond, the point may be another branch's
constexpr double seen_step = 0.01;        // what a shorter one goes past shows on no curve
// Angle between the chord and the mean of both tangents, as a share of that between these: a kink
// anywhere in the step has half of it at most, an arc nothing.
constexpr double most_swerve = 0.6;
constexpr double sure_swerve = 0.1;   // 6°: below, a look halfway decides
constexpr double seen_swerve = 0.03;  // worth that look
// Distance from the cubic through both ends halfway, of the step, and as a share of the angle
// between the tangents: a kink anywhere leaves an eighth of it at most.
constexpr double most_off = 0.04;
constexpr double most_off_by_turn = 0.15;
constexpr double polished_on_the_way = 1e-13;  // of the residual: rounding, or next to it
constexpr int modest_attempts = 2;             // of a step, without Newton's method
constexpr int wanted_iterations = 4;
constexpr int wanted_updates = 12;  // of Broyden's method, by forces alone
// Of a step, which is at most a fifth of a resonance wide: below it are rounding errors only.
constexpr double exact_share = 1e-13;
// Of a sampled force, whose Jacobian errs by some 1e-4: the square of this in the amplitude of a
// peak.
constexpr double sampled_share = 5e-3;

void reverse(BranchVector& way) {
  way.x = -way.x;
  way.parameter = -way.parameter;
}

/// Of a small angle, by its cosine.
double angle_of(double cosine) { return std::sqrt(std::max(2.0 - 2.0 * cosine, 0.0)); }

}  // namespace

BranchWalker::BranchWalker(ParametricSystem system, ScalingRule rule, NewtonResult start,
                           double forward, double tolerance)
    : system_(std::move(system)), rule_(std::move(rule)), tolerance_(tolerance) {
  now_.scaling = rule_(start);
  now_.solution = std::move(start);
  const BranchVector along{Eigen::VectorXd::Zero(now_.solution.point.x.size()), forward};
  const Tangent tangent = branch_tangent(now_.solution.evaluation, along, now_.scaling);
  now_.tangent = tangent.direction;
  orientation_ = before_orientation_ = tangent.orientation;
  before_ = now_;
}

BranchWalker::Trial BranchWalker::attempt(double distance, Effort effort) {
  // A learned predictor is worth its steps where a Jacobian is not at hand at each iterate. Exact
  // forces have it, and what the tangent misses tells of kinks that the predictor leads past.
  if (!residual_) return attempt(now_.tangent, distance, effort);
  return corrected(predictor_.point(before_, now_, distance), now_.tangent, distance, effort);
}

BranchWalker::Trial BranchWalker::attempt(const BranchVector& direction, double distance,
                                          Effort effort) {
  return corrected(moved(now_.solution.point, direction, distance, now_.scaling), direction,
                   distance, effort);
}

BranchWalker::Trial BranchWalker::corrected(const BranchVector& predicted,
                                            const BranchVector& direction, double distance,
                                            Effort effort) {
  Trial trial;
  NewtonOptions options{.tolerance = tolerance_, .max_iterations = effort.iterations};
  // Beside a branch point the residual is the square of an error of the place.
  if (distance >= kink_step) options.polished_to = polished_on_the_way;
  if (!residual_) options.max_evaluations = effort.evaluations;
  NewtonResult solution = solved(predicted, direction, options, now_);
  evaluations_ += solution.evaluations;
  iterations_ += solution.iterations;
  trial.converged = solution.converged;
  if (!solution.converged) return trial;
  trial.correction = length(difference(solution.point, predicted, now_.scaling)) / distance;
  const Scaling scaling = rule_(solution);
  const BranchVector previous = rescaled(direction, now_.scaling, scaling);
  const Tangent tangent = tangent_at(solution, previous, scaling);
  trial.cosine = dot(tangent.direction, previous);
  trial.orientation = tangent.orientation;
  trial.point = {std::move(solution), tangent.direction, scaling};
  return trial;
}

NewtonResult BranchWalker::solved(const BranchVector& predicted, const BranchVector& direction,
                                  const NewtonOptions& options, const WalkerPoint& nearby) {
  if (!residual_) return solve_newton(system_, predicted, direction, now_.scaling, options);
  if (!now_.solution.factors) {  // by Newton's method
    now_.solution.factors =
        std::make_shared<BranchFactors>(now_.solution.evaluation, now_.tangent, now_.scaling);
  }
  const auto& factors = nearby.solution.factors ? nearby.solution.factors : now_.solution.factors;
  return solve_with_few_jacobians({system_, residual_}, predicted, direction, now_.scaling, options,
                                  factors.get());
}

bool BranchWalker::smooth(const Trial& trial) const {
  // The sign of the determinant is that of the branch: another one is another branch's, or a kink
  // at which the branch turns back lies in between.
  const bool same =
      trial.orientation == 0.0 || orientation_ == 0.0 || trial.orientation == orientation_;
  return same && trial.cosine > cosine_limit && trial.correction < correction_limit &&
         swerve(trial) <= std::max(sure_swerve, most_swerve * angle_of(trial.cosine));
}

/// A branch that bends one way has its chord between both tangents. Where it lies beside them the
/// step has gone over a bend and back, or over folds to a part of the branch beside this one.
/// @return angle between the chord and the mean of the tangents; 0: too short a step to matter.
double BranchWalker::swerve(const Trial& trial) const {
  const WalkerPoint& to = trial.point;
  const BranchVector chord = difference(to.solution.point, now_.solution.point, to.scaling);
  const double size = length(chord);
  if (size < seen_step || takes_swerves_) return 0.0;
  const BranchVector from = rescaled(now_.tangent, now_.scaling, to.scaling);
  const double along = dot(chord, from) + dot(chord, to.tangent);
  return angle_of(along / (size * std::sqrt(2.0 + 2.0 * trial.cosine)));
}

/// Whether the branch halfway is not where both ends of the step and their tangents have it. Asked
/// where the chord swerves; of forces that are sampled, whose Jacobian is dear, never.
bool BranchWalker::is_elsewhere_halfway(const Trial& trial) {
  if (residual_ || swerve(trial) < seen_swerve) return false;
  const Scaling& scaling = now_.scaling;
  BranchVector chord = difference(trial.point.solution.point, now_.solution.point, scaling);
  const double size = length(chord);
  chord.x /= size;
  chord.parameter /= size;
  const BranchVector middle = cubic_between(Knot(now_, chord, size, scaling),
                                            Knot(trial.point, chord, size, scaling), 0.5, 1.0);
  const NewtonResult next =
      solve_newton(system_, middle, chord, scaling, {.tolerance = tolerance_, .max_iterations = 1});
  evaluations_ += next.evaluations;
  const double off = length(difference(next.point, middle, scaling)) / size;
  return off > std::max(most_off, most_off_by_turn * angle_of(trial.cosine));
}

/// What lies behind a trial, three steps back along its own tangent.
BranchWalker::Trial BranchWalker::behind(const Trial& trial) {
  const double distance = 3.0 * step_;
  BranchVector back = rescaled(trial.point.tangent, trial.point.scaling, now_.scaling);
  reverse(back);
  return corrected(moved(trial.point.solution.point, back, distance, now_.scaling), back, distance,
                   usual);
}

/// Where slip begins or ends two parts of a branch may meet in a tip so sharp that a step goes from
/// one to the other all but straight on. There the determinant has the other sign; so it has
/// beyond a branch point, but not any more for who goes back from there past it.
/// @return empty: the way back bends too much to tell, and a shorter step would.
std::optional<bool> BranchWalker::beyond_a_tip(const Trial& trial) {
  const Trial back = behind(trial);
  const bool straight =
      back.converged && back.cosine > cosine_limit && back.correction < correction_limit;
  if (!straight && step_ > turning_step) return std::nullopt;
  return back.converged && back.orientation == orientation_;
}

/// Another branch may cross this one where it bends: who goes back from there is on the part that
/// was walked, the other way round.
bool BranchWalker::crosses_bent(const Trial& trial) {
  if (residual_ || trial.cosine < least_bent || trial.cosine > cosine_limit) return false;
  const Trial back = behind(trial);
  return back.converged && back.orientation == -orientation_ && back.cosine > least_bent;
}

void BranchWalker::accept(Trial trial) {
  // At a kink where the branch turns back by more than a right angle, or in a tip, the determinant
  // tells the way on.
  before_orientation_ = orientation_;
  const bool turned =
      trial.orientation != 0.0 && orientation_ != 0.0 && trial.orientation != orientation_;
  if (turned && ((trial.cosine < cosine_limit && !trial.bent) || trial.tip)) {
    reverse(trial.point.tangent);
  } else if (trial.orientation != 0.0) {
    orientation_ = trial.orientation;
  }
  predictor_.learn(before_, now_, trial.point.solution.point);
  before_ = std::move(now_);
  now_ = std::move(trial.point);
}

void BranchWalker::choose_step(const Trial& trial) {
  const int wanted = residual_ ? wanted_updates : wanted_iterations;
  const double effort =
      std::sqrt(static_cast<double>(wanted) / std::max(trial.point.solution.iterations, 1));
  const double angle = std::acos(std::clamp(trial.cosine, -1.0, 1.0));
  const double bend = angle > 0.0 ? (residual_ ? learned_angle : angle_wanted) / angle : 2.0;
  step_ = std::min(residual_ ? longest_learned_step : longest_step,
                   step_ * std::clamp(std::min(effort, bend), 0.5, 2.0));
}

BranchWalker::Trial BranchWalker::limited(Trial trial, double distance) {
  constexpr int most_cuts = 3;  // the first is all but right
  const long n_forced = states_.n_forced();
  double share = states_.first_cut(now_, trial.point, distance);
  for (int i = 0; i < most_cuts && share < 1.0; ++i) {
    Trial shorter = attempt(share * distance, usual);
    if (!shorter.converged || !smooth(shorter)) break;
    trial = std::move(shorter);
    distance *= share;
    share = states_.next_cut(now_, trial.point, distance);
  }
  if (states_.n_forced() > n_forced) remember(Remedy::states_at_once);
  step_ = std::min(step_, states_.next_length(distance));
  return trial;
}

void BranchWalker::remember(Remedy remedy) {
  remedies_.push_back({now_.solution.point.parameter, remedy});
}

bool BranchWalker::advance() {
  kink_.reset();
  at_tip_ = false;
  bool failed = false;
  int modest = residual_ ? modest_attempts : 0;
  while (step_ >= shortest_step) {
    Trial trial = attempt(step_, modest-- > 0 ? forces_alone : usual);
    // By factors of another place the determinant is not known to so short a step.
    const bool flips = trial.orientation * orientation_ < 0.0;
    const bool against = !residual_ && flips && trial.cosine > cosine_limit;
    const bool back = !residual_ && flips == (trial.cosine > 0.0);
    const double sharp = against ? tip_step : (back ? turning_step : kink_step);
    const bool kink = step_ < sharp && trial.correction < kink_correction;
    if (trial.converged && (kink || (smooth(trial) && !is_elsewhere_halfway(trial)))) {
      const std::optional<bool> tip = against ? beyond_a_tip(trial) : false;
      if (!tip) {
        step_ *= 0.5;
        continue;
      }
      trial.tip = *tip;
      trial.bent = flips && crosses_bent(trial);
      if (failed) remember(Remedy::shorter_step);
      const double distance = step_;
      at_tip_ = trial.tip;
      choose_step(trial);
      accept(trial.tip ? std::move(trial) : limited(std::move(trial), distance));
      return true;
    }
    failed = failed || !trial.converged;
    step_ *= 0.5;
  }
  return turn_at_kink() || leap();
}

Stall BranchWalker::stall() {
  constexpr double chattering = 1e-3;  // relative change of the Jacobian over a step of 1e-6
  constexpr double vertical = 0.1;     // share of the parameter in the tangent
  // That of the solution itself: its evaluation may have the derivatives of the guess.
  const BranchVector& at = now_.solution.point;
  const Eigen::MatrixXd here = system_(at.x, at.parameter).jacobian.dense();
  ++evaluations_;
  for (const double ahead : {-1e-6, 1e-6}) {
    const BranchVector probe = moved(now_.solution.point, now_.tangent, ahead, now_.scaling);
    const Eigen::MatrixXd there = system_(probe.x, probe.parameter).jacobian.dense();
    ++evaluations_;
    if (!((there - here).norm() <= chattering * here.norm())) return Stall::chatter;
  }
  return std::abs(now_.tangent.parameter) < vertical ? Stall::fold : Stall::newton;
}

bool BranchWalker::turn_at_kink() {
  // Where slip begins a branch may turn back sharply: no solution lies ahead in the old direction.
  // Just beyond the kink the Jacobian is that of the other regime; its null vector, with the sign
  // that keeps the orientation of the branch, points out of the kink (Allgower & Georg 1990,
  // section 2.1). Two events at once, as of a motion that changes sign after half a period, may
  // turn that sign by what breaks the symmetry.
  return orientation_ != 0.0 && (leave_kink(orientation_) || leave_kink(-orientation_));
}

/// Along a direction out of a kink lies a part of the branch whose tangent it is; the part that was
/// walked has another one. @param angle  versine of that between the direction and the old tangent.
bool BranchWalker::is_other_part(const Trial& trial, double angle) {
  constexpr double least_angle = 1e-4;  // 0.8°: below, the Jacobian has not jumped
  constexpr double much_less = 0.04;    // a fifth of the angle
  return angle > least_angle && 1.0 - trial.cosine < much_less * angle;
}

/// The Jacobian just beyond a kink is that of the regime in which the probe lies, straight on at
/// first. Where several events meet, the branch may go on in another: of a stuck point whose
/// friction falls with the speed, the force reaches its limit before and after each of its peaks at
/// once. The regime is the right one where its own null vector leads into it.
/// @param orientation  beyond the kink.
bool BranchWalker::leave_kink(double orientation) {
  constexpr int most_regimes = 4;
  constexpr double same_way = 1e-6;  // versine
  for (double beyond = 1e-7; beyond < 1e-2; beyond *= 10.0) {
    BranchVector towards = now_.tangent;
    for (int i = 0; i < most_regimes; ++i) {
      const BranchVector probe = moved(now_.solution.point, towards, beyond, now_.scaling);
      const BalanceEvaluation other = system_(probe.x, probe.parameter);
      ++evaluations_;
      std::optional<BranchVector> way = null_vector(other, now_.scaling, orientation);
      if (!way) break;
      if (i > 0 && 1.0 - dot(*way, towards) < same_way) break;
      if (leave_kink(*way, beyond, orientation)) return true;
      towards = std::move(*way);
    }
  }
  return false;
}

/// @param beyond  how far off the Jacobian was seen whose null vector `way` is.
bool BranchWalker::leave_kink(const BranchVector& way, double beyond, double orientation) {
  const double angle = 1.0 - std::abs(dot(way, now_.tangent));
  for (double distance = 30.0 * beyond; distance < 2e-2; distance *= 5.0) {
    Trial trial = attempt(way, distance, {15, any_number});
    const bool onward = trial.converged && trial.correction < 0.7 && trial.cosine > 0.5 &&
                        trial.orientation == orientation;
    if (!onward || (orientation != orientation_ && !is_other_part(trial, angle))) continue;
    remember(Remedy::kink_turn);
    kink_ = {now_.solution, way, now_.scaling};
    step_ = distance;
    accept(std::move(trial));
    return true;
  }
  return false;
}

bool BranchWalker::leap() {
  // A kink the corrector cannot cross in small steps may be crossed in a long one.
  for (double distance = 1e-5; distance < longest_leap; distance *= 3.0) {
    Trial trial = attempt(distance, {40, any_number});
    if (!trial.converged || trial.correction > 1.0) continue;
    remember(Remedy::long_step);
    step_ = std::min(distance, 1e-2);
    accept(std::move(trial));
    return true;
  }
  return false;
}

double BranchWalker::resolution() const { return residual_ ? sampled_share : exact_share; }

/// On the plane through the start across the chord.
std::optional<WalkerPoint> BranchWalker::corrected(const BranchVector& start,
                                                   const BranchVector& chord,
                                                   const WalkerPoint& nearby) {
  const Scaling& scaling = now_.scaling;
  // Next to a kink an iterate of the wrong side meets the usual tolerance, with the wrong tangent.
  NewtonResult solution = solved(start, chord, {.tolerance = tolerance_}, nearby);
  evaluations_ += solution.evaluations;
  iterations_ += solution.iterations;
  const double tolerance = std::max(tolerance_, scaling.rounding);
  if (!(solution.residual <= tolerance)) return std::nullopt;
  solution.converged = true;
  Tangent tangent = tangent_at(solution, chord, scaling);
  // Within a sharp turn the branch may run against the chord; the determinant tells.
  const bool known = orientation_ != 0.0 && orientation_ == before_orientation_;
  if (known && tangent.orientation == -orientation_) {
    tangent.direction.x = -tangent.direction.x;
    tangent.direction.parameter = -tangent.direction.parameter;
  }
  return WalkerPoint{std::move(solution), std::move(tangent.direction), scaling};
}

/// Beside the step that leaves a kink lies the part that was walked, and Newton's method may find
/// it: seen from the kink it is more than 45° off the chord, which the part ahead is not.
/// @param chord  of the step, of length one.
bool BranchWalker::strays(const WalkerPoint& point, const BranchVector& chord) const {
  const BranchVector way = difference(point.solution.point, before_.solution.point, now_.scaling);
  const double along = dot(way, chord);
  return 2.0 * along * along < dot(way, way);
}

std::optional<StepPoint> BranchWalker::between(const StepPoint& a, const StepPoint& b,
                                               double share) {
  const Scaling& scaling = now_.scaling;
  BranchVector chord = difference(now_.solution.point, before_.solution.point, scaling);
  const double size = length(chord);
  if (size == 0.0) return std::nullopt;
  chord.x /= size;
  chord.parameter /= size;
  const double width = b.share - a.share;
  const double u = (share - a.share) / width;
  for (const BranchVector& start : starts_between(Knot(a.point, chord, size, scaling),
                                                  Knot(b.point, chord, size, scaling), u, width)) {
    auto point = corrected(start, chord, u < 0.5 ? a.point : b.point);
    if (!point || (kink_ && strays(*point, chord))) continue;
    return StepPoint{share, std::move(*point)};
  }
  return std::nullopt;
}

NewtonResult BranchWalker::at_parameter(double parameter, double share) {
  const auto& a = before_.solution.point;
  const auto& b = now_.solution.point;
  const NewtonOptions options{.tolerance = tolerance_, .max_iterations = 30};
  NewtonResult result =
      solve_newton(system_, {a.x + share * (b.x - a.x), parameter}, now_.scaling, options);
  evaluations_ += result.evaluations;
  iterations_ += result.iterations;
  return result;
}

}  // namespace microslip::solver
