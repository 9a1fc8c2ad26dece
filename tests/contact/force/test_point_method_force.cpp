#include "contact/force/point_method_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/contact_map.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/line/line_events.hpp"
#include "tests/support/asked_force.hpp"

namespace microslip::contact::test_point_method_force {
namespace {

constexpr Eigen::Index n_modes = 3;
constexpr double spring_r = 0.7;  // along r, so that the second direction has something to say

PointMotion motion_of(const Harmonics& m) {
  const auto& y = m.rows();
  return {y(0, 0), y(1, 0), y(2, 0), y(0, 1), y(1, 1), y(2, 1)};
}

// The closed form of one harmonic and, while there is contact at all, a linear spring along r.
class ClosedForm final : public PointMethod {
 public:
  explicit ClosedForm(const PointParameters& point) : point_(point) {}

  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override {
    const FrictionCycle cycle = friction_cycle(point_, motion_of(motion));
    result.regime = cycle.regime;
    result.force = Harmonics(1, n_point_signals);
    auto& f = result.force.rows();
    f.col(0) << cycle.friction.mean, cycle.friction.sin, cycle.friction.cos;
    f.col(1) << cycle.normal.mean, cycle.normal.sin, cycle.normal.cos;
    const double k_r = cycle.regime == CycleRegime::separated ? 0.0 : spring_r;
    f.col(2) = k_r * motion.rows().col(2);
    result.jacobian = Eigen::MatrixXd::Zero(9, 9);
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (Eigen::Index l = 0; l < 3; ++l) {
        for (Eigen::Index s = 0; s < 2; ++s) {
          for (Eigen::Index t = 0; t < 2; ++t) {
            result.jacobian(3 * k + s, 3 * l + t) = cycle.jacobian(3 * s + k, 3 * t + l);
          }
        }
      }
      result.jacobian(3 * k + 2, 3 * k + 2) = k_r;
    }
    // Any dependence on ω serves to see where it arrives.
    result.frequency_derivative = frequency * result.force.vector();
  }

  [[nodiscard]] PointHistory history(const Harmonics& motion, double /*frequency*/,
                                     const Eigen::VectorXd& phases, int /*n*/) const override {
    const FrictionCycle cycle = friction_cycle(point_, motion_of(motion));
    PointHistory history;
    history.regime = cycle.regime;
    history.segments.assign(cycle.segments().begin(), cycle.segments().end());
    history.dissipated_energy = cycle.dissipated_energy;
    history.slip_distance = cycle.slip_distance;
    history.normal_slip = cycle.normal_slip;
    for (const double phase : phases) {
      const CycleInstant now = at_phase(cycle, point_, motion_of(motion), phase);
      history.instants.push_back(
          {now.state, {now.u, now.v, 0.0}, {now.friction, now.normal, 0.0}, {now.slider, 0.0}});
    }
    return history;
  }

  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override {
    return {point_.tangential_stiffness, point_.normal_stiffness, spring_r};
  }
  [[nodiscard]] double reference_load() const override { return std::max(point_.rest_load, 0.0); }

 private:
  PointParameters point_;
};

struct Patch {
  Eigen::VectorXd weights;
  std::vector<PointParameters> points;
  std::vector<std::shared_ptr<const PointMethod>> methods;
  ModalShapes shapes;
};

Patch random_patch(Eigen::Index n, double preload) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Patch patch;
  patch.weights.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    patch.weights[i] = 0.1 + u(random);
    patch.points.push_back(
        {0.5 + u(random), 0.5 + u(random), 0.3 + u(random), preload * u(random)});
    patch.methods.push_back(std::make_shared<ClosedForm>(patch.points.back()));
  }
  std::srand(7);
  patch.shapes.u = Eigen::MatrixXd::Random(n, n_modes);
  patch.shapes.v = Eigen::MatrixXd::Random(n, n_modes);
  return patch;
}

Harmonics random_motion() {
  std::srand(11);
  Harmonics q(1, n_modes);
  q.rows().setRandom();
  return q;
}

// Two sums of n terms in different order.
double rounding(Eigen::Index n) { return 4e-15 * static_cast<double>(n); }

// The closed form, said to be off by 0.25 Pa.
class Vague final : public PointMethod {
 public:
  explicit Vague(const PointParameters& point) : exact_(point) {}

  void traction(const Harmonics& motion, double frequency, PointTraction& result) const override {
    exact_.traction(motion, frequency, result);
    result.defect = 0.25;
  }
  [[nodiscard]] PointHistory history(const Harmonics& motion, double frequency,
                                     const Eigen::VectorXd& phases, int n) const override {
    return exact_.history(motion, frequency, phases, n);
  }
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override {
    return exact_.stuck_stiffness();
  }
  [[nodiscard]] double reference_load() const override { return exact_.reference_load(); }

 private:
  ClosedForm exact_;
};

// ‖w (Φ_uᵀ δf_p + Φ_vᵀ δn)‖ for δf of at most 0.25: only the points that say so count.
TEST(PointMethodForce, CarriesTheDefectOfItsPoints) {
  Patch p = random_patch(5, 1.0);
  const Harmonics q = random_motion();
  EXPECT_EQ(tests::evaluate(PointMethodForce(p.weights, p.methods, p.shapes), q, 2.0).defect, 0.0);
  p.methods[1] = std::make_shared<Vague>(p.points[1]);
  const double expected =
      0.25 * p.weights[1] *
      std::sqrt(p.shapes.u.row(1).squaredNorm() + p.shapes.v.row(1).squaredNorm());
  EXPECT_NEAR(tests::evaluate(PointMethodForce(p.weights, p.methods, p.shapes), q, 2.0).defect,
              expected, 1e-15);
}

// 32 points make a block: one block, broken and whole ones.
TEST(PointMethodForce, GivesWhatTheClosedFormPatchGives) {
  for (const Eigen::Index n : {1, 32, 77}) {
    for (const double preload : {-2.0, 0.5, 3.0}) {
      const Patch p = random_patch(n, preload);
      PatchForce expected(ContactPatch(p.weights, p.points), p.shapes);
      PointMethodForce ours(p.weights, p.methods, p.shapes);
      const Harmonics q = random_motion();
      const ForceAndJacobian a = tests::evaluate(ours, q, 2.0);
      const ForceAndJacobian b = tests::evaluate(expected, q, 2.0);
      EXPECT_LE((a.force.vector() - b.force.vector()).cwiseAbs().maxCoeff(), rounding(n));
      EXPECT_LE((a.jacobian - b.jacobian).cwiseAbs().maxCoeff(), rounding(n));
      const CycleReport r = tests::report(ours, q, 2.0);
      const CycleReport s = tests::report(expected, q, 2.0);
      EXPECT_NEAR(r.slip_share, s.slip_share, 1e-14);
      EXPECT_NEAR(r.three_states_share, s.three_states_share, 1e-14);
      EXPECT_NEAR(r.slip_work, s.slip_work, rounding(n));
    }
  }
}

TEST(PointMethodForce, ForcesBeyondTheMotionAreThoseOfMotionPaddedWithZeros) {
  Patch patch = random_patch(40, 1.0);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    patch.methods[i] = std::make_shared<LineEvents>(patch.points[i]);
  }
  PointMethodForce force(patch.weights, patch.methods, patch.shapes);
  for (const int n_harmonics : {1, 3}) {
    std::srand(13);
    Harmonics q(n_harmonics, n_modes);
    q.rows().setRandom();
    Harmonics wide(9, n_modes);
    wide.rows().topRows(2 * n_harmonics + 1) = q.rows();
    const Harmonics alone = tests::evaluate(force, q, 1.0, {.n_harmonics = 9}).force;
    const Harmonics whole = tests::evaluate(force, wide, 1.0).force;
    EXPECT_GT(whole.rows().bottomRows(4).norm(), 1e-6 * whole.rows().norm());
    EXPECT_LT((alone.rows() - whole.rows()).norm(), rounding(40) * whole.rows().norm());
  }
}

TEST(PointMethodForce, ActsAlongTheSecondDirection) {
  const Eigen::Index n = 40;
  Patch p = random_patch(n, 9.0);  // none separated for good
  p.shapes.w = Eigen::MatrixXd::Random(n, n_modes);
  PointMethodForce with(p.weights, p.methods, p.shapes);
  ModalShapes flat = p.shapes;
  flat.w.resize(0, 0);
  PointMethodForce without(p.weights, p.methods, flat);
  const Harmonics q = random_motion();
  const Eigen::MatrixXd K = spring_r * p.shapes.w.transpose() * p.weights.asDiagonal() * p.shapes.w;
  const Eigen::MatrixXd extra =
      tests::evaluate(with, q, 1.0).force.rows() - tests::evaluate(without, q, 1.0).force.rows();
  EXPECT_LE((extra - q.rows() * K).cwiseAbs().maxCoeff(), rounding(n));
  EXPECT_LE((with.stuck_stiffness() - without.stuck_stiffness() - K).cwiseAbs().maxCoeff(),
            rounding(n));
}

TEST(PointMethodForce, JacobianAndFrequencyDerivativeAreThoseOfTheForce) {
  Patch p = random_patch(20, 1.0);
  p.shapes.w = Eigen::MatrixXd::Random(20, n_modes);
  PointMethodForce force(p.weights, p.methods, p.shapes);
  const Harmonics q = random_motion();
  const ForceAndJacobian at = tests::evaluate(force, q, 3.0);
  const double h = 1e-6;
  for (Eigen::Index j = 0; j < q.vector().size(); ++j) {
    Harmonics up = q;
    Harmonics down = q;
    up.vector()[j] += h;
    down.vector()[j] -= h;
    const Eigen::VectorXd difference = (tests::evaluate(force, up, 3.0).force.vector() -
                                        tests::evaluate(force, down, 3.0).force.vector()) /
                                       (2.0 * h);
    // Central differences: h² of third derivatives, and rounding / h.
    EXPECT_LE((at.jacobian.col(j) - difference).cwiseAbs().maxCoeff(), 1e-6) << j;
  }
  // The test's law: ∂f/∂ω = ω f, with the whole load and not its change.
  Harmonics load(1, n_modes);
  for (Eigen::Index i = 0; i < 20; ++i) {
    load.rows().row(0) +=
        p.weights[i] * p.methods[static_cast<std::size_t>(i)]->reference_load() * p.shapes.v.row(i);
  }
  const Eigen::VectorXd whole = at.force.vector() + load.vector();
  EXPECT_LE((at.frequency_derivative - 3.0 * whole).cwiseAbs().maxCoeff(), rounding(20) * 3.0);
}

TEST(PointMethodForce, MapIsThatOfTheClosedForm) {
  const Patch p = random_patch(12, 0.8);
  const Harmonics q = random_motion();
  const ContactMap ours = contact_map(p.methods, p.shapes, q, 1.0, 36, 1e-3);
  const ContactMap expected = contact_map(p.points, p.shapes, q, 36, 1e-3);
  EXPECT_EQ(ours.state, expected.state);
  EXPECT_EQ(ours.friction_traction, expected.friction_traction);
  EXPECT_EQ(ours.slip_duration, expected.slip_duration);
  EXPECT_EQ(ours.wear_depth, expected.wear_depth);
  EXPECT_EQ(ours.slip_r.cols(), 0);
}

TEST(PointMethodForce, RefusesWhatDoesNotFit) {
  const Patch p = random_patch(4, 1.0);
  const auto make = [&](const Eigen::VectorXd& weights, const ModalShapes& shapes) {
    return PointMethodForce(weights, p.methods, shapes);
  };
  EXPECT_THROW((void)make(p.weights.head(3), p.shapes), std::invalid_argument);
  EXPECT_THROW((void)make(-p.weights, p.shapes), std::invalid_argument);
  ModalShapes bad = p.shapes;
  bad.v(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)make(p.weights, bad), std::invalid_argument);
  PointMethodForce good(p.weights, p.methods, p.shapes);
  EXPECT_THROW((void)tests::evaluate(good, Harmonics(1, n_modes + 1), 1.0), std::invalid_argument);
  EXPECT_THROW((void)tests::evaluate(good, Harmonics(0, n_modes), 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_point_method_force
