/// @file
/// A meshed contact patch as functions of position: what a rule fitted to the lines of slip and separation
/// (contact/fitted_patch_force.hpp) needs, which asks for points that no sampling has foreseen.
///
///   mode shapes    the fitted polynomials
///   stiffness      1/k = 1/k_local + c, c interpolated by the finite elements of the face (theory
///                  section 14): smooth within a face, continuous across
///   friction, preload   as the scene gives them, anywhere
///
/// Cells: one rectangle where the patch is one along p and r and the stiffness is the same everywhere; else the
/// faces of the mesh; where these have curved edges the cells of the sampling.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_patch.hpp"
#include "contact/patch/modal_contact_field.hpp"
#include "contact/patch/patch_quadrature.hpp"
#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"
#include "pipelines/scene/field_description.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// Coordinates in the plane of a patch: x = origin + p·frame.row(0) + r·frame.row(2).
struct PatchPlane {
  Eigen::Vector3d origin;  ///< [m]
  Eigen::Matrix3d frame;   ///< rows p, q, r
};

class PatchFields {
 public:
  /// @param plane         its origin is that of friction and preload fields.
  /// @param shapes        in p and r from shapes_origin.
  /// @param residual      row sums on the surface; nullptr: local stiffness alone.
  /// @param sampled       cells to fall back on, vertices in p and r.
  /// @throws SceneError   a field that is not finite or out of range, a preload field whose integral is not above 0.
  PatchFields(const mesh::Mesh& mesh, const ContactDescription& contact, const PatchPlane& plane,
              contact::ModalContactField shapes, const Eigen::Vector3d& shapes_origin,
              const fem::ResidualFlexibility* residual, contact::PatchCells sampled);

  /// The friction coefficient everywhere times a factor.
  void multiply_friction(double factor) { friction_factor_ *= factor; }

  [[nodiscard]] const contact::PatchCells& cells() const { return cells_; }
  /// u and v alone. @param p, r  [m], n each.   @return n × n_modes.
  [[nodiscard]] contact::ModalShapes shapes(const Eigen::VectorXd& p,
                                            const Eigen::VectorXd& r) const;
  /// @param load  preload [N], carried by the part of the patch that is pressed; negative: the gap it stands for (interfaces: −load/∬k_v dA).
  /// @throws RefusedError  a stiffness that is not positive.
  [[nodiscard]] std::vector<contact::PointParameters> parameters(const Eigen::VectorXd& p,
                                                                 const Eigen::VectorXd& r,
                                                                 double load) const;

 private:
  struct Face {
    mesh::FaceType type = mesh::FaceType::tri3;
    Eigen::Matrix<double, Eigen::Dynamic, 2> nodes;       // (p, r)
    Eigen::Matrix<double, Eigen::Dynamic, 2> compliance;  // along p and q, at the nodes
    Eigen::Vector2d low, high;                            // box around it
  };

  void add_faces(const mesh::Mesh& mesh, const mesh::Surface& surface, const PatchPlane& plane,
                 const fem::ResidualFlexibility* residual);
  /// ∬ max(field, 0) dA. @param place  of the field, for messages.
  [[nodiscard]] double carried_by_field(const std::string& place) const;
  void choose_cells(double area, contact::PatchCells sampled);
  [[nodiscard]] Eigen::MatrixX2d compliance(const Eigen::VectorXd& p,
                                            const Eigen::VectorXd& r) const;
  /// [N/m³] along p (axis 0) or q (axis 1).
  [[nodiscard]] Eigen::VectorXd stiffness(const Eigen::MatrixX2d& compliance, int axis) const;

  std::optional<double> tangential_stiffness_, normal_stiffness_;
  Field friction_;
  double friction_factor_ = 1.0;
  std::optional<Field> preload_;
  contact::ModalContactField shapes_;
  Eigen::Vector2d shapes_offset_;  // (p, r) of the plane → (p, r) of the shapes
  std::vector<Face> faces_;
  bool has_residual_;
  contact::PatchCells cells_;
  double unit_preload_ = 0.0;     // [Pa] per 1 N carried, times the field where there is one
  double total_stiffness_ = 0.0;  // ∬ k_v dA [N/m]
};

}  // namespace microslip::pipelines
