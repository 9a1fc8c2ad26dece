/// @file
/// A second pair of eyes: what no blade has is questioned, never refused. Every question is a row
/// of the tables beside: a quantity, what is usual, the key that says it,
/// and what may have gone wrong.
///
/// A question is one line: "material.youngs_modulus: Young's modulus is 210 Pa; usual is 1e+09 to
/// 1e+12 Pa (…): …". Scenes without a mesh may be in any units:
/// of them only what has no unit is questioned.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/record/progress.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// What a scene says by itself.
[[nodiscard]] std::vector<std::string> questions(const SceneDescription& scene);

/// What it says of its mesh. @param mesh  that has all names of the scene.
[[nodiscard]] std::vector<std::string> questions(const SceneDescription& scene,
                                                 const mesh::Mesh& mesh);

/// Whether material, size or contact stiffness are what no blade has, most likely for a unit that
/// is not the one written: modes of such a scene tell nothing.   @param mesh  as above.
[[nodiscard]] bool may_be_in_other_units(const SceneDescription& scene, const mesh::Mesh& mesh);

/// What the modes say of the frequency range and of the contact. @param model  with its effects.
[[nodiscard]] std::vector<std::string> questions(const SceneDescription& scene,
                                                 const ReducedModel& model);

/// What the curves say.
[[nodiscard]] std::vector<std::string> questions(const SceneDescription& scene,
                                                 const mesh::Mesh& mesh,
                                                 const std::vector<CurveResult>& curves);

/// The same as warnings.
template <typename... What>
void ask(Progress& progress, const What&... what) {
  for (const std::string& question : questions(what...)) progress.warning(question);
}

}  // namespace microslip::pipelines
