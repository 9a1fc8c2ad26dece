#include "mesh/elements/face_map.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include "mesh/count_text.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

std::int64_t tag_of(const std::vector<ElementBlock>& elements, const FaceUse& use) {
  return elements[use.block].tags[static_cast<std::size_t>(use.element)];
}

/// Seen from its element, corners of a face from the least node on, towards the smaller neighbour
/// of it: +1 as listed, −1 against.
struct Cycle {
  std::array<Eigen::Index, 4> corners{};
  int sense = 1;
};

Cycle cycle_of(const std::vector<Eigen::Index>& nodes, int n_corners) {
  const auto n = static_cast<std::size_t>(n_corners);
  const auto least = static_cast<std::size_t>(
      std::min_element(nodes.begin(), nodes.begin() + n_corners) - nodes.begin());
  const std::size_t next = (least + 1) % n;
  const std::size_t previous = (least + n - 1) % n;
  Cycle cycle;
  cycle.sense = nodes[next] < nodes[previous] ? 1 : -1;
  for (std::size_t i = 0; i < n; ++i) {
    cycle.corners[i] = nodes[(cycle.sense > 0 ? least + i : least + n - i) % n];
  }
  return cycle;
}

/// Collects one kind of finding: how many, and the elements of the first few.
class Finding {
 public:
  void add(const std::vector<ElementBlock>& elements, const FaceOwners& owners) {
    if (count_++ >= 4) return;
    std::ostringstream text;
    text << (count_ > 1 ? "; " : "");
    for (int i = 0; i < std::min(owners.count, 3); ++i) {
      text << (i > 0 ? ", " : "") << tag_of(elements, owners.uses[static_cast<std::size_t>(i)]);
    }
    if (owners.count > 3) text << ", …";
    listed_ += text.str();
  }
  /// @param one, many  what they are, of one and of several.
  void refuse(const char* one, const char* many, const std::string& remedy) const {
    if (count_ == 0) return;
    throw MeshError("bad-mesh: " + counted(count_, one, many) + ": elements " + listed_ +
                    (count_ > 4 ? "; …; " : "; ") + remedy);
  }

 private:
  int count_ = 0;
  std::string listed_;
};

}  // namespace

FaceKey face_key(const std::array<Eigen::Index, 4>& nodes, int n_corners) {
  FaceKey key{-1, -1, -1, -1};
  for (int i = 0; i < n_corners; ++i) {
    key[static_cast<std::size_t>(i)] = nodes[static_cast<std::size_t>(i)];
  }
  const auto order = [&](std::size_t i, std::size_t j) {
    if (key[j] < key[i]) std::swap(key[i], key[j]);
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return key;
}

FaceMap map_faces(const std::vector<ElementBlock>& elements) {
  FaceMap map;
  for (std::size_t b = 0; b < elements.size(); ++b) {
    const ElementBlock& block = elements[b];
    const auto table = faces(block.type);
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      for (std::size_t f = 0; f < table.size(); ++f) {
        const int corners = n_corners(face_type(block.type, f));
        std::array<Eigen::Index, 4> nodes{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(corners); ++i) {
          nodes[i] = block.connectivity(e, table[f][i]);
        }
        FaceOwners& owners = map[face_key(nodes, corners)];
        if (owners.count < 3) owners.uses[static_cast<std::size_t>(owners.count)] = {b, e, f};
        ++owners.count;
      }
    }
  }
  return map;
}

std::vector<Eigen::Index> face_nodes(const std::vector<ElementBlock>& elements,
                                     const FaceUse& use) {
  const ElementBlock& block = elements[use.block];
  std::vector<Eigen::Index> nodes;
  for (const int local : faces(block.type)[use.face]) {
    nodes.push_back(block.connectivity(use.element, local));
  }
  return nodes;
}

std::vector<FaceUse> outer_faces(const FaceMap& faces) {
  std::vector<FaceUse> outer;
  for (const auto& [key, owners] : faces) {
    if (owners.count == 1) outer.push_back(owners.uses.front());
  }
  std::sort(outer.begin(), outer.end());
  return outer;
}

void check_faces(const std::vector<ElementBlock>& elements, const FaceMap& map) {
  Finding crowded;
  Finding one_sided;
  Finding unequal;
  for (const auto& [key, owners] : map) {
    if (owners.count == 1) continue;
    if (owners.count > 2) {
      crowded.add(elements, owners);
      continue;
    }
    std::vector<Eigen::Index> one = face_nodes(elements, owners.uses[0]);
    std::vector<Eigen::Index> other = face_nodes(elements, owners.uses[1]);
    const int corners = key[0] < 0 ? 3 : 4;
    const Cycle here = cycle_of(one, corners);
    const Cycle there = cycle_of(other, corners);
    std::sort(one.begin(), one.end());
    std::sort(other.begin(), other.end());
    if (here.corners != there.corners || one != other) {
      unequal.add(elements, owners);
    } else if (here.sense == there.sense) {
      one_sided.add(elements, owners);
    }
  }
  crowded.refuse("face has three or more elements", "faces have three or more elements",
                 "elements overlap or are there twice");
  one_sided.refuse("face has both its elements on one side",
                   "faces have both their elements on one side", "the elements overlap");
  unequal.refuse(
      "face has two elements that share its corners but not its edges or the nodes on them",
      "faces share their corners but not their edges or the nodes on them",
      "the elements do not fit together; use one element order in the whole body");
}

}  // namespace microslip::mesh
