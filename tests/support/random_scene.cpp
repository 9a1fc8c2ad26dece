#include "tests/support/random_scene.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"

namespace microslip::tests {
RandomScene random_scene(std::uint64_t seed) {
  DrawFrom<std::mt19937_64> draw(seed);  // seeds are stored
  const int n_modes = draw.whole(1, 6);
  const int n_points = draw.whole(1, 12);
  RandomScene result;
  solver::Scene& s = result.scene;
  s.natural_frequency.resize(n_modes);
  s.damping_ratio.resize(n_modes);
  s.output.resize(n_modes);
  s.excitation = contact::Harmonics(1, n_modes);
  double omega = draw.log_uniform(10.0, 1e4);
  const double first = omega;
  const double damping = draw.log_uniform(1e-4, 0.05);
  const double force = draw.log_uniform(1e-2, 1e2);
  for (int i = 0; i < n_modes; ++i) {
    s.natural_frequency[i] = omega;
    omega *= draw.uniform(1.05, 3.0);
    s.damping_ratio[i] = damping;
    s.output[i] = draw.uniform(-1.0, 1.0);
    s.excitation.rows()(1, i) = force * draw.uniform(-1.0, 1.0);
    s.excitation.rows()(2, i) = force * draw.uniform(-1.0, 1.0);
  }
  // Stiffness against the first mode's, preload against the force that reaches the contact.
  const double stiffness = first * first * draw.log_uniform(0.01, 100.0) / n_points;
  const double ratio = draw.log_uniform(0.1, 10.0);
  const double mu = draw.log_uniform(0.05, 1.0);
  const double load = force * draw.log_uniform(0.1, 100.0) / n_points;
  const bool gap = draw.uniform(0.0, 1.0) < 0.25;
  const double normal_share = draw.uniform(0.0, 1.0) < 0.3 ? 0.0 : draw.log_uniform(0.05, 1.0);
  Eigen::VectorXd weights(n_points);
  std::vector<contact::PointParameters> points(static_cast<std::size_t>(n_points));
  contact::ModalShapes shapes{
      Eigen::MatrixXd(n_points, n_modes), Eigen::MatrixXd(n_points, n_modes), {}};
  for (int i = 0; i < n_points; ++i) {
    weights[i] = draw.uniform(0.5, 1.5);
    points[static_cast<std::size_t>(i)] = {
        stiffness, normal_share > 0.0 ? ratio * stiffness : 0.0, mu,
        (gap && normal_share > 0.0 ? -1.0 : 1.0) * load * draw.uniform(0.5, 1.5)};
    for (int k = 0; k < n_modes; ++k) {
      shapes.u(i, k) = draw.uniform(-1.0, 1.0);
      shapes.v(i, k) = normal_share * draw.uniform(-1.0, 1.0);
    }
  }
  s.contact = std::make_unique<ReadablePatch>(
      contact::ContactPatch(std::move(weights), std::move(points)), std::move(shapes));
  result.options.frequency_begin = first * draw.uniform(0.5, 0.9);
  result.options.frequency_end = s.natural_frequency[n_modes - 1] * draw.uniform(1.1, 2.5);
  return result;
}

solver::Scene single_point_scene(const SinglePoint& single) {
  solver::Scene s;
  s.natural_frequency = Eigen::VectorXd::Constant(1, single.frequency);
  s.damping_ratio = Eigen::VectorXd::Constant(1, single.damping_ratio);
  s.output = Eigen::VectorXd::Ones(1);
  s.excitation = contact::Harmonics(1, 1);
  s.excitation.rows()(1, 0) = single.force;
  contact::ModalShapes shapes{Eigen::MatrixXd::Constant(1, 1, single.phi_u),
                              Eigen::MatrixXd::Constant(1, 1, single.phi_v),
                              {}};
  s.contact = std::make_unique<ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Ones(1), {single.point}), std::move(shapes));
  return s;
}

solver::Scene three_dof_scene(double preload, double force_factor) {
  // Modes of the chain c1 = 41 339, c2 = 41 328 N/m, 1 kg each: (x1, y1, y2); 10 N on y2.
  const Eigen::Vector3d first(0.46531, 0.46531, 0.752975);
  const Eigen::Vector3d second(0.0, -0.8507, 0.5257);
  solver::Scene s;
  s.natural_frequency = 2.0 * std::numbers::pi * Eigen::Vector2d(20.0, 52.4);
  s.damping_ratio = Eigen::Vector2d(0.02, 0.02);
  s.output = Eigen::Vector2d(first[2], second[2]);
  s.excitation = contact::Harmonics(1, 2);
  s.excitation.rows().row(1) = 10.0 * force_factor * s.output.transpose();
  contact::ModalShapes shapes{Eigen::MatrixXd(1, 2), Eigen::MatrixXd(1, 2), {}};
  shapes.u << first[1], second[1];
  shapes.v << first[0], second[0];
  s.contact = std::make_unique<ReadablePatch>(
      contact::ContactPatch(Eigen::VectorXd::Ones(1), {{40000.0, 40000.0, 0.5, preload}}),
      std::move(shapes));
  return s;
}

}  // namespace microslip::tests
