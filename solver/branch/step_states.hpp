/// @file
/// How far a step along the branch may go before too much of the contact has changed its state:
/// what happens between two points of a curve is then seen on it.
///
///   many points   (area × period) that changes its state ≤ 20 %                                (1)
///   up to 32      no point changes it for more than a part of its period: one that turns its
///                 phases round moves the whole curve, though its kind of cycle is the same at both
///                 ends
///   up to 8       the step ends just beyond the first point whose kind of cycle changes: a kink of
///                 the branch
///
/// Where in a step that happens is read from the cubic through both ends: nothing is solved for. A
/// step is never cut below a least length, which grows while one step after another is cut: states
/// that chatter slow the walk down for a few steps and cannot stop it.
///
/// Source: theory section 16.
#pragma once

#include <functional>
#include <utility>

#include <Eigen/Core>

#include "contact/modal_force.hpp"
#include "solver/branch/branch_geometry.hpp"

namespace microslip::solver {

/// States of the contact at a point; @param result  written whole, empty: not told.
using StateReader = std::function<void(const BranchVector& at, contact::ContactStates& result)>;

class StepStates {
 public:
  /// Without a reader no step is ever cut.
  explicit StepStates(StateReader reader = {}) : reader_(std::move(reader)) {}

  /// A step that has converged.
  /// @return share of its length at which it should end; 1: it may stay.
  [[nodiscard]] double first_cut(const WalkerPoint& from, const WalkerPoint& to, double length);
  /// The same for a step that has been cut: it may end beyond one change.
  [[nodiscard]] double next_cut(const WalkerPoint& from, const WalkerPoint& to, double length);
  /// Most that the next step should have so that (1) holds. @param length  of the step accepted.
  [[nodiscard]] double next_length(double length) const;

  /// Steps that were cut, and those that change more than (1) all the same, at once.
  [[nodiscard]] long n_cuts() const { return n_cuts_; }
  [[nodiscard]] long n_forced() const { return n_forced_; }
  /// Times the reader was asked.
  [[nodiscard]] long n_readings() const { return n_readings_; }

 private:
  enum class Bound { wanted, bearable };
  /// On the way of a step, and what has changed up to there.
  struct Place {
    double share = 0.0;
    contact::StateChange change;
  };

  [[nodiscard]] bool exceeds(const contact::StateChange& change, Bound bound) const;
  [[nodiscard]] bool is_few() const;
  void read(const BranchVector& at, contact::ContactStates& result);
  void read_ends(const BranchVector& from, const BranchVector& to);
  [[nodiscard]] Place look(const BranchVector& at, double share);
  /// Share of the step that keeps a bound; 1: all of it does.
  [[nodiscard]] double located(const WalkerPoint& from, const WalkerPoint& to, Bound bound);
  [[nodiscard]] double cut(double share, double length);
  /// @param patient  as long as few steps were cut.
  [[nodiscard]] double least_length(double patient) const;

  StateReader reader_;
  contact::ContactStates before_;
  contact::ContactStates after_;
  contact::ContactStates between_;
  BranchVector before_at_;
  BranchVector after_at_;
  contact::StateChange change_;  // over the step looked at last
  bool is_at_once_ = false;      // more than (1) within the shortest length
  int impatience_ = 0;
  long n_cuts_ = 0;
  long n_forced_ = 0;
  long n_readings_ = 0;
};

}  // namespace microslip::solver
