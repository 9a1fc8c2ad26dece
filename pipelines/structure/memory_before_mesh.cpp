#include "pipelines/structure/memory_before_mesh.hpp"

#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "fem/memory_forecast.hpp"
#include "fem/petsc_error.hpp"
#include "mesh/mesh_error.hpp"
#include "pipelines/description/element_count.hpp"
#include "pipelines/import/step_mesh.hpp"
#include "pipelines/structure/geometry_bytes.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "pipelines/text/required_file.hpp"

namespace microslip::pipelines {
namespace {

constexpr double least_in_cube = 20.0;  // unknowns, see (1)

double volume_of(const SceneDescription& scene) {
  if (const auto* step = std::get_if<StepModel>(&scene.model)) {
    require_file(step->file, step->place);
    return open_step(step->file, step->length_unit).geometry.volume;
  }
  return blade_volume(std::get<BladeModel>(scene.model).geometry);
}

/// Of some thirty thousand unknowns. Empty: the geometry has parts that they do not resolve.
std::optional<mesh::Mesh> coarse_mesh(const SceneDescription& scene, double volume, double size) {
  constexpr double unknowns = 30'000.0;
  const double coarse = std::cbrt(least_in_cube * volume / unknowns);
  const TemporaryFolder folder;
  try {
    return obtain_mesh(with_elements_scaled(scene, coarse / size), folder.path() / "mesh.msh");
  } catch (const mesh::MeshRoomError&) {
    throw;
  } catch (const mesh::MeshError&) {
    return std::nullopt;
  }
}

double least_unknowns(double volume, double element_size) {
  return least_in_cube * volume / std::pow(element_size, 3);
}

/// Whatever the shape of the body; or so many elements are refused where they would be meshed.
bool needs_no_look(const SceneDescription& scene) {
  constexpr double most_each = 0.07;  // [MB]: three times what a million of a blade take
  const std::optional<double> size = element_size_of(scene);
  if (!size) return true;
  const double volume = volume_of(scene);
  constexpr double any_height = 1.0;
  return most_each * least_unknowns(volume, *size) < available_memory().megabytes ||
         !too_many_elements(*size, volume, any_height).empty();
}

bool is_kept(const SceneDescription& scene) {
  const ResultCache* cache = ResultCache::in_use();
  return cache != nullptr && cache->kept("mesh", geometry_of(scene)).has_value();
}

}  // namespace

std::optional<MemoryBeforeMesh> memory_before_mesh(const SceneDescription& scene) {
  const std::optional<double> size = element_size_of(scene);
  if (!size) return std::nullopt;
  const double volume = volume_of(scene);
  const double unknowns = least_unknowns(volume, *size);
  const std::optional<mesh::Mesh> coarse = coarse_mesh(scene, volume, *size);
  if (!coarse) return std::nullopt;
  const double ratio = unknowns / (3.0 * static_cast<double>(coarse->n_nodes()));
  const fem::MemoryForecast direct = fem::direct_memory(*coarse);
  SolverMemory memory;
  memory.solver = scene.settings.basis.solver;
  memory.direct_mb = direct.matrices * ratio + direct.solver * std::pow(ratio, 1.25);
  memory.iterative_mb = fem::iterative_memory(*coarse).total() * ratio;
  memory.available = available_memory();
  return MemoryBeforeMesh{unknowns, memory};
}

void require_memory_before_mesh(const SceneDescription& scene) {
  if (needs_no_look(scene)) return;
  const std::optional<MemoryBeforeMesh> least = memory_before_mesh(scene);
  if (!least || least->memory.needed_mb() <= least->memory.available.megabytes) return;
  if (is_kept(scene)) return;
  throw fem::MemoryError(fmt::format(
      "out of memory: nothing is meshed, as elements of {:g} m make {:.2g} degrees of "
      "freedom or more, for which {}",
      *element_size_of(scene), least->degrees_of_freedom, memory_warning(least->memory)));
}

}  // namespace microslip::pipelines
