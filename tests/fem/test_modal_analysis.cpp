#include "fem/modal_analysis.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "fem/petsc_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem {
namespace {

using mesh::ElementType;

const Material steel{2.1e11, 0.3, 7850.0};

mesh::Mesh bar_mesh(ElementType type = ElementType::tet10) {
  return test::box_mesh(type, {.size = {0.1, 0.02, 0.015}, .cells = {6, 2, 2}, .map = {}});
}

TEST(ModalAnalysis, ClampedBarBendsTwistsAndStretchesAtTheFrequenciesOfBeams) {
  const mesh::Mesh mesh = bar_mesh();
  Structure bar(mesh, steel, {"x0"});
  const ModalBasis basis = bar.solve_modes({.n_modes = 8, .residual_tolerance = 1e-8});
  std::cerr << (basis.frequency / (2 * std::numbers::pi)).transpose() << "\n" << basis.residual.transpose() << "\n" << basis.inertia_count << "\n";
  const double L = 0.1, c = std::sqrt(steel.youngs_modulus/steel.density);
  std::cerr << 1.8751*1.8751/(2*std::numbers::pi)/L/L*c*0.015/std::sqrt(12.) << " " << c/4/L << "\n";
}

}  // namespace
}  // namespace microslip::fem
