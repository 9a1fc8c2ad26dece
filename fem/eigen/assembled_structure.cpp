#include "fem/eigen/assembled_structure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "fem/assembly/corner_interpolation.hpp"
#include "fem/assembly/given_system.hpp"
#include "fem/assembly/rotating_system.hpp"
#include "fem/blas_threads.hpp"
#include "fem/eigen/attachment.hpp"
#include "fem/eigen/mode_search.hpp"
#include "fem/eigen/rigid_modes.hpp"
#include "fem/elements/number_text.hpp"
#include "fem/elements/polynomial_tractions.hpp"
#include "fem/elements/symmetric_pairs.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/conjugate_gradients.hpp"
#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"
#include "fem/surface_load.hpp"

namespace microslip::fem {
namespace {

// ω² this far below the next one is no elastic mode: frequencies of one body do not differ by 1000.
constexpr double zero_ratio = 1e-6;

Eigen::Index count_zero(const Eigen::VectorXd& values) {
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i + 1 < values.size(); ++i) {
    if (values[i] < zero_ratio * values[i + 1]) n = i + 1;
  }
  return n;
}

// A mode has no sign of its own: the first of its largest components is made positive.
void fix_signs(Eigen::MatrixXd& shapes) {
  constexpr double tie = 1.0 - 1e-6;  // components equal by symmetry differ by rounding
  for (auto shape : shapes.colwise()) {
    const double largest = shape.cwiseAbs().maxCoeff();
    for (const double value : shape) {
      if (std::abs(value) < tie * largest) continue;
      if (value < 0.0) shape = -shape;
      break;
    }
  }
}

double infinity_norm(Mat matrix) {
  PetscReal norm = 0.0;
  check(MatNorm(matrix, NORM_INFINITY, &norm));
  return norm;
}

void check_rows(const Eigen::MatrixXd& forces, Eigen::Index n_nodes) {
  if (forces.rows() == 3 * n_nodes) return;
  throw std::invalid_argument("forces have " + std::to_string(forces.rows()) +
                              " rows, 3 per mesh node are " + std::to_string(3 * n_nodes));
}

/// @param u  3 n_nodes × 3, under traction along p, q, r.
ResidualFlexibility residual_along(const Eigen::Matrix3d& frame, const Eigen::MatrixXd& u,
                                   const std::vector<Eigen::Index>& nodes) {
  ResidualFlexibility result{Eigen::MatrixX3d(std::ssize(nodes), 3)};
  for (Eigen::Index i = 0; i < std::ssize(nodes); ++i) {
    const Eigen::Index node = nodes[static_cast<std::size_t>(i)];
    result.row_sums.row(i) =
        frame.cwiseProduct(u.middleRows<3>(3 * node).transpose()).rowwise().sum().transpose();
  }
  return result;
}

ResidualFlexibility residual_at_places(const Eigen::MatrixXd& u,
                                       const std::vector<Eigen::Index>& nodes) {
  ResidualFlexibility result{{}, Eigen::MatrixXd(std::ssize(nodes), 9)};
  for (Eigen::Index i = 0; i < std::ssize(nodes); ++i) {
    const Eigen::Index node = nodes[static_cast<std::size_t>(i)];
    result.displacements.row(i) = u.middleRows<3>(3 * node).reshaped().transpose();
  }
  return result;
}

class AssembledStructure : public StructureSolver {
 public:
  AssembledStructure(const mesh::Mesh& mesh, FeSystem assembled, Tet10Rule rule, SolverKind solver);

  Eigen::VectorXd rotate(const mesh::Mesh& mesh, const Material& material, const Rotation& rotation,
                         const Eigen::VectorXd& known) override;
  [[nodiscard]] Eigen::Index n_dofs() const override { return 3 * system_.dofs.n_free_nodes(); }
  [[nodiscard]] double mass() const override { return system_.mass; }
  [[nodiscard]] ModalBasis solve_modes(const ModalOptions& options) override;
  [[nodiscard]] std::optional<Eigen::Index> count_modes() override;
  [[nodiscard]] Eigen::MatrixXd solve_static(const Eigen::MatrixXd& forces) override;
  [[nodiscard]] ResidualFlexibility residual_flexibility(const ModalBasis& basis,
                                                         const mesh::Surface& surface,
                                                         const mesh::FaceFrame& frame) override;
  [[nodiscard]] AttachedBasis attach(const ModalBasis& basis,
                                     const std::vector<AttachmentFace>& faces,
                                     const Eigen::MatrixXd& forces,
                                     const AttachmentOptions& options) override;
  [[nodiscard]] const ModalTimings& timings() const override { return spent_; }

  /// Springs to ground hold rigid-body modes that were free: keeps those they do not strain.
  void drop_held_rigid_modes();
  void count_assembly(double seconds) { spent_.assembly = seconds; }

 private:
  void prepare();
  void prepare(Mat matrix);
  [[nodiscard]] Eigen::MatrixX3d own_nodes() const;
  [[nodiscard]] CountedPairs search(Eigen::Index n_elastic, CountTime when);
  [[nodiscard]] Eigen::MatrixXd solve_elastic(const Eigen::MatrixXd& loads,
                                              const Eigen::MatrixXd& kept) const;
  [[nodiscard]] Eigen::MatrixXd elastic_modes(const ModalBasis& basis) const;
  [[nodiscard]] StaticShapes static_shapes(const Eigen::MatrixXd& forces,
                                           const Eigen::MatrixXd& kept) const;
  [[nodiscard]] ModalBasis with_shapes(const ModalBasis& basis, const RitzShapes& ritz) const;
  [[nodiscard]] Eigen::MatrixXd embedding(const ModalBasis& leaner, const ModalBasis& richer) const;
  [[nodiscard]] ModalBasis basis_from(const CountedPairs& found, Eigen::Index n_modes) const;
  void check_residuals(const ModalBasis& basis, double tolerance) const;

  Eigen::MatrixX3d nodes_;
  FeSystem system_;
  Eigen::MatrixXd rigid_;                  // M-orthonormal, rows of this rank
  double shift_ = 0.0;                     // of `inverse_`
  std::unique_ptr<LinearSolver> inverse_;  // of K − shift M
  ModalTimings spent_;
  Tet10Rule rule_;
  SolverKind kind_;
  Equilibrium rotating_{};                       // without displacement: it does not
  CountedPairs uncounted_{};                     // of the last search, without its pairs
  MatHandle from_corners_{};                     // of quadratic elements, for the iterative way
  std::unique_ptr<OneBlasThread> one_thread_{};  // of that way
};

AssembledStructure::AssembledStructure(const mesh::Mesh& mesh, FeSystem assembled, Tet10Rule rule,
                                       SolverKind solver)
    : nodes_(mesh.nodes()),
      system_(std::move(assembled)),
      rigid_(rigid_body_modes(mesh, system_)),
      rule_(rule),
      kind_(solver) {
  if (solver != SolverKind::iterative) return;
  from_corners_ = corner_interpolation(mesh, system_.dofs);
  one_thread_ = std::make_unique<OneBlasThread>();
}

// With rigid-body modes below zero by a tenth of the first elastic eigenvalue: far enough for an
// accurate factorisation, near enough to tell the elastic modes apart.
void AssembledStructure::prepare() {
  if (inverse_) return;
  if (rigid_.cols() == 0) {
    shift_ = 0.0;
    return prepare(system_.stiffness.get());
  }
  shift_ = -0.1 * elastic_scale(nodes_, system_, rigid_.cols());
  prepare(shifted_stiffness(system_, shift_).get());
}

void AssembledStructure::prepare(Mat matrix) {
  if (kind_ == SolverKind::direct) {
    inverse_ = std::make_unique<Factorisation>(matrix, FactorKind::positive_definite);
  } else {
    inverse_ = std::make_unique<ConjugateGradients>(matrix, own_nodes(), from_corners_.get());
  }
  spent_.ordering = inverse_->ordering_seconds();
  spent_.factorisation = inverse_->factor_seconds();
}

Eigen::MatrixX3d AssembledStructure::own_nodes() const {
  const DofMap& dofs = system_.dofs;
  Eigen::MatrixX3d own(dofs.last() - dofs.first(), 3);
  for (Eigen::Index i = dofs.first(); i < dofs.last(); ++i) {
    own.row(i - dofs.first()) = nodes_.row(dofs.mesh_node(i));
  }
  return own;
}

CountedPairs AssembledStructure::search(Eigen::Index n_elastic, CountTime when) {
  const ModeCount counting = kind_ == SolverKind::iterative  ? ModeCount::none
                             : when == CountTime::at_the_end ? ModeCount::later
                                                             : ModeCount::by_inertia;
  CountedPairs found = find_elastic_modes(system_, *inverse_, shift_, n_elastic, rigid_, counting);
  spent_.eigensolve += found.search_seconds;
  spent_.inertia += found.inertia_seconds;
  return found;
}

ModalBasis AssembledStructure::basis_from(const CountedPairs& found, Eigen::Index n_modes) const {
  const Eigen::Index n_rigid = std::min(rigid_.cols(), n_modes);
  const Eigen::Index n_elastic = n_modes - n_rigid;
  const EigenPairs elastic{found.pairs.values.head(n_elastic),
                           found.pairs.vectors.leftCols(n_elastic)};
  Eigen::MatrixXd local(system_.dofs.n_local_dofs(), n_modes);
  local << rigid_.leftCols(n_rigid), elastic.vectors;
  ModalBasis basis;
  basis.frequency = Eigen::VectorXd::Zero(n_modes);
  basis.frequency.tail(n_elastic) = elastic.values.cwiseSqrt();
  basis.residual = Eigen::VectorXd::Zero(n_modes);
  if (n_rigid > 0) {
    const Eigen::MatrixXd R = rigid_.leftCols(n_rigid);
    basis.residual.head(n_rigid) =
        column_norms(multiply(system_.stiffness.get(), R))
            .cwiseQuotient(infinity_norm(system_.stiffness.get()) * column_norms(R));
  }
  if (n_elastic > 0) basis.residual.tail(n_elastic) = relative_residuals(system_, elastic);
  basis.shapes = system_.dofs.to_mesh(local);
  fix_signs(basis.shapes);
  basis.n_rigid_body = n_rigid;
  basis.inertia_count = found.n_counted;
  return basis;
}

// Rounding of φ alone leaves ε‖K‖‖φ‖ in Kφ; on fine meshes that is more than the tolerance asks.
void AssembledStructure::check_residuals(const ModalBasis& basis, double tolerance) const {
  const double stiffness_norm = infinity_norm(system_.stiffness.get());
  for (Eigen::Index k = 0; k < basis.frequency.size(); ++k) {
    const double omega = basis.frequency[k];
    double allowed = tolerance;
    if (omega > 0.0) {
      // ‖Kφ‖ ≥ ω² / ‖φ‖, since φᵀKφ = ω².
      allowed += std::numeric_limits<double>::epsilon() * stiffness_norm *
                 basis.shapes.col(k).squaredNorm() / (omega * omega);
    }
    if (!(basis.residual[k] <= allowed)) {
      throw EigenError("eigen-inaccurate: mode " + std::to_string(k + 1) + " has residual " +
                       number_text(basis.residual[k]) + ", allowed is " + number_text(allowed));
    }
  }
}

// u with Ku = f − MRRᵀf, u ⟂ M [R kept], for loads f. For a held body simply K⁻¹f without what the
// kept modes carry. With rigid-body modes the factor is that of K − shift M, and the residual
// correction contracts by |shift|/(λ + |shift|) per step, λ the first eigenvalue that is not kept.
Eigen::MatrixXd AssembledStructure::solve_elastic(const Eigen::MatrixXd& loads,
                                                  const Eigen::MatrixXd& kept) const {
  constexpr int max_steps = 500;
  constexpr double tolerance = 1e-13;  // of the load: what a direct solution reaches
  const Mat K = system_.stiffness.get();
  const Mat M = system_.mass_matrix.get();
  Eigen::MatrixXd known(kept.rows(), kept.cols() + rigid_.cols());
  known << kept, rigid_;
  const Eigen::MatrixXd M_known = multiply(M, known);
  const auto without_known = [&](const Eigen::MatrixXd& u) -> Eigen::MatrixXd {
    return u - known * inner_products(M_known, u);
  };
  const auto load_without_known = [&](const Eigen::MatrixXd& f) -> Eigen::MatrixXd {
    return f - M_known * inner_products(known, f);
  };
  const Eigen::MatrixXd target = load_without_known(loads);
  Eigen::MatrixXd u = without_known(inverse_->solve(target));
  if (shift_ == 0.0) return u;
  const double scale = column_norms(loads).maxCoeff();
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::MatrixXd rest = target - load_without_known(multiply(K, u));
    const double size = column_norms(rest).maxCoeff();
    if (size <= tolerance * scale || size > 0.9 * before) break;  // at the floor rounding sets
    before = size;
    u += without_known(inverse_->solve(rest));
  }
  return u;
}

/// Attachment shapes behind the free modes of a basis.
ModalBasis AssembledStructure::with_shapes(const ModalBasis& basis, const RitzShapes& ritz) const {
  Eigen::MatrixXd shapes = system_.dofs.to_mesh(ritz.shapes);
  fix_signs(shapes);
  const Eigen::Index n_free = basis.n_free();
  ModalBasis result = basis;
  result.n_attachment = shapes.cols();
  result.frequency.resize(n_free + shapes.cols());
  result.frequency << basis.frequency.head(n_free), ritz.frequency;
  result.shapes.resize(basis.shapes.rows(), n_free + shapes.cols());
  result.shapes << basis.shapes.leftCols(n_free), shapes;
  return result;
}

/// Ψ_richerᵀ M Ψ_leaner, bases M-orthonormal with the same free modes.
Eigen::MatrixXd AssembledStructure::embedding(const ModalBasis& leaner,
                                              const ModalBasis& richer) const {
  const Eigen::Index n_free = leaner.n_free();
  const auto shapes = [&](const ModalBasis& basis) {
    return Eigen::MatrixXd(system_.dofs.to_local(basis.shapes.rightCols(basis.n_attachment)));
  };
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(richer.frequency.size(), leaner.frequency.size());
  T.topLeftCorner(n_free, n_free).setIdentity();
  T.bottomRightCorner(richer.n_attachment, leaner.n_attachment) =
      inner_products(shapes(richer), multiply(system_.mass_matrix.get(), shapes(leaner)));
  return T;
}

Eigen::MatrixXd AssembledStructure::elastic_modes(const ModalBasis& basis) const {
  return system_.dofs.to_local(
      basis.shapes.middleCols(basis.n_rigid_body, basis.n_free() - basis.n_rigid_body));
}

StaticShapes AssembledStructure::static_shapes(const Eigen::MatrixXd& forces,
                                               const Eigen::MatrixXd& kept) const {
  StaticShapes result{system_.dofs.to_local(forces), {}};
  result.shapes = solve_elastic(result.loads, kept);
  return result;
}

void AssembledStructure::drop_held_rigid_modes() {
  if (rigid_.cols() == 0) return;
  const Eigen::MatrixXd energy = inner_products(rigid_, multiply(system_.stiffness.get(), rigid_));
  const SymmetricPairs eigen = symmetric_pairs(0.5 * (energy + energy.transpose()));
  const double scale = elastic_scale(nodes_, system_, rigid_.cols());
  const auto n_free = static_cast<Eigen::Index>((eigen.values.array() < 1e-9 * scale).count());
  rigid_ = (rigid_ * eigen.vectors.leftCols(n_free)).eval();
}

Eigen::VectorXd AssembledStructure::rotate(const mesh::Mesh& mesh, const Material& material,
                                           const Rotation& rotation, const Eigen::VectorXd& known) {
  if (rigid_.cols() > 0) {
    throw EigenError("rotation: " + std::to_string(rigid_.cols()) +
                     " rigid-body modes are free, nothing holds the body against its centrifugal "
                     "load: clamp what turns with it");
  }
  if (known.size() > 0) {
    rotating_ = {known, rotation.speed};
  } else if (rotating_.displacement.size() == 0) {
    rotating_.displacement = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
  }
  inverse_.reset();
  rotating_ = {rotate_system(system_, mesh, material, rule_, rotation, rotating_), rotation.speed};
  return rotating_.displacement;
}

ModalBasis AssembledStructure::solve_modes(const ModalOptions& options) {
  if (options.n_modes < 1 || options.n_modes > n_dofs()) {
    throw std::invalid_argument("n_modes = " + std::to_string(options.n_modes) +
                                " is not between 1 and the " + std::to_string(n_dofs()) +
                                " degrees of freedom");
  }
  const Eigen::Index n_rigid = rigid_.cols();
  if (n_rigid > 6) {
    throw EigenError("mechanism: " + std::to_string(n_rigid) +
                     " zero modes, a free body has six: the mesh has loose parts");
  }
  prepare();
  CountedPairs found = search(std::max<Eigen::Index>(options.n_modes - n_rigid, 0), options.count);
  if (const Eigen::Index n_zero = count_zero(found.pairs.values); n_zero > 0) {
    throw EigenError(
        "mechanism: " + std::to_string(n_rigid + n_zero) + " zero modes, " +
        std::to_string(n_zero) +
        " of them inside the body (parts that share only an edge, a corner or too few supports)");
  }
  ModalBasis basis = basis_from(found, options.n_modes);
  check_residuals(basis, options.residual_tolerance);
  found.pairs = {};
  uncounted_ = std::move(found);
  return basis;
}

std::optional<Eigen::Index> AssembledStructure::count_modes() {
  if (kind_ == SolverKind::iterative) return -1;
  const auto start = std::chrono::steady_clock::now();
  inverse_.reset();
  const Eigen::Index counted = count_below(system_, uncounted_.count_shift);
  spent_.inertia += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (counted != rigid_.cols() + uncounted_.n_below) return std::nullopt;
  return counted;
}

Eigen::MatrixXd AssembledStructure::solve_static(const Eigen::MatrixXd& forces) {
  check_rows(forces, nodes_.rows());
  if (rigid_.cols() > 0) {
    throw EigenError(
        "rigid-body: " + std::to_string(rigid_.cols()) +
        " rigid-body modes are free, the stiffness matrix is singular: no static solution");
  }
  prepare();
  return system_.dofs.to_mesh(inverse_->solve(system_.dofs.to_local(forces)));
}

ResidualFlexibility AssembledStructure::residual_flexibility(const ModalBasis& basis,
                                                             const mesh::Surface& surface,
                                                             const mesh::FaceFrame& frame) {
  prepare();
  const Eigen::MatrixXd kept = elastic_modes(basis);
  const Eigen::MatrixXd loads = system_.dofs.to_local(uniform_tractions(nodes_, surface, frame));
  const Eigen::MatrixXd u = system_.dofs.to_mesh(solve_elastic(loads, kept));
  return frame.is_local() ? residual_at_places(u, surface.nodes)
                          : residual_along(frame.plane, u, surface.nodes);
}

AttachedBasis AssembledStructure::attach(const ModalBasis& basis,
                                         const std::vector<AttachmentFace>& faces,
                                         const Eigen::MatrixXd& forces,
                                         const AttachmentOptions& options) {
  check_rows(forces, nodes_.rows());
  prepare();
  const Eigen::MatrixXd kept = elastic_modes(basis);
  const ShapesOfDegree solve = [&](int degree) {
    const Eigen::Index n_before = 3 * n_polynomials(degree - 1);
    StaticShapes shapes;
    for (const AttachmentFace& face : faces) {
      const Eigen::MatrixXd loads = polynomial_tractions(nodes_, face.surface, face.frame, degree);
      StaticShapes own = static_shapes(loads.rightCols(loads.cols() - n_before), kept);
      own.stiffness = face.local_stiffness.replicate(own.loads.cols() / 3, 1);
      shapes.append(own);
    }
    return shapes;
  };
  AttachmentSet set = attachment_set(solve, options);
  StaticShapes of_forces;
  if (forces.cols() > 0) of_forces = static_shapes(forces, kept);
  const Eigen::MatrixXd free = system_.dofs.to_local(basis.shapes.leftCols(basis.n_free()));
  const auto attached = [&](StaticShapes& shapes) {
    if (forces.cols() > 0) shapes.append(of_forces);
    return ritz_shapes(system_, shapes, free);
  };
  const RitzShapes ritz = attached(set.shapes);
  AttachedBasis result{with_shapes(basis, ritz), set.degree, set.missed_share,
                       set.shapes.shapes.cols() - ritz.shapes.cols()};
  if (set.richer.shapes.cols() > 0) {
    const RitzShapes more = attached(set.richer);
    result.richer = RicherBasis{with_shapes(basis, more), {}};
    result.richer->embedding = embedding(result.basis, result.richer->basis);
  }
  return result;
}

}  // namespace

std::unique_ptr<StructureSolver> assembled_structure(const mesh::Mesh& mesh,
                                                     const Material& material,
                                                     const std::vector<std::string>& clamped,
                                                     Tet10Rule rule, SolverKind solver) {
  const auto start = std::chrono::steady_clock::now();
  auto structure = std::make_unique<AssembledStructure>(
      mesh, assemble(mesh, material, clamped, rule), rule, solver);
  structure->count_assembly(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return structure;
}

std::unique_ptr<StructureSolver> given_structure(const mesh::Mesh& mesh,
                                                 const GivenMatrices& matrices, SolverKind solver) {
  auto structure = std::make_unique<AssembledStructure>(mesh, given_system(mesh, matrices),
                                                        Tet10Rule::accurate, solver);
  structure->drop_held_rigid_modes();  // springs to ground and single supports are in K alone
  return structure;
}

}  // namespace microslip::fem
