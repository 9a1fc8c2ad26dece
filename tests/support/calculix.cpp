#include "tests/support/calculix.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace microslip::test {
namespace {

namespace fs = std::filesystem;

const char* calculix_name(mesh::ElementType type) {
  switch (type) {
    case mesh::ElementType::tet4:
      return "C3D4";
    case mesh::ElementType::tet10:
      return "C3D10";
    case mesh::ElementType::hex8:
      return "C3D8";
    case mesh::ElementType::hex20:
      return "C3D20";
    case mesh::ElementType::wedge6:
      return "C3D6";
    case mesh::ElementType::wedge15:
      return "C3D15";
    case mesh::ElementType::pyramid5:
    case mesh::ElementType::pyramid13:
      break;
  }
  throw std::invalid_argument(std::string("CalculiX has no ") + mesh::name(type));
}

void write_elements(std::ostream& out, const mesh::Mesh& mesh) {
  Eigen::Index number = 0;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    out << "*ELEMENT, TYPE=" << calculix_name(block.type) << ", ELSET=all\n";
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      out << ++number;
      for (Eigen::Index i = 0; i < block.connectivity.cols(); ++i) {
        // A data line holds 16 numbers at most.
        out << (i == 10 ? ",\n" : ", ") << block.connectivity(e, i) + 1;
      }
      out << '\n';
    }
  }
}

void write_deck(const fs::path& file, const mesh::Mesh& mesh, const fem::Material& material,
                const std::vector<std::string>& clamped, int n_modes,
                const fem::Rotation& rotation) {
  std::ofstream out(file);
  out << std::setprecision(12) << "*NODE\n";  // a number has room for 20 characters
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    out << i + 1 << ", " << mesh.nodes()(i, 0) << ", " << mesh.nodes()(i, 1) << ", "
        << mesh.nodes()(i, 2) << '\n';
  }
  write_elements(out, mesh);
  std::set<Eigen::Index> held;
  for (const std::string& name : clamped) {
    for (const Eigen::Index node : mesh.node_set(name)) held.insert(node);
  }
  out << "*MATERIAL, NAME=metal\n*ELASTIC\n"
      << material.youngs_modulus << ", " << material.poissons_ratio << "\n*DENSITY\n"
      << material.density << "\n*SOLID SECTION, ELSET=all, MATERIAL=metal\n*BOUNDARY\n";
  for (const Eigen::Index node : held) out << node + 1 << ", 1, 3\n";
  if (rotation.speed > 0.0) {
    const Eigen::Vector3d& o = rotation.origin;
    const Eigen::Vector3d& e = rotation.direction;
    out << "*STEP, NLGEOM, INC=100\n*CONTROLS, PARAMETERS=FIELD\n"
        << "1e-8, 1e-8, , , 1e-8, 1e-8, 1e-8, 1e-8\n*STATIC\n*DLOAD\nall, CENTRIF, "
        << rotation.speed * rotation.speed << ", " << o.x() << ", " << o.y() << ", " << o.z()
        << ", " << e.x() << ", " << e.y() << ", " << e.z() << "\n*END STEP\n";
  }
  out << (rotation.speed > 0.0 ? "*STEP, PERTURBATION\n" : "*STEP\n") << "*FREQUENCY\n"
      << n_modes << "\n*END STEP\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The table below "E I G E N V A L U E   O U T P U T": number, ω², ω, f, imaginary part.
Eigen::VectorXd read_frequencies(const fs::path& dat, int n_modes) {
  Eigen::VectorXd frequency(n_modes);
  int n = 0;
  std::ifstream in(dat);
  for (std::string line; n < n_modes && std::getline(in, line);) {
    std::istringstream words(line);
    int number = 0;
    double square = 0.0;
    double omega = 0.0;
    if (words >> number >> square >> omega && number == n + 1) frequency[n++] = omega;
  }
  if (n < n_modes) throw std::runtime_error("ccx printed " + std::to_string(n) + " frequencies");
  return frequency;
}

}  // namespace

bool has_calculix() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

Eigen::VectorXd calculix_frequencies(const mesh::Mesh& mesh, const fem::Material& material,
                                     const std::vector<std::string>& clamped, int n_modes,
                                     const fem::Rotation& rotation) {
  const TemporaryFolder folder;
  write_deck(folder.path() / "modes.inp", mesh, material, clamped, n_modes, rotation);
  const std::string command = "cd '" + folder.path().string() + "' && ccx modes > log 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("ccx failed: " + text_of(folder.path() / "log"));
  }
  return read_frequencies(folder.path() / "modes.dat", n_modes);
}

}  // namespace microslip::test
