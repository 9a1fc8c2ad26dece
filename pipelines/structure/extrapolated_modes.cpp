#include "pipelines/structure/extrapolated_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "mesh/interpolation.hpp"
#include "pipelines/structure/larger_elements.hpp"
#include "pipelines/structure/solver_time.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Of coarse meshes other parts of the error show, which fall faster; the edges have the last word.
constexpr double without_edges = 5.66;  // 2^2.5
constexpr double highest_ratio = 16.0;  // of quadratic elements; what shows more is an accident
constexpr double small_step = 0.03;     // of a frequency: elements larger than parts of the body
constexpr double turn = 2.0 * std::numbers::pi;

/// Shapes at the nodes of another mesh. @param shapes  3 n_nodes × n, x y z per node.
Eigen::MatrixXd moved(const Interpolation& to, const Eigen::MatrixXd& shapes) {
  using Nodal = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::MatrixXd result(3 * to.rows(), shapes.cols());
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    const Eigen::Map<const Nodal> from(shapes.col(i).data(), to.cols(), 3);
    Eigen::Map<Nodal>(result.col(i).data(), to.rows(), 3) = to * from;
  }
  return result;
}

fem::ModalBasis at_nodes(const Interpolation& to, fem::ModalBasis basis) {
  basis.shapes = moved(to, basis.shapes);
  return basis;
}

/// Columns of one kind of a basis: free modes or attachment shapes.
struct Columns {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;
};

/// The column of another basis that has the same shape; −1: none.
struct Match {
  Eigen::Index column = -1;
  double sign = 1.0;
};
using Matches = std::vector<Match>;

// Cosine: what two shapes differ by beyond their sign is scaled by up to two. Modes of nearly one
// frequency, which turn from mesh to mesh, are not the same.
constexpr double same_shape = 0.99;

/// @param other  shapes at the same nodes.
/// @param least  cosine above which shapes are the same; 0: the nearest of all.
Matches matches(const fem::ModalBasis& basis, const fem::ModalBasis& other,
                double least = same_shape) {
  Matches found(static_cast<std::size_t>(basis.frequency.size()));
  const Eigen::MatrixXd cosines =
      basis.shapes.colwise().normalized().transpose() * other.shapes.colwise().normalized();
  const std::array kinds{Columns{0, std::min(basis.n_free(), other.n_free())},
                         Columns{basis.n_free(), basis.frequency.size()}};
  const bool all = basis.n_free() == other.n_free() && basis.n_attachment == other.n_attachment;
  for (const Columns& kind : std::span(kinds).first(all ? 2 : 1)) {
    for (Eigen::Index i = kind.begin; i < kind.end; ++i) {
      Eigen::Index j = 0;
      const auto of_kind = cosines.row(i).segment(kind.begin, kind.end - kind.begin);
      if (!(of_kind.cwiseAbs().maxCoeff(&j) > least)) continue;
      j += kind.begin;
      found[static_cast<std::size_t>(i)] = {j, std::copysign(1.0, cosines(i, j))};
    }
  }
  return found;
}

/// Frequencies on elements of h, 2h and 4h [rad/s].
struct ThreeFrequencies {
  double fine, coarse, coarsest;
};

/// Steps of one sign, each smaller than the one before, and small already.
bool converges(const ThreeFrequencies& of) {
  const double step = of.coarse - of.fine;
  const double before = of.coarsest - of.coarse;
  return step * before > 0.0 && std::abs(step) < std::abs(before) &&
         std::abs(step) < small_step * of.fine;
}

using Ratios = std::vector<std::optional<double>>;  // 2^p of columns; empty: they stay

/// Of the frequencies of each, where three meshes have its shape and they converge.
Ratios ratios_of(const fem::ModalBasis& fine, const Matches& in_coarse,
                 const fem::ModalBasis& coarse, const Matches& in_coarsest,
                 const fem::ModalBasis& coarsest) {
  Ratios ratios(in_coarse.size());
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Eigen::Index j = in_coarse[i].column;
    const Eigen::Index k = j < 0 ? -1 : in_coarsest[static_cast<std::size_t>(j)].column;
    if (k < 0) continue;
    const ThreeFrequencies own{fine.frequency[static_cast<Eigen::Index>(i)], coarse.frequency[j],
                               coarsest.frequency[k]};
    if (converges(own)) ratios[i] = observed_ratio(own.fine, own.coarse, own.coarsest);
  }
  return ratios;
}

/// @param coarse  shapes at the nodes of the fine mesh.
void extrapolate(fem::ModalBasis& fine, const fem::ModalBasis& coarse, const Matches& same,
                 const Ratios& ratios) {
  for (std::size_t n = 0; n < same.size(); ++n) {
    if (same[n].column < 0 || !ratios[n]) continue;
    const auto i = static_cast<Eigen::Index>(n);
    const Eigen::Index j = same[n].column;
    const double share = 1.0 / (*ratios[n] - 1.0);
    const double square = std::pow(fine.frequency[i], 2);
    const double limit = square + share * (square - std::pow(coarse.frequency[j], 2));
    if (!(limit > 0.0)) {  // not of what converges(), where most of ω² is left
      throw RefusedError(fmt::format(
          "modes cannot be extrapolated: mode {} lies at {:.4g} Hz, on elements of twice the size "
          "at {:.4g} Hz; set accuracy.extrapolation = \"off\"",
          i + 1, fine.frequency[i] / turn, coarse.frequency[j] / turn));
    }
    fine.frequency[i] = std::sqrt(limit);
    fine.shapes.col(i) += share * (fine.shapes.col(i) - same[n].sign * coarse.shapes.col(j));
  }
}

ExtrapolationRatios by_kind(const fem::ModalBasis& basis, const Ratios& ratios) {
  const auto attachment = ratios.begin() + basis.n_free();
  return {{ratios.begin(), attachment}, {attachment, ratios.end()}};
}

/// Of another scene, for the columns of this basis; what that has not stays.
Ratios of_columns(const fem::ModalBasis& basis, const ExtrapolationRatios& known) {
  Ratios ratios = known.free;
  ratios.resize(static_cast<std::size_t>(basis.n_free()));
  ratios.insert(ratios.end(), known.attachment.begin(), known.attachment.end());
  ratios.resize(static_cast<std::size_t>(basis.frequency.size()));
  return ratios;
}

/// Of errors, for meshes whose sizes differ by less than twice.
Ratios over(Ratios ratios, double refinement) {
  for (std::optional<double>& one : ratios) {
    if (one) one = ratio_over(refinement, *one);
  }
  return ratios;
}

/// One mesh in the places of another whose elements are larger.
struct Step {
  Interpolation to;  ///< nodes of the finer one
  double refinement = 2.0;
};

/// Sizes at sharp edges are always halved: of 5.1 mm with 1.02 mm there, whose frequency is 2 Hz
/// too high and 3 Hz below that of twice the size, this takes off 2.7 Hz, the volume of elements 5.
Step step_between(const mesh::Mesh& coarse, const mesh::Mesh& fine, const SceneDescription& scene) {
  constexpr double least = 1.25;  // of nearly the same mesh little is known, not without bound
  const auto* blade = std::get_if<BladeModel>(&scene.model);
  const bool has_edges = blade != nullptr && blade->sizes.edge_size;
  return {mesh::interpolation(coarse, fine.nodes()),
          has_edges ? 2.0 : std::max(least, refinement_between(fine, coarse, scene))};
}

/// The bases of three meshes: those of h and 2h are extrapolated, the same columns of both.
ExtrapolationRatios extrapolate(fem::ModalBasis& fine, const Interpolation& to_fine,
                                fem::ModalBasis& coarse, const Step& to_coarse,
                                const fem::ModalBasis& coarsest) {
  const fem::ModalBasis coarse_at_fine = at_nodes(to_fine, coarse);
  const fem::ModalBasis coarsest_at_coarse = at_nodes(to_coarse.to, coarsest);
  const Matches in_coarse = matches(fine, coarse_at_fine);
  const Matches in_coarsest = matches(coarse, coarsest_at_coarse);
  const Ratios ratios = ratios_of(fine, in_coarse, coarse, in_coarsest, coarsest);
  Ratios ratios_of_coarse(in_coarsest.size());
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Eigen::Index j = in_coarse[i].column;
    if (j >= 0) ratios_of_coarse[static_cast<std::size_t>(j)] = ratios[i];
  }
  // As if sizes were halved: where they were not, too little is taken off, which is the safe side.
  // Those of 2h tell the error of that, and their elements may be hardly smaller than those of 4h.
  extrapolate(fine, coarse_at_fine, in_coarse, ratios);
  extrapolate(coarse, coarsest_at_coarse, in_coarsest,
              over(std::move(ratios_of_coarse), to_coarse.refinement));
  return by_kind(fine, ratios);
}

/// Modes, and those with more attachment shapes. @return of the modes.
ExtrapolationRatios extrapolate(SolvedStructure& fine, SolvedStructure& coarse,
                                const SolvedStructure& coarsest, const SceneDescription& scene) {
  const Interpolation to_fine = mesh::interpolation(coarse.mesh, fine.mesh.nodes());
  const Step to_coarse = step_between(coarsest.mesh, coarse.mesh, scene);
  std::optional<fem::RicherBasis>& richer = fine.modes.richer;
  if (richer && coarse.modes.richer && coarsest.modes.richer) {
    extrapolate(richer->basis, to_fine, coarse.modes.richer->basis, to_coarse,
                coarsest.modes.richer->basis);
  } else {
    richer.reset();  // what more shapes change would be told with the error of the mesh
  }
  return extrapolate(fine.modes.basis, to_fine, coarse.modes.basis, to_coarse,
                     coarsest.modes.basis);
}

/// Elements larger than the body is thick do not grow as asked. Empty: they do.
std::string hardly_differ(const mesh::Mesh& fine, const mesh::Mesh& coarse,
                          const SceneDescription& scene) {
  constexpr double least = 1.5;
  const double refinement = refinement_between(fine, coarse, scene);
  if (refinement >= least) return {};
  return fmt::format(
      ": larger than the body is thick, these elements differ by a factor of {:.2g}, not of two, "
      "and modes are not extrapolated",
      refinement);
}

/// What the coarser meshes take, where it is more than half of the time there is: the curves need
/// the rest. Empty: it fits.
std::string too_long(const mesh::Mesh& mesh, const SceneDescription& scene) {
  constexpr double most = 0.5;
  const double seconds = larger_elements_seconds(3.0 * static_cast<double>(mesh.n_nodes()), scene);
  const double left = seconds_to_work();
  if (seconds <= most * left) return {};
  return fmt::format(
      "modes are not extrapolated: on elements of two and four times the size they take some "
      "{:.2g} s, and the budget leaves {:.2g} s",
      seconds, left);
}

/// Elements so many times as large as those of the scene: "of 3 mm", "cut twice".
std::string elements_text(const SceneDescription& scene, double factor) {
  if (const auto size = element_size_of(scene)) {
    return fmt::format("of {:.3g} mm", 1e3 * factor * *size);
  }
  constexpr std::array cut{"as the file has them", "cut once", "cut twice"};
  const SceneDescription larger = with_elements_scaled(scene, factor);
  const auto n = static_cast<std::size_t>(std::get<MeshFileModel>(larger.model).refinement);
  return n < cut.size() ? cut[n] : fmt::format("cut {} times", n);
}

std::string text_of(const SceneDescription& scene, const ThreeFrequencies& first) {
  return fmt::format("first frequency {:.6g} Hz on elements {}, {:.6g} {}, {:.6g} {}",
                     first.fine / turn, elements_text(scene, 1.0), first.coarse / turn,
                     elements_text(scene, 2.0), first.coarsest / turn, elements_text(scene, 4.0));
}

}  // namespace

bool is_extrapolated(const SceneDescription& scene) {
  return scene.accuracy.tolerance > 0.0 && scene.accuracy.extrapolation &&
         largest_factor(scene) >= 4.0;
}

double observed_ratio(double fine, double coarse, double coarsest) {
  const double ratio = (coarsest - coarse) / (coarse - fine);
  const bool is_small = std::abs(coarse - fine) < small_step * fine;
  const bool is_smooth = is_small && ratio > without_edges && ratio <= highest_ratio;
  return is_smooth ? ratio : ratio_of_edges;
}

double refinement_between(const mesh::Mesh& fine, const mesh::Mesh& coarse,
                          const SceneDescription& scene) {
  if (std::holds_alternative<MeshFileModel>(scene.model)) return 2.0;  // each element cut
  return std::clamp(std::sqrt(coarse.typical_element_volume() / fine.typical_element_volume()), 1.0,
                    2.0);
}

double ratio_over(double refinement, double ratio) {
  return std::pow(ratio, std::log2(refinement));
}

std::string extrapolate_modes(SolvedStructure& structure, const SceneDescription& scene,
                              LargerElements& larger) {
  const fem::ModalBasis& basis = structure.modes.basis;
  if (!is_extrapolated(scene)) return {};
  if (cut_short()) return "modes are not extrapolated: out of time";
  if (basis.n_rigid_body > 0) return "modes are not extrapolated: the body is not held";
  if (std::string text = too_long(structure.mesh, scene); !text.empty()) return text;
  try {
    const auto coarser =
        std::make_shared<CoarserMeshes>(CoarserMeshes{.twice = larger.twice(basis.n_free())});
    const SolvedStructure four_times = larger.four_times(basis.n_free());
    const ThreeFrequencies first{basis.frequency[0], coarser->twice.modes.basis.frequency[0],
                                 four_times.modes.basis.frequency[0]};
    const std::string text = text_of(scene, first);
    if (std::string same = hardly_differ(structure.mesh, coarser->twice.mesh, scene);
        !same.empty()) {
      return text + same;
    }
    if (!converges(first)) return text + ": they are too far apart to be extrapolated";
    SolvedStructure limit = structure;
    coarser->ratios = extrapolate(limit, coarser->twice, four_times, scene);
    if (!coarser->ratios.free.front()) {
      return text + ": modes are not extrapolated, the first has another shape on each mesh";
    }
    structure = std::move(limit);
    coarser->text = fmt::format("{}: modes are extrapolated to no size, the first to {:.6g} Hz",
                                text, structure.modes.basis.frequency[0] / turn);
    structure.coarser = coarser;
    return coarser->text;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {  // the error of the mesh is told as it is without
    return fmt::format("modes are not extrapolated: on elements of two and four times the size: {}",
                       error.what());
  }
}

SolvedStructure solved_likewise(SceneDescription scene, const SolvedStructure& like,
                                const std::filesystem::path& mesh_file) {
  scene.accuracy.extrapolation = false;
  SolvedStructure structure = solved_structure(scene, mesh_file);
  if (!like.coarser) return structure;
  fem::ModalBasis& basis = structure.modes.basis;
  const SolvedStructure twice = on_larger_elements(scene, 2.0, basis.n_free());
  const fem::ModalBasis coarse =
      at_nodes(mesh::interpolation(twice.mesh, structure.mesh.nodes()), twice.modes.basis);
  // Where shapes turn among one another they are left as they are.
  constexpr double nearest = 0.9;
  extrapolate(basis, coarse, matches(basis, coarse, nearest),
              of_columns(basis, like.coarser->ratios));
  structure.modes.richer.reset();  // not extrapolated
  return structure;
}

}  // namespace microslip::pipelines
