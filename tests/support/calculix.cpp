#include "tests/support/calculix.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>

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

void write_nodes(std::ostream& out, const Eigen::MatrixX3d& nodes, Eigen::Index first) {
  out << std::setprecision(12) << "*NODE\n";  // a number has room for 20 characters
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    out << first + i << ", " << nodes(i, 0) << ", " << nodes(i, 1) << ", " << nodes(i, 2) << '\n';
  }
}

/// Nodes, elements (set "all"), material "metal" and supports.
void write_body(std::ostream& out, const mesh::Mesh& mesh, const fem::Material& material,
                const std::vector<std::string>& clamped) {
  write_nodes(out, mesh.nodes(), 1);
  write_elements(out, mesh);
  std::set<Eigen::Index> held;
  for (const std::string& name : clamped) {
    for (const Eigen::Index node : mesh.node_set(name)) held.insert(node);
  }
  out << "*MATERIAL, NAME=metal\n*ELASTIC\n"
      << material.youngs_modulus << ", " << material.poissons_ratio << "\n*DENSITY\n"
      << material.density << "\n*SOLID SECTION, ELSET=all, MATERIAL=metal\n*BOUNDARY\n";
  for (const Eigen::Index node : held) out << node + 1 << ", 1, 3\n";
}

void write_centrifugal_load(std::ostream& out, const fem::Rotation& rotation) {
  const Eigen::Vector3d& o = rotation.origin;
  const Eigen::Vector3d& e = rotation.direction;
  out << "*DLOAD\nall, CENTRIF, " << rotation.speed * rotation.speed << ", " << o.x() << ", "
      << o.y() << ", " << o.z() << ", " << e.x() << ", " << e.y() << ", " << e.z() << '\n';
}

void write_modes_deck(const fs::path& file, const mesh::Mesh& mesh, const fem::Material& material,
                      const std::vector<std::string>& clamped, int n_modes,
                      const fem::Rotation& rotation) {
  std::ofstream out(file);
  write_body(out, mesh, material, clamped);
  if (rotation.speed > 0.0) {
    out << "*STEP, NLGEOM, INC=100\n*CONTROLS, PARAMETERS=FIELD\n"
        << "1e-8, 1e-8, , , 1e-8, 1e-8, 1e-8, 1e-8\n*STATIC\n";
    write_centrifugal_load(out, rotation);
    out << "*END STEP\n";
  }
  out << (rotation.speed > 0.0 ? "*STEP, PERTURBATION\n" : "*STEP\n") << "*FREQUENCY\n"
      << n_modes << "\n*END STEP\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

/// Element faces of a surface on tetrahedra, by Abaqus' numbers.
void write_slave_faces(std::ostream& out, const mesh::Mesh& mesh, const mesh::Surface& surface) {
  constexpr int corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  std::set<std::set<Eigen::Index>> wanted;
  for (const mesh::FaceBlock& block : surface.faces) {
    for (const auto& row : block.connectivity.rowwise()) {
      wanted.insert({row[0], row[1], row[2]});
    }
  }
  out << "*SURFACE, NAME=slave, TYPE=ELEMENT\n";
  Eigen::Index number = 0;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    for (const auto& element : block.connectivity.rowwise()) {
      ++number;
      for (int face = 0; face < 4; ++face) {
        const auto& c = corners[face];
        if (!wanted.contains({element[c[0]], element[c[1]], element[c[2]]})) continue;
        out << number << ", S" << face + 1 << '\n';
      }
    }
  }
}

/// A brick that holds still, whose first face lies in the plane of a surface and reaches beyond it.
void write_ground(std::ostream& out, const mesh::Mesh& mesh, const mesh::Surface& surface) {
  const auto plane = mesh::fit_plane(mesh.nodes(), surface);
  const Eigen::Vector3d t = plane.diameter * plane.normal.unitOrthogonal();
  const Eigen::Vector3d s = plane.normal.cross(t);
  Eigen::MatrixX3d nodes(8, 3);
  nodes.topRows<4>() << -t.transpose() - s.transpose(), t.transpose() - s.transpose(),
      t.transpose() + s.transpose(), -t.transpose() + s.transpose();
  nodes.topRows<4>().rowwise() += plane.centroid.transpose();
  nodes.bottomRows<4>() = nodes.topRows<4>();
  nodes.bottomRows<4>().rowwise() += plane.diameter * plane.normal.transpose();
  const Eigen::Index first = mesh.n_nodes() + 1;
  write_nodes(out, nodes, first);
  out << "*ELEMENT, TYPE=C3D8, ELSET=ground\n" << mesh.n_elements() + 1;
  for (Eigen::Index i = 0; i < 8; ++i) out << ", " << first + i;
  out << "\n*SOLID SECTION, ELSET=ground, MATERIAL=metal\n*BOUNDARY\n";
  for (Eigen::Index i = 0; i < 8; ++i) out << first + i << ", 1, 3\n";
  out << "*SURFACE, NAME=master, TYPE=ELEMENT\n" << mesh.n_elements() + 1 << ", S1\n";
}

void write_contact_deck(const fs::path& file, const mesh::Mesh& mesh, const fem::Material& material,
                        const std::vector<std::string>& clamped, const CalculixLayer& layer) {
  std::ofstream out(file);
  const mesh::Surface& surface = mesh.surface(layer.surface);
  write_body(out, mesh, material, clamped);
  write_ground(out, mesh, surface);
  write_slave_faces(out, mesh, surface);
  out << "*NSET, NSET=face\n";
  for (const Eigen::Index node : surface.nodes) out << node + 1 << ",\n";
  out << "*SURFACE INTERACTION, NAME=layer\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
      << layer.stiffness
      << "\n*CONTACT PAIR, INTERACTION=layer, TYPE=SURFACE TO SURFACE\nslave, master\n"
      << "*STEP, INC=1000\n*STATIC\n";
  if (layer.rotation.speed > 0.0) write_centrifugal_load(out, layer.rotation);
  out << "*CLOAD\n";
  for (Eigen::Index i = 0; i < layer.load.size(); ++i) {
    if (layer.load[i] != 0.0)
      out << i / 3 + 1 << ", " << i % 3 + 1 << ", " << layer.load[i] << '\n';
  }
  out << "*NODE PRINT, NSET=face\nU\n*CONTACT PRINT, SLAVE=slave, MASTER=master\nCF\n*END STEP\n";
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

/// The last table of displacements and the last normal force of a contact.
CalculixContact read_contact(const fs::path& dat, const mesh::Surface& surface) {
  CalculixContact found{0.0, Eigen::MatrixX3d::Zero(std::ssize(surface.nodes), 3)};
  std::ifstream in(dat);
  Eigen::Index n_read = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Eigen::Index node = 0;
    Eigen::Vector3d u;
    if (line.find("displacements") != std::string::npos) n_read = 0;
    if (line.find("normal force (+ = tension)") != std::string::npos) {
      double area = 0.0;
      in >> area >> found.force;
    } else if (words >> node >> u[0] >> u[1] >> u[2]) {
      const auto place = std::ranges::lower_bound(surface.nodes, node - 1);
      if (place == surface.nodes.end() || *place != node - 1) continue;
      found.displacement.row(place - surface.nodes.begin()) = u.transpose();
      ++n_read;
    }
  }
  if (n_read < std::ssize(surface.nodes) || found.force == 0.0) {
    throw std::runtime_error("ccx printed displacements of " + std::to_string(n_read) +
                             " nodes of the contact and a force of " + std::to_string(found.force));
  }
  found.force = -found.force;
  return found;
}

/// Runs NAME.inp of a folder.
void run_calculix(const fs::path& folder, const std::string& name) {
  const std::string command = "cd '" + folder.string() + "' && ccx " + name + " > log 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("ccx failed: " + text_of(folder / "log"));
  }
}

}  // namespace

bool has_calculix() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

Eigen::VectorXd calculix_frequencies(const mesh::Mesh& mesh, const fem::Material& material,
                                     const std::vector<std::string>& clamped, int n_modes,
                                     const fem::Rotation& rotation) {
  const TemporaryFolder folder;
  write_modes_deck(folder.path() / "modes.inp", mesh, material, clamped, n_modes, rotation);
  run_calculix(folder.path(), "modes");
  return read_frequencies(folder.path() / "modes.dat", n_modes);
}

CalculixContact calculix_contact(const mesh::Mesh& mesh, const fem::Material& material,
                                 const std::vector<std::string>& clamped,
                                 const CalculixLayer& layer) {
  const TemporaryFolder folder;
  write_contact_deck(folder.path() / "contact.inp", mesh, material, clamped, layer);
  run_calculix(folder.path(), "contact");
  return read_contact(folder.path() / "contact.dat", mesh.surface(layer.surface));
}

}  // namespace microslip::test
