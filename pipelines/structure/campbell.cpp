#include "pipelines/structure/campbell.hpp"

#include <cmath>

#include <fmt/format.h>

#include "fem/modal_analysis.hpp"
#include "fem/ranks.hpp"
#include "pipelines/structure/on_all_ranks.hpp"
#include "pipelines/structure/structure_task.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Tell = std::function<void(double, const Eigen::VectorXd&)>;

/// Collective over the MPI ranks.
Eigen::MatrixXd frequencies_over(const StructureTask& task, const Eigen::VectorXd& speeds,
                                 const Tell& tell) {
  fem::Structure structure(task.mesh, task.material, task.clamped);
  const Eigen::Index n_modes = task.basis.n_modes;
  Eigen::MatrixXd frequencies(speeds.size(), n_modes);
  fem::Rotation rotation = *task.rotation;
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    if (fem::anywhere(interrupt_requested())) throw InterruptedError("interrupted");
    rotation.speed = speeds[i];
    static_cast<void>(structure.rotate(task.mesh, task.material, rotation));
    const Eigen::VectorXd frequency = structure.solve_modes({.n_modes = n_modes}).frequency;
    frequencies.row(i) = frequency;
    tell(speeds[i], frequency);
  }
  return frequencies;
}

}  // namespace

void require_rotation(const SceneDescription& scene) {
  const std::string file = scene.file.string();
  if (scene.kind != "blade" && scene.kind != "mesh" && scene.kind != "step") {
    throw SceneError(
        fmt::format("{}: model.kind: \"{}\" has no elements that a rotation could load; campbell "
                    "is for \"blade\", "
                    "\"mesh\" and \"step\"",
                    file, scene.kind));
  }
  if (!scene.rotation) {
    throw SceneError(fmt::format(
        "{}: static.axis: is missing; campbell needs [static] axis = {{ origin = [x, y, z], "
        "direction = [x, y, z] }}",
        file));
  }
  if (setting_of(scene, "centrifugal") == "off") {
    throw SceneError(fmt::format(
        "{}: effects.centrifugal: \"off\" contradicts campbell, which is of the stiffness at "
        "every speed: leave that out",
        file));
  }
}

CampbellDiagram campbell_diagram(const mesh::Mesh& mesh, const SceneDescription& scene,
                                 const Eigen::VectorXd& speeds,
                                 const std::function<void(double, const Eigen::VectorXd&)>& tell) {
  require_rotation(scene);
  const StructureTask task{
      mesh, scene.clamped, scene.material, {}, scene.rotation, scene.settings.basis, {}, {}};
  CampbellDiagram diagram{speeds, {}};
  const auto bytes = [&] {
    ByteWriter writer;
    writer(speeds);
    writer(bytes_of(task));
    return writer.bytes();
  };
  on_all_ranks(campbell_work, bytes,
               [&] { diagram.frequency = frequencies_over(task, speeds, tell); });
  return diagram;
}

void take_part_in_campbell(std::string_view bytes) {
  Eigen::VectorXd speeds;
  std::string task;
  ByteReader reader(bytes);
  reader(speeds);
  reader(task);
  static_cast<void>(frequencies_over(structure_task(task), speeds, [](auto, const auto&) {}));
}

std::vector<Crossing> crossings(const CampbellDiagram& diagram, int highest_engine_order) {
  std::vector<Crossing> found;
  for (int order = 1; order <= highest_engine_order; ++order) {
    for (Eigen::Index mode = 0; mode < diagram.frequency.cols(); ++mode) {
      const Eigen::ArrayXd square = diagram.speeds.array().square();
      const Eigen::ArrayXd above =
          diagram.frequency.col(mode).array().square() - order * order * square;
      for (Eigen::Index i = 0; i + 1 < square.size(); ++i) {
        if ((above[i] > 0.0) == (above[i + 1] > 0.0)) continue;
        const double share = above[i] / (above[i] - above[i + 1]);
        found.push_back({order, mode, std::sqrt(square[i] + share * (square[i + 1] - square[i]))});
      }
    }
  }
  return found;
}

}  // namespace microslip::pipelines
