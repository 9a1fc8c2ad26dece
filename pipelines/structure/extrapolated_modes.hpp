/// @file
/// Modes without most of the error of their mesh. Where edges are re-entrant, ω² errs in proportion
/// to the size h of the elements, whatever their order: halving it halves the error and costs ten
/// times as much. Meshes of 2h and 4h tell most of it for less than that of h takes:
///
///   x = x_h + (x_h − x_2h) / (2^p − 1)
///
/// for ω² and the shape of every mode and attachment shape that the meshes of 2h and 4h have
/// too and whose frequencies converge, with 2^p of observed_ratio(). Others stay; so do residual
/// flexibility and a static preload.
///
/// Source: Richardson, The deferred approach to the limit, Phil. Trans. R. Soc. A 226 (1927)
/// 299–361.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/structure/solved_structure.hpp"

namespace microslip::pipelines {

class LargerElements;

/// 2^p of every mode and attachment shape; empty: it stays.
struct ExtrapolationRatios {
  std::vector<std::optional<double>> free{};
  std::vector<std::optional<double>> attachment{};
};

struct CoarserMeshes {
  SolvedStructure twice;         ///< of 2h, extrapolated from 4h by r^p of refinement_between()
  ExtrapolationRatios ratios{};  ///< the first of `free` is there
  std::string text{};            ///< what was done, for the log
};

/// Where an accuracy is asked for and the geometry is meshed here, unless
/// `accuracy.extrapolation` is off.
[[nodiscard]] bool is_extrapolated(const SceneDescription& scene);

/// 2^p at re-entrant edges of 270°: stresses grow there as distance^(λ − 1), λ = 0.5445 (Williams,
/// J. Appl. Mech. 19 (1952) 526), frequencies err by h^2λ.
inline constexpr double ratio_of_edges = 2.127;

/// 2^p = (ω_4h − ω_2h) / (ω_2h − ω_h) of three meshes, between 2^2.5 and 16 (smooth fields,
/// quadratic elements), of steps below 3 %. Else it is that of re-entrant edges, h^1.09: meshes
/// show the rate of the coarsest then, or an accident, which is not that of what is left on the
/// finest.
[[nodiscard]] double observed_ratio(double fine, double coarse, double coarsest);

/// How many times smaller elements are than those of a mesh that was to have twice their size: 2,
/// or less where these are larger than the body is thick and do not grow as asked. By the volume of
/// the element about a place (mesh::Mesh), which in a thin body grows as the square: of the default
/// blade 1.24 from 12 to 24 mm, where errors fall by a factor of 1.23, and 1.42 from 10 to 20 mm,
/// where they fall by 1.7. Small elements at sharp edges, where most nodes are, say nothing of
/// those of the body, which have the error then: from 20 to 40 mm, with a tenth of that there, it
/// is 1.26, and errors fall by 1.24.
[[nodiscard]] double refinement_between(const mesh::Mesh& fine, const mesh::Mesh& coarse,
                                        const SceneDescription& scene);

/// r^p of errors. @param ratio  2^p.
[[nodiscard]] double ratio_over(double refinement, double ratio);

/// Extrapolates the modes of a structure and keeps what they are extrapolated from.
/// Leaves them where the scene does not ask for it, the coarser meshes cannot be solved or take
/// more than half of the time that is left, or their first frequencies do not fall towards that of
/// the fine one.
/// @param structure  mesh and modes of the scene.
/// @param larger     of it, which may be being solved.
/// @return what was done, or why it was not, for the log; empty: the scene does not ask for it.
/// @throws InterruptedError
std::string extrapolate_modes(SolvedStructure& structure, const SceneDescription& scene,
                              LargerElements& larger);

/// Mesh and modes of a scene that differs from another in a number that is searched. What is
/// extrapolated, and by how much, is that of the other: decided anew at each value it would make
/// a search go over steps.
/// @param like       of the other scene.
/// @param mesh_file  where the mesher writes.
/// @throws RefusedError  modes of this one are too far from those on coarser elements for it. Else
///                       as solved_structure().
[[nodiscard]] SolvedStructure solved_likewise(SceneDescription scene, const SolvedStructure& like,
                                              const std::filesystem::path& mesh_file);

}  // namespace microslip::pipelines
