#include "pipelines/structure/given_modes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fem/modal_mass.hpp"
#include "mesh/element_type.hpp"
#include "mesh/refined_mesh.hpp"
#include "pipelines/import/conversion.hpp"
#include "pipelines/import/node_rows.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

// Codes differ in their quadrature of the mass, most on coarse meshes.
constexpr double mass_told = 0.02;
constexpr double mass_refused = 0.5;
// Of the largest of Young's moduli to the least.
constexpr double modulus_told = 1.1;
constexpr double modulus_refused = 10.0;
// Soft supports and rotation raise those of some modes, fibres spread them: what is left is a
// material still. Mixed-up nodes and directions bend elements so much that none is.
constexpr double softest = 1e9;      // [Pa]
constexpr double stiffest = 1.5e12;  // [Pa]: diamond has 1.2e12

Eigen::MatrixXd shapes_on(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& of_file) {
  Eigen::MatrixXd shapes(3 * std::ssize(rows), of_file.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    shapes.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = of_file.middleRows<3>(3 * rows[i]);
  }
  return shapes;
}

/// Modes and attachment shapes the scene takes, by their column in the file.
std::vector<Eigen::Index> columns_of(const ModesOfFile& read, const SceneDescription& scene) {
  const ModesFile& file = *given_modes(scene);
  const BasisSettings& basis = scene.settings.basis;
  const Eigen::Index n_free = read.frequency_hz.size() - read.n_attachment;
  if (basis.n_modes > n_free) {
    throw SceneError(fmt::format("{}: {} modes are asked for, {} has {}",
                                 place_in(scene, "modes.count"), basis.n_modes, file.file.string(),
                                 n_free));
  }
  const bool attached = basis.residual == ResidualKind::attachment;
  if (attached && read.n_attachment == 0) {
    throw SceneError(fmt::format(
        "modes.residual = \"attachment\": {} has no attachment shapes; expected \"none\"",
        file.file.string()));
  }
  std::vector<Eigen::Index> columns(
      static_cast<std::size_t>(basis.n_modes > 0 ? basis.n_modes : n_free));
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  for (Eigen::Index i = 0; attached && i < read.n_attachment; ++i) columns.push_back(n_free + i);
  return columns;
}

/// Two bodies may touch: which node of two in one place is that of the mesh nothing tells,
/// unless they move as one.
void check_places(const mesh::Mesh& mesh, const ModesOfFile& read, const Eigen::MatrixX3d& nodes,
                  const std::vector<Eigen::Index>& rows, const ModesFile& file) {
  constexpr double apart = 1e-3;  // of the largest displacement of the mode
  const Eigen::RowVectorXd largest = read.shapes.cwiseAbs().colwise().maxCoeff();
  for (const auto& [row, twin] : rows_in_one_place(mesh, nodes, rows)) {
    const Eigen::MatrixXd difference =
        read.shapes.middleRows<3>(3 * row) - read.shapes.middleRows<3>(3 * twin);
    if ((difference.cwiseAbs().colwise().maxCoeff().array() <= apart * largest.array()).all()) {
      continue;
    }
    throw SceneError(fmt::format(
        "{}: two nodes of {} lie at ({:.6g}, {:.6g}, {:.6g}) m and move differently, so that "
        "nothing tells which is that of the mesh: write the modes at the nodes of this mesh alone",
        file.place, file.file.filename().string(), nodes(row, 0), nodes(row, 1), nodes(row, 2)));
  }
}

/// Young's modulus that frequency and strain energy of each mode tell: E = ω² φᵀMφ / (φᵀKφ for E =
/// 1). One of all modes, whatever they are scaled by. Linear elements of other codes are softer
/// than ours: nothing is told of them. @param mass  φᵀMφ.
void check_stiffness(const mesh::Mesh& mesh, const SceneDescription& scene,
                     const Eigen::VectorXd& mass, StructureModes& modes) {
  constexpr double poissons_ratio = 0.3;  // of another one the moduli move by some percent together
  const Eigen::Index n_rigid = modes.basis.n_rigid_body;
  const Eigen::Index n = modes.basis.n_free() - n_rigid;
  if (n < 1 || !mesh::has_midside_nodes(mesh)) return;
  const Eigen::VectorXd unit_stiffness =
      fem::modal_stiffness(mesh, {1.0, poissons_ratio, scene.material.density},
                           modes.basis.shapes.middleCols(n_rigid, n));
  const Eigen::VectorXd modulus = modes.basis.frequency.segment(n_rigid, n).array().square() *
                                  mass.segment(n_rigid, n).array() / unit_stiffness.array();
  Eigen::Index low = 0;
  Eigen::Index high = 0;
  const double least = modulus.minCoeff(&low);
  const double most = modulus.maxCoeff(&high);
  const ModesFile& file = *given_modes(scene);
  const std::string found = fmt::format(
      "frequencies, shapes and density of {} tell a Young's modulus of {:.3g} Pa (mode {}) to "
      "{:.3g} "
      "Pa (mode {})",
      file.file.filename().string(), least, n_rigid + low + 1, most, n_rigid + high + 1);
  if (least > stiffest) {
    throw SceneError(
        fmt::format("{}: {}, as no material has: are the frequencies in Hz? In rad/s they are 6.28 "
                    "times as large, "
                    "the modulus 39.5 times. Are length_unit and density right?",
                    file.place, found));
  }
  if (most > modulus_refused * least && least < softest) {
    throw SceneError(
        fmt::format("{}: {}; a body of one material has one: are nodes or directions mixed up, are "
                    "the shapes of "
                    "this mesh?",
                    file.place, found));
  }
  if (most <= modulus_told * least) {
    modes.notes.push_back(found);
    return;
  }
  modes.warnings.push_back(
      found +
      "; a body of one material at rest has one. Are some nodes or directions mixed up? A second "
      "material, rotation and supports that give move it as well");
}

/// All modal masses are one number that another density makes 1 kg: "",
/// unless a body may have that.
std::string other_density(const Eigen::VectorXd& mass, double density) {
  constexpr double one_number = 1.01;
  constexpr double least = 100.0;  // kg/m³
  constexpr double most = 25000.0;
  const double fitting = density / mass.mean();
  if (mass.maxCoeff() > one_number * mass.minCoeff() || fitting < least || fitting > most)
    return {};
  return fmt::format(
      " With {:.4g} kg/m^3 they would have it: is material.density that of the body?", fitting);
}

/// What ΦᵀMΦ says of the shapes; rescales them where the scene asks for it.
void check_mass(const mesh::Mesh& mesh, const SceneDescription& scene, StructureModes& modes) {
  const ModesFile& file = *given_modes(scene);
  const double density = scene.material.density;
  if (density <= 0.0) {
    modes.warnings.push_back(fmt::format(
        "the modes of {} are taken as mass-normalised, in {:g} kg: give material.density to have "
        "that checked",
        file.file.filename().string(), file.mass_unit));
    return;
  }
  const Eigen::MatrixXd G = fem::modal_mass(mesh, density, modes.basis.shapes);
  const Eigen::VectorXd mass = G.diagonal();
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd coupling = scale.asDiagonal() * G * scale.asDiagonal();
  coupling.diagonal().setZero();
  const double worst = coupling.cwiseAbs().maxCoeff();
  check_stiffness(mesh, scene, mass, modes);
  const std::string found =
      fmt::format("with {:g} kg/m^3 the modal masses of {} are {:.6g} to {:.6g} kg", density,
                  file.file.filename().string(), mass.minCoeff(), mass.maxCoeff());
  if (worst > mass_told) {
    // No error yet: where the density is not the same everywhere, this mass is not that of the
    // modes.
    modes.warnings.push_back(fmt::format(
        "two modes of {} are not orthogonal: their common mass is {:.2g} % of their own. Is the "
        "density the same everywhere, are nodes or directions mixed up?",
        file.file.filename().string(), 100.0 * worst));
  }
  if (file.rescaled) {
    modes.basis.shapes = (modes.basis.shapes * scale.asDiagonal()).eval();
    modes.notes.push_back(found + ": rescaled to 1 kg");
    return;
  }
  const double off = (mass.array() - 1.0).abs().maxCoeff();
  if (off > mass_refused) {
    throw SceneError(fmt::format(
        "{}: {}; mass-normalised modes have 1 kg.{} Is model.mass_unit {:g} kg, or are they scaled "
        "otherwise (then model.normalisation = \"other\")?",
        file.place, found, other_density(mass, density), file.mass_unit));
  }
  if (off > mass_told) {
    modes.warnings.push_back(found + "; 1 kg is expected." + other_density(mass, density));
  } else {
    modes.notes.push_back(found + "; 1 kg is expected");
  }
}

void tell_residual(const SceneDescription& scene, StructureModes& modes) {
  if (scene.contacts.empty()) return;
  if (modes.basis.n_attachment > 0) {
    modes.attachment_text =
        fmt::format("attachment: {} static shapes of the file", modes.basis.n_attachment);
    return;
  }
  modes.warnings.push_back(fmt::format(
      "modes.residual = \"none\": nothing stands for the modes beyond the {} given. With ten modes "
      "of the default blade that moves peaks by up to 7 %; attachment shapes (.npz), or matrices "
      "instead of modes, leave 0.02 %",
      modes.basis.n_free()));
}

}  // namespace

ModesOfFile read_modes_of(const std::filesystem::path& file, const std::filesystem::path& deck) {
  const TemporaryFolder folder;
  const std::filesystem::path data = folder.path() / "modes.bin";
  const bool needs_deck = is_punch_file(file);
  const nlohmann::json facts =
      convert_file("convert_modes.py", file, data, {}, needs_deck ? deck : std::filesystem::path());
  const auto frequency = facts.at("frequency_Hz").get<std::vector<double>>();
  const auto n_nodes = facts.at("n_nodes").get<Eigen::Index>();
  ModesOfFile modes;
  modes.n_attachment = facts.at("n_attachment").get<Eigen::Index>();
  modes.frequency_hz = Eigen::Map<const Eigen::VectorXd>(frequency.data(), std::ssize(frequency));
  // Doubles: the coordinates of every node, then its displacements, mode after mode.
  Eigen::MatrixXd numbers(3 * n_nodes, 1 + modes.frequency_hz.size());
  std::ifstream in(data, std::ios::binary);
  const auto n_bytes = static_cast<std::streamsize>(numbers.size() * Eigen::Index{sizeof(double)});
  if (!in.read(reinterpret_cast<char*>(numbers.data()), n_bytes)) {
    throw std::runtime_error(data.string() + ": the converter left less than it says");
  }
  modes.nodes = numbers.col(0).reshaped(3, n_nodes).transpose();
  modes.shapes = numbers.rightCols(modes.frequency_hz.size());
  return modes;
}

StructureModes given_structure(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const auto& model = std::get<MeshFileModel>(scene.model);
  const ModesOfFile read = read_modes_of(model.modes->file, model.file);
  const std::vector<Eigen::Index> columns = columns_of(read, scene);
  const Eigen::MatrixX3d nodes = model.length_unit.value() * read.nodes;
  StructureModes modes;
  modes.n_dofs = 3 * mesh.n_nodes();
  modes.mass = scene.material.density * mesh.volume();
  fem::ModalBasis& basis = modes.basis;
  basis.frequency = 2.0 * std::numbers::pi * read.frequency_hz(columns);
  basis.n_attachment =
      scene.settings.basis.residual == ResidualKind::attachment ? read.n_attachment : 0;
  basis.n_rigid_body = (basis.frequency.head(basis.n_free()).array() == 0.0).count();
  const std::vector<Eigen::Index> rows =
      rows_of_nodes(mesh, nodes, model.modes->file, model.modes->place);
  check_places(mesh, read, nodes, rows, *model.modes);
  basis.shapes =
      shapes_on(rows, read.shapes(Eigen::all, columns)) / std::sqrt(model.modes->mass_unit);
  check_mass(mesh, scene, modes);
  tell_residual(scene, modes);
  return modes;
}

}  // namespace microslip::pipelines
