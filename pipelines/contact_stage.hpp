/// @file
/// The corridor between the wings: what is left of the finite elements on the contact face becomes
/// plain arrays the response stage can use (theory sections 1, 2, 13, 14).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/run_results.hpp"
#include "pipelines/scene_description.hpp"

namespace microslip::pipelines {

/// Frame of a patch: rows p (slip direction in the plane), q (outward normal), r = p × q.
/// @throws SceneError  slip direction along the normal, or a face that is not plane.
[[nodiscard]] Eigen::Matrix3d contact_frame(const mesh::Mesh& mesh,
                                            const ContactDescription& contact);

/// Area-weighted mean of the contact points [m].
[[nodiscard]] Eigen::Vector3d patch_centroid(const ReducedModel& model);

/// 1/k = 1/k_local + c (theory section 14). @param local  no value: rigid.
/// @param direction  for messages.
/// @param refuse  else a stiffness that is not positive stays, for those who need it to refuse.
[[nodiscard]] Eigen::VectorXd series_stiffness(const std::optional<double>& local,
                                               const Eigen::VectorXd& residual,
                                               const char* direction, bool refuse);

/// Damping ratio of each mode. Attachment shapes take the last ratio of a list.
/// @param frequency  ω_n [rad/s].   @param n_attachment  so many of them, the last, are attachment shapes.
/// @throws SceneError  a list of another length than the modes, or α ≠ 0 with a rigid-body mode.
[[nodiscard]] Eigen::VectorXd damping_ratios(const ModesDescription& modes,
                                             const Eigen::VectorXd& frequency,
                                             Eigen::Index n_attachment = 0);

/// Reduced model of a meshed structure. Without a contact the contact arrays are empty.
/// @param residual  row sums on the contact surface; nullptr: local stiffness alone.
/// @param warnings  sentences for the log are appended.
/// @throws SceneError    an unknown name, a face that is not plane.
/// @throws RefusedError  a contact stiffness that is not positive (theory section 14).
[[nodiscard]] ReducedModel reduce_to_contact(const mesh::Mesh& mesh, const SceneDescription& scene,
                                             const fem::ModalBasis& basis,
                                             const fem::ResidualFlexibility* residual,
                                             std::vector<std::string>& warnings);

/// Reduced model of a modal scene: the numbers it gives.
[[nodiscard]] ReducedModel reduced_model(const ModalModel& modal);

}  // namespace microslip::pipelines
