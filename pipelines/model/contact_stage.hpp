/// @file
/// The corridor between the wings: what is left of the finite elements on the contact face becomes
/// plain arrays the response stage can use (theory sections 1, 2, 13, 14).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// 1/k = 1/k_local + c (theory section 14). @param local  no value: rigid.
/// @param direction  for messages.
/// @param refuse  else a stiffness that is not positive stays, for those who need it to refuse.
[[nodiscard]] Eigen::VectorXd series_stiffness(const std::optional<double>& local,
                                               const Eigen::VectorXd& residual,
                                               const char* direction, bool refuse);

/// Reduced model of a meshed structure: one patch per contact of the scene.
/// @param residuals  row sums on the contact surfaces, one each; empty: local stiffness alone.
/// @param warnings  sentences for the log are appended.
/// @throws SceneError    an unknown name, a slip direction along the normal.
/// @throws RefusedError  a contact stiffness that is not positive (theory section 14).
[[nodiscard]] ReducedModel reduce_to_contact(const mesh::Mesh& mesh, const SceneDescription& scene,
                                             const fem::ModalBasis& basis,
                                             const std::vector<fem::ResidualFlexibility>& residuals,
                                             std::vector<std::string>& warnings);

/// Reduced model of a modal scene: the numbers it gives, its points as one patch.
/// @param scene  of a kind without mesh.
[[nodiscard]] ReducedModel reduced_model(const SceneDescription& scene);

}  // namespace microslip::pipelines
