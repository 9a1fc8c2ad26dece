#include "contact/line/event_force.hpp"

#include <algorithm>
#include <numbers>

namespace microslip::contact {
namespace {

constexpr double pi = std::numbers::pi;

double norm(int i) { return i == 0 ? 0.5 / pi : 1.0 / pi; }

// Coefficient of a guard by index of the basis.
double coefficient(const TrigonometricPolynomial& p, int i) {
  if (i == 0) {
    return p.mean();
  }
  const int h = (i + 1) / 2;
  return i % 2 == 1 ? p.sin(h) : p.cos(h);
}

// A point that sticks after separation has |spring'| ≤ μ load', so the quotient is bounded even
// where both vanish.
double touch_down_quotient(const EventGuards& guards, double phase, double mu) {
  const double load = guards.load.jet(phase).slope;
  const double spring = guards.spring.jet(phase).slope;
  return load > 0.0 ? std::clamp(spring / load, -mu, mu) : 0.0;
}

// ∂c/∂v_j over k_v b_j(θ_e).
double memory_by_load(const EventPhase& phase, const EventGuards& guards, double mu) {
  switch (phase.origin) {
    case StickOrigin::positive_slip:
      return mu;
    case StickOrigin::negative_slip:
      return -mu;
    case StickOrigin::touch_down:
      return touch_down_quotient(guards, phase.memory, mu);
    default:
      return 0.0;
  }
}

// Rows and columns of a Jacobian of n_point_signals signals.
enum Signal : int { tangential = 0, normal = 1 };
Eigen::Index entry(int i, Signal signal) { return n_point_signals * i + signal; }

// norm(i) · factor · ⟨b_i b_j⟩ in the rows and columns of two signals.
void set_products(const TrigonometricMoments& moments, double factor, int n_harmonics, Signal row,
                  Signal column, Eigen::MatrixXd& jacobian) {
  const double mean = norm(0) * factor;
  const double wave = norm(1) * factor;
  for (int i = 0; i <= 2 * n_harmonics; ++i) {
    jacobian(entry(i, row), entry(0, column)) = (i == 0 ? mean : wave) * moments.product(i, 0);
    jacobian(entry(0, row), entry(i, column)) = mean * moments.product(0, i);
  }
  for (int b = 1; b <= n_harmonics; ++b) {
    double* const sine = &jacobian(0, entry(2 * b - 1, column));
    double* const cosine = &jacobian(0, entry(2 * b, column));
    for (int a = 1; a <= n_harmonics; ++a) {
      const auto p = moments.products(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
      sine[entry(2 * a - 1, row)] = wave * p.sin_sin;
      sine[entry(2 * a, row)] = wave * p.cos_sin;
      cosine[entry(2 * a - 1, row)] = wave * p.sin_cos;
      cosine[entry(2 * a, row)] = wave * p.cos_cos;
    }
  }
}

}  // namespace

void EventForce::gather(const PointParameters& point, const EventGuards& guards,
                        const EventPhases& phases, int n_harmonics) {
  rubs_ = point.rubs();
  n_harmonics_ = n_harmonics;
  const int highest = n_harmonics + guards.load.degree();
  const int n = 2 * n_harmonics + 1;
  for (TrigonometricMoments* moments : {&piece_, &stick_, &slip_, &contact_}) {
    moments->reset(highest);
  }
  const bool separates = phases.regime == CycleRegime::separation;
  if (!separates && phases.regime != CycleRegime::separated) {
    contact_.set_period();  // the load is its own Fourier series
  }
  memory_.assign(static_cast<std::size_t>(n), 0.0);
  stick_mean_.clear();
  for (const EventPhase& phase : phases.phases) {
    if (phase.state == ContactState::separated) {
      continue;
    }
    piece_.set_piece(phase.begin, phase.length);
    if (separates) {
      contact_.add(1.0, piece_);
    }
    if (phase.state != ContactState::stick) {
      slip_.add(phase.state == ContactState::positive_slip ? 1.0 : -1.0, piece_);
      continue;
    }
    stick_.add(1.0, piece_);
    for (int i = 0; i < n; ++i) {
      stick_mean_.push_back(piece_.single(i));
      memory_[static_cast<std::size_t>(i)] += phase.offset * piece_.single(i);
    }
  }
}

void EventForce::set_force(const PointParameters& point, const EventGuards& guards,
                           Harmonics& force) {
  const int n = 2 * n_harmonics_ + 1;
  const int m = 2 * guards.load.degree() + 1;
  for (int i = 0; i < n; ++i) {
    double f = memory_[static_cast<std::size_t>(i)];
    double load = 0.0;
    for (int j = 0; j < m; ++j) {
      const double n_j = coefficient(guards.load, j);
      f += coefficient(guards.spring, j) * stick_.product(i, j) +
           point.friction_coefficient * n_j * slip_.product(i, j);
      load += n_j * contact_.product(i, j);
    }
    force.rows()(i, 0) = rubs_ ? norm(i) * f : 0.0;
    force.rows()(i, 1) = norm(i) * load;
    force.rows()(i, 2) = 0.0;
  }
}

void EventForce::set_springs(const PointParameters& point, Eigen::MatrixXd& jacobian) const {
  const double k_v = point.normal_stiffness;
  set_products(contact_, k_v, n_harmonics_, normal, normal, jacobian);
  if (!rubs_) {
    return;
  }
  set_products(stick_, point.tangential_stiffness, n_harmonics_, tangential, tangential, jacobian);
  for (int i = 0; i <= 2 * n_harmonics_; ++i) {
    jacobian(entry(i, tangential), entry(0, tangential)) = 0.0;  // the spring knows no mean
  }
  set_products(slip_, point.friction_coefficient * k_v, n_harmonics_, tangential, normal, jacobian);
}

void EventForce::add_memories(const PointParameters& point, const EventGuards& guards,
                              const EventPhases& phases, Eigen::MatrixXd& jacobian) {
  const int n = 2 * n_harmonics_ + 1;
  const double* mean = stick_mean_.data();
  for (const EventPhase& phase : phases.phases) {
    if (phase.state != ContactState::stick) {
      continue;
    }
    if (phase.origin == StickOrigin::virgin) {
      jacobian(entry(0, tangential), entry(0, tangential)) += point.tangential_stiffness;
    } else if (phase.length > 0.0) {
      set_basis(phase.memory, n_harmonics_, basis_);
      const double by_u = -point.tangential_stiffness;
      const double by_v =
          memory_by_load(phase, guards, point.friction_coefficient) * point.normal_stiffness;
      for (int j = 0; j < n; ++j) {
        const double b = basis_[static_cast<std::size_t>(j)];
        for (int i = 0; i < n; ++i) {
          const double weight = norm(i) * mean[i] * b;
          jacobian(entry(i, tangential), entry(j, tangential)) += j == 0 ? 0.0 : by_u * weight;
          jacobian(entry(i, tangential), entry(j, normal)) += by_v * weight;
        }
      }
    }
    mean += n;
  }
}

Harmonics EventForce::force(const PointParameters& point, const EventGuards& guards,
                            const EventPhases& phases, int n_harmonics) {
  gather(point, guards, phases, n_harmonics);
  Harmonics force(n_harmonics, n_point_signals);
  set_force(point, guards, force);
  return force;
}

void set_states(const EventPhases& phases, PointTraction& result) {
  result.regime = phases.regime;
  for (const EventPhase& phase : phases.phases) {
    result.period.set(phase.state, phase.begin, phase.length);
  }
}

void EventForce::traction(const PointParameters& point, const EventGuards& guards,
                          const EventPhases& phases, PointTraction& result) {
  const int n_harmonics = guards.load.degree();
  const Eigen::Index size = n_point_signals * (2 * n_harmonics + 1);
  gather(point, guards, phases, n_harmonics);
  if (result.force.n_harmonics() != n_harmonics || result.force.n_signals() != n_point_signals) {
    result.force = Harmonics(n_harmonics, n_point_signals);
  }
  result.jacobian.setZero(size, size);
  result.frequency_derivative.setZero(size);
  set_states(phases, result);
  set_force(point, guards, result.force);
  set_springs(point, result.jacobian);
  if (rubs_) {
    add_memories(point, guards, phases, result.jacobian);
  }
}

}  // namespace microslip::contact
