#include "solver/balance/harmonic_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("scene: " + message);
}

void check(const Scene& scene) {
  const Eigen::Index n = scene.n_modes();
  require(n >= 1, "no modes");
  require(scene.damping_ratio.size() == n && scene.output.size() == n &&
              scene.excitation.n_signals() == n,
          "damping ratios, output and excitation must have one entry per mode (" +
              std::to_string(n) + ")");
  require(scene.contact == nullptr || scene.contact->n_modes() == n,
          "the contact has another number of modes");
  require(scene.natural_frequency.allFinite() && (scene.natural_frequency.array() >= 0.0).all(),
          "natural frequencies must be finite and at least 0");
  require(scene.damping_ratio.allFinite() && scene.output.allFinite() &&
              scene.excitation.rows().allFinite(),
          "damping ratios, output and excitation must be finite");
}

/// L of one harmonic, [dynamic, −viscous; viscous, dynamic] over its sine and cosine:
/// an entry per mode.
struct HarmonicBlock {
  Eigen::ArrayXd dynamic;
  Eigen::ArrayXd viscous;

  /// @param s  where the sine begins, of x and of the result; the cosine follows.
  void add_product(const Eigen::VectorXd& x, Eigen::Index s, Eigen::VectorXd& result) const {
    const Eigen::Index n = dynamic.size();
    const auto sine = x.segment(s, n).array();
    const auto cosine = x.segment(s + n, n).array();
    result.segment(s, n).array() += dynamic * sine - viscous * cosine;
    result.segment(s + n, n).array() += dynamic * cosine + viscous * sine;
  }
};

/// @param frequency  kω.
HarmonicBlock harmonic_block(const Eigen::VectorXd& stiffness, const Eigen::VectorXd& damping,
                             double frequency) {
  return {stiffness.array() - frequency * frequency, frequency * damping.array()};
}

std::vector<Eigen::Index> rows_of(const HarmonicSet& set, bool has_mean) {
  std::vector<Eigen::Index> rows;
  if (has_mean) rows.push_back(0);
  for (const int k : set.orders()) {
    rows.push_back(2 * k - 1);
    rows.push_back(2 * k);
  }
  return rows;
}

/// What nothing holds has no mean that follows.
bool mean_follows(const Scene& scene) {
  return scene.contact && !scene.contact->answers_mean() &&
         (scene.natural_frequency.array() > 0.0).all();
}

}  // namespace

HarmonicBalance::HarmonicBalance(const Scene& scene, HarmonicSet set)
    : scene_(scene),
      set_(std::move(set)),
      has_mean_(set_.has_mean() && !mean_follows(scene)),
      rows_(rows_of(set_, has_mean_)) {
  check(scene);
  const Eigen::Index n = scene.n_modes();
  excitation_ = unknowns(scene.excitation);
  stiffness_ = scene.natural_frequency.array().square();
  damping_ = 2.0 * scene.damping_ratio.array() * scene.natural_frequency.array();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (scene.natural_frequency[i] == 0.0 && has_mean_) rigid_.push_back(i);
  }
  stuck_stiffness_ = scene.contact ? scene.contact->stuck_stiffness() : Eigen::MatrixXd::Zero(n, n);
  if (scene.contact) work_ = scene.contact->workspace();
}

Harmonics HarmonicBalance::harmonics(const Eigen::VectorXd& x) const {
  const Eigen::Index n = scene_.n_modes();
  if (is_complete()) return {set_.highest(), n, x};
  Harmonics q(set_.highest(), n);
  Eigen::Index at = 0;
  for (const Eigen::Index row : rows_) {
    q.rows().row(row) = x.segment(at, n).transpose();
    at += n;
  }
  return q;
}

Harmonics HarmonicBalance::motion(const Eigen::VectorXd& x, const BalanceEvaluation& at) const {
  Harmonics q = harmonics(x);
  if (at.mean.size() > 0) q.rows().row(0) = at.mean.transpose();
  return q;
}

/// Where the set has a mean that is no unknown.
void HarmonicBalance::set_mean(const Harmonics& force, BalanceEvaluation& result) const {
  if (has_mean_ || !set_.has_mean()) return;
  const Eigen::VectorXd load = (scene_.excitation.mean() - force.mean()).transpose();
  result.mean = load.cwiseQuotient(stiffness_);
}

Eigen::VectorXd HarmonicBalance::unknowns(const Harmonics& q) const {
  const Eigen::Index n = scene_.n_modes();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.size()) * n);
  Eigen::Index at = 0;
  for (const Eigen::Index row : rows_) {
    if (row < q.rows().rows()) x.segment(at, n) = q.rows().row(row).transpose();
    at += n;
  }
  return x;
}

Eigen::VectorXd HarmonicBalance::unknowns(const Eigen::VectorXd& full) const {
  if (is_complete()) return full;
  return unknowns(Harmonics(set_.highest(), scene_.n_modes(), full));
}

/// Force and derivatives in the unknowns alone; all rows of the force.
contact::ForceAndJacobian HarmonicBalance::contact_at(const Eigen::VectorXd& x, double frequency,
                                                      bool fewer) {
  return scene_.contact->evaluate(harmonics(x), frequency, {.rows = rows_, .fewer = fewer}, *work_);
}

void HarmonicBalance::add_linear_residual(const Eigen::VectorXd& x, double frequency,
                                          Eigen::VectorXd& residual) const {
  const Eigen::Index n = scene_.n_modes();
  Eigen::Index s = orders_begin();
  residual.head(s) += stiffness_.head(s).cwiseProduct(x.head(s));
  for (const int k : set_.orders()) {
    harmonic_block(stiffness_, damping_, k * frequency).add_product(x, s, residual);
    s += 2 * n;
  }
}

PairedDiagonal HarmonicBalance::linear_jacobian(double frequency) const {
  const Eigen::Index n = scene_.n_modes();
  Eigen::Index s = orders_begin();
  PairedDiagonal own{n, s, Eigen::VectorXd(size()), Eigen::VectorXd::Zero(size())};
  own.diagonal.head(s) = stiffness_.head(s);
  for (const int k : set_.orders()) {
    const HarmonicBlock block = harmonic_block(stiffness_, damping_, k * frequency);
    own.diagonal.segment(s, 2 * n) = block.dynamic.matrix().replicate(2, 1);
    own.coupling.segment(s, n) = -block.viscous.matrix();
    own.coupling.segment(s + n, n) = block.viscous.matrix();
    s += 2 * n;
  }
  return own;
}

/// Harmonics near a natural frequency, where what a mode answers with is not told by its stiffness,
/// and what is soft beside the contact.
std::vector<Eigen::Index> HarmonicBalance::resonant_unknowns(double frequency) const {
  constexpr double near = 0.1;   // of stiffness and inertia together
  constexpr double soft = 1e-4;  // of the stiffness of the contact that sticks
  const Eigen::Index n = scene_.n_modes();
  const auto is_soft = [&](double own, Eigen::Index mode) {
    return own < soft * stuck_stiffness_(mode, mode);
  };
  std::vector<Eigen::Index> unknowns;
  for (Eigen::Index i = 0; i < orders_begin(); ++i) {
    if (is_soft(stiffness_[i], i)) unknowns.push_back(i);
  }
  Eigen::Index s = orders_begin();
  for (const int k : set_.orders()) {
    const HarmonicBlock block = harmonic_block(stiffness_, damping_, k * frequency);
    const double inertia = (k * frequency) * (k * frequency);
    for (const Eigen::Index first : {s, s + n}) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double left = std::hypot(block.dynamic[i], block.viscous[i]);
        const bool is_near = !(left > near * (stiffness_[i] + inertia));
        if (is_near || is_soft(left, i)) unknowns.push_back(first + i);
      }
    }
    s += 2 * n;
  }
  return unknowns;
}

void HarmonicBalance::add_frequency_derivative(const Eigen::VectorXd& x, double frequency,
                                               BalanceEvaluation& result) const {
  const Eigen::Index n = scene_.n_modes();
  Eigen::Index s = orders_begin();
  for (const int k : set_.orders()) {
    const HarmonicBlock by_frequency{Eigen::ArrayXd::Constant(n, -2.0 * k * k * frequency),
                                     k * damping_.array()};
    by_frequency.add_product(x, s, result.parameter_derivative);
    s += 2 * n;
  }
}

void HarmonicBalance::add_linear_part(const Eigen::VectorXd& x, double frequency,
                                      Eigen::MatrixXd& jacobian, BalanceEvaluation& result) const {
  add_linear_residual(x, frequency, result.residual);
  linear_jacobian(frequency).add_to(jacobian);
  add_frequency_derivative(x, frequency, result);
}

void HarmonicBalance::hold_loose_means(double frequency, Eigen::MatrixXd& jacobian) const {
  if (rigid_.empty()) return;
  // Of the stiffness of these modes when everything sticks: squared it is above rounding, and a
  // body that is held softly is held.
  constexpr double nothing = 1e-7;
  const double stuck = stuck_stiffness_(Eigen::all, rigid_).norm();
  const Eigen::MatrixXd columns = jacobian(Eigen::all, rigid_) / (stuck > 0.0 ? stuck : 1.0);
  const auto pairs = contact::symmetric_pairs(columns.transpose() * columns);
  for (Eigen::Index i = 0; pairs && i < pairs->values.size(); ++i) {
    if (pairs->values[i] > nothing * nothing) continue;
    const Eigen::VectorXd loose = pairs->vectors.col(i);
    jacobian(rigid_, rigid_) += std::max(stuck, frequency * frequency) * loose * loose.transpose();
  }
}

void HarmonicBalance::add_stiffness(const Eigen::MatrixXd& stiffness, double factor,
                                    Eigen::MatrixXd& matrix) const {
  const Eigen::Index n = scene_.n_modes();
  for (Eigen::Index i = 0; i < size(); i += n) matrix.block(i, i, n, n) += factor * stiffness;
}

/// A step of Newton's method that leads below zero is to be shortened: there is no such excitation,
/// and friction that falls with the speed would grow without bound.
BalanceEvaluation HarmonicBalance::nowhere() const {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(size());
  BalanceEvaluation result;
  result.residual = Eigen::VectorXd::Constant(size(), std::numeric_limits<double>::infinity());
  result.jacobian = Eigen::MatrixXd::Zero(size(), size());
  result.parameter_derivative = result.contact_force = nothing;
  return result;
}

BalanceEvaluation HarmonicBalance::evaluate(const Eigen::VectorXd& x, double frequency) {
  if (frequency < 0.0) return nowhere();
  BalanceEvaluation result;
  Eigen::MatrixXd jacobian;
  if (scene_.contact) {
    contact::ForceAndJacobian contact = contact_at(x, frequency, rigid_.empty());
    result.contact_force = unknowns(contact.force);
    result.residual = result.contact_force - excitation_;
    result.parameter_derivative = std::move(contact.frequency_derivative);
    result.defect = contact.defect;
    set_mean(contact.force, result);
    if (contact.fewer) {
      add_linear_residual(x, frequency, result.residual);
      add_frequency_derivative(x, frequency, result);
      result.jacobian = BalanceJacobian({.own = linear_jacobian(frequency),
                                         .contact = std::move(contact.fewer),
                                         .resonant = resonant_unknowns(frequency)});
      return result;
    }
    jacobian = std::move(contact.jacobian);
  } else {
    result.contact_force = Eigen::VectorXd::Zero(size());
    result.residual = -excitation_;
    jacobian = Eigen::MatrixXd::Zero(size(), size());
    result.parameter_derivative = Eigen::VectorXd::Zero(size());
  }
  add_linear_part(x, frequency, jacobian, result);
  hold_loose_means(frequency, jacobian);
  result.jacobian = std::move(jacobian);
  return result;
}

BalanceEvaluation HarmonicBalance::residual(const Eigen::VectorXd& x, double frequency) {
  if (frequency < 0.0) return nowhere();
  BalanceEvaluation result;
  result.contact_force = Eigen::VectorXd::Zero(size());
  if (scene_.contact) {
    const contact::ForceAndJacobian contact =
        scene_.contact->evaluate(harmonics(x), frequency, {}, *work_);
    result.contact_force = unknowns(contact.force);
    result.defect = contact.defect;
    set_mean(contact.force, result);
  }
  result.residual = result.contact_force - excitation_;
  add_linear_residual(x, frequency, result.residual);
  return result;
}

Eigen::MatrixXd HarmonicBalance::derivatives_at(const Harmonics& q, double frequency) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(size(), size());
  if (scene_.contact) {
    jacobian = scene_.contact->evaluate(q, frequency, {.rows = rows_}, *work_).jacobian;
  }
  linear_jacobian(frequency).add_to(jacobian);
  hold_loose_means(frequency, jacobian);
  return jacobian;
}

Harmonics HarmonicBalance::contact_force(const Eigen::VectorXd& x, double frequency,
                                         int n_harmonics) {
  if (!scene_.contact) return {n_harmonics, scene_.n_modes()};
  return scene_.contact->evaluate(harmonics(x), frequency, {.n_harmonics = n_harmonics}, *work_)
      .force;
}

contact::CycleReport HarmonicBalance::report(const Harmonics& q, double frequency) {
  return scene_.contact ? scene_.contact->report(q, frequency, *work_) : contact::CycleReport{};
}

void HarmonicBalance::states(const Eigen::VectorXd& x, double frequency,
                             contact::ContactStates& result) {
  result.clear();
  if (scene_.contact) scene_.contact->states(harmonics(x), frequency, result, *work_);
}

BalanceEvaluation HarmonicBalance::evaluate_homotopy(const Eigen::VectorXd& x, double frequency,
                                                     double share,
                                                     const Eigen::MatrixXd& stiffness) {
  BalanceEvaluation result;
  const contact::ForceAndJacobian contact = contact_at(x, frequency, false);
  result.contact_force = unknowns(contact.force);
  result.defect = share * contact.defect;
  Eigen::MatrixXd linear = Eigen::MatrixXd::Zero(size(), size());
  add_stiffness(stiffness, 1.0, linear);
  const Eigen::VectorXd linear_force = linear * x;
  result.residual = share * result.contact_force + (1.0 - share) * linear_force - excitation_;
  Eigen::MatrixXd jacobian = share * contact.jacobian + (1.0 - share) * linear;
  result.parameter_derivative = Eigen::VectorXd::Zero(size());
  add_linear_part(x, frequency, jacobian, result);
  hold_loose_means(frequency, jacobian);
  result.jacobian = std::move(jacobian);
  result.parameter_derivative = result.contact_force - linear_force;
  return result;
}

Eigen::VectorXd HarmonicBalance::linear_response(double frequency,
                                                 const Eigen::MatrixXd& stiffness) const {
  // No linear force couples harmonics: one at a time.
  const Eigen::Index n = scene_.n_modes();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
  const auto solve = [&](int k, Eigen::Index first, Eigen::Index count) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index i = 0; i < count; i += n) {
      matrix.block(i, i, n, n) = stiffness;
      matrix.block(i, i, n, n).diagonal().array() +=
          stiffness_.array() - (k * frequency) * (k * frequency);
    }
    if (k > 0) {
      matrix.topRightCorner(n, n).diagonal() -= k * frequency * damping_;
      matrix.bottomLeftCorner(n, n).diagonal() += k * frequency * damping_;
    }
    x.segment(first, count) = contact::solved(matrix, excitation_.segment(first, count));
  };
  // Where a mean is any it is zero.
  Eigen::Index first = orders_begin();
  const bool is_loaded = rigid_.empty() || !excitation_.head(first).isZero(0.0);
  if (has_mean_ && is_loaded) solve(0, 0, n);
  for (const int k : set_.orders()) {
    // What is not driven rests, at a resonance without damping as well.
    if (!excitation_.segment(first, 2 * n).isZero(0.0)) solve(k, first, 2 * n);
    first += 2 * n;
  }
  return x;
}

double HarmonicBalance::force_scale(double frequency) const {
  const double load = excitation_.norm();
  if (load == 0.0 || !scene_.contact) return load;
  const Eigen::VectorXd stuck = linear_response(frequency, stuck_stiffness_);
  if (!stuck.allFinite()) return load;
  const Eigen::Index n = scene_.n_modes();
  return std::max(load, (stuck_stiffness_ * stuck.reshaped(n, stuck.size() / n)).norm());
}

double HarmonicBalance::work_error(const Harmonics& q, double frequency) {
  return work_ ? scene_.contact->work_error(q, frequency, *work_) : 0.0;
}

double HarmonicBalance::largest_terms(const Eigen::VectorXd& x, double frequency) const {
  const Harmonics q = harmonics(x);
  // A stiff contact holds its points still: motions of the modes cancel there, their rounding does
  // not.
  double sum = (q.rows() * stiffness_.asDiagonal()).norm() +
               (q.rows().cwiseAbs() * stuck_stiffness_.cwiseAbs()).norm();
  for (const int k : set_.orders()) {
    sum += (k * frequency) * (k * frequency) * std::hypot(q.sine(k).norm(), q.cosine(k).norm());
  }
  return sum;
}

}  // namespace microslip::solver
