#include "pipelines/structure/extrapolated_modes.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mesh/interpolation.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double lowest_ratio = 2.0;
constexpr double highest_ratio = 16.0;

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

/// @param other  shapes at the same nodes.
Matches matches(const fem::ModalBasis& basis, const fem::ModalBasis& other) {
  constexpr double same = 0.9;  // cosine
  Matches found(static_cast<std::size_t>(basis.frequency.size()));
  if (basis.n_free() != other.n_free() || basis.n_attachment != other.n_attachment) return found;
  const Eigen::MatrixXd cosines =
      basis.shapes.colwise().normalized().transpose() * other.shapes.colwise().normalized();
  for (const Columns& kind :
       {Columns{0, basis.n_free()}, Columns{basis.n_free(), basis.frequency.size()}}) {
    for (Eigen::Index i = kind.begin; i < kind.end; ++i) {
      Eigen::Index j = 0;
      const auto of_kind = cosines.row(i).segment(kind.begin, kind.end - kind.begin);
      if (!(of_kind.cwiseAbs().maxCoeff(&j) > same)) continue;
      j += kind.begin;
      found[static_cast<std::size_t>(i)] = {j, std::copysign(1.0, cosines(i, j))};
    }
  }
  return found;
}

/// One column.
void extrapolate(fem::ModalBasis& fine, Eigen::Index i, const fem::ModalBasis& coarse,
                 const Match& match, double ratio) {
  constexpr double most = 0.5;  // of ω²: beyond it nothing converges
  const double share = 1.0 / (ratio - 1.0);
  const double square = std::pow(fine.frequency[i], 2);
  const double change = share * (square - std::pow(coarse.frequency[match.column], 2));
  if (!(std::abs(change) < most * square)) return;
  fine.frequency[i] = std::sqrt(square + change);
  fine.shapes.col(i) += share * (fine.shapes.col(i) - match.sign * coarse.shapes.col(match.column));
}

/// @param coarse  shapes at the nodes of the fine mesh.
/// @param ratios  2^p of the columns.
void extrapolate(fem::ModalBasis& fine, const fem::ModalBasis& coarse, const Matches& same,
                 const std::vector<double>& ratios) {
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i].column < 0) continue;
    extrapolate(fine, static_cast<Eigen::Index>(i), coarse, same[i], ratios[i]);
  }
}

fem::ModalBasis at_nodes(const Interpolation& to, fem::ModalBasis basis) {
  basis.shapes = moved(to, basis.shapes);
  return basis;
}

/// 2^p of each column: of its own frequencies where three meshes have it, else of the first.
std::vector<double> ratios_of(const fem::ModalBasis& fine, const Matches& in_coarse,
                              const fem::ModalBasis& coarse, const Matches& in_coarsest,
                              const fem::ModalBasis& coarsest, double first) {
  std::vector<double> ratios(in_coarse.size(), first);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Eigen::Index j = in_coarse[i].column;
    if (j < 0) continue;
    const Eigen::Index k = in_coarsest[static_cast<std::size_t>(j)].column;
    if (k < 0) continue;
    ratios[i] = observed_ratio(fine.frequency[static_cast<Eigen::Index>(i)], coarse.frequency[j],
                               coarsest.frequency[k]);
  }
  return ratios;
}

/// The bases of three meshes: those of h and 2h are extrapolated.
void extrapolate(fem::ModalBasis& fine, const Interpolation& to_fine, fem::ModalBasis& coarse,
                 const Interpolation& to_coarse, const fem::ModalBasis& coarsest, double first) {
  const fem::ModalBasis coarse_at_fine = at_nodes(to_fine, coarse);
  const fem::ModalBasis coarsest_at_coarse = at_nodes(to_coarse, coarsest);
  const Matches in_coarse = matches(fine, coarse_at_fine);
  const Matches in_coarsest = matches(coarse, coarsest_at_coarse);
  const std::vector<double> ratios =
      ratios_of(fine, in_coarse, coarse, in_coarsest, coarsest, first);
  std::vector<double> ratios_of_coarse(in_coarsest.size(), first);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Eigen::Index j = in_coarse[i].column;
    if (j >= 0) ratios_of_coarse[static_cast<std::size_t>(j)] = ratios[i];
  }
  extrapolate(fine, coarse_at_fine, in_coarse, ratios);
  extrapolate(coarse, coarsest_at_coarse, in_coarsest, ratios_of_coarse);
}

/// Modes, and those with more attachment shapes.
void extrapolate(SolvedStructure& fine, SolvedStructure& coarse, const SolvedStructure& coarsest,
                 double first) {
  const Interpolation to_fine = mesh::interpolation(coarse.mesh, fine.mesh.nodes());
  const Interpolation to_coarse = mesh::interpolation(coarsest.mesh, coarse.mesh.nodes());
  extrapolate(fine.modes.basis, to_fine, coarse.modes.basis, to_coarse, coarsest.modes.basis,
              first);
  if (!fine.modes.richer || !coarse.modes.richer || !coarsest.modes.richer) return;
  extrapolate(fine.modes.richer->basis, to_fine, coarse.modes.richer->basis, to_coarse,
              coarsest.modes.richer->basis, first);
}

/// Falling, each step smaller than the one before, and small already.
bool converges(double fine, double coarse, double coarsest) {
  constexpr double small = 0.03;  // of the frequency: elements larger than parts of the body
  const double step = coarse - fine;
  return step > 0.0 && step < coarsest - coarse && step < small * fine;
}

std::string text_of(double size, double fine, double coarse, double coarsest, double limit) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return fmt::format(
      "first frequency {:.6g} Hz on elements of {:.3g} mm, {:.6g} on {:.3g} mm, {:.6g} on {:.3g} "
      "mm: modes are extrapolated to no size, the first to {:.6g} Hz",
      fine / turn, 1e3 * size, coarse / turn, 2e3 * size, coarsest / turn, 4e3 * size,
      limit / turn);
}

}  // namespace

bool is_extrapolated(const SceneDescription& scene) {
  return scene.accuracy.tolerance > 0.0 && scene.accuracy.extrapolation && element_size_of(scene);
}

SolvedStructure on_larger_elements(const SceneDescription& scene, double factor,
                                   Eigen::Index n_modes) {
  const TemporaryFolder folder;
  SceneDescription coarser = with_elements_scaled(scene, factor);
  coarser.accuracy.extrapolation = false;
  coarser.settings.basis.n_modes = static_cast<int>(n_modes);
  coarser.settings.basis.reach = 0.0;
  return solved_structure(coarser, folder.path() / "mesh.msh");
}

double observed_ratio(double fine, double coarse, double coarsest) {
  const double ratio = (coarsest - coarse) / (coarse - fine);
  return std::isfinite(ratio) ? std::clamp(ratio, lowest_ratio, highest_ratio) : lowest_ratio;
}

void extrapolate_modes(SolvedStructure& structure, const SceneDescription& scene) {
  const fem::ModalBasis& basis = structure.modes.basis;
  if (!is_extrapolated(scene) || basis.n_rigid_body > 0) return;
  try {
    const auto coarser = std::make_shared<CoarserMeshes>(
        CoarserMeshes{.twice = on_larger_elements(scene, 2.0, basis.n_free())});
    const SolvedStructure four_times = on_larger_elements(scene, 4.0, basis.n_free());
    const double fine = basis.frequency[0];
    const double coarse = coarser->twice.modes.basis.frequency[0];
    const double coarsest = four_times.modes.basis.frequency[0];
    if (!converges(fine, coarse, coarsest)) return;
    coarser->ratio = observed_ratio(fine, coarse, coarsest);
    extrapolate(structure, coarser->twice, four_times, coarser->ratio);
    coarser->text = text_of(*element_size_of(scene), fine, coarse, coarsest,
                            structure.modes.basis.frequency[0]);
    structure.coarser = coarser;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception&) {  // the error of the mesh is told as it is without
  }
}

}  // namespace microslip::pipelines
