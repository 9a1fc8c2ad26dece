#include "pipelines/structure/solver_time.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "pipelines/system/deadline.hpp"
#include "pipelines/system/machine_speed.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// What contact does to the modes in the linear limits: decompositions of matrices of their number.
double limits_seconds(const SceneDescription& scene) {
  constexpr double of_a_cube = 2.9e-7;  // measured at 300 and 900
  if (scene.contacts.empty() || !scene.response) return 0.0;
  const double m = scene.settings.basis.n_modes;
  return machine_slowness() * of_a_cube * m * m * m;
}

}  // namespace

double modes_seconds(double degrees_of_freedom, const BasisSettings& basis) {
  // From 31 395 to 998 523 degrees of freedom, share/doc/costs.md.
  const double n = degrees_of_freedom;
  const double ten =
      basis.solver == fem::SolverKind::iterative ? 5.3e-4 * n : 1.5e-5 * n + 3.1e-10 * n * n;
  // Of many modes orthogonality takes the square of their number.
  const double m = basis.n_modes;
  return machine_slowness() * (ten * std::max(1.0, m / 10.0) + 6e-9 * n * m * m);
}

double equilibrium_seconds(double degrees_of_freedom, const SceneDescription& scene) {
  // Of the modes; measured on a blade of 69 003 degrees of freedom: Newton's method and the count
  // that tells whether it is stable, static solutions of each node of a contact.
  constexpr double of_rotation = 2.0;
  constexpr double of_contact = 0.3;
  const bool rotates = scene.rotation && scene.rotation->speed > 0.0;
  const double share =
      (rotates ? of_rotation : 0.0) + (has_static_preload(scene) ? of_contact : 0.0);
  return share > 0.0 ? share * modes_seconds(degrees_of_freedom, scene.settings.basis) : 0.0;
}

double mesh_and_modes_seconds(double degrees_of_freedom, const SceneDescription& scene) {
  const double of_a_freedom = element_size_of(scene) ? per_meshed_freedom : 1e-5;
  const double mesh =
      machine_slowness() * of_a_freedom * degrees_of_freedom + limits_seconds(scene);
  if (given_modes(scene) != nullptr) return mesh;
  const double modes = modes_seconds(degrees_of_freedom, scene.settings.basis) +
                       equilibrium_seconds(degrees_of_freedom, scene);
  constexpr double start = 0.5;  // of the mesher, of the libraries
  return machine_slowness() * start + mesh + modes;
}

double larger_elements_seconds(double degrees_of_freedom, const SceneDescription& scene) {
  constexpr double fewer = 5.0;  // a blade is thin: between the square and the cube of two
  return mesh_and_modes_seconds(degrees_of_freedom / fewer, scene) +
         mesh_and_modes_seconds(degrees_of_freedom / (fewer * fewer), scene);
}

void require_time(const mesh::Mesh& mesh, const BasisSettings& basis) {
  constexpr double at_least = 0.5;  // of the forecast
  const double degrees_of_freedom = 3.0 * static_cast<double>(mesh.n_nodes());
  const double seconds = modes_seconds(degrees_of_freedom, basis);
  if (at_least * seconds <= seconds_to_work()) return;
  throw ExhaustedError(fmt::format(
      "out of time: {} modes of {:.0f} degrees of freedom take some {:.2g} s, and the budget "
      "leaves "
      "{:.2g} s for them; take larger elements, fewer modes, or a budget of {:.2g} s or more",
      basis.n_modes, degrees_of_freedom, seconds, std::max(seconds_to_work(), 0.0),
      2.0 * (seconds_spent() + seconds)));
}

}  // namespace microslip::pipelines
