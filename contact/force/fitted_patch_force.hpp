/// @file
/// Force of a patch whose quadrature follows the lines between stick, slip and separation (theory
/// section 13). The rule depends on the motion, so it is frozen while an iteration runs and fitted anew
/// to its result:
///
///   force.begin_point();
///   do { q = solve(force); } while (force.refit({{q, ω}}).outcome == Refit::Outcome::replaced);
///
/// A result stands when the force on a rule fitted to it differs by less than the tolerance. Near the
/// solution a rule fitted to the previous result errs with the square of what the lines moved, so one or
/// two refits are the rule. Lines that appear, close or touch an edge between two results cannot make it
/// cycle: from the second refit of a point on the rule keeps the lines of the previous result as well,
/// the order rises, and the number of refits is bounded.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/force/fitted_rule.hpp"
#include "contact/modal_force.hpp"
#include "contact/force/regime_guards.hpp"

namespace microslip::contact {

struct FittedPatchOptions {
  FittedRuleOptions rule;
  double force_tolerance = 1e-6;  ///< of Refit::change, > 0
  int max_refits = 4;             ///< for one solution point, ≥ 1
};

class FittedPatchForce final : public ModalForce {
 public:
  /// Makes the force on given points, e.g. PatchForce.
  using MakeForce = std::function<std::unique_ptr<ModalForce>(ContactPatch, ModalShapes)>;

  /// Starts with Gauss points on the cells.
  /// @param cells       the patch; few large cells are enough where fields are smooth.
  /// @param shapes      mode shapes anywhere on it.   @param parameters  constants likewise.
  /// @param make_force  the law of the points.
  /// @throws std::invalid_argument  an option out of range; as gauss_rule(), ContactPatch, make_force.
  FittedPatchForce(PatchCells cells, ShapeField shapes, ParameterField parameters,
                   const FittedPatchOptions& options, MakeForce make_force);
  /// With PatchForce.
  FittedPatchForce(PatchCells cells, ShapeField shapes, ParameterField parameters,
                   const FittedPatchOptions& options);

  [[nodiscard]] Eigen::Index n_modes() const override { return force_->n_modes(); }
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency) const override {
    return force_->evaluate(q, frequency);
  }
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) const override {
    return force_->report(q, frequency);
  }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return force_->stuck_stiffness();
  }
  /// Of the points of the rule in use.
  void states(const Harmonics& q, double frequency, ContactStates& result) const override {
    force_->states(q, frequency, result);
  }
  // linear_state() stays unknown: what is proved of the points of a rule is not proved between them, and
  // the next rule has others.

  /// The rule stays.
  void begin_point() override;
  /// @param motions  H = 1 each, at least one; the rule follows the lines of all of them.
  [[nodiscard]] Refit refit(const std::vector<Motion>& motions) override;
  [[nodiscard]] Refit refit(const Harmonics& q, double frequency) {
    return refit(std::vector<Motion>{{q, frequency}});
  }
  void undo_refit() override;

  [[nodiscard]] const PatchRule& rule() const { return rule_; }
  [[nodiscard]] const ModalForce& force() const { return *force_; }

 private:
  [[nodiscard]] PatchRule fitted_to(const std::vector<Motion>& motions) const;
  [[nodiscard]] std::unique_ptr<ModalForce> force_on(const PatchRule& rule) const;

  PatchCells cells_;
  ShapeField shapes_;
  ParameterField parameters_;
  FittedPatchOptions options_;
  MakeForce make_force_;
  PatchRule rule_;
  std::unique_ptr<ModalForce> force_;
  std::vector<Motion> previous_;  // what the rule was last fitted to for this point
  struct Replaced {
    PatchRule rule;
    std::unique_ptr<ModalForce> force;
  };
  std::optional<Replaced> replaced_;  // by the last refit
  int n_refits_ = 0;
};

}  // namespace microslip::contact
