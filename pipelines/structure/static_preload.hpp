/// @file
/// The preload that static loads make (theory section 2.1): the finite elements are condensed to
/// the normal freedoms of the contact faces, on which a contact that cannot pull is solved without
/// friction. All contacts of a scene together: one that closes moves the others.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/patch/elastic_rest.hpp"
#include "fem/modal_analysis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Nodes of the contact faces, one after the other, along the outward normal of their face.
/// @param structure  of the scene, rotating where it does: its factorisation is used.
/// @param rotated    displacement of the rotating body, 3 n_nodes [m]; empty: at rest.
/// @throws RefusedError  the supports leave the body a rigid motion.
/// @note One static solution per node of the faces.
[[nodiscard]] contact::ElasticFace static_face(fem::Structure& structure, const mesh::Mesh& mesh,
                                               const SceneDescription& scene,
                                               const Eigen::VectorXd& rotated);

/// The same, solved for: one more factorisation than the modes take.
/// @param rotated  as above, where it is known; empty: it is found.
/// @throws RefusedError, fem::EigenError  as above, fem::Structure::rotate(); on several MPI ranks.
[[nodiscard]] contact::ElasticFace static_face(const mesh::Mesh& mesh,
                                               const SceneDescription& scene,
                                               Eigen::VectorXd rotated = {});

/// What static_face() follows from beside the structure itself, as bytes.
[[nodiscard]] std::string static_inputs(const mesh::Mesh& mesh, const SceneDescription& scene);

/// Gives the patches of a model the preload that the face carries, at 1 N in all, and the model its
/// total. Open points have gaps.
/// @throws RefusedError  no contact is pressed; with the distances that are left.
void set_static_preload(ReducedModel& model, const mesh::Mesh& mesh, const SceneDescription& scene,
                        const contact::ElasticFace& face);

/// What is unusual of it: few points that are closed, a pressure that nothing bears. Sentences.
/// @param model  as set_static_preload() has left it.
[[nodiscard]] std::vector<std::string> static_preload_questions(const ReducedModel& model,
                                                                const SceneDescription& scene);

/// A line per contact: force, pressures, gaps, the share that is open.
/// @throws RefusedError  as set_static_preload().
[[nodiscard]] std::string describe_static_preload(const mesh::Mesh& mesh,
                                                  const SceneDescription& scene,
                                                  const contact::ElasticFace& face);

/// The same, solved for: a static solution of the finite elements.
/// @throws RefusedError, fem::EigenError  as static_face(), fem::Structure::rotate().
[[nodiscard]] std::string describe_static_preload(const mesh::Mesh& mesh,
                                                  const SceneDescription& scene);

}  // namespace microslip::pipelines
