#include "pipelines/import/step_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/import/face_choice.hpp"
#include "pipelines/scene/scene_template.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using mesh::StepFace;

Eigen::Vector3d extent_of(const mesh::StepGeometry& geometry) {
  return geometry.nodes.colwise().maxCoeff() - geometry.nodes.colwise().minCoeff();
}

/// Without the digits that rounding leaves.
double clean(double value, double size) { return std::abs(value) < 1e-9 * size ? 0.0 : value; }

std::string coordinates(const Eigen::Vector3d& x, double size) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", clean(x.x(), size), clean(x.y(), size),
                     clean(x.z(), size));
}

/// As a scene has it.
std::string point_text(const Eigen::Vector3d& x, double size) {
  const auto one = [&](double value) {
    return fmt::format("\"{:.6g} mm\"", 1e3 * clean(value, size));
  };
  return fmt::format("[{}, {}, {}]", one(x.x()), one(x.y()), one(x.z()));
}

std::string unit_vector(Eigen::Index axis) {
  const Eigen::Vector3i unit = Eigen::Vector3i::Unit(axis);
  return fmt::format("[{}, {}, {}]", unit.x(), unit.y(), unit.z());
}

/// One significant digit, downwards.
double rounded(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  return std::floor(value / power) * power;
}

/// A guess at what of a blade a face is.
class StepSceneMaker {
 public:
  StepSceneMaker(const StepBody& body, const std::filesystem::path& scene_folder)
      : body_(body), geometry_(body.geometry), extent_(extent_of(geometry_)) {
    extent_.maxCoeff(&span_);
    const std::filesystem::path& file = body.source.file;
    const auto relative = std::filesystem::relative(file, scene_folder);
    values_["model.file"] =
        fmt::format("\"{}\"", (relative.empty() ? file : relative).generic_string());
    set_unit();
  }

  std::string make() {
    choose_faces();
    choose_points();
    double area = 0.0;
    for (const StepFace& face : geometry_.faces) area += face.area;
    const double size = rounded(std::min(2.0 * geometry_.volume / area, 0.1 * extent_.maxCoeff()));
    values_["model.element_size"] = fmt::format("\"{:g} mm\"", 1e3 * size);
    remarks_["model.element_size"] =
        "CHECK: here the mean thickness of the body, 2 × volume / surface, rounded down";
    std::string text = "# What the file has (`microslip faces` draws it):\n";
    std::istringstream table(describe_faces(body_));
    for (std::string line; std::getline(table, line);) text += "#   " + line + '\n';
    return text + scene_template("step", values_, remarks_);
  }

 private:
  void set_unit() {
    const std::string doubt = size_doubt(body_);
    values_["model.length_unit"] = body_.units.empty() || !doubt.empty() ? "\"mm\"" : "";
    if (body_.units.empty()) {
      remarks_["model.length_unit"] = "CHECK: the file does not tell it";
    } else if (!doubt.empty()) {
      remarks_["model.length_unit"] = "CHECK: " + doubt;
    }
  }

  /// The largest plane face that fits; nullptr: none.
  template <typename Fits>
  [[nodiscard]] const StepFace* largest(const Fits& fits) const {
    const StepFace* best = nullptr;
    for (const StepFace& face : geometry_.faces) {
      if (face.kind != "plane" || !fits(face)) continue;
      if (best == nullptr || face.area > best->area) best = &face;
    }
    return best;
  }

  /// From a plane across the longest side to the nearest corner of the face's triangles [m].
  [[nodiscard]] double distance(const StepFace& face, double plane) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < geometry_.owner.size(); ++i) {
      if (geometry_.owner[i] != face.number) continue;
      for (const Eigen::Index node : geometry_.triangles.row(static_cast<Eigen::Index>(i))) {
        least = std::min(least, std::abs(geometry_.nodes(node, span_) - plane));
      }
    }
    return least;
  }

  void choose_faces() {
    const double low = geometry_.nodes.col(span_).minCoeff();
    const double high = geometry_.nodes.col(span_).maxCoeff();
    const auto at_end = [&](const StepFace& face) {
      const double x = face.centre[span_];
      return std::min(x - low, high - x) < 1e-3 * extent_[span_];
    };
    const StepFace* root = largest(at_end);
    if (root == nullptr) root = &geometry_.faces.front();
    const auto along = [&](const StepFace& face) {
      return face.number != root->number && std::abs(face.normal[span_]) < 0.2;
    };
    const StepFace* contact = largest([&](const StepFace& face) {
      return along(face) && distance(face, root->centre[span_]) > 1e-3 * extent_[span_];
    });
    if (contact == nullptr) contact = largest(along);
    if (contact == nullptr) contact = &geometry_.faces.back();
    root_ = root->centre;
    values_["faces"] = fmt::format(
        "# CHOOSE what is held; here the larger plane face at an end of the longest side\n"
        "root = {{ number = {} }}\n# CHOOSE what rubs; here the largest plane face along that "
        "side, away from it\n"
        "contact = {{ number = {} }}\n",
        root->number, contact->number);
    const Eigen::Vector3d in_face = Eigen::Vector3d::Ones() - contact->normal.cwiseAbs();
    Eigen::Index slip = 0;
    (in_face + 1e-3 * extent_ / extent_.maxCoeff()).maxCoeff(&slip);
    values_["contact.slip_direction"] = unit_vector(slip);
  }

  void choose_points() {
    Eigen::Index farthest = 0;
    (geometry_.nodes.rowwise() - root_.transpose()).rowwise().squaredNorm().maxCoeff(&farthest);
    const std::string at =
        point_text(geometry_.nodes.row(farthest).transpose(), extent_.maxCoeff());
    Eigen::Index thin = 0;
    extent_.minCoeff(&thin);  // a blade bends where it is thin
    const std::string bends = unit_vector(thin);
    values_["excitation.forces"] = fmt::format(
        "[\n  {{ at = {}, direction = {}, amplitude = \"1 N\", phase = \"0 deg\" }},\n]", at,
        bends);
    values_["response.output"] = fmt::format("{{ at = {}, direction = {} }}", at, bends);
    const char* remark = "CHANGE: here the corner farthest from what is held";
    remarks_["excitation.forces"] = remark;
    remarks_["response.output"] = remark;
    remarks_["response.frequency"] = "CHANGE: `microslip modes` tells the natural frequencies";
  }

  const StepBody& body_;
  const mesh::StepGeometry& geometry_;
  Eigen::Vector3d extent_;
  Eigen::Vector3d root_ = Eigen::Vector3d::Zero();
  Eigen::Index span_ = 0;
  TemplateTexts values_;
  TemplateTexts remarks_;
};

}  // namespace

std::string describe_faces(const StepBody& body) {
  const Eigen::Vector3d extent = extent_of(body.geometry);
  const double size = extent.maxCoeff();
  std::string text = fmt::format(
      "{}\none solid of {}, {} m, {:.6g} m^3; lengths below are in m\n"
      "{:>6}  {:<12}{:>12}  {:<30} {}\n",
      unit_text(body), mesh::counted(body.geometry.faces.size(), "face", "faces"),
      fmt::format("{:.4g} x {:.4g} x {:.4g}", extent.x(), extent.y(), extent.z()),
      body.geometry.volume, "face", "kind", "area", "centre", "normal");
  for (const StepFace& face : body.geometry.faces) {
    text += fmt::format("{:>6}  {:<12}{:>12.5g}  {:<30} {}\n", face.number, face.kind, face.area,
                        coordinates(face.centre, size),
                        face.normal.isZero() ? "-" : coordinates(face.normal, 1.0));
  }
  return text;
}

std::string scene_of_step(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const StepBody body = open_step(file, std::nullopt);
  return StepSceneMaker(body, folder).make();
}

}  // namespace microslip::pipelines
