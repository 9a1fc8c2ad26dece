#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <ostream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "mesh/mesh.hpp"
#include "pipelines/contact_stage.hpp"
#include "pipelines/effects.hpp"
#include "pipelines/response_stage.hpp"
#include "pipelines/structure_stage.hpp"
#include "pipelines/study.hpp"

namespace microslip::pipelines {
namespace {

/// A folder that is gone when this is.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "microslip-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw ExhaustedError("no temporary folder can be made in " +
                           std::filesystem::temp_directory_path().string());
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // a leftover in the temporary folder harms nobody
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Anchored at 115 000 degrees of freedom: 4 s and 0.7 GB on two cores (factorisation of a sparse
/// three-dimensional mesh: time as n^1.5, memory as n^1.3).
void forecast(const mesh::Mesh& mesh, const SceneDescription& scene, std::ostream& out) {
  const auto n_dofs = 3.0 * static_cast<double>(mesh.n_nodes());
  const double size = n_dofs / 115'000.0;
  const double modes = 4.0 * std::pow(size, 1.5) * std::max(1.0, scene.modes.count / 10.0);
  const double memory = 0.2 + 0.7 * std::pow(size, 1.3);
  fmt::print(out, "forecast: {:.0f} degrees of freedom; modes {:.1f} s, {:.1f} GB", n_dofs, modes,
             memory);
  if (scene.response) {
    const double per_curve = 0.15 * (scene.contact ? scene.contact->n_points / 300.0 : 0.1);
    const auto n_curves = static_cast<double>(curve_requests(scene).size());
    const double searches = scene.response->optimum_preload ? 25.0 : 0.0;
    fmt::print(out, "; curves {:.1f} s", per_curve * (n_curves + searches));
  }
  out << '\n';
}

void describe_effects(const SceneDescription& scene, std::ostream& out) {
  out << "effects:\n";
  for (const EffectRecord& effect : effects_of(scene)) {
    fmt::print(out, "  {:<17}{:<4} {}\n", effect.name, effect.simulated ? "yes" : "no",
               effect.reason);
  }
}

void check_modal(const ModalModel& modal, const SceneDescription& scene, std::ostream& out) {
  fmt::print(out, "modal scene: {} modes from {:.6g} to {:.6g} Hz, {} contact points, area {:.6g}\n",
             modal.frequency_hz.size(), modal.frequency_hz.minCoeff(),
             modal.frequency_hz.maxCoeff(), modal.points.size(), modal.weights.sum());
  const ReducedModel model = reduced_model(modal);
  require_held(model);
  if (scene.response) {
    fmt::print(out, "{} curves from {:.6g} to {:.6g} Hz\n", curve_requests(scene).size(),
               scene.response->frequency_begin_hz, scene.response->frequency_end_hz);
  }
}

}  // namespace

int check_study(const SceneDescription& scene, std::ostream& out) {
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    check_modal(*modal, scene, out);
  } else {
    const TemporaryFolder folder;
    const mesh::Mesh mesh = obtain_mesh(scene, folder.path() / "mesh.msh");
    check_names(mesh, scene);
    out << describe_mesh(mesh, scene.material.density) << '\n';
    if (scene.clamped.empty() && scene.response) {
      out << "warning: nothing is clamped: `run` will refuse rigid-body modes that nothing holds\n";
    }
    forecast(mesh, scene, out);
  }
  describe_effects(scene, out);
  out << "the scene is complete and consistent\n";
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
