#include "pipelines/model/patch_shapes.hpp"

#include <array>
#include <optional>
#include <vector>

#include "contact/patch/modal_contact_field.hpp"
#include "pipelines/model/contact_frame.hpp"

namespace microslip::pipelines {
namespace {

/// Displacement of every mode along one direction at given mesh nodes: n_nodes × n_modes.
Eigen::MatrixXd along(const Eigen::MatrixXd& shapes, const std::vector<Eigen::Index>& nodes,
                      const Eigen::Vector3d& direction) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(nodes.size()), shapes.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    values.row(i) =
        direction.transpose() * shapes.middleRows<3>(3 * nodes[static_cast<std::size_t>(i)]);
  }
  return values;
}

/// p, q and r of places, n each.
struct PlaceAxes {
  Eigen::MatrixX3d p, q, r;
};

PlaceAxes axes_of(const mesh::FaceFrame& frame, const Eigen::MatrixX3d& normals) {
  const Eigen::Index n = normals.rows();
  PlaceAxes axes{Eigen::MatrixX3d(n, 3), normals, Eigen::MatrixX3d(n, 3)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Matrix3d own = frame.at(normals.row(i));
    axes.p.row(i) = own.row(0);
    axes.r.row(i) = own.row(2);
  }
  return axes;
}

/// Displacements along axes that differ from place to place.
/// @param xyz  n_places × n_modes along x, y, z.
Eigen::MatrixXd along(const std::array<Eigen::MatrixXd, 3>& xyz, const Eigen::MatrixX3d& axis) {
  return axis.col(0).asDiagonal() * xyz[0] + axis.col(1).asDiagonal() * xyz[1] +
         axis.col(2).asDiagonal() * xyz[2];
}

contact::ModalShapes shapes_at_places(const Eigen::MatrixXd& shapes,
                                      const std::vector<Eigen::Index>& nodes,
                                      const Eigen::SparseMatrix<double>& to,
                                      const PlaceAxes& axes) {
  std::array<Eigen::MatrixXd, 3> xyz;
  for (Eigen::Index i = 0; i < 3; ++i) {
    xyz[static_cast<std::size_t>(i)] = to * along(shapes, nodes, Eigen::Vector3d::Unit(i));
  }
  return {along(xyz, axes.p), along(xyz, axes.q), along(xyz, axes.r)};
}

/// Of a curved face: the displacements of the elements along the axes of each place,
/// no field fitted in a plane.
void set_local_shapes(contact::Patch& patch, const SampledFace& face,
                      const Eigen::MatrixXd& shapes) {
  const auto& [mesh, surface, sampling, frame] = face;
  const PlaceAxes centres = axes_of(frame, sampling.centre_normals);
  const PlaceAxes vertices = axes_of(frame, sampling.vertex_normals);
  patch.cells.slip_directions = centres.p;
  patch.cells.normals = centres.q;
  patch.vertices.slip_directions = vertices.p;
  patch.vertices.normals = vertices.q;
  patch.cells.shapes = shapes_at_places(shapes, surface.nodes, sampling.to_centres, centres);
  patch.vertices.shapes = shapes_at_places(shapes, surface.nodes, sampling.to_vertices, vertices);
}

contact::ModalShapes interpolate(const Eigen::SparseMatrix<double>& to,
                                 const contact::ModalShapes& nodal) {
  return {to * nodal.u, to * nodal.v, to * nodal.w};
}

/// The plane of a patch: where p = r = 0, and rows p, q, r.
struct PatchPlane {
  Eigen::Vector3d origin;
  Eigen::Matrix3d frame;
};

Eigen::MatrixX3d node_positions(const mesh::Mesh& mesh, const mesh::Surface& surface) {
  Eigen::MatrixX3d positions(static_cast<Eigen::Index>(surface.nodes.size()), 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    positions.row(i) = mesh.nodes().row(surface.nodes[static_cast<std::size_t>(i)]);
  }
  return positions;
}

/// Places all over the patch, the same whatever number of contact points it has.
Eigen::MatrixX2d places_between_nodes(const mesh::Mesh& mesh, const mesh::Surface& surface,
                                      const PatchPlane& plane) {
  constexpr int enough = 1000;  // some ten between nodes where the patch is coarse
  const mesh::SurfaceSampling dense = mesh::sample_surface(mesh.nodes(), surface, enough);
  const auto places = in_plane(dense.centres, plane.origin, plane.frame);
  Eigen::MatrixX2d result(places.p.size(), 2);
  result << places.p, places.r;
  return result;
}

contact::ModalContactField fitted_field(const mesh::Mesh& mesh, const mesh::Surface& surface,
                                        const mesh::SurfaceSampling& sampling,
                                        const PatchSettings& settings,
                                        const contact::ModalShapes& nodal,
                                        const PatchPlane& plane) {
  const auto nodes = in_plane(node_positions(mesh, surface), plane.origin, plane.frame);
  // A positive share of the area for each node; interpolation weights themselves may be negative.
  const Eigen::VectorXd weights = sampling.to_centres.cwiseAbs().transpose() * sampling.weights;
  const auto degree = settings.fit == PatchSettings::Fit::degree
                          ? std::optional<int>(settings.fit_degree)
                          : std::nullopt;
  return {nodes.p, nodes.r, weights, nodal, degree, places_between_nodes(mesh, surface, plane)};
}

contact::ModalShapes shapes_at(const contact::ModalContactField& field,
                               const Eigen::MatrixX3d& points, const PatchPlane& plane) {
  const auto places = in_plane(points, plane.origin, plane.frame);
  return field.at(places.p, places.r);
}

/// Along the axes of the patch, of the elements or of a field fitted to them.
void set_plane_shapes(contact::Patch& patch, const SampledFace& face, const PatchSettings& settings,
                      const Eigen::MatrixXd& shapes) {
  const auto& [mesh, surface, sampling, frame] = face;
  const contact::ModalShapes nodal{along(shapes, surface.nodes, frame.plane.row(0)),
                                   along(shapes, surface.nodes, frame.plane.row(1)),
                                   along(shapes, surface.nodes, frame.plane.row(2))};
  const auto take_elements = [&] {
    patch.cells.shapes = interpolate(sampling.to_centres, nodal);
    patch.vertices.shapes = interpolate(sampling.to_vertices, nodal);
  };
  if (settings.fit == PatchSettings::Fit::none) {
    take_elements();
    return;
  }
  const PatchPlane plane{mesh::fit_plane(mesh.nodes(), surface).centroid, frame.plane};
  const contact::ModalContactField field =
      fitted_field(mesh, surface, sampling, settings, nodal, plane);
  patch.fit_error = field.fit_error();
  if (settings.fit == PatchSettings::Fit::automatic && is_fit_poor(patch)) {
    take_elements();
    return;
  }
  patch.fit_degree = field.degree();
  patch.cells.shapes = shapes_at(field, sampling.centres, plane);
  patch.vertices.shapes = shapes_at(field, sampling.vertices, plane);
}

}  // namespace

bool is_fit_poor(const contact::Patch& patch) {
  constexpr double poor = 0.05;
  return patch.fit_error.size() > 0 && patch.fit_error.maxCoeff() > poor;
}

void set_shapes(contact::Patch& patch, const SampledFace& face, const PatchSettings& settings,
                const Eigen::MatrixXd& shapes) {
  if (face.frame.is_local()) {
    set_local_shapes(patch, face, shapes);
  } else {
    set_plane_shapes(patch, face, settings, shapes);
  }
}

}  // namespace microslip::pipelines
