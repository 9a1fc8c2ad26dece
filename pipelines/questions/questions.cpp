#include "pipelines/questions/questions.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "pipelines/import/mesh_file.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/questions/question.hpp"

namespace microslip::pipelines {
namespace {

std::string usual_text(const Question& question) {
  std::string text = question.low == question.high ? fmt::format("{:g}", question.high)
                     : question.high == unlimited  ? fmt::format("at least {:g}", question.low)
                     : question.low == 0.0
                         ? fmt::format("at most {:g}", question.high)
                         : fmt::format("{:g} to {:g}", question.low, question.high);
  if (*question.unit != 0) text += fmt::format(" {}", question.unit);
  if (*question.usual != 0) text += fmt::format(" ({})", question.usual);
  return text;
}

/// "is" stands between a quantity and its value unless the quantity brings its verb.
std::string sentence(const Question& question, const Finding& finding) {
  const std::string_view quantity = question.quantity;
  const bool has_verb = quantity.ends_with("is") || quantity.ends_with("be") ||
                        quantity.ends_with("given") || quantity.ends_with("rises") ||
                        quantity.ends_with("reaches") || quantity.ends_with("from");
  std::string text =
      fmt::format("{}: {} {}{:.4g}", finding.key, quantity, has_verb ? "" : "is ", finding.value);
  if (*question.unit != 0) text += fmt::format(" {}", question.unit);
  if (!finding.where.empty()) text += " " + finding.where;
  return text + fmt::format("; usual is {}: {}", usual_text(question), question.remedy);
}

bool is_usual(const Question& question, const Finding& finding) {
  return finding.value >= question.low && finding.value <= question.high;
}

std::vector<std::string> asked(std::span<const Question> questions, const Facts& facts) {
  std::vector<std::string> sentences;
  for (const Question& question : questions) {
    for (const Finding& finding : question.measure(facts)) {
      if (!is_usual(question, finding)) sentences.push_back(sentence(question, finding));
    }
  }
  return sentences;
}

/// Whether anything was most likely written in another unit.
bool any_of_units(std::span<const Question> questions, const Facts& facts) {
  return std::ranges::any_of(questions, [&](const Question& question) {
    return question.is_of_units && std::ranges::any_of(question.measure(facts), [&](const auto& f) {
             return !is_usual(question, f);
           });
  });
}

/// The file counts. @return "": the scene says the same, or nothing
std::string order_question(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const auto* file = std::get_if<MeshFileModel>(&scene.model);
  if (file == nullptr || !file->order || file->midside_nodes) return {};
  const mesh::ElementType type = mesh.elements().front().type;
  const int order = mesh::is_quadratic(type) ? 2 : 1;
  if (order == *file->order) return {};
  return fmt::format(
      "model.order: {} is written, the elements of {} are of order {} ({}), and are taken as they "
      "are: is it the file that is meant?",
      *file->order, file->file.filename().string(), order, name(type));
}

/// Of a STEP file; those of meshes are among the remarks of the mesh.
std::string step_unit_question(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const auto* step = std::get_if<StepModel>(&scene.model);
  return step == nullptr ? std::string{}
                         : unit_question(step->file, step->length_unit, unit_of_file(*step),
                                         mesh.longest_side() / step->length_unit.value_or(1.0));
}

}  // namespace

std::vector<std::string> questions(const SceneDescription& scene) {
  return asked(scene_questions(), {.scene = scene});
}

std::vector<std::string> questions(const SceneDescription& scene, const mesh::Mesh& mesh) {
  std::vector<std::string> sentences = mesh.remarks();
  for (const std::string& question :
       {order_question(scene, mesh), step_unit_question(scene, mesh)}) {
    if (!question.empty()) sentences.push_back(question);
  }
  for (std::string& sentence : asked(mesh_questions(), {.scene = scene, .mesh = &mesh})) {
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

bool may_be_in_other_units(const SceneDescription& scene, const mesh::Mesh& mesh) {
  const Facts facts{.scene = scene, .mesh = &mesh};
  return any_of_units(scene_questions(), facts) || any_of_units(mesh_questions(), facts);
}

std::vector<std::string> questions(const SceneDescription& scene, const ReducedModel& model) {
  return asked(modes_questions(), {.scene = scene, .model = &model});
}

std::vector<std::string> questions(const SceneDescription& scene, const mesh::Mesh& mesh,
                                   const std::vector<CurveResult>& curves) {
  return asked(curve_questions(), {.scene = scene, .mesh = &mesh, .curves = &curves});
}

}  // namespace microslip::pipelines
