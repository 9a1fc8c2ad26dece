// Random modal scenes (1–6 modes, 1–12 points, parameters log-uniform, seeds 0 … 299) and wilder
// ones (1–8 modes down to 1 % apart, 1–24 points, seeds 0 … 999) with default settings. Each must
// end in a complete curve or a named diagnosis; every written point carries its proof (theory
// section 15): residual, energy balance and dissipation mismatch. Invariances of the same scenes:
// homogeneity (theory 15.4), shift in phase (15.5), reversed sweeps.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/optimum/peak_trace.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"
#include "tests/support/traced_peaks.hpp"

namespace microslip::random_scenes {
namespace {

constexpr double certificate = 1e-10;  // every written point of every curve
// A fully stuck point far from resonance with a damping ratio of 1e-5 exchanges 1e-7 of what its
// works are differences of: eps divided by that is the accuracy there is.
constexpr double inherent = 1e-9;
constexpr double time_cap = 20.0;  // s per scene; the slowest takes some 3 s on a loaded core

/// What a campaign counts, printed as a table.
class Campaign {
 public:
  void add(int seed, const tests::RandomScene& random) {
    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const auto curve = solver::trace_response(
        random.scene, random.options,
        [&](const solver::ResponsePoint& /*point*/) { return elapsed() < time_cap; });
    EXPECT_EQ(curve.complete, curve.diagnosis == solver::Diagnosis::none) << seed;
    slowest_ = std::max(slowest_, elapsed());
    const std::string whole = curve.certificate.empty() ? "complete" : "complete, certified";
    ++outcomes_[curve.complete ? whole : to_string(curve.diagnosis)];
    if (!curve.complete) std::printf("seed %d: %s\n", seed, curve.message.c_str());
    for (const auto& event : curve.log) ++remedies_[to_string(event.remedy)];
    iterations_ += curve.iterations;
    evaluations_ += curve.contact_evaluations;
    n_points_ += curve.points.size();
    for (const auto& point : curve.points) {
      ASSERT_TRUE(point.q.vector().allFinite() && std::isfinite(point.amplitude)) << seed;
      residual = std::max(residual, point.residual);
      imbalance = std::max(imbalance, point.energy_imbalance);
      mismatch = std::max(mismatch, point.dissipation_mismatch);
    }
  }

  void print() const {
    for (const auto& [name, count] : outcomes_) std::printf("%-22s %6d\n", name.c_str(), count);
    for (const auto& [name, count] : remedies_)
      std::printf("  remedy %-15s %4d\n", name.c_str(), count);
    std::printf("%zu points, %ld iterations, %ld contact evaluations, slowest scene %.1f s\n",
                n_points_, iterations_, evaluations_, slowest_);
    std::printf("largest residual %.1e, energy imbalance %.1e, dissipation mismatch %.1e\n",
                residual, imbalance, mismatch);
  }

  [[nodiscard]] int n_complete() const {
    int count = 0;
    for (const auto& [name, number] : outcomes_) count += name.starts_with("complete") ? number : 0;
    return count;
  }

  double residual = 0.0;
  double imbalance = 0.0;
  double mismatch = 0.0;

 private:
  std::map<std::string, int> outcomes_;
  std::map<std::string, int> remedies_;
  std::size_t n_points_ = 0;
  long iterations_ = 0;
  long evaluations_ = 0;
  double slowest_ = 0.0;
};

TEST(RandomScenes, EndInACompleteCurveOrANamedDiagnosis) {
  Campaign campaign;
  const int n_scenes = tests::campaign_size(300);
  for (int seed = 0; seed < n_scenes; ++seed) {
    campaign.add(seed, tests::random_scene(static_cast<std::uint64_t>(seed)));
  }
  campaign.print();
  EXPECT_GE(campaign.n_complete(), n_scenes - n_scenes / 300);
  EXPECT_LE(campaign.residual, 1e-11);
  EXPECT_LE(campaign.imbalance, certificate);
  EXPECT_LE(campaign.mismatch, certificate);
}

TEST(WildScenes, EndInACompleteCurveOrANamedDiagnosis) {
  Campaign campaign;
  const int n_scenes = tests::campaign_size(1000);
  for (int seed = 0; seed < n_scenes; ++seed) {
    campaign.add(seed, tests::wild_scene(static_cast<std::uint64_t>(seed)));
  }
  campaign.print();
  EXPECT_GE(campaign.n_complete(), 99 * n_scenes / 100);
  EXPECT_LE(campaign.imbalance, inherent);
  EXPECT_LE(campaign.mismatch, inherent);
}

/// A random scene with all preloads and gaps times a factor.
solver::Scene with_preload(std::uint64_t seed, double factor) {
  tests::RandomScene random = tests::random_scene(seed);
  const auto& patch = dynamic_cast<const tests::ReadablePatch&>(*random.scene.contact);
  std::vector<contact::PointParameters> points = patch.patch().points();
  for (contact::PointParameters& point : points) point.rest_load *= factor;
  random.scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(patch.patch().weights(), std::move(points)), patch.shapes());
  return std::move(random.scene);
}

TEST(RandomScenes, HaveThePeaksThatAreFollowedOnTheirWholeCurves) {
  std::size_t n_values = 0;
  int n_curves = 0;
  double difference = 0.0;
  const int n_families = tests::campaign_size(12, 2);
  for (int i = 0; i < n_families; ++i) {
    const auto seed = static_cast<std::uint64_t>(10 + i);
    const solver::ContinuationOptions range = tests::random_scene(seed).options;
    const auto family = [&](double factor) { return with_preload(seed, factor); };
    solver::PeakTraceOptions options;
    options.lower = 0.1;
    options.upper = 10.0;
    options.n_values = 13;
    const solver::PeakTrace trace = tests::traced_peaks(family, range, options);
    n_values += trace.peaks.size();
    n_curves += trace.n_curves;
    for (const solver::PeakOfParameter& peak : trace.peaks) {
      double highest = 0.0;
      for (const auto& point : solver::trace_response(family(peak.parameter), range).points) {
        highest = std::max(highest, point.amplitude);
      }
      difference = std::max(difference, std::abs(peak.amplitude - highest) / highest);
    }
  }
  std::printf("%zu peaks, %d whole curves, largest difference %.1e\n", n_values, n_curves,
              difference);
  EXPECT_GT(static_cast<int>(n_values), 100 * n_families / 12);
  EXPECT_LE(difference, 1e-8);  // two solutions of one peak, at a kink perhaps
}

/// The three degrees of freedom of theory section 20.4 at a preload that jumps.
solver::ContinuationOptions three_dof_range() {
  solver::ContinuationOptions options;
  options.frequency_begin = 2.0 * M_PI * 18.0;
  options.frequency_end = 2.0 * M_PI * 28.0;
  return options;
}

TEST(ThreeDegreesOfFreedom, JumpAtThePreloadsPaperBNames) {
  for (const double preload : {25.0, 30.0, 50.0}) {
    const auto curve = solver::trace_response(tests::three_dof_scene(preload), three_dof_range());
    int folds = 0;
    int unstable = 0;
    for (const auto& point : curve.points) {
      folds += point.mark == solver::PointMark::fold ? 1 : 0;
      unstable += point.determinant_sign < 0.0 ? 1 : 0;
      if (point.determinant_sign < 0.0 && point.mark != solver::PointMark::fold) {
        EXPECT_EQ(point.stability, solver::Stability::unstable);
      }
    }
    EXPECT_TRUE(curve.complete) << preload;
    EXPECT_GE(folds, 2) << preload;
    EXPECT_GT(unstable, 0) << preload;
  }
}

TEST(ThreeDegreesOfFreedom, ForcesAndPreloadsTimesAPowerOfTwoScaleTheResponseBitByBit) {
  const auto one = solver::trace_response(tests::three_dof_scene(30.0), three_dof_range());
  const auto four = solver::trace_response(tests::three_dof_scene(120.0, 4.0), three_dof_range());
  ASSERT_EQ(one.points.size(), four.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    ASSERT_EQ(one.points[i].frequency, four.points[i].frequency);
    ASSERT_EQ(4.0 * one.points[i].q.vector(), four.points[i].q.vector());
  }
}

TEST(ThreeDegreesOfFreedom, AnyOtherFactorScalesTheResponseToRounding) {
  const double omega = 2.0 * M_PI * 20.5;  // away from folds at both loads
  const auto one =
      solver::solve_at_frequency(tests::three_dof_scene(100.0), omega, three_dof_range());
  const auto three =
      solver::solve_at_frequency(tests::three_dof_scene(300.0, 3.0), omega, three_dof_range());
  ASSERT_TRUE(one.complete && three.complete);
  const Eigen::VectorXd x = one.points.front().q.vector();
  EXPECT_LT((three.points.front().q.vector() - 3.0 * x).norm(), 1e-12 * 3.0 * x.norm());
}

TEST(ThreeDegreesOfFreedom, ShiftingTheForceInPhaseShiftsTheResponse) {
  const double omega = 2.0 * M_PI * 20.5;
  const double angle = 0.7;
  const auto one =
      solver::solve_at_frequency(tests::three_dof_scene(100.0), omega, three_dof_range());
  solver::Scene turned = tests::three_dof_scene(100.0);
  const Eigen::RowVectorXd force = turned.excitation.rows().row(1);
  turned.excitation.rows().row(1) = std::cos(angle) * force;
  turned.excitation.rows().row(2) = std::sin(angle) * force;  // F sin(θ + angle)
  const auto other = solver::solve_at_frequency(turned, omega, three_dof_range());
  ASSERT_TRUE(one.complete && other.complete);
  EXPECT_NEAR(other.points.front().amplitude, one.points.front().amplitude,
              1e-11 * one.points.front().amplitude);
  EXPECT_NEAR(
      std::remainder(other.points.front().phase - one.points.front().phase - angle, 2.0 * M_PI),
      0.0, 1e-10);
}

TEST(ThreeDegreesOfFreedom, MirroredMotionUnderConstantLoadMirrorsTheResponse) {
  tests::SinglePoint single;
  single.point = {5.0, 0.0, 0.3, 1.0};
  const auto one = solver::solve_at_frequency(tests::single_point_scene(single), 1.1, {});
  single.force = -single.force;
  const auto other = solver::solve_at_frequency(tests::single_point_scene(single), 1.1, {});
  ASSERT_TRUE(one.complete && other.complete);
  EXPECT_LT((one.points.front().q.vector() + other.points.front().q.vector()).norm(),
            1e-12 * one.points.front().q.vector().norm());
}

TEST(ThreeDegreesOfFreedom, ReversedSweepsFindTheSameBranch) {
  auto range = three_dof_range();
  const auto up = solver::trace_response(tests::three_dof_scene(30.0), range);
  std::swap(range.frequency_begin, range.frequency_end);
  const auto down = solver::trace_response(tests::three_dof_scene(30.0), range);
  const auto marked = [](const solver::ResponseCurve& curve) {
    std::multimap<double, double> list;
    for (const auto& point : curve.points) {
      if (point.mark != solver::PointMark::none) list.emplace(point.frequency, point.amplitude);
    }
    return list;
  };
  const auto a = marked(up);
  const auto b = marked(down);
  ASSERT_TRUE(up.complete && down.complete);
  ASSERT_EQ(a.size(), b.size());
  for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) {
    EXPECT_NEAR(i->first, j->first, 1e-8 * i->first);
    EXPECT_NEAR(i->second, j->second, 1e-5 * i->second);  // at a fold the branch is vertical
  }
}

TEST(LinearLimits, AreReachedExactly) {
  tests::SinglePoint single;
  single.damping_ratio = 0.02;
  single.point = {2.0, 0.0, 0.5, 1e9};  // never slips
  const auto stiffness = [&](double k, double omega) {
    return std::abs(single.force) / std::hypot(1.0 + k - omega * omega, 2.0 * 0.02 * omega);
  };
  for (const double omega : {0.3, 1.0, 1.7, 1.732, 2.5}) {
    const auto stuck = solver::solve_at_frequency(tests::single_point_scene(single), omega, {});
    ASSERT_TRUE(stuck.complete);
    EXPECT_NEAR(stuck.points.front().amplitude, stiffness(2.0, omega),
                1e-12 * stiffness(2.0, omega));
  }
  single.point.friction_coefficient = 0.0;
  for (const double omega : {0.3, 1.0, 1.7}) {
    const auto free = solver::solve_at_frequency(tests::single_point_scene(single), omega, {});
    EXPECT_NEAR(free.points.front().amplitude, stiffness(0.0, omega),
                1e-12 * stiffness(0.0, omega));
  }
}

}  // namespace
}  // namespace microslip::random_scenes
