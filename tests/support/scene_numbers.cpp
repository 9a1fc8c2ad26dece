#include "tests/support/scene_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "contact/contact_force.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::tests {
namespace {

contact::ContactEffects effects_of(const SceneNumbers& numbers) {
  contact::ContactEffects effects;
  effects.n_harmonics = numbers.n_harmonics;
  effects.second_direction = numbers.is_planar();
  return effects;
}

/// Rest loads are those of the points under a scale of one.
std::vector<contact::Patch> patches_of(const SceneNumbers& numbers) {
  const Eigen::Index n = numbers.weights.size();
  contact::Patch patch;
  patch.load_measure = contact::LoadMeasure::scale;
  contact::PatchSamples& cells = patch.cells;
  cells.points = Eigen::MatrixX3d::Zero(n, 3);
  cells.weights = numbers.weights;
  cells.shapes = {numbers.u, numbers.v, numbers.w};
  cells.stiffness.resize(n, 3);
  cells.friction.resize(n);
  cells.preload_field.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const contact::PointParameters& point = numbers.points[static_cast<std::size_t>(i)];
    const double k = point.tangential_stiffness;
    cells.stiffness.row(i) << k, point.normal_stiffness, numbers.second_stiffness * k;
    cells.friction[i] = point.friction_coefficient;
    cells.preload_field[i] = point.rest_load;
  }
  std::vector<contact::Patch> patches;
  patches.push_back(std::move(patch));
  return patches;
}

/// Masses in a row, the first held by the ground, the last sometimes; one contact.
SceneNumbers random_chain(Draw& draw) {
  const int n = draw.whole(2, 5);
  Eigen::VectorXd root_mass(n);
  for (double& root : root_mass) root = std::sqrt(draw.log_uniform(0.1, 10.0));
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const double k = draw.log_uniform(1e4, 1e6);
    K(i, i) += k;
    if (i == 0) continue;
    K(i - 1, i - 1) += k;
    K(i, i - 1) -= k;
    K(i - 1, i) -= k;
  }
  if (draw.chance(0.5)) K(n - 1, n - 1) += draw.log_uniform(1e4, 1e6);
  const Eigen::VectorXd inverse = root_mass.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(inverse.asDiagonal() * K *
                                                             inverse.asDiagonal());
  const Eigen::MatrixXd shapes = inverse.asDiagonal() * modes.eigenvectors();
  SceneNumbers chain;
  chain.frequency = modes.eigenvalues().cwiseSqrt();
  chain.damping = Eigen::VectorXd::Constant(n, draw.log_uniform(1e-3, 0.05));
  chain.output = shapes.row(draw.whole(0, n - 1)).transpose();
  const double force = draw.log_uniform(0.1, 100.0);
  chain.excitation = Eigen::MatrixXd::Zero(3, n);
  chain.excitation.row(1) = force * shapes.row(draw.whole(0, n - 1));
  const int rubs = draw.whole(0, n - 1);
  chain.u = shapes.row(rubs);
  if (draw.chance(0.4)) chain.u -= shapes.row((rubs + 1) % n);
  const bool moves = draw.chance(0.6);
  chain.v = Eigen::MatrixXd::Zero(1, n);
  if (moves) chain.v = shapes.row((rubs + n - 1) % n);
  const double stiffness = draw.log_uniform(1e4, 1e6);
  const double load = force * draw.log_uniform(0.1, 30.0);
  chain.weights = Eigen::VectorXd::Ones(1);
  chain.points = {{stiffness, moves ? stiffness * draw.log_uniform(0.1, 10.0) : 0.0,
                   draw.log_uniform(0.05, 1.0), moves && draw.chance(0.25) ? -load : load}};
  chain.begin = 0.6 * chain.frequency[0];
  chain.end = 1.3 * chain.frequency[std::min(n - 1, 2)];
  return chain;
}

SceneNumbers random_points(std::uint64_t seed) {
  const RandomScene random = random_scene(seed);
  return numbers_of("", random.scene, random.options.frequency_begin, random.options.frequency_end);
}

SceneNumbers random_patch(Draw& draw) {
  const PatchScene size{draw.whole(2, 5),
                        draw.chance(0.3) ? draw.whole(50, 80) : draw.whole(6, 40)};
  const double load = draw.log_uniform(1.0, 1e3);
  const bool gap = draw.chance(0.25);
  SceneNumbers patch =
      numbers_of("", patch_scene(size, gap ? -load : load, draw.log_uniform(0.3, 3.0)),
                 2.0 * std::numbers::pi * 250.0, 2.0 * std::numbers::pi * 450.0);
  if (!gap && draw.chance(0.3)) {  // constant load
    patch.v.setZero();
    for (contact::PointParameters& point : patch.points) point.normal_stiffness = 0.0;
  }
  return patch;
}

/// A motion across, a part of that along.
void add_second_direction(SceneNumbers& numbers, Draw& draw) {
  const double share = draw.log_uniform(0.1, 1.0);
  const bool smooth = numbers.u.rows() > 12;
  numbers.w.resize(numbers.u.rows(), numbers.u.cols());
  for (Eigen::Index k = 0; k < numbers.w.cols(); ++k) {
    const double phase = draw.uniform(0.0, 6.0);
    for (Eigen::Index i = 0; i < numbers.w.rows(); ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(numbers.w.rows());
      const double value =
          smooth ? std::cos(phase + (1.0 + static_cast<double>(k)) * x) : draw.uniform(-1.0, 1.0);
      numbers.w(i, k) = share * value * numbers.u.cwiseAbs().maxCoeff();
    }
  }
  if (draw.chance(0.5)) numbers.second_stiffness = draw.log_uniform(0.3, 3.0);
}

}  // namespace

bool SceneNumbers::is_sampled() const {
  return contact::is_sampled(patches_of(*this), effects_of(*this));
}

SceneNumbers numbers_of(std::string name, const solver::Scene& scene, double begin, double end) {
  const auto& force = dynamic_cast<const ReadablePatch&>(*scene.contact);
  SceneNumbers numbers;
  numbers.name = std::move(name);
  numbers.frequency = scene.natural_frequency;
  numbers.damping = scene.damping_ratio;
  numbers.output = scene.output;
  numbers.excitation = scene.excitation.rows();
  numbers.weights = force.patch().weights();
  numbers.points = force.patch().points();
  numbers.u = force.shapes().u;
  numbers.v = force.shapes().v;
  numbers.begin = begin;
  numbers.end = end;
  return numbers;
}

solver::Scene scene_of(const SceneNumbers& numbers) {
  solver::Scene scene;
  scene.natural_frequency = numbers.frequency;
  scene.damping_ratio = numbers.damping;
  scene.output = numbers.output;
  scene.excitation =
      contact::Harmonics(static_cast<int>(numbers.excitation.rows() - 1) / 2, numbers.n_modes());
  scene.excitation.rows() = numbers.excitation;
  const std::vector<contact::Patch> patches = patches_of(numbers);
  scene.contact = contact::ContactForce(patches, effects_of(numbers), 1.0).modal_force();
  return scene;
}

SceneNumbers random_numbers(std::uint64_t seed) {
  Draw draw(seed);
  constexpr std::array kinds{"points", "chain", "patch", "wild"};
  const std::size_t kind = seed % kinds.size();
  SceneNumbers numbers;
  if (kind == 0) {
    numbers = random_points(seed);
  } else if (kind == 1) {
    numbers = random_chain(draw);
  } else if (kind == 2) {
    numbers = random_patch(draw);
  } else {
    const RandomScene wild = wild_scene(seed);
    numbers = numbers_of("", wild.scene, wild.options.frequency_begin, wild.options.frequency_end);
  }
  constexpr std::array harmonics{1, 1, 1, 2, 3, 3, 4, 5};
  numbers.n_harmonics = harmonics.at(static_cast<std::size_t>(draw.whole(0, 7)));
  if (draw.chance(kind == 1 ? 0.0 : 0.3)) add_second_direction(numbers, draw);
  numbers.name = std::to_string(seed) + " (" + kinds.at(kind) + ", " +
                 std::to_string(numbers.points.size()) + " points, " +
                 (numbers.points.front().rest_load < 0.0 ? "gap, " : "") +
                 (numbers.is_planar() ? "two directions, " : "") +
                 std::to_string(numbers.n_harmonics) + " harmonics)";
  return numbers;
}

}  // namespace microslip::tests
