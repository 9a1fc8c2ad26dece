/// @file
/// Small meshes as gmsh files, for the tests of this folder.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh::tests {

/// Project node at each place of a gmsh file, written down anew from gmsh's manual ("Node
/// ordering"): the tests must not take it from the reader.
inline std::vector<int> file_order(ElementType type) {
  if (type == ElementType::tet10) return {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  // file: edges 01 02 03 12 14 25 34 35 45; project: 01 12 20 34 45 53 03 14 25
  if (type == ElementType::wedge15) return {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10};
  // file: edges 01 03 04 12 14 23 24 34; project: 01 12 23 30 04 14 24 34
  if (type == ElementType::pyramid13) return {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12};
  // file: edges 01 03 04 12 15 23 26 37 45 47 56 67; project: 01 12 23 30 45 56 67 74 04 15 26 37
  return {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14};
}

inline int file_type(ElementType type) {
  switch (solid(type)) {
    case Solid::tetrahedron:
      return 11;
    case Solid::hexahedron:
      return 17;
    case Solid::wedge:
      return 18;
    case Solid::pyramid:
      return 19;
  }
  return 0;
}

/// Those a file is written of here.
inline constexpr std::array quadratic_types{ElementType::tet10, ElementType::hex20,
                                            ElementType::wedge15, ElementType::pyramid13};

/// One curved element: the reference element under x ↦ x + 0.05 (y², z², x²), known volume.
struct CurvedElement {
  ElementType type;
  Eigen::MatrixX3d nodes;  // project order
};

inline CurvedElement curved_element(ElementType type) {
  CurvedElement element{type, reference_nodes(type)};
  for (Eigen::Index a = 0; a < element.nodes.rows(); ++a) {
    const Eigen::RowVector3d x = element.nodes.row(a);
    element.nodes.row(a) += 0.05 * Eigen::RowVector3d(x[1] * x[1], x[2] * x[2], x[0] * x[0]);
  }
  return element;
}

template <typename Type>
void put(std::string& out, Type value) {
  char bytes[sizeof(Type)];
  std::memcpy(bytes, &value, sizeof(Type));
  out.append(bytes, sizeof(Type));
}

/// Numbers one after the other, as text or as bytes.
class GmshWriter {
 public:
  GmshWriter(double version, bool binary) : wide_(version > 4.0), binary_(binary) {
    out_ = "$MeshFormat\n";
    out_ += wide_ ? "4.1" : "2.2";
    out_ += binary ? " 1 8\n" : " 0 8\n";
    if (binary) {
      integer(1);
      out_ += '\n';
    }
    out_ += "$EndMeshFormat\n";
  }
  void text(const std::string& line) { out_ += line; }
  void integer(std::int64_t value) {
    binary_ ? put(out_, static_cast<std::int32_t>(value)) : word(std::to_string(value));
  }
  void size(std::int64_t value) {
    if (binary_ && wide_) {
      put(out_, static_cast<std::uint64_t>(value));
    } else {
      integer(value);
    }
  }
  void real(double value) {
    std::ostringstream stream;
    stream.precision(17);
    stream << value;
    binary_ ? put(out_, value) : word(stream.str());
  }
  [[nodiscard]] const std::string& content() const { return out_; }

 private:
  void word(const std::string& w) {
    out_ += w;
    out_ += " ";
  }
  std::string out_;
  bool wide_;
  bool binary_;
};

/// Format 2.2 or 4.1, text or binary: one volume element, its first face as the surface "face one",
/// its first corner as the point "tip", and a node no element uses.
inline std::string gmsh_file(const CurvedElement& element, double version, bool binary) {
  const std::vector<int> order = file_order(element.type);
  const std::vector<int>& face = faces(element.type)[0];
  const auto n = static_cast<std::int64_t>(order.size());
  const int volume_type = file_type(element.type);
  const int face_type = face.size() == 6 ? 9 : 16;
  const auto tag = [](int node) { return 100 + 7 * node; };  // gaps between the numbers
  GmshWriter w(version, binary);
  w.text("$PhysicalNames\n3\n0 5 \"tip\"\n2 6 \"face one\"\n3 8 \"body\"\n$EndPhysicalNames\n");
  const auto position = [&](int node) {
    for (Eigen::Index d = 0; d < 3; ++d) w.real(node < 0 ? 9.0 : element.nodes(node, d));
  };
  if (version < 4.0) {
    w.text("$Nodes\n");
    w.text(std::to_string(n + 1));
    w.text("\n");
    for (int node = -1; node < n; ++node) {
      w.integer(tag(node));
      position(node);
      if (!binary) w.text("\n");
    }
    w.text("\n$EndNodes\n$Elements\n3\n");
    const auto one = [&](int number, int type, int group, const std::vector<int>& nodes) {
      if (binary) {
        w.integer(type), w.integer(1), w.integer(2), w.integer(number);
      } else {
        w.integer(number), w.integer(type), w.integer(2);
      }
      w.integer(group), w.integer(1);
      for (const int node : nodes) w.integer(tag(node));
      if (!binary) w.text("\n");
    };
    one(1, 15, 5, {order[0]});
    one(2, face_type, 6, face);
    one(3, volume_type, 8, order);
    w.text("\n$EndElements\n");
    return w.content();
  }
  w.text("$Entities\n");
  w.size(1), w.size(0), w.size(1), w.size(1);
  w.integer(1), w.real(0), w.real(0), w.real(0), w.size(1), w.integer(5);
  const auto box = [&] {
    for (int i = 0; i < 6; ++i) w.real(0.0);
  };
  w.integer(1), box(), w.size(1), w.integer(6), w.size(0);
  w.integer(1), box(), w.size(1), w.integer(8), w.size(0);
  w.text("\n$EndEntities\n$Nodes\n");
  w.size(1), w.size(n + 1), w.size(1), w.size(1000);
  w.integer(3), w.integer(1), w.integer(0), w.size(n + 1);
  for (int node = -1; node < n; ++node) w.size(tag(node));
  for (int node = -1; node < n; ++node) position(node);
  w.text("\n$EndNodes\n$Elements\n");
  w.size(3), w.size(3), w.size(1), w.size(3);
  const auto one = [&](int number, int dimension, int type, const std::vector<int>& nodes) {
    w.integer(dimension), w.integer(1), w.integer(type), w.size(1), w.size(number);
    for (const int node : nodes) w.size(tag(node));
  };
  one(1, 0, 15, {order[0]});
  one(2, 2, face_type, face);
  one(3, 3, volume_type, order);
  w.text("\n$EndElements\n");
  return w.content();
}

}  // namespace microslip::mesh::tests
