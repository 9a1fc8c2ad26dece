/// @file
/// Stiffness and consistent mass of one element, linear elasticity, small strain:
///
///   K_ab = ∫ [ λ g_a g_bᵀ + G g_b g_aᵀ + G (g_a·g_b) I ] dV,     M_ab = ∫ ρ N_a N_b dV I
///
/// g_a = ∇N_a, λ and G the Lamé constants. Hughes, The Finite Element Method, section 2.8.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fem/material.hpp"
#include "fem/quadrature.hpp"
#include "mesh/element_type.hpp"

namespace microslip::fem {

/// 3n × 3n, row by row, x y z per node: as PETSc takes blocks.
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 60, 60>;
/// Coordinates of the nodes of one element, n × 3 [m].
using ElementNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, 20, 3>;

/// Shape functions at quadrature points are evaluated once per element type, not per element.
class ElementIntegrator {
 public:
  ElementIntegrator(mesh::ElementType type, const Material& material,
                    StiffnessRule rule = StiffnessRule::accurate);

  [[nodiscard]] ElementMatrix stiffness(const ElementNodes& nodes) const;
  /// ρ∫N_a N_b dV, n × n: the same for x, y and z.
  [[nodiscard]] ElementMatrix scalar_mass(const ElementNodes& nodes) const;

 private:
  struct Sample {
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 20, 1> values;
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 20, 3> gradients;
    double weight = 0.0;
  };
  [[nodiscard]] static std::vector<Sample> sampled(mesh::ElementType type,
                                                   const QuadratureRule& rule);

  std::vector<Sample> stiffness_samples_;
  std::vector<Sample> mass_samples_;
  double lambda_;
  double shear_;
  double density_;
};

/// @throws std::invalid_argument  E, ν or ρ out of range; names it.
void check_material(const Material& material);

}  // namespace microslip::fem
