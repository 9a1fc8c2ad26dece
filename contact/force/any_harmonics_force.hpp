/// @file
/// The force of a patch with one tangential direction for any number of harmonics: the closed form where
/// the motion has one (patch_force.hpp), cycles found event by event beyond (event_law.hpp). Both are exact,
/// so that a solver may change the number of harmonics from point to point and pays for those it has.
#pragma once

#include <vector>

#include "contact/force/law_patch_force.hpp"
#include "contact/force/patch_force.hpp"

namespace microslip::contact {

class AnyHarmonicsForce final : public ModalForce {
 public:
  /// @param patch   points, n_points.
  /// @param shapes  relative mode shapes at the points, n_points × n_modes; w is not used.
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  AnyHarmonicsForce(const ContactPatch& patch, const ModalShapes& shapes);

  [[nodiscard]] Eigen::Index n_modes() const override { return closed_.n_modes(); }
  /// @throws std::invalid_argument  another number of modes, or no harmonic.
  [[nodiscard]] ForceAndJacobian evaluate(const Harmonics& q, double frequency) const override;
  [[nodiscard]] ForceAndJacobian evaluate_rows(
      const Harmonics& q, double frequency, const std::vector<Eigen::Index>& rows) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] Harmonics force_up_to(const Harmonics& q, double frequency,
                                      int n_harmonics) const override;
  /// @throws std::invalid_argument  as evaluate().
  [[nodiscard]] CycleReport report(const Harmonics& q, double frequency) const override;
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override;
  /// @throws std::invalid_argument  as evaluate().
  void states(const Harmonics& q, double frequency, ContactStates& result) const override;
  [[nodiscard]] LinearState linear_state(const Harmonics& centre, double radius) const override;

 private:
  PatchForce closed_;
  LawPatchForce events_;
};

}  // namespace microslip::contact
