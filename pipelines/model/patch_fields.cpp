#include "pipelines/model/patch_fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>

#include "contact/force/fitted_rule.hpp"
#include "contact/patch/preload_field.hpp"
#include "mesh/shape_functions.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

// Areas of the same patch, added up differently, agree to rounding; a rectangle or straight edges
// that only nearly are would lose a part of the patch.
constexpr double same_area = 1e-9;
Eigen::Vector2d in_plane(const PatchPlane& plane, const Eigen::Vector3d& x) {
  return {plane.frame.row(0).dot(x - plane.origin), plane.frame.row(2).dot(x - plane.origin)};
}

/// How far outside its face a place is, 0 inside, in reference coordinates.
double outside(mesh::FaceType type, const Eigen::Vector2d& xi) {
  if (mesh::n_corners(type) == 3) {
    return std::max({0.0, -xi[0], -xi[1], xi[0] + xi[1] - 1.0});
  }
  return std::max({0.0, std::abs(xi[0]) - 1.0, std::abs(xi[1]) - 1.0});
}

/// Newton's method for x(ξ) = place; a face with straight edges needs one step.
Eigen::Vector2d reference_place(mesh::FaceType type,
                                const Eigen::Matrix<double, Eigen::Dynamic, 2>& nodes,
                                const Eigen::Vector2d& place) {
  constexpr int max_steps = 20;
  constexpr double enough = 1e-13;  // of a face
  Eigen::Vector2d xi = mesh::n_corners(type) == 3 ? Eigen::Vector2d(1.0 / 3.0, 1.0 / 3.0)
                                                  : Eigen::Vector2d(0.0, 0.0);
  for (int i = 0; i < max_steps; ++i) {
    const mesh::FaceShapes s = mesh::shapes(type, xi);
    const Eigen::Vector2d rest = place - nodes.transpose() * s.values;
    const Eigen::Matrix2d tangents = nodes.transpose() * s.gradients;
    const Eigen::Vector2d step = tangents.inverse() * rest;
    if (!step.allFinite()) break;
    xi += step;
    if (step.norm() < enough) break;
  }
  return xi;
}

double area_of(const contact::PatchCells& cells) {
  return contact::midpoint_rule(cells).weights.sum();
}

}  // namespace

PatchFields::PatchFields(const mesh::Mesh& mesh, const ContactDescription& contact,
                         const PatchPlane& plane, contact::ModalContactField shapes,
                         const Eigen::Vector3d& shapes_origin,
                         const fem::ResidualFlexibility* residual, contact::PatchCells sampled)
    : tangential_stiffness_(contact.tangential_stiffness),
      normal_stiffness_(contact.normal_stiffness),
      friction_(contact.friction),
      shapes_(std::move(shapes)),
      shapes_offset_(-in_plane(plane, shapes_origin)),
      has_residual_(residual != nullptr) {
  if (contact.preload_field) preload_.emplace(*contact.preload_field);
  const mesh::Surface& surface = mesh.surface(contact.surface);
  add_faces(mesh, surface, plane, residual);
  choose_cells(surface.area, std::move(sampled));
  const contact::PatchRule rule = contact::gauss_rule(cells_, contact::FittedRuleOptions{}.order);
  total_stiffness_ = rule.weights.dot(stiffness(compliance(rule.p, rule.r), 1));
  unit_preload_ = 1.0 / (preload_ ? carried_by_field(contact.preload_field->place) : rule.weights.sum());
}

double PatchFields::carried_by_field(const std::string& place) const {
  const auto field = [this](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    return preload_->at(p, r);
  };
  // The pressed part ends at a line, which no rule of a whole cell sees.
  const contact::PatchRule rule = contact::fitted_rule(cells_, {field, {{}}}, {});
  const Eigen::VectorXd shape = field(rule.p, rule.r);
  const double carried = contact::carried_force(shape, rule.weights);
  if (!(rule.weights.dot(shape) > 0.0) || !std::isfinite(1.0 / carried)) {
    throw SceneError(place + ": expected a field whose integral over the patch is above 0");
  }
  return carried;
}

void PatchFields::add_faces(const mesh::Mesh& mesh, const mesh::Surface& surface,
                            const PatchPlane& plane, const fem::ResidualFlexibility* residual) {
  for (const mesh::FaceBlock& block : surface.faces) {
    const Eigen::Index n = block.connectivity.cols();
    for (Eigen::Index i = 0; i < block.connectivity.rows(); ++i) {
      Face face;
      face.type = block.type;
      face.nodes.resize(n, 2);
      face.compliance = Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(n, 2);
      for (Eigen::Index a = 0; a < n; ++a) {
        const Eigen::Index node = block.connectivity(i, a);
        face.nodes.row(a) = in_plane(plane, mesh.nodes().row(node).transpose());
        const auto row = std::lower_bound(surface.nodes.begin(), surface.nodes.end(), node) -
                         surface.nodes.begin();
        if (residual != nullptr) face.compliance.row(a) = residual->row_sums.row(row).head<2>();
      }
      face.low = face.nodes.colwise().minCoeff();
      face.high = face.nodes.colwise().maxCoeff();
      faces_.push_back(std::move(face));
    }
  }
}

void PatchFields::choose_cells(double area, contact::PatchCells sampled) {
  Eigen::Vector2d low = faces_.front().low;
  Eigen::Vector2d high = faces_.front().high;
  for (const Face& face : faces_) {
    low = low.cwiseMin(face.low);
    high = high.cwiseMax(face.high);
  }
  const auto is_patch = [area](double other) { return std::abs(other - area) <= same_area * area; };
  if (!has_residual_ && is_patch((high - low).prod())) {
    cells_ = contact::rectangle_cells(low, high, 1, 1);
    return;
  }
  const auto n = static_cast<Eigen::Index>(faces_.size());
  contact::PatchCells cells{Eigen::MatrixX2d(4 * n, 2), Eigen::MatrixX4i(n, 4)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Face& face = faces_[static_cast<std::size_t>(i)];
    const int n_corners = mesh::n_corners(face.type);
    cells.vertices.middleRows<4>(4 * i) = face.nodes.row(0).replicate<4, 1>();
    cells.vertices.middleRows(4 * i, n_corners) = face.nodes.topRows(n_corners);
    for (int a = 0; a < 4; ++a) {
      cells.corners(i, a) = a < n_corners ? static_cast<int>(4 * i) + a : -1;
    }
  }
  cells_ = is_patch(area_of(cells)) ? std::move(cells) : std::move(sampled);
}

contact::ModalShapes PatchFields::shapes(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  contact::ModalShapes shapes =
      shapes_.at(p.array() + shapes_offset_[0], r.array() + shapes_offset_[1]);
  shapes.w.resize(0, 0);
  return shapes;
}

Eigen::MatrixX2d PatchFields::compliance(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  Eigen::MatrixX2d result = Eigen::MatrixX2d::Zero(p.size(), 2);
  if (!has_residual_) return result;
  constexpr double inside = 1e-9;  // of a face: a place on an edge belongs to either side
  std::size_t last = 0;            // rules list the points of a cell together
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d place(p[i], r[i]);
    double nearest = 1e300;
    for (std::size_t k = 0; k < faces_.size() && nearest > inside; ++k) {
      const std::size_t index = (last + k) % faces_.size();
      const Face& face = faces_[index];
      const Eigen::Vector2d margin = 0.1 * (face.high - face.low);
      const bool far = ((place - face.low + margin).array() < 0.0).any() ||
                       ((face.high + margin - place).array() < 0.0).any();
      if (far) continue;
      const Eigen::Vector2d xi = reference_place(face.type, face.nodes, place);
      const double distance = outside(face.type, xi);
      if (distance >= nearest) continue;
      nearest = distance;
      last = index;
      result.row(i) = mesh::shapes(face.type, xi).values.transpose() * face.compliance;
    }
  }
  return result;
}

Eigen::VectorXd PatchFields::stiffness(const Eigen::MatrixX2d& compliance, int axis) const {
  return series_stiffness(axis == 0 ? tangential_stiffness_ : normal_stiffness_,
                          compliance.col(axis), axis == 0 ? "tangential" : "normal", true);
}

std::vector<contact::PointParameters> PatchFields::parameters(const Eigen::VectorXd& p,
                                                              const Eigen::VectorXd& r,
                                                              double load) const {
  const Eigen::MatrixX2d flexible = compliance(p, r);
  const Eigen::VectorXd tangential = stiffness(flexible, 0);
  const Eigen::VectorXd normal = stiffness(flexible, 1);
  const Eigen::VectorXd friction = friction_factor_ * friction_.at(p, r);
  Eigen::VectorXd preload = Eigen::VectorXd::Constant(p.size(), load * unit_preload_);
  if (load < 0.0) {
    if (total_stiffness_ <= 0.0) {
      throw RefusedError(
          "response.preload: a gap needs a normal contact stiffness, and it is zero");
    }
    preload = load / total_stiffness_ * normal;
  } else if (preload_) {
    preload.array() *= preload_->at(p, r).array();
  }
  std::vector<contact::PointParameters> points(static_cast<std::size_t>(p.size()));
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    points[static_cast<std::size_t>(i)] = {tangential[i], normal[i], friction[i], preload[i]};
  }
  return points;
}

}  // namespace microslip::pipelines
