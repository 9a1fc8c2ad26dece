#include "pipelines/model/linear_limits.hpp"

#include <complex>

#include "contact/dense.hpp"

namespace microslip::pipelines {
namespace {

Eigen::MatrixXd stuck_stiffness(const contact::PatchSamples& cells, bool along_r) {
  Eigen::VectorXd u = cells.weights.cwiseProduct(cells.stiffness.col(0));
  Eigen::VectorXd w = cells.weights.cwiseProduct(cells.stiffness.col(2));
  const Eigen::VectorXd v = cells.weights.cwiseProduct(cells.stiffness.col(1));
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (!cells.has_friction(i)) u[i] = w[i] = 0.0;
  }
  const auto part = [](const Eigen::MatrixXd& shape, const Eigen::VectorXd& k) -> Eigen::MatrixXd {
    return shape.transpose() * k.asDiagonal() * shape;
  };
  Eigen::MatrixXd sum = part(cells.shapes.u, u) + part(cells.shapes.v, v);
  if (along_r && cells.shapes.w.size() > 0) sum += part(cells.shapes.w, w);
  return sum;
}

}  // namespace

Eigen::MatrixXd stuck_stiffness(const ReducedModel& model, bool along_r) {
  const Eigen::Index n = model.frequency.size();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (const contact::Patch& patch : model.patches)
    stiffness += stuck_stiffness(patch.cells, along_r);
  return stiffness;
}

Eigen::VectorXcd linear_response(const ReducedModel& model, const Eigen::MatrixXd& stiffness,
                                 double frequency) {
  const Eigen::ArrayXd omega = model.frequency.array();
  const Eigen::ArrayXcd diagonal =
      (omega.square() - frequency * frequency).cast<std::complex<double>>() +
      std::complex<double>(0.0, 2.0 * frequency) * (model.damping_ratio.array() * omega);
  Eigen::VectorXcd force(model.frequency.size());
  force.real() = model.force_sine;
  force.imag() = model.force_cosine;
  if (stiffness.isZero(0.0)) return force.array() / diagonal;
  Eigen::MatrixXcd dynamic = stiffness.cast<std::complex<double>>();
  dynamic.diagonal() += diagonal.matrix();
  return contact::solved(dynamic, force);
}

Eigen::VectorXd resonances(const ReducedModel& model, const Eigen::MatrixXd& stiffness) {
  Eigen::MatrixXd total = stiffness;
  total.diagonal() += model.frequency.array().square().matrix();
  const auto squares = contact::symmetric_eigenvalues(total);
  return squares.value_or(Eigen::VectorXd()).cwiseMax(0.0).cwiseSqrt();
}

}  // namespace microslip::pipelines
