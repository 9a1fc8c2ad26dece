/// @file
/// Axes of the contact faces of a mesh (theory section 1): those of a face as a whole, and whether
/// its places have their own (the effect `local_frames`).
#pragma once

#include <Eigen/Core>

#include "mesh/face_frame.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// off_plane() of a plane face, whose frame is that of every place: what a mesher rounds [-].
inline constexpr double plane_to_rounding = 1e-9;

/// Largest distance of a node from the mean plane of the face, over its size [-].
[[nodiscard]] double off_plane(const mesh::Mesh& mesh, const ContactDescription& contact);

/// Whether every place has axes of its own: as the scene says, else where the face is not plane.
[[nodiscard]] bool has_local_frames(const mesh::Mesh& mesh, const ContactDescription& contact);

/// Of the face as a whole: rows p (slip direction in the mean plane), q (its outward normal), r = p
/// × q. Where places have axes of their own this is for coordinates along the face alone, p then
/// any direction if the slip direction is along q.
/// @throws SceneError  slip direction along the normal of a face that is taken as plane.
[[nodiscard]] Eigen::Matrix3d contact_frame(const mesh::Mesh& mesh,
                                            const ContactDescription& contact);

/// What tells p, q and r at every place.   @throws SceneError  as contact_frame().
[[nodiscard]] mesh::FaceFrame face_frame(const mesh::Mesh& mesh, const ContactDescription& contact);

/// Along p and r of a frame, from an origin [m], n each.
struct PlaneCoordinates {
  Eigen::VectorXd p;
  Eigen::VectorXd r;
};
[[nodiscard]] PlaneCoordinates in_plane(const Eigen::MatrixX3d& points,
                                        const Eigen::Vector3d& origin,
                                        const Eigen::Matrix3d& frame);

/// The place of a face where the slip direction is nearest to the normal.
struct SteepestPlace {
  double sine = 1.0;  ///< of the angle between slip direction and normal
  Eigen::Vector3d place, normal;
};
[[nodiscard]] SteepestPlace steepest_place(const mesh::Mesh& mesh,
                                           const ContactDescription& contact);

/// @throws SceneError  a slip direction along the normal of a plane face, or nearly so at some
///         place of a curved one; what the scene asks for of a face that is not plane and takes a
///         plane: contact.fit, contact.preload_moment.
void require_frames(const mesh::Mesh& mesh, const SceneDescription& scene);

}  // namespace microslip::pipelines
