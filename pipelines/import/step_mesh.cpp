#include "pipelines/import/step_mesh.hpp"

#include <fmt/format.h>

#include "mesh/mesh_error.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/import/face_choice.hpp"
#include "pipelines/import/mesher_limits.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "pipelines/text/required_file.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

std::string unit_names(const std::vector<mesh::StepUnit>& units) {
  std::string text;
  for (const mesh::StepUnit& unit : units) text += (text.empty() ? "" : " and ") + unit.name;
  return text;
}

std::string says_unit(const fs::path& file, const std::vector<mesh::StepUnit>& units) {
  return fmt::format("{}: {}", file.filename().string(),
                     units.empty() ? "the file does not say its unit of length"
                                   : "lengths in " + unit_names(units));
}

void require_unit(const StepModel& model, const std::vector<mesh::StepUnit>& units) {
  const std::string name = model.file.filename().string();
  if (units.empty() && !model.length_unit) {
    throw SceneError(fmt::format(
        "{}: is missing, and {} does not say in which unit its lengths are; write length_unit = "
        "\"mm\", \"m\", \"in\" or what it is",
        model.length_place, name));
  }
  if (units.size() > 1 && model.length_unit) {
    throw SceneError(
        fmt::format("{}: {} has lengths in {}: one unit cannot replace them; leave it out",
                    model.length_place, name, unit_names(units)));
  }
}

/// The mesher would work long for nothing.
void require_few_elements(const StepModel& model, const StepBody& body) {
  const std::string fault =
      too_many_elements(model.element_size, body.geometry.volume, longest_side(body.geometry));
  if (!fault.empty()) throw SceneError(fmt::format("{}: {}", model.size_place, fault));
}

/// What the mesher says does not know the scene.
[[noreturn]] void blame_unusual_size(const StepModel& model, const StepBody& body,
                                     const mesh::MeshError& error) {
  const double height = longest_side(body.geometry);
  if (model.element_size <= largest_usual_element * height) throw;  // as it is
  throw SceneError(fmt::format(
      "{}: with elements of {:g} m no mesh is made of a body that is {:.3g} m long; usual is {}: "
      "is "
      "it in millimetres? give the unit ({})",
      model.size_place, model.element_size, height, usual_element_sizes(height), error.what()));
}

mesh::StepMeshing meshing_of(const StepModel& model, const mesh::StepGeometry& geometry) {
  mesh::StepMeshing meshing{.element_size = model.element_size};
  for (const FaceDescription& face : model.faces) {
    const std::vector<int> numbers = chosen_faces(geometry, face);
    meshing.names[face.name] = numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const FaceChoice& choice = face.choices[i];
      if (choice.size) meshing.face_size[numbers[i]] = *choice.size;
      if (choice.edge_size) meshing.edge_size[numbers[i]] = *choice.edge_size;
    }
  }
  return meshing;
}

}  // namespace

StepBody open_step(const fs::path& file, std::optional<double> length_unit) {
  StepBody body;
  body.units = mesh::step_length_units(file);
  // Without a unit OpenCASCADE leaves the numbers as they are.
  const double read_as = body.units.empty() ? 1.0 : body.units.front().metres;
  body.source = {file, length_unit ? *length_unit / read_as : 1.0};
  const TemporaryFolder folder;
  body.geometry = with_mesher([&](const mesh::MesherLimits& limits) {
    return mesh::read_step(body.source, folder.path() / "faces.txt", limits);
  });
  return body;
}

std::string unit_text(const StepBody& body) { return says_unit(body.source.file, body.units); }

std::string unit_text(const StepModel& model) {
  std::string text = says_unit(model.file, mesh::step_length_units(model.file));
  if (model.length_unit)
    text += fmt::format("; taken as {:g} m by length_unit", *model.length_unit);
  return text;
}

std::optional<double> unit_of_file(const StepModel& model) {
  const std::vector<mesh::StepUnit> units = mesh::step_length_units(model.file);
  if (units.size() != 1) return std::nullopt;
  return units.front().metres;
}

std::string size_doubt(const StepBody& body) {
  constexpr double shortest = 1e-3;  // of the longest side [m]
  constexpr double longest = 10.0;
  const double side = longest_side(body.geometry);
  if (side >= shortest && side <= longest) return {};
  const std::string unit = body.units.empty() ? "metre" : unit_names(body.units);
  if (body.source.scale != 1.0) {
    return fmt::format(
        "the body is {:.3g} m long by length_unit, {:.3g} m in {}; blades are 0.02 to 3 m. Write "
        "the unit that length_unit should be, or leave it out",
        side, side / body.source.scale, body.units.empty() ? unit : unit + ", as the file says");
  }
  return fmt::format(
      "the body is {:.3g} m long, read in {}; blades are 0.02 to 3 m. If the file "
      "says a wrong unit, write the right one: length_unit = \"mm\"",
      side, unit);
}

void mesh_step_model(const StepModel& model, const fs::path& file) {
  require_file(model.file, model.place);
  require_unit(model, mesh::step_length_units(model.file));
  const StepBody body = open_step(model.file, model.length_unit);
  if (const std::string doubt = size_doubt(body); !doubt.empty()) {
    throw SceneError(fmt::format("{}: {}: {}", model.place, model.file.filename().string(), doubt));
  }
  require_few_elements(model, body);
  const mesh::StepMeshing meshing = meshing_of(model, body.geometry);
  try {
    with_mesher([&](const mesh::MesherLimits& limits) {
      mesh::mesh_step(body.source, meshing, file, limits);
    });
  } catch (const mesh::MeshRoomError&) {
    throw;
  } catch (const mesh::MeshError& error) {
    blame_unusual_size(model, body, error);
  }
}

}  // namespace microslip::pipelines
