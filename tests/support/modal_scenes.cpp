#include "tests/support/modal_scenes.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "contact/sampled/patch_force.hpp"
#include "contact/transient/patch_transient.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::tests {
namespace {

constexpr double pi = std::numbers::pi;

/// Modes, output and a force along sin θ through the output's own direction;
/// contact added by the caller.
solver::Scene linear_scene(const Eigen::VectorXd& frequency, double damping_ratio,
                           const Eigen::VectorXd& output, const Eigen::VectorXd& force) {
  solver::Scene scene;
  scene.natural_frequency = frequency;
  scene.damping_ratio = Eigen::VectorXd::Constant(frequency.size(), damping_ratio);
  scene.output = output;
  scene.excitation = contact::Harmonics(1, frequency.size());
  scene.excitation.rows().row(1) = force.transpose();
  return scene;
}

/// Modal frequencies of the chains of theory section 20: 20.0 and 52.4 Hz before rounding.
Eigen::VectorXd chain_frequencies() {
  const double k1 = 41339.0;
  const double k2 = 41328.0;
  const double half_trace = 0.5 * (k1 + 2.0 * k2);
  const double root = std::sqrt(half_trace * half_trace - k1 * k2);
  return Eigen::Vector2d(std::sqrt(half_trace - root), std::sqrt(half_trace + root));
}

solver::Scene random_structure(Draw& draw, int n_modes, double force) {
  solver::Scene scene;
  scene.natural_frequency.resize(n_modes);
  scene.damping_ratio.resize(n_modes);
  scene.output.resize(n_modes);
  scene.excitation = contact::Harmonics(1, n_modes);
  const double damping = draw.log_uniform(1e-5, 0.1);
  const bool static_load = draw.chance(0.2);
  double omega = draw.log_uniform(10.0, 1e4);
  for (int i = 0; i < n_modes; ++i) {
    scene.natural_frequency[i] = omega;
    omega *= 1.0 + draw.log_uniform(0.01, 3.0);
    scene.damping_ratio[i] = damping * draw.uniform(0.5, 1.5);
    scene.output[i] = draw.uniform(-1.0, 1.0);
    scene.excitation.rows()(0, i) = static_load ? 0.3 * force * draw.uniform(-1.0, 1.0) : 0.0;
    scene.excitation.rows()(1, i) = force * draw.uniform(-1.0, 1.0);
    scene.excitation.rows()(2, i) = force * draw.uniform(-1.0, 1.0);
  }
  return scene;
}

std::unique_ptr<ReadablePatch> random_patch(Draw& draw, int n_modes, double first, double force) {
  const int n_points = draw.whole(1, 24);
  const double stiffness = first * first * draw.log_uniform(1e-3, 1e3) / n_points;
  const bool moves_normally = draw.chance(0.7);
  const double normal_stiffness = moves_normally ? stiffness * draw.log_uniform(0.1, 10.0) : 0.0;
  const double normal_share = moves_normally ? draw.log_uniform(0.05, 1.0) : 0.0;
  const double friction = draw.log_uniform(0.05, 1.0);
  const bool gap = moves_normally && draw.chance(0.35);
  const double load = (gap ? -1.0 : 1.0) * force * draw.log_uniform(1e-2, 1e3) / n_points;
  Eigen::VectorXd weights(n_points);
  std::vector<contact::PointParameters> points;
  contact::ModalShapes shapes{
      Eigen::MatrixXd(n_points, n_modes), Eigen::MatrixXd(n_points, n_modes), {}};
  for (int i = 0; i < n_points; ++i) {
    weights[i] = draw.uniform(0.5, 1.5);
    points.push_back({stiffness, normal_stiffness, friction, load * draw.uniform(0.5, 1.5)});
    for (int k = 0; k < n_modes; ++k) {
      shapes.u(i, k) = draw.uniform(-1.0, 1.0);
      shapes.v(i, k) = normal_share * draw.uniform(-1.0, 1.0);
    }
  }
  return std::make_unique<ReadablePatch>(
      contact::ContactPatch(std::move(weights), std::move(points)), std::move(shapes));
}

solver::Scene copied_structure(const solver::Scene& scene) {
  solver::Scene copy;
  copy.natural_frequency = scene.natural_frequency;
  copy.damping_ratio = scene.damping_ratio;
  copy.excitation = scene.excitation;
  copy.output = scene.output;
  return copy;
}

/// @throws std::bad_cast  the contact is not a ReadablePatch.
std::unique_ptr<ReadablePatch> copied_patch(const solver::Scene& scene, double load_factor) {
  const auto& patch = dynamic_cast<const ReadablePatch&>(*scene.contact);
  std::vector<contact::PointParameters> points = patch.patch().points();
  for (contact::PointParameters& point : points) point.rest_load *= load_factor;
  return std::make_unique<ReadablePatch>(
      contact::ContactPatch(patch.patch().weights(), std::move(points)), patch.shapes());
}

}  // namespace

solver::Scene chain_scene(double preload) {
  // (k₂ − ω²) y₂ = k₂ y₁ gives each mode, then ΦᵀΦ = 1.
  const Eigen::VectorXd frequency = chain_frequencies();
  Eigen::Matrix2d modes;
  for (Eigen::Index i = 0; i < 2; ++i) {
    modes.col(i) << 41328.0 - frequency[i] * frequency[i], 41328.0;
    modes.col(i).normalize();
  }
  const Eigen::VectorXd output = modes.row(1).transpose();
  solver::Scene scene = linear_scene(frequency, 0.02, output, 10.0 * output);
  scene.contact = std::make_unique<ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Ones(1), {{40000.0, 0.0, 0.5, preload}}),
      contact::ModalShapes{modes.row(0), Eigen::MatrixXd::Zero(1, 2), {}});
  return scene;
}

solver::Scene patch_scene(const PatchScene& size, double preload, double force) {
  Eigen::VectorXd frequency(size.n_modes);
  Eigen::VectorXd output(size.n_modes);
  const auto n = static_cast<Eigen::Index>(size.n_points);
  contact::ModalShapes shapes{
      Eigen::MatrixXd(n, size.n_modes), Eigen::MatrixXd(n, size.n_modes), {}};
  for (int k = 0; k < size.n_modes; ++k) {
    frequency[k] = 2.0 * pi * 300.0 * (1.0 + 1.7 * k + 0.4 * k * k);
    output[k] = 4.0 * std::cos(1.3 * k);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      shapes.u(i, k) = 0.6 * std::cos(0.7 * k + 1.1 * x * (k + 1.0));
      shapes.v(i, k) = 0.4 * std::sin(0.4 + 0.9 * k + 0.8 * x * (k + 1.0));
    }
  }
  solver::Scene scene = linear_scene(frequency, 0.002, output, force * output);
  const double stiffness = 4e7;  // of the patch, tangential and normal [N/m]
  const double share = 1.0 / static_cast<double>(n);
  std::vector<contact::PointParameters> points(static_cast<std::size_t>(n),
                                               {stiffness, stiffness, 0.4, preload});
  scene.contact = std::make_unique<ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Constant(n, share), std::move(points)),
      std::move(shapes));
  return scene;
}

RandomScene wild_scene(std::uint64_t seed) {
  Draw draw(seed);
  const int n_modes = draw.whole(1, 8);
  const double force = draw.log_uniform(1e-3, 1e3);
  RandomScene result;
  result.scene = random_structure(draw, n_modes, force);
  const auto& frequency = result.scene.natural_frequency;
  result.scene.contact = random_patch(draw, n_modes, frequency[0], force);
  result.options.frequency_begin = frequency[0] * draw.uniform(0.5, 0.95);
  result.options.frequency_end = frequency[draw.whole(0, n_modes - 1)] * draw.uniform(1.05, 2.5);
  if (draw.chance(0.3)) std::swap(result.options.frequency_begin, result.options.frequency_end);
  return result;
}

solver::Scene scaled_scene(const solver::Scene& scene, double factor) {
  solver::Scene copy = copied_structure(scene);
  copy.excitation.rows() *= factor;
  copy.contact = copied_patch(scene, factor);
  return copy;
}

solver::Scene turned_scene(const solver::Scene& scene, double phase) {
  // F(θ + φ): (s + ic) e^{iφ}
  solver::Scene copy = copied_structure(scene);
  const double cosine = std::cos(phase);
  const double sine = std::sin(phase);
  copy.excitation.rows().row(1) =
      cosine * scene.excitation.rows().row(1) - sine * scene.excitation.rows().row(2);
  copy.excitation.rows().row(2) =
      sine * scene.excitation.rows().row(1) + cosine * scene.excitation.rows().row(2);
  copy.contact = copied_patch(scene, 1.0);
  return copy;
}

void add_transient(solver::Scene& scene) {
  const auto& patch = dynamic_cast<const ReadablePatch&>(*scene.contact);
  scene.transient = std::make_unique<contact::PatchTransient>(patch.patch(), patch.shapes());
}

void use_event_cycles(solver::Scene& scene) {
  const auto& patch = dynamic_cast<const ReadablePatch&>(*scene.contact);
  std::vector<std::shared_ptr<const contact::PointMethod>> laws;
  for (const contact::PointParameters& point : patch.patch().points()) {
    laws.push_back(std::make_shared<contact::LineEvents>(point));
  }
  scene.contact = std::make_unique<contact::PointMethodForce>(patch.patch().weights(),
                                                              std::move(laws), patch.shapes());
}

void use_lanes(solver::Scene& scene, int instants) {
  const auto& patch = dynamic_cast<const ReadablePatch&>(*scene.contact);
  std::vector<contact::SurfaceLaw> surfaces;
  for (const contact::PointParameters& point : patch.patch().points()) {
    surfaces.emplace_back(point, 0.0);
  }
  scene.contact = std::make_unique<contact::sampled::PatchForce>(
      patch.patch().weights(), std::move(surfaces), patch.shapes(), instants);
}

}  // namespace microslip::tests
