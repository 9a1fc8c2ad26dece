#include "contact/force/fitted_patch_force.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/force/patch_force.hpp"

namespace microslip::contact {
namespace {

void require_valid(const FittedPatchOptions& options) {
  if (!(options.force_tolerance > 0.0)) {
    throw std::invalid_argument("FittedPatchForce: force_tolerance " +
                                std::to_string(options.force_tolerance) + ", must be above 0");
  }
  if (options.max_refits < 1) {
    throw std::invalid_argument("FittedPatchForce: max_refits " +
                                std::to_string(options.max_refits) + ", must be at least 1");
  }
}

// 0 where nothing can push: no contact and no motion either.
double relative_change(const ModalForce& force, const Harmonics& q, const Eigen::VectorXd& before,
                       const Eigen::VectorXd& after) {
  const double stuck = (q.rows() * force.stuck_stiffness()).norm();
  const double scale = std::max(after.norm(), stuck);
  return scale > 0.0 ? (after - before).norm() / scale : 0.0;
}

}  // namespace

FittedPatchForce::FittedPatchForce(PatchCells cells, ShapeField shapes, ParameterField parameters,
                                   const FittedPatchOptions& options, MakeForce make_force)
    : cells_(std::move(cells)),
      shapes_(std::move(shapes)),
      parameters_(std::move(parameters)),
      options_(options),
      make_force_(std::move(make_force)),
      rule_(gauss_rule(cells_, options.rule.order)) {
  require_valid(options_);
  force_ = force_on(rule_);
}

FittedPatchForce::FittedPatchForce(PatchCells cells, ShapeField shapes, ParameterField parameters,
                                   const FittedPatchOptions& options)
    : FittedPatchForce(std::move(cells), std::move(shapes), std::move(parameters), options,
                       [](ContactPatch patch, ModalShapes at) -> std::unique_ptr<ModalForce> {
                         return std::make_unique<PatchForce>(std::move(patch), std::move(at));
                       }) {}

void FittedPatchForce::begin_point() {
  previous_.clear();
  n_refits_ = 0;
}

Refit FittedPatchForce::refit(const std::vector<Motion>& motions) {
  PatchRule rule = fitted_to(motions);
  std::unique_ptr<ModalForce> force = force_on(rule);
  Refit result{Refit::Outcome::kept, 0.0, rule_.n_points()};
  for (const Motion& motion : motions) {
    result.change = std::max(
        result.change, relative_change(*force, motion.q,
                                       force_->evaluate(motion.q, motion.frequency).force.vector(),
                                       force->evaluate(motion.q, motion.frequency).force.vector()));
  }
  if (result.change <= options_.force_tolerance) return result;
  if (n_refits_ >= options_.max_refits) {
    result.outcome = Refit::Outcome::exhausted;
    return result;
  }
  ++n_refits_;
  previous_ = motions;
  replaced_ = Replaced{std::move(rule_), std::move(force_)};
  rule_ = std::move(rule);
  force_ = std::move(force);
  return {Refit::Outcome::replaced, result.change, rule_.n_points()};
}

void FittedPatchForce::undo_refit() {
  if (!replaced_) return;
  rule_ = std::move(replaced_->rule);
  force_ = std::move(replaced_->force);
  replaced_.reset();
}

PatchRule FittedPatchForce::fitted_to(const std::vector<Motion>& motions) const {
  std::vector<Harmonics> states;
  for (const Motion& motion : motions) states.push_back(motion.q);
  // The first refit of a point moves the lines. If that is not enough they may appear and vanish in
  // turn: those of the result before stay, and more points per piece may be what is missing.
  if (n_refits_ > 1) {
    for (const Motion& motion : previous_) states.push_back(motion.q);
  }
  FittedRuleOptions options = options_.rule;
  options.order += 2 * std::max(0, n_refits_ - 1);
  return fitted_rule(cells_, regime_guards(shapes_, parameters_, std::move(states)), options);
}

std::unique_ptr<ModalForce> FittedPatchForce::force_on(const PatchRule& rule) const {
  return make_force_(ContactPatch(rule.weights, parameters_(rule.p, rule.r)),
                     shapes_(rule.p, rule.r));
}

}  // namespace microslip::contact
