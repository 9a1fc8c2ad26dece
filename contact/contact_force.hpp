/// @file
/// The one place where it is chosen how the points of a contact are evaluated, and the one object
/// that answers for them: the force for harmonic balance, the force for integration in time, the
/// history for maps, what is carried at rest. All of them see the same points under the same load
/// with the same effects.
///
///   one harmonic, one direction, plain surfaces    closed form (theory sections 3, 4)
///   48 points or more, of other surfaces or in     the period sampled, all points in lanes
///   two directions 9 or more                       (contact/sampled)
///   else                                           each point event by event (contact/line,
///                                                  contact/plane)
///
/// Several patches are one force whose points are those of all patches in order.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "contact/contact_effects.hpp"
#include "contact/contact_map.hpp"
#include "contact/modal_force.hpp"
#include "contact/motion_coordinates.hpp"
#include "contact/patch.hpp"
#include "contact/surface/surface_law.hpp"
#include "contact/transient_force.hpp"

namespace microslip::contact {

/// Where a patch is sampled.
enum class Places { cells, vertices };

/// Load of a contact at rest [N], over all its points.
struct RestingLoad {
  double carried = 0.0;      ///< ∬ max(n₀', 0) dA
  double integral = 0.0;     ///< ∬ n₀' dA, gaps counted as pull
  bool partly_open = false;  ///< presses on a part, a gap on another
};

/// How points are evaluated. Another method for whole patches (contact/sampled) is one more name
/// here, its condition in method_for() and its case in ContactForce::force_of(), which has weights,
/// shapes and surfaces() of all points.
enum class Method { closed_form, lanes, point_methods };

/// The choice. @param n_points  of all patches together.
/// @param plain  one direction, constant friction, smooth surfaces everywhere.
[[nodiscard]] Method method_for(Eigen::Index n_points, bool plain, int n_harmonics);

/// One direction, constant friction, smooth surfaces everywhere.
[[nodiscard]] bool are_plain(std::span<const Patch> patches, const ContactEffects& effects);

/// Whether forces of the patches are sampled in time, in lanes (contact/sampled), instead of
/// located event by event: where several harmonics meet many points.
[[nodiscard]] bool is_sampled(std::span<const Patch> patches, const ContactEffects& effects);

/// Of a period.
inline constexpr int most_instants = 2048;

/// Instants of a period, of forces that are sampled: with the third power of the step where
/// surfaces are smooth and points move along one line (sampled/kinks.hpp), with the second
/// elsewhere, they err by less than the tolerance of the effects, but where points slip deeply or
/// would need more than most.
[[nodiscard]] int instants_of(std::span<const Patch> patches, const ContactEffects& effects);

class ContactForce {
 public:
  /// @param patches  of one scene, ≥ 1; borrowed for the life of this object, not of what it gives.
  /// @param load     of a curve, by the measure of the patches (patch/patch_load.hpp).
  /// @param coordinates  of forces sampled in time, of as many modes as the patches have.
  /// @throws LoadError  no such load.
  /// @throws std::invalid_argument  a constant out of its range.
  ContactForce(const std::vector<Patch>& patches, const ContactEffects& effects, double load,
               MotionCoordinates coordinates = {});

  /// Of all patches together.
  [[nodiscard]] std::unique_ptr<ModalForce> modal_force() const;
  /// Of one alone, e.g. for its report.
  [[nodiscard]] std::unique_ptr<ModalForce> modal_force(std::size_t patch) const;
  [[nodiscard]] std::unique_ptr<TransientForce> transient_force() const;

  /// What every place of a patch does over a period.
  /// @param q          a solution [m√kg], as many harmonics as it has.
  /// @param frequency  ω [rad/s].
  /// @param n_phases   ≥ 1.
  /// @throws LoadError, std::invalid_argument  as the constructor, of the vertices.
  [[nodiscard]] ContactMap map(std::size_t patch, Places places, const Harmonics& q,
                               double frequency, int n_phases) const;

  [[nodiscard]] RestingLoad at_rest() const;
  /// Constants of the contact points of a patch under the load.
  [[nodiscard]] const std::vector<PointParameters>& points(std::size_t patch) const {
    return points_[patch];
  }

 private:
  [[nodiscard]] std::unique_ptr<ModalForce> force_of(std::size_t begin, std::size_t end) const;
  /// With the mean of the motion, or without.
  [[nodiscard]] std::unique_ptr<ModalForce> as_coupled(std::unique_ptr<ModalForce> force) const;
  /// Of the points of these patches, in order.
  [[nodiscard]] std::vector<SurfaceLaw> surfaces(std::size_t begin, std::size_t end) const;

  const std::vector<Patch>& patches_;
  ContactEffects effects_;
  double load_;
  MotionCoordinates coordinates_;
  std::vector<std::vector<PointParameters>> points_;  // of the cells, per patch
};

}  // namespace microslip::contact
