/// @file
/// What `--resume` needs of a run that was killed or interrupted: its scene and its finished parts,
/// each in a file of its own in RUN/checkpoint, written whole. Numbers are kept as they are in
/// memory, so that what follows from them is the same bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/structure/structure_stage.hpp"

namespace microslip::pipelines {

/// Nodes, elements, names: two meshes are the same when this is.
[[nodiscard]] std::uint64_t fingerprint_of(const mesh::Mesh& mesh);

/// Of the bytes of a file.
[[nodiscard]] std::uint64_t fingerprint_of(const std::filesystem::path& file);

/// Files from which mesh and modes of a scene come; none: they follow from the scene alone.
[[nodiscard]] std::vector<std::filesystem::path> files_of_structure(const SceneDescription& scene);

/// Whether a run has begun in a folder and not come to its end.
[[nodiscard]] bool is_begun(const std::filesystem::path& folder);

class Checkpoint {
 public:
  /// @param run      its folder.
  /// @param resumed  whether finished parts there are those of this run; else none is found.
  Checkpoint(const std::filesystem::path& run, bool resumed);

  /// Forgets the parts of the run before and keeps the scene of this one;
  /// does nothing in a run that is resumed.
  /// @throws ExhaustedError  it cannot be written.
  void begin(const std::string& scene_toml);
  /// Only the scene is left: a resumed run starts from the beginning.
  void forget_parts();
  /// The run is complete: nothing is left to resume.
  void end();

  /// A finished part, "modes", "curves/NAME", …; empty: not finished. Part: StructureModes,
  /// CurveResult, std::uint64_t.
  /// @throws SceneError  written by another version or build, or damaged.
  template <typename Part>
  [[nodiscard]] std::optional<Part> find(const std::string& name) const;
  /// @throws ExhaustedError  it cannot be written.
  template <typename Part>
  void keep(const std::string& name, const Part& part) const;
  /// Keeps what an input comes to, or compares it with what it came to before the run was resumed.
  /// @param what  begins the message, e.g. "the mesh".
  /// @throws SceneError  it is another.
  void require_same(const std::string& name, std::uint64_t value, const std::string& what) const;

 private:
  std::filesystem::path folder_;
  bool resumed_;
};

/// What there is to resume in a folder.
/// @param scene_toml  of the scene that is given now, completed.
/// @return  the exit code of a run that has come to its end; empty: one that has not.
/// @throws SceneError  no run, or that of another scene: the message names the key that differs.
[[nodiscard]] std::optional<int> ended_run(const std::filesystem::path& folder,
                                           const std::string& scene_toml);

}  // namespace microslip::pipelines
