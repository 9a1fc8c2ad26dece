/// @file
/// Meshes of elements twice and four times as large and their modes, by one BLAS thread wherever
/// they are solved: beside the modes of the scene, in a process of their own, they have the same
/// bits as after them in this one.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/mesh_excess.hpp"
#include "pipelines/structure/solved_structure.hpp"
#include "pipelines/structure/solver_process.hpp"

namespace microslip::pipelines {

/// In this process. @param n_modes  however far they reach.
[[nodiscard]] SolvedStructure on_larger_elements(const SceneDescription& scene, double factor,
                                                 Eigen::Index n_modes);

/// What a structure was asked about its mesh: nothing is solved for twice.
struct MeshAnswers {
  std::map<std::pair<double, Eigen::Index>, SolvedStructure> larger{};  ///< by factor, n_modes
  std::optional<FrequencyExcess> excess{};
};

/// The same, kept with the structure of the scene: who asks again does not solve again.
[[nodiscard]] const SolvedStructure& on_larger_elements(const SceneDescription& scene,
                                                        const SolvedStructure& structure,
                                                        double factor, Eigen::Index n_modes);

/// Of the modes that a structure has (mesh_excess.hpp), told once.
[[nodiscard]] const FrequencyExcess& frequency_excess(const SolvedStructure& structure,
                                                      const SceneDescription& scene);

/// They are being solved beside as long as it lives, where that is allowed: by a thread that meshes
/// (the mesher is a process already) and hands tasks to the other process.
class LargerElements {
 public:
  /// Begins, with the meshes alone where the number of modes is not known before, where the scene
  /// asks for them, on one rank, without an end of time, for what that
  /// process can solve, with two cores and memory for both.
  /// @param mesh     of the scene.
  /// @param cores    this process may use.
  /// @param program  that solves; empty: solver_program().
  LargerElements(const SceneDescription& scene, const mesh::Mesh& mesh, int cores,
                 std::filesystem::path program = {});
  /// Ends what is not finished.
  ~LargerElements() = default;
  LargerElements(const LargerElements&) = delete;
  LargerElements& operator=(const LargerElements&) = delete;
  LargerElements(LargerElements&&) = delete;
  LargerElements& operator=(LargerElements&&) = delete;

  /// Of 2h and of 4h: what was solved beside, once that has ended; what was not, or with another
  /// number of modes, is solved here and now.
  /// @throws as solved_structure().
  [[nodiscard]] SolvedStructure twice(Eigen::Index n_modes) { return taken(0, n_modes); }
  [[nodiscard]] SolvedStructure four_times(Eigen::Index n_modes) { return taken(1, n_modes); }

  [[nodiscard]] bool began() const { return began_; }

 private:
  void solve_beside(const std::stop_token& stop);
  [[nodiscard]] SolvedStructure taken(std::size_t i, Eigen::Index n_modes);

  SceneDescription scene_;
  SolvedElsewhere elsewhere_{};
  bool began_ = false;
  std::array<std::optional<mesh::Mesh>, 2> meshes_{};
  std::array<std::optional<StructureModes>, 2> modes_{};
  std::jthread worker_;  ///< last: the others are its own until it has ended
};

}  // namespace microslip::pipelines
