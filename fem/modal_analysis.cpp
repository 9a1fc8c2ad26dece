#include "fem/modal_analysis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include "fem/eigensolver.hpp"
#include "fem/factorisation.hpp"
#include "fem/petsc_check.hpp"
#include "fem/surface_load.hpp"

namespace microslip::fem {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Shares of E/(ρD²), D the diagonal of the bounding box. A body 1000 times longer than thick has its
// first elastic λ at 1e-6 of it; rounding leaves rigid-body motions some 1e-12 above zero.
constexpr double rigid_share = 1e-8;
constexpr double shift_share = 1e-4;
constexpr double cluster_gap = 1e-6;  // relative: eigenvalues nearer than this count as one cluster

[[noreturn]] void refuse(const std::string& diagnosis, const std::string& text) {
  throw EigenError(diagnosis + ": " + text);
}

/// One sign for a mode on every machine: its largest component is positive.
void fix_sign(Eigen::Ref<Eigen::VectorXd> shape) {
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  if (shape[largest] < 0.0) shape = -shape;
}

double elastic_scale(const mesh::Mesh& mesh, const Material& material) {
  const double diagonal = (mesh.upper() - mesh.lower()).squaredNorm();
  return material.youngs_modulus / (material.density * diagonal);
}

/// Pairs with which to judge the count: how many lie below a shift placed in a gap.
struct Gap {
  double shift = 0.0;
  Eigen::Index n_below = 0;
};

/// The first gap at or after the last mode asked for that is wide enough to tell both sides apart.
Gap find_gap(const Eigen::VectorXd& values, Eigen::Index n_modes, double scale) {
  const double floor = rigid_share * scale;
  for (Eigen::Index i = n_modes - 1; i + 1 < values.size(); ++i) {
    const double width = values[i + 1] - values[i];
    if (width > cluster_gap * std::max(std::abs(values[i + 1]), floor)) {
      return {values[i] + 0.5 * width, i + 1};
    }
  }
  return {};
}

}  // namespace

struct Structure::Implementation {
  DofMap dofs;
  FeSystem system;
  double shift;          // of the factorisation: 0 when the supports hold the body
  double elastic_scale;  // E/(ρD²) [1/s²]
  Eigen::MatrixX3d nodes;
  std::optional<Factorisation> inverse;
  ModalTimings timings;
  double mass = 0.0;

  const Factorisation& factorised() {
    if (!inverse) {
      inverse.emplace(system, shift, Factorisation::Kind::positive_definite);
      timings.ordering += inverse->ordering_seconds();
      timings.factorisation += inverse->factor_seconds();
    }
    return *inverse;
  }

  EigenPairs pairs(Eigen::Index n_modes, Eigen::Index n_basis) {
    const Factorisation& factors = factorised();
    const auto begin = Clock::now();
    // One pair more than asked for, to place the shift of the count between it and the last one.
    EigenPairs found = lowest_pairs(system, factors, shift,
                                    std::min<Eigen::Index>(n_modes + 1, 3 * dofs.n_free_nodes()),
                                    n_basis);
    timings.eigensolve += seconds_since(begin);
    return found;
  }

  Eigen::Index count_below(double value) {
    const auto begin = Clock::now();
    const Factorisation factors(system, value, Factorisation::Kind::indefinite);
    timings.inertia += seconds_since(begin);
    return factors.n_below_shift();
  }
};

Structure::Structure(const mesh::Mesh& mesh, const Material& material,
                     const std::vector<std::string>& clamped, StiffnessRule rule,
                     const SurfaceSprings* springs) {
  check_material(material);
  const auto begin = Clock::now();
  DofMap dofs(mesh, clamped);
  FeSystem system = assemble(mesh, dofs, material, rule, springs);
  const double scale = elastic_scale(mesh, material);
  const double shift = dofs.holds_rigid_motion() ? 0.0 : -shift_share * scale;
  self_ = std::make_unique<Implementation>(
      Implementation{std::move(dofs), std::move(system), shift, scale, mesh.nodes(), {}, {}, 0.0});
  self_->timings.assembly = seconds_since(begin);
  self_->mass = material.density * mesh.volume();
}

Structure::~Structure() = default;
Structure::Structure(Structure&&) noexcept = default;
Structure& Structure::operator=(Structure&&) noexcept = default;

Eigen::Index Structure::n_dofs() const { return 3 * self_->dofs.n_free_nodes(); }
double Structure::mass() const { return self_->mass; }
const ModalTimings& Structure::timings() const { return self_->timings; }

namespace {

void check_found(const EigenPairs& pairs, const ModalOptions& options) {
  if (pairs.values.size() < options.n_modes) {
    refuse("eigen-missed-mode", std::to_string(options.n_modes) + " modes requested, " +
                                    std::to_string(pairs.values.size()) + " converged");
  }
  const double worst = pairs.residual.head(options.n_modes).maxCoeff();
  if (!(worst <= options.residual_tolerance)) {
    std::ostringstream text;
    text << "a pair has the residual " << worst << ", above " << options.residual_tolerance;
    refuse("eigen-inaccurate", text.str());
  }
}

Eigen::Index count_rigid(const EigenPairs& pairs, double scale) {
  const Eigen::Index n = (pairs.values.array().abs() < rigid_share * scale).count();
  if (n > 6) {
    refuse("mechanism", std::to_string(n) +
                            " modes without stiffness, six are rigid-body motions: parts of the mesh "
                            "hang together by less than a face");
  }
  return n;
}

}  // namespace

ModalBasis Structure::solve_modes(const ModalOptions& options) {
  if (options.n_modes < 1 || options.n_modes > n_dofs()) {
    throw std::invalid_argument("modes: count = " + std::to_string(options.n_modes) +
                                "; must be 1 to " + std::to_string(n_dofs()) +
                                ", the free degrees of freedom");
  }
  ModalBasis basis;
  EigenPairs pairs;
  const double scale = self_->elastic_scale;
  // A missed mode shows in the count; a larger Krylov basis finds it.
  for (Eigen::Index n_basis = 0, attempt = 0;; ++attempt) {
    pairs = self_->pairs(options.n_modes, n_basis);
    check_found(pairs, options);
    const Gap gap = find_gap(pairs.values, options.n_modes, scale);
    if (gap.n_below == 0) {
      if (pairs.values.size() == n_dofs()) {
        basis.inertia_count = n_dofs();
        break;
      }
      // The modes after the last one asked for form a cluster: more pairs tell where it ends.
      if (attempt == 3) refuse("eigen-missed-mode", "no gap above the last mode to count at");
      n_basis = 4 * (options.n_modes + 8) * (attempt + 1);
      continue;
    }
    basis.inertia_count = self_->count_below(gap.shift);
    if (basis.inertia_count == gap.n_below) break;
    if (attempt == 1) {
      refuse("eigen-missed-mode", std::to_string(basis.inertia_count) +
                                      " eigenvalues lie below the shift by inertia, " +
                                      std::to_string(gap.n_below) + " were found");
    }
    n_basis = 4 * (options.n_modes + 8);
  }
  basis.n_rigid_body = std::min(count_rigid(pairs, scale), options.n_modes);
  basis.frequency = pairs.values.head(options.n_modes).cwiseMax(0.0).cwiseSqrt();
  basis.frequency.head(basis.n_rigid_body).setZero();
  basis.residual = pairs.residual.head(options.n_modes);
  basis.shapes.resize(3 * self_->dofs.n_nodes(), options.n_modes);
  for (Eigen::Index i = 0; i < options.n_modes; ++i) {
    fix_sign(pairs.vectors.col(i));
    basis.shapes.col(i) = self_->dofs.expand(pairs.vectors.col(i));
  }
  return basis;
}

Eigen::MatrixXd Structure::solve_static(const Eigen::MatrixXd& forces) {
  if (self_->shift != 0.0) {
    refuse("rigid-body", "a static load on a structure that nothing holds has no answer");
  }
  Eigen::MatrixXd right(n_dofs(), forces.cols());
  for (Eigen::Index j = 0; j < forces.cols(); ++j) {
    right.col(j) = self_->dofs.restrict(forces.col(j));
  }
  const Eigen::MatrixXd free = self_->factorised().solve(right);
  Eigen::MatrixXd all(forces.rows(), forces.cols());
  for (Eigen::Index j = 0; j < forces.cols(); ++j) all.col(j) = self_->dofs.expand(free.col(j));
  return all;
}

Eigen::MatrixXd Structure::solve_harmonic(double frequency, const Eigen::MatrixXd& forces) {
  const Factorisation inverse(self_->system, frequency * frequency,
                              Factorisation::Kind::indefinite);
  Eigen::MatrixXd right(n_dofs(), forces.cols());
  for (Eigen::Index j = 0; j < forces.cols(); ++j) {
    right.col(j) = self_->dofs.restrict(forces.col(j));
  }
  const Eigen::MatrixXd free = inverse.solve(right);
  Eigen::MatrixXd all(forces.rows(), forces.cols());
  for (Eigen::Index j = 0; j < forces.cols(); ++j) all.col(j) = self_->dofs.expand(free.col(j));
  return all;
}

ResidualFlexibility Structure::residual_flexibility(const ModalBasis& basis,
                                                    const mesh::Surface& surface,
                                                    const Eigen::Matrix3d& frame) {
  const Eigen::MatrixXd loads = uniform_tractions(self_->nodes, surface, frame);
  Eigen::MatrixXd motion = solve_static(loads);
  // K⁻¹t − Σ φ (φ·t)/ω²: what the kept modes do not carry.
  const Eigen::MatrixXd carried =
      basis.frequency.cwiseAbs2().cwiseInverse().asDiagonal() * (basis.shapes.transpose() * loads);
  motion -= basis.shapes * carried;
  ResidualFlexibility result;
  result.row_sums.resize(static_cast<Eigen::Index>(surface.nodes.size()), 3);
  for (Eigen::Index i = 0; i < result.row_sums.rows(); ++i) {
    const Eigen::Index node = surface.nodes[static_cast<std::size_t>(i)];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      result.row_sums(i, axis) = frame.row(axis).dot(motion.col(axis).segment<3>(3 * node));
    }
  }
  return result;
}

}  // namespace microslip::fem
