#include "mesh/checks/mesh_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include <Eigen/Geometry>

#include "mesh/count_text.hpp"
#include "mesh/elements/element_locator.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {
namespace {

constexpr double look =
    1e-4;  // of the size of a face: above rounding, below the gaps engineers draw

/// The middle and a point near each corner.
std::vector<Eigen::Vector2d> sample_points(FaceType type) {
  if (n_corners(type) == 3) return {{1.0 / 3.0, 1.0 / 3.0}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}};
  return {{0.0, 0.0}, {-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}};
}

/// Shape functions at the sample points of every face type, computed once.
class FaceSamples {
 public:
  FaceSamples() {
    for (const FaceType type : all_face_types) {
      for (const Eigen::Vector2d& xi : sample_points(type)) {
        shapes_[static_cast<std::size_t>(type)].push_back(shapes(type, xi));
      }
    }
  }
  [[nodiscard]] const std::vector<FaceShapes>& of(FaceType type) const {
    return shapes_[static_cast<std::size_t>(type)];
  }

 private:
  std::array<std::vector<FaceShapes>, all_face_types.size()> shapes_;
};

/// One outer face with an element before it.
struct Finding {
  std::int64_t own = 0;  // numbers in the file
  std::int64_t other = 0;
  Eigen::Vector3d x;
  bool overlaps = false;  // behind the face as well: not merely touching
};

class OuterFaces {
 public:
  OuterFaces(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements)
      : nodes_(nodes), elements_(elements), locator_(nodes, elements) {}

  [[nodiscard]] std::optional<Finding> look_out_of(const FaceUse& use) const {
    const std::vector<Eigen::Index> face = face_nodes(elements_, use);
    const Eigen::MatrixX3d own = nodes_(face, Eigen::all);
    const ElementReference element{use.block, use.element};
    for (const FaceShapes& s : samples_.of(face_type(elements_[use.block].type, use.face))) {
      const Eigen::Vector3d x = own.transpose() * s.values;
      const Eigen::Matrix<double, 3, 2> tangents = own.transpose() * s.gradients;
      const Eigen::Vector3d normal = tangents.col(0).cross(tangents.col(1));
      const Eigen::Vector3d step = look * normal / std::sqrt(normal.norm());
      const std::optional<ElementReference> other = locator_.holder(x + step, element);
      if (other)
        return Finding{tag_of(element), tag_of(*other), x, locator_.holds(*other, x - step)};
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::int64_t tag_of(const ElementReference& element) const {
    return elements_[element.block].tags[static_cast<std::size_t>(element.element)];
  }

  const Eigen::MatrixX3d& nodes_;
  const std::vector<ElementBlock>& elements_;
  ElementLocator locator_;
  FaceSamples samples_;
};

void refuse(const std::vector<Finding>& findings, const std::string& where,
            const std::string& relation, const std::string& remedy) {
  std::ostringstream text;
  text << "bad-mesh: " << counted(findings.size(), "outer face lies ", "outer faces lie ") << where
       << ": of elements ";
  for (std::size_t i = 0; i < std::min<std::size_t>(findings.size(), 6); ++i) {
    text << (i > 0 ? ", " : "") << findings[i].own << ' ' << relation << ' ' << findings[i].other;
  }
  text << (findings.size() > 6 ? ", …" : "") << "; the first near ("
       << findings.front().x.transpose() << ") m; " << remedy;
  throw MeshError(text.str());
}

}  // namespace

void check_outer_faces(const Eigen::MatrixX3d& nodes, const std::vector<ElementBlock>& elements,
                       const FaceMap& faces) {
  const OuterFaces outer(nodes, elements);
  std::vector<Finding> overlapping;
  std::vector<Finding> touching;
  for (const auto& [key, owners] : faces) {
    if (owners.count != 1) continue;
    if (const std::optional<Finding> finding = outer.look_out_of(owners.uses.front())) {
      (finding->overlaps ? overlapping : touching).push_back(*finding);
    }
  }
  for (auto* findings : {&overlapping, &touching}) {
    std::sort(findings->begin(), findings->end(),
              [](const Finding& a, const Finding& b) { return a.own < b.own; });
  }
  if (!overlapping.empty()) {
    refuse(overlapping, "inside other elements", "in", "the elements overlap");
  }
  if (!touching.empty()) {
    refuse(touching, "on other elements without being joined", "on",
           "the faces do not match: a quadrilateral against triangles, or nodes in the middle of a "
           "neighbour's "
           "face or edge; make the mesh conforming");
  }
}

}  // namespace microslip::mesh
