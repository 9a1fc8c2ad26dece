/// @file
/// Axes of a contact on a surface: one set everywhere, or one for every place of a face that is
/// curved (theory section 1).
///
///   q = n,   p = (s − (s·n) n)/|s − (s·n) n|,   r = p × q,      n the outward normal of a place, s
///                                                               the slip direction
#pragma once

#include <optional>
#include <utility>

#include <Eigen/Core>

namespace microslip::mesh {

/// Rows p, q, r at a place with outward unit normal `normal`. @param slip_direction  not along it.
[[nodiscard]] Eigen::Matrix3d axes_at(const Eigen::Vector3d& normal,
                                      const Eigen::Vector3d& slip_direction);

struct FaceFrame {
  Eigen::Matrix3d plane = Eigen::Matrix3d::Identity();  ///< rows p, q, r of the face as a whole
  /// Of which each place makes axes of its own; none: those of the face.
  std::optional<Eigen::Vector3d> slip_direction;

  FaceFrame() = default;
  FaceFrame(Eigen::Matrix3d everywhere) : plane(std::move(everywhere)) {}
  FaceFrame(Eigen::Matrix3d of_the_face, Eigen::Vector3d of_places)
      : plane(std::move(of_the_face)), slip_direction(std::move(of_places)) {}

  [[nodiscard]] bool is_local() const { return slip_direction.has_value(); }
  [[nodiscard]] Eigen::Matrix3d at(const Eigen::Vector3d& normal) const {
    return slip_direction ? axes_at(normal, *slip_direction) : plane;
  }
};

}  // namespace microslip::mesh
