#include "solver/curve/linear_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_linear_certificate {
namespace {

using contact::LinearState;
using tests::frequency_range;

LinearCertificate certificate_of(const Scene& scene, double low, double high) {
  return certify_linear(HarmonicBalance(scene, 1), low, high);
}

/// ω₀ = 1, stuck √3; the stuck amplitude peaks at 1/(2ζω₀√3) = 28.9.
Scene rubbing(double preload, double phi_v = 0.0) {
  tests::SinglePoint single;
  single.point = {2.0, 1.0, 0.5, preload};
  single.phi_v = phi_v;
  return tests::single_point_scene(single);
}

TEST(LinearCertificate, HoldsJustAboveThePreloadAtWhichThePeakSlips) {
  // k_u a = μ n₀ at the peak a = F/(2ζ √(ω_s² − ζ²)).
  const double peak = 1.0 / (2.0 * 0.01 * std::sqrt(3.0 - 1e-4));
  EXPECT_EQ(certificate_of(rubbing(1.01 * 4.0 * peak), 0.5, 3.0).state, LinearState::stuck);
  EXPECT_EQ(certificate_of(rubbing(0.999 * 4.0 * peak), 0.5, 3.0).state, LinearState::unknown);
  // Away from the peak the same preload is enough again.
  EXPECT_EQ(certificate_of(rubbing(0.999 * 4.0 * peak), 2.0, 3.0).state, LinearState::stuck);
}

TEST(LinearCertificate, SeesAPeakBetweenTwoFrequenciesThatHold) {
  // ζ = 1e-5: the peak is 1e-4 of the range wide, both ends are far below the limit.
  tests::SinglePoint single;
  single.damping_ratio = 1e-5;
  single.point = {2.0, 0.0, 0.5, 100.0};
  const Scene scene = tests::single_point_scene(single);
  EXPECT_EQ(certificate_of(scene, 0.5, 0.6).state, LinearState::stuck);
  EXPECT_EQ(certificate_of(scene, 0.5, 3.0).state, LinearState::unknown);
}

TEST(LinearCertificate, HoldsForAGapThatIsNotClosed) {
  // |A| peaks at 50 with φ_v = 1: n₀' = −k_v 51 stays open, −k_v 49 does not.
  tests::SinglePoint single;
  single.phi_v = 1.0;
  single.point = {2.0, 1.0, 0.5, -51.0};
  EXPECT_EQ(certificate_of(tests::single_point_scene(single), 0.5, 2.0).state, LinearState::free);
  single.point.rest_load = -49.0;
  EXPECT_EQ(certificate_of(tests::single_point_scene(single), 0.5, 2.0).state,
            LinearState::unknown);
}

TEST(LinearCertificate, CountsTheMeanMotion) {
  // A static load opens the contact: k_v v₀ takes away what the preload gives.
  Scene scene = rubbing(130.0, 0.5);
  EXPECT_EQ(certificate_of(scene, 0.5, 1.2).state, LinearState::stuck);
  scene.excitation.rows()(0, 0) = -900.0;
  EXPECT_EQ(certificate_of(scene, 0.5, 1.2).state, LinearState::unknown);
}

/// Springs to ground; remembers the balls it was asked of, and proves nothing by other sets.
class Listening final : public contact::ModalForce {
 public:
  explicit Listening(double stiffness) : ModalForce(1), stiffness_(stiffness) {}
  [[nodiscard]] contact::CycleReport report(const Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Constant(1, 1, stiffness_);
  }
  [[nodiscard]] LinearState linear_state_of(const contact::MotionSet& motions) const override {
    if (motions.spread.size() > 0) return LinearState::unknown;
    heard.push_back(motions);
    return LinearState::unknown;
  }
  mutable std::vector<contact::MotionSet> heard;

 private:
  [[nodiscard]] contact::ForceAndJacobian evaluated(const Harmonics& /*q*/, double /*frequency*/,
                                                    const contact::Asked& /*asked*/,
                                                    Workspace& /*work*/) const override {
    throw std::logic_error("no proof evaluates the force");
  }
  double stiffness_;
};

/// Q/(ω₀² + S − ω² + 2iζω₀ω), sine + i cosine, in more digits.
std::complex<long double> response(const Scene& scene, double stiffness, double omega) {
  const long double natural = scene.natural_frequency[0];
  const long double square = static_cast<long double>(omega) * omega;
  const std::complex<long double> d(natural * natural + stiffness - square,
                                    2.0L * scene.damping_ratio[0] * natural * omega);
  return static_cast<long double>(scene.excitation.sine(1)[0]) / d;
}

// Just beside a resonance, where λ − ω² loses most of its digits: an oscillator without damping
// leaves no margin but that for rounding.
TEST(LinearCertificate, ABallHasTheResponseWhateverRoundingDoes) {
  int n_balls = 0;
  for (int i = 1; i <= 200; ++i) {
    Scene scene = rubbing(1e9);
    scene.damping_ratio[0] = 0.0;
    const double stiffness = 2.0 + 1e-3 * i;
    auto force = std::make_unique<Listening>(stiffness);
    const Listening& contact = *force;
    scene.contact = std::move(force);
    const double low = std::sqrt(1.0 + stiffness) * (1.0 + 1e-5 * i);
    static_cast<void>(certificate_of(scene, low, low));
    ASSERT_FALSE(contact.heard.empty());
    const contact::MotionSet& ball = contact.heard.front();
    const auto exact = response(scene, stiffness, low);
    const std::complex<long double> centre(ball.centre.sine()[0], ball.centre.cosine()[0]);
    EXPECT_LE(std::abs(exact - centre), ball.radius) << low;
    EXPECT_LT(ball.radius, 1e-6 * std::abs(exact)) << low;
    ++n_balls;
  }
  EXPECT_EQ(n_balls, 200);
}

TEST(LinearCertificate, OfNoContactIsNone) {
  Scene scene = rubbing(1e9);
  scene.contact = nullptr;
  EXPECT_EQ(certificate_of(scene, 0.5, 1.2).state, LinearState::unknown);
}

TEST(LinearCertificate, OfTheHarmonicsOfTheForceIsNone) {
  Scene scene = rubbing(1e9);
  scene.excitation = contact::Harmonics(2, 1);
  scene.excitation.rows()(3, 0) = 1.0;
  EXPECT_EQ(certify_linear(HarmonicBalance(scene, 2), 0.5, 1.2).state, LinearState::unknown);
}

TEST(CertifiedCurve, IsTheNonlinearOneWithoutASingleContactEvaluation) {
  const Scene scene = tests::patch_scene({}, 1e6);
  ContinuationOptions options = frequency_range(2.0 * M_PI * 250.0, 2.0 * M_PI * 800.0);
  const ResponseCurve proved = trace_response(scene, options);
  options.linear_certificate = false;
  const ResponseCurve solved = trace_response(scene, options);
  ASSERT_TRUE(proved.complete && solved.complete);
  EXPECT_NE(proved.certificate.find("stuck"), std::string::npos) << proved.certificate;
  std::printf("%s; %.4f s instead of %.4f s\n", proved.certificate.c_str(), proved.seconds,
              solved.seconds);
  EXPECT_TRUE(solved.certificate.empty());
  EXPECT_EQ(proved.contact_evaluations, 0);
  EXPECT_GT(solved.contact_evaluations, 0);
  const auto peak = [](const ResponseCurve& curve) {
    const auto found =
        std::find_if(curve.points.begin(), curve.points.end(),
                     [](const auto& point) { return point.mark == PointMark::peak; });
    EXPECT_NE(found, curve.points.end());
    return found == curve.points.end() ? ResponsePoint{} : *found;
  };
  EXPECT_GT(peak(solved).amplitude, 0.0);
  // ζ = 0.002 magnifies rounding of the stiffness 500 times.
  EXPECT_NEAR(peak(proved).amplitude, peak(solved).amplitude, 1e-10 * peak(solved).amplitude);
  EXPECT_NEAR(peak(proved).frequency, peak(solved).frequency, 1e-9 * peak(solved).frequency);
  for (const ResponsePoint& point : proved.points) {
    EXPECT_EQ(point.report.stick_share, 1.0);
    EXPECT_LT(point.energy_imbalance, 1e-10);
    EXPECT_LT(point.dissipation_mismatch, 1e-10);
  }
}

TEST(CertifiedCurve, SaysOverWhatItIsProved) {
  const Scene scene = rubbing(200.0);
  EXPECT_EQ(trace_response(scene, frequency_range(2.0, 3.0)).certificate,
            "proved fully stuck over the whole range (1 frequency interval looked at): the linear "
            "response is a solution; others may exist");
  EXPECT_EQ(trace_response(scene, frequency_range(2.0, 2.0)).certificate,
            "proved fully stuck at this frequency: the linear response is a solution; others may "
            "exist");
}

TEST(CertifiedCurve, NeverEntersNewtonsMethod) {
  const Scene scene = rubbing(1e3);
  for (const auto& [begin, end] : {std::pair(0.5, 3.0), std::pair(1.5, 1.5)}) {
    ContinuationOptions options = frequency_range(begin, end);
    options.n_harmonics = 5;
    const ResponseCurve curve = trace_response(scene, options);
    ASSERT_TRUE(curve.complete) << curve.message;
    EXPECT_NE(curve.certificate.find("stuck"), std::string::npos) << curve.certificate;
    EXPECT_EQ(curve.iterations, 0);
    EXPECT_EQ(curve.contact_evaluations, 0);
  }
}

TEST(CertifiedCurve, IsStoppedByItsObserver) {
  int seen = 0;
  const ResponseCurve curve = trace_response(rubbing(1e6), frequency_range(0.5, 3.0),
                                             [&](const ResponsePoint&) { return ++seen < 5; });
  EXPECT_EQ(curve.diagnosis, Diagnosis::interrupted);
  EXPECT_EQ(seen, 5);
}

TEST(CertifiedCurve, OfRandomScenesHoldsWhereTheNonlinearSolverIsAsked) {
  // What is proved must be what is solved: every certified random scene agrees with the contact.
  int proved = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const tests::RandomScene random = tests::random_scene(seed);
    HarmonicBalance balance(random.scene, 1);
    const auto [low, high] =
        std::minmax(random.options.frequency_begin, random.options.frequency_end);
    const LinearCertificate certificate = certify_linear(balance, low, high);
    if (certificate.state == LinearState::unknown) continue;
    ++proved;
    const bool stuck = certificate.state == LinearState::stuck;
    const Eigen::Index n = random.scene.n_modes();
    const Eigen::MatrixXd stiffness =
        stuck ? balance.stuck_stiffness() : Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i <= 400; ++i) {
      const double omega = low + (high - low) * i / 400.0;
      const Eigen::VectorXd x = balance.linear_response(omega, stiffness);
      const double residual = balance.evaluate(x, omega).residual.norm();
      ASSERT_LE(residual, 1e-9 * balance.force_scale(omega)) << seed << " at " << omega;
    }
  }
  EXPECT_GT(proved, 2);
}

}  // namespace
}  // namespace microslip::solver::test_linear_certificate
