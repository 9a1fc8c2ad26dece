#include "fem/element_matrices.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "mesh/shape_functions.hpp"

namespace microslip::fem {

void check_material(const Material& material) {
  const auto refuse = [](const char* name, double value, const char* range) {
    throw std::invalid_argument(std::string("material: ") + name + " = " + std::to_string(value) +
                                "; must be " + range);
  };
  const auto [E, nu, rho] = material;
  if (!(E > 0.0) || !std::isfinite(E)) refuse("Young's modulus", E, "above 0 Pa and finite");
  if (!(nu > -1.0 && nu < 0.5)) refuse("Poisson's ratio", nu, "between -1 and 0.5");
  if (!(rho > 0.0) || !std::isfinite(rho)) refuse("density", rho, "above 0 kg/m^3 and finite");
}

std::vector<ElementIntegrator::Sample> ElementIntegrator::sampled(mesh::ElementType type,
                                                                  const QuadratureRule& rule) {
  std::vector<Sample> samples;
  for (const QuadraturePoint& point : rule) {
    const auto shapes = mesh::shapes(type, point.position);
    samples.push_back({shapes.values, shapes.gradients, point.weight});
  }
  return samples;
}

ElementIntegrator::ElementIntegrator(mesh::ElementType type, const Material& material,
                                     StiffnessRule rule)
    : stiffness_samples_(sampled(type, stiffness_rule(type, rule))),
      mass_samples_(sampled(type, mass_rule(type))) {
  check_material(material);
  const auto [E, nu, rho] = material;
  lambda_ = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  shear_ = E / (2.0 * (1.0 + nu));
  density_ = rho;
}

ElementMatrix ElementIntegrator::stiffness(const ElementNodes& nodes) const {
  const Eigen::Index n = nodes.rows();
  ElementMatrix K = ElementMatrix::Zero(3 * n, 3 * n);
  for (const Sample& sample : stiffness_samples_) {
    const Eigen::Matrix3d J = nodes.transpose() * sample.gradients;  // ∂x/∂ξ
    const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 20, 3> g = sample.gradients * J.inverse();
    const double volume = sample.weight * J.determinant();
    for (Eigen::Index b = 0; b < n; ++b) {
      for (Eigen::Index a = 0; a <= b; ++a) {
        const Eigen::Matrix3d outer = g.row(a).transpose() * g.row(b);  // g_a g_bᵀ
        Eigen::Matrix3d block = lambda_ * outer + shear_ * outer.transpose();
        block.diagonal().array() += shear_ * outer.trace();
        K.block<3, 3>(3 * a, 3 * b) += volume * block;
      }
    }
  }
  K.triangularView<Eigen::StrictlyLower>() = K.transpose();
  return K;
}

ElementMatrix ElementIntegrator::scalar_mass(const ElementNodes& nodes) const {
  const Eigen::Index n = nodes.rows();
  ElementMatrix M = ElementMatrix::Zero(n, n);
  for (const Sample& sample : mass_samples_) {
    const Eigen::Matrix3d J = nodes.transpose() * sample.gradients;
    const double mass = density_ * sample.weight * J.determinant();
    M.noalias() += mass * sample.values * sample.values.transpose();
  }
  return M;
}

}  // namespace microslip::fem
