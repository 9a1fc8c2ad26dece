/// @file
/// Harmonic-balance equations of a scene (theory section 13; paper A, eqs 30–38), for any set of
/// harmonics:
///
///   R(x, ω) = L(ω) x + G(x, ω) − Q = 0,     x = harmonics of q, in the order of
///                                               Harmonics::vector() without those that the set
///                                               leaves out, which are zero
///
///   mean        L: ω_n²; of a contact that does not answer it (theory section 13) no unknown:
///               B = (Q_b − G_b(x)) / ω_n²
///   harmonic k  L: [ ω_n² − k²ω²    −2ζ_n ω_n kω  ]  on (sine, cosine) of mode n
///                  [ 2ζ_n ω_n kω    ω_n² − k²ω²   ]
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "solver/balance/balance_jacobian.hpp"
#include "solver/balance/harmonic_set.hpp"
#include "solver/scene.hpp"

namespace microslip::solver {

/// R and its derivatives at one iterate; n = (2 · number of harmonics + 1) · n_modes, without the
/// mean n_modes less.
struct BalanceEvaluation {
  Eigen::VectorXd residual;              ///< R [N/√kg], n
  BalanceJacobian jacobian;              ///< ∂R/∂x [1/s²], n × n
  Eigen::VectorXd parameter_derivative;  ///< ∂R/∂ω at fixed x, or by a homotopy's parameter, n
  Eigen::VectorXd contact_force;         ///< G [N/√kg], n
  Eigen::VectorXd mean{};  ///< B [m√kg], n_modes, where it follows from x; else empty
  double defect = 0.0;     ///< what ‖R‖ may be off by because G is not known better [N/√kg]
};

/// With the workspace of its contact: whoever may evaluate has it without const,
/// for one thread at a time.
class HarmonicBalance {
 public:
  /// @param scene  borrowed; must outlive this.
  /// @throws std::invalid_argument  sizes in the scene differ,
  ///         a value is not finite or out of range.
  HarmonicBalance(const Scene& scene, HarmonicSet set);

  [[nodiscard]] Eigen::Index size() const { return excitation_.size(); }
  /// As it was asked for: of a contact that does not answer the mean, that is no unknown.
  [[nodiscard]] const HarmonicSet& set() const { return set_; }
  /// Whether the mean is an unknown.
  [[nodiscard]] bool has_mean() const { return has_mean_; }
  /// Where the sine of the first order begins: behind the mean, if that is unknown.
  [[nodiscard]] Eigen::Index orders_begin() const { return has_mean_ ? scene_.n_modes() : 0; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Eigen::VectorXd& excitation() const { return excitation_; }
  /// x with zeros for what is no unknown, up to the highest harmonic of the set.
  [[nodiscard]] Harmonics harmonics(const Eigen::VectorXd& x) const;
  /// The same with the mean that follows.
  /// @param at  evaluate() or residual() at x.
  [[nodiscard]] Harmonics motion(const Eigen::VectorXd& x, const BalanceEvaluation& at) const;
  /// The harmonics of the set alone; zero where q has none.
  [[nodiscard]] Eigen::VectorXd unknowns(const Harmonics& q) const;
  /// The same of a vector in the order of harmonics(x).vector(), of a gradient say.
  [[nodiscard]] Eigen::VectorXd unknowns(const Eigen::VectorXd& full) const;

  /// @return  of a frequency below 0 an infinite residual.
  [[nodiscard]] BalanceEvaluation evaluate(const Eigen::VectorXd& x, double frequency);
  /// The same without derivatives, which are empty; several times cheaper.
  [[nodiscard]] BalanceEvaluation residual(const Eigen::VectorXd& x, double frequency);
  /// ∂R/∂x by the unknowns of this at a motion that may have other harmonics as well, at least as
  /// many.
  [[nodiscard]] Eigen::MatrixXd derivatives_at(const Harmonics& q, double frequency);
  /// λ of the contact and 1 − λ of a linear stiffness in its place; the parameter is λ:
  ///   R = L x + λ G + (1 − λ) S x − Q
  /// @param stiffness  S on every harmonic [1/s²], n_modes × n_modes; zero: from the free limit.
  [[nodiscard]] BalanceEvaluation evaluate_homotopy(const Eigen::VectorXd& x, double frequency,
                                                    double share, const Eigen::MatrixXd& stiffness);
  /// Contact force up to a harmonic that the set may not have; without contact none.
  [[nodiscard]] Harmonics contact_force(const Eigen::VectorXd& x, double frequency,
                                        int n_harmonics);
  /// What the contact did under a solution, see ModalForce::report(); all zero without contact.
  [[nodiscard]] contact::CycleReport report(const Harmonics& q, double frequency);
  /// See ModalForce::work_error(); 0 without contact.
  [[nodiscard]] double work_error(const Harmonics& q, double frequency);
  /// See ModalForce::states(); empty without contact.
  void states(const Eigen::VectorXd& x, double frequency, contact::ContactStates& result);
  /// Response of the linear structure with a stiffness added: (L + S) x = Q. A resonance without
  /// damping gives entries that are not finite.
  [[nodiscard]] Eigen::VectorXd linear_response(double frequency,
                                                const Eigen::MatrixXd& stiffness) const;
  /// Zero, or ModalForce::stuck_stiffness().
  [[nodiscard]] const Eigen::MatrixXd& stuck_stiffness() const { return stuck_stiffness_; }
  /// max(‖Q‖, ‖contact force of the stuck limit‖) [N/√kg]: what residuals are measured by.
  [[nodiscard]] double force_scale(double frequency) const;
  /// Size of the terms that cancel in R [N/√kg]: stiffness, inertia and stuck contact under x. A
  /// point that slips far is computed as the small difference of forces of this size.
  [[nodiscard]] double largest_terms(const Eigen::VectorXd& x, double frequency) const;

 private:
  [[nodiscard]] bool is_complete() const { return has_mean_ && set_.complete(); }
  void set_mean(const Harmonics& force, BalanceEvaluation& result) const;
  void add_linear_residual(const Eigen::VectorXd& x, double frequency,
                           Eigen::VectorXd& residual) const;
  /// Of L, each mode and harmonic alone.
  [[nodiscard]] PairedDiagonal linear_jacobian(double frequency) const;
  void add_linear_part(const Eigen::VectorXd& x, double frequency, Eigen::MatrixXd& jacobian,
                       BalanceEvaluation& result) const;
  void add_frequency_derivative(const Eigen::VectorXd& x, double frequency,
                                BalanceEvaluation& result) const;
  [[nodiscard]] std::vector<Eigen::Index> resonant_unknowns(double frequency) const;
  void add_stiffness(const Eigen::MatrixXd& stiffness, double factor,
                     Eigen::MatrixXd& matrix) const;
  /// Where nothing holds a rigid body at rest, free or with every point that could hold it
  /// slipping, its place is any: the derivative gets a stiffness there, by which Newton's method
  /// leaves the place as it is.
  void hold_loose_means(double frequency, Eigen::MatrixXd& jacobian) const;
  [[nodiscard]] BalanceEvaluation nowhere() const;
  [[nodiscard]] contact::ForceAndJacobian contact_at(const Eigen::VectorXd& x, double frequency,
                                                     bool fewer);

  const Scene& scene_;
  HarmonicSet set_;
  bool has_mean_;
  std::vector<Eigen::Index> rows_;  // of Harmonics::rows(), one per block of unknowns
  Eigen::VectorXd excitation_;
  Eigen::VectorXd stiffness_;  // ω_n²
  Eigen::VectorXd damping_;    // 2ζ_n ω_n
  Eigen::MatrixXd stuck_stiffness_;
  std::vector<Eigen::Index> rigid_;                       // modes of frequency 0
  std::unique_ptr<contact::ModalForce::Workspace> work_;  // nullptr: no contact
};

}  // namespace microslip::solver
