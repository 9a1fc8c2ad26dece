/// @file
/// One question to a study: what is measured, what of it is usual, what may have gone wrong.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// What is known at a stage; nullptr: later.
struct Facts {
  const SceneDescription& scene;
  const mesh::Mesh* mesh = nullptr;
  const ReducedModel* model = nullptr;
  const std::vector<CurveResult>* curves = nullptr;
};

struct Finding {
  std::string key;
  double value = 0.0;   ///< in the unit of its question
  std::string where{};  ///< what the value is of, in words after it
};
using Findings = std::vector<Finding>;

/// Asked where a finding is below `low` or above `high`.
struct Question {
  const char* quantity;
  const char* unit;
  double low, high;   ///< usual
  const char* usual;  ///< examples, "": none
  const char* remedy;
  Findings (*measure)(const Facts&);
  bool is_of_units = false;  ///< what was most likely written in another unit: modes say nothing
};

inline constexpr double unlimited = std::numeric_limits<double>::infinity();
inline constexpr double percent = 100.0;
inline constexpr double least_contact_stiffness = 1e6;  // [N/m³]: softer than any joint

inline bool is_meshed(const SceneDescription& scene) {
  return !std::holds_alternative<ModalModel>(scene.model);
}

/// To what a scene says by itself.
[[nodiscard]] std::span<const Question> scene_questions();
/// To what it says of its mesh; the facts have one, with all names of the scene.
[[nodiscard]] std::span<const Question> mesh_questions();
/// To what its modes say of range and contact; the facts have a model with its effects.
[[nodiscard]] std::span<const Question> modes_questions();
/// To what its curves say; the facts have a mesh and curves.
[[nodiscard]] std::span<const Question> curve_questions();

}  // namespace microslip::pipelines
