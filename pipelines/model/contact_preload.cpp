#include "pipelines/model/contact_preload.hpp"

#include <stdexcept>
#include <variant>

#include <fmt/format.h>

#include "contact/patch/preload_equilibrium.hpp"
#include "contact/patch/preload_field.hpp"
#include "mesh/surface.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/field.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

struct FacePoints {
  Eigen::VectorXd p, r;     // from the centroid [m]
  Eigen::VectorXd weights;  // [m²]
};

FacePoints face_points(const mesh::Mesh& mesh, const ContactDescription& contact, int n_points) {
  const mesh::SurfaceSampling sampling =
      mesh::sample_surface(mesh.nodes(), mesh.surface(contact.surface), n_points);
  const Eigen::Matrix3d frame = contact_frame(mesh, contact);
  const Eigen::RowVector3d centroid =
      sampling.weights.transpose() * sampling.centres / sampling.weights.sum();
  const Eigen::MatrixX3d local = (sampling.centres.rowwise() - centroid) * frame.transpose();
  return {local.col(0), local.col(2), sampling.weights};
}

/// Whether the resultant acts inside the face does not depend on the springs of its points.
void require_balance(const FacePoints& face, const ContactDescription& contact, double load) {
  const std::array<double, 2>& moment = contact.preload_moment;
  try {
    static_cast<void>(contact::preload_equilibrium(
        contact::ContactArea({face.r, face.p, face.weights}),
        contact::one_sided_springs(Eigen::VectorXd::Ones(face.p.size())),
        {.force = load, .moment_y = moment[1], .moment_z = moment[0]}));
  } catch (const contact::PreloadError& error) {
    throw RefusedError(fmt::format("preload-unbalanced: {}: {}.preload_moment: {}", contact.place,
                                   contact.key, error.what()));
  }
}

}  // namespace

Eigen::VectorXd preload_field_of(const ContactDescription& contact, const Eigen::VectorXd& p,
                                 const Eigen::VectorXd& r, const Eigen::VectorXd& weights) {
  if (!contact.preload_field) return contact::uniform_rest_load(weights, 1.0);
  const Eigen::VectorXd shape = contact.preload_field->at(p, r);
  try {
    Eigen::VectorXd field = contact::scaled_rest_load(shape, weights, 1.0);
    contact::require_total(field, weights, 1.0,
                           1e-12);  // sums of thousands of points round to 1e-14
    return field;
  } catch (const std::invalid_argument& error) {
    throw SceneError(contact.preload_field->place + ": " + error.what());
  }
}

std::vector<double> preload_shares(const mesh::Mesh& mesh, const SceneDescription& scene) {
  std::vector<double> shares;
  double sum = 0.0;
  for (const ContactDescription& contact : scene.contacts) {
    shares.push_back(contact.preload_share ? *contact.preload_share
                                           : mesh.surface(contact.surface).area);
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

namespace {

/// @param share  of a load that presses.
void require_preload(const mesh::Mesh& mesh, const SceneDescription& scene, std::size_t index,
                     double share) {
  const ContactDescription& contact = scene.contacts[index];
  const bool turned = contact.preload_moment != std::array{0.0, 0.0};
  if (!contact.preload_field && !turned) return;
  const FacePoints face = face_points(mesh, contact, contact_points(scene.settings, index));
  if (!turned) {
    static_cast<void>(preload_field_of(contact, face.p, face.r, face.weights));
    return;
  }
  if (!scene.response) return;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto* load = std::get_if<double>(&request.load);
    if (load != nullptr) require_balance(face, contact, share * *load);
  }
}

std::string describe_preload(const mesh::Mesh& mesh, const ContactDescription& contact,
                             int n_points) {
  if (!contact.preload_field) return {};
  const FacePoints face = face_points(mesh, contact, n_points);
  const Eigen::VectorXd field = preload_field_of(contact, face.p, face.r, face.weights);
  const double integral = face.weights.dot(field);
  const double pressed = face.weights.dot((field.array() > 0.0).cast<double>().matrix());
  if (!(field.minCoeff() < 0.0)) return {};
  return fmt::format(
      "preload field: presses on {:.1f} % of the patch, a gap on the rest; of a preload of 100 N "
      "the contact "
      "carries 100 N, and the integral of the field, gaps counted as pull, is {:.6g} N",
      100.0 * pressed / face.weights.sum(), 100.0 * integral);
}

}  // namespace

void require_preload(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const std::vector<double> shares = preload_shares(mesh, scene);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    require_preload(mesh, scene, i, shares[i]);
  }
}

std::string describe_preload(const mesh::Mesh& mesh, const SceneDescription& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactDescription& contact = scene.contacts[i];
    const std::string one = describe_preload(mesh, contact, contact_points(scene.settings, i));
    if (one.empty()) continue;
    if (!text.empty()) text += '\n';
    if (scene.contacts.size() > 1) text += contact.name + ": ";
    text += one;
  }
  return text;
}

}  // namespace microslip::pipelines
