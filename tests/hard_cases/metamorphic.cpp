// What is hard: nobody knows the right curve of a scene with friction, gaps and jumps; but what
// must not matter is known exactly. Relations between whole curves (numbered as in
// share/doc/hard_cases.md): units M1, order of modes and points M3, signs of modes M4, basis of a
// repeated pair M5, a point split in two M6, phase of the force M7, direction of the sweep M8, size
// M9, friction coefficient against load M10, limits of the preload M11, mirror M12, a mode that
// nothing moves M13, area against stiffness M15, work at the peaks M16.
// Met in: a foreign implementation of these relations, which lost side peaks in three scenes of 95.
// Right: the same peaks and folds, and the same solutions at fixed frequencies, however many there
// are.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::metamorphic {
namespace {

using solver::PointMark;
using solver::ResponseCurve;

constexpr double pi = std::numbers::pi;
// Two walks end their iterations at different residuals of at most 1e-11; next to a fold or
// resonance of damping 1e-3 the solution moves a thousand times as much.
constexpr double tolerance = 1e-7;

/// A scene as plain numbers.
struct Numbers {
  std::string name;
  Eigen::VectorXd frequency, damping, output;
  Eigen::MatrixXd excitation;  ///< 3 × n_modes
  Eigen::VectorXd weights;
  std::vector<contact::PointParameters> points;
  Eigen::MatrixXd u, v;  ///< n_points × n_modes
  double begin = 0.0, end = 0.0;

  [[nodiscard]] Eigen::Index n_modes() const { return frequency.size(); }
};

Numbers numbers_of(std::string name, const solver::Scene& scene, double begin, double end) {
  const auto& force = dynamic_cast<const tests::ReadablePatch&>(*scene.contact);
  return {std::move(name),
          scene.natural_frequency,
          scene.damping_ratio,
          scene.output,
          scene.excitation.rows(),
          force.patch().weights(),
          force.patch().points(),
          force.shapes().u,
          force.shapes().v,
          begin,
          end};
}

solver::Scene scene_of(const Numbers& numbers) {
  solver::Scene scene;
  scene.natural_frequency = numbers.frequency;
  scene.damping_ratio = numbers.damping;
  scene.output = numbers.output;
  scene.excitation = contact::Harmonics(1, numbers.n_modes());
  scene.excitation.rows() = numbers.excitation;
  scene.contact =
      std::make_unique<tests::ReadablePatch>(contact::ContactPatch(numbers.weights, numbers.points),
                                             contact::ModalShapes{numbers.u, numbers.v, {}});
  return scene;
}

/// Scenes of every kind: jumps, gaps, many points, normal motion or none.
std::vector<Numbers> scenes() {
  std::vector<Numbers> list;
  list.push_back(
      numbers_of("three_dof", tests::three_dof_scene(30.0), 2.0 * pi * 18.0, 2.0 * pi * 28.0));
  list.push_back(numbers_of("chain", tests::chain_scene(30.0), 2.0 * pi * 15.0, 2.0 * pi * 60.0));
  for (const double preload : {20.0, 200.0, -50.0}) {
    list.push_back(numbers_of("patch " + std::to_string(preload),
                              tests::patch_scene({4, 8}, preload), 2.0 * pi * 250.0,
                              2.0 * pi * 400.0));
  }
  for (const std::uint64_t seed : {1U, 4U, 7U, 12U}) {
    const tests::RandomScene random = tests::random_scene(seed);
    list.push_back(numbers_of("random " + std::to_string(seed), random.scene,
                              random.options.frequency_begin, random.options.frequency_end));
  }
  return list;
}

/// What a curve is, whatever steps it was walked in.
struct Shape {
  std::vector<std::pair<double, double>> peaks, folds;  ///< frequency, amplitude; by frequency
  std::vector<std::vector<double>> amplitudes;  ///< of all solutions at fixed frequencies, sorted
  double largest = 0.0;
};

std::vector<std::pair<double, double>> places(const ResponseCurve& curve, PointMark mark) {
  std::vector<std::pair<double, double>> list;
  for (const auto& point : tests::marked(curve, mark)) {
    list.emplace_back(point.frequency, point.amplitude);
  }
  std::ranges::sort(list);
  return list;
}

Shape shape_of(const Numbers& numbers) {
  const solver::Scene scene = scene_of(numbers);
  const auto options = tests::frequency_range(numbers.begin, numbers.end);
  const ResponseCurve curve = solver::trace_response(scene, options);
  EXPECT_TRUE(curve.complete) << numbers.name << ": " << curve.message;
  Shape shape{places(curve, PointMark::peak), places(curve, PointMark::fold), {}, 0.0};
  EXPECT_EQ(shape.folds.size() % 2, 0U) << numbers.name;  // from end to end
  for (const auto& point : curve.points) shape.largest = std::max(shape.largest, point.amplitude);
  const double low = std::min(numbers.begin, numbers.end);
  const double width = std::abs(numbers.end - numbers.begin);
  for (const double share : {0.13, 0.31, 0.47, 0.59, 0.83}) {
    std::vector<double> found;
    for (const auto& point :
         solver::points_at_frequency(scene, curve, low + share * width, options)) {
      found.push_back(point.amplitude);
    }
    std::ranges::sort(found);
    shape.amplitudes.push_back(std::move(found));
  }
  return shape;
}

/// What a relation does to frequencies and amplitudes.
struct Factors {
  double frequency = 1.0;
  double amplitude = 1.0;
  double tolerance = metamorphic::tolerance;  ///< relative
};

void expect_places(const std::vector<std::pair<double, double>>& now,
                   const std::vector<std::pair<double, double>>& before, const Factors& factors,
                   double scale) {
  ASSERT_EQ(now.size(), before.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_NEAR(now[i].first / factors.frequency, before[i].first,
                factors.tolerance * before[i].first);
    EXPECT_NEAR(now[i].second / factors.amplitude, before[i].second, factors.tolerance * scale);
  }
}

void expect_same(const Shape& now, const Shape& before, const Factors& factors = {}) {
  {
    SCOPED_TRACE("peaks");
    expect_places(now.peaks, before.peaks, factors, before.largest);
  }
  {
    SCOPED_TRACE("folds");
    expect_places(now.folds, before.folds, factors, before.largest);
  }
  for (std::size_t i = 0; i < before.amplitudes.size(); ++i) {
    ASSERT_EQ(now.amplitudes[i].size(), before.amplitudes[i].size()) << "solutions at " << i;
    for (std::size_t k = 0; k < before.amplitudes[i].size(); ++k) {
      EXPECT_NEAR(now.amplitudes[i][k] / factors.amplitude, before.amplitudes[i][k],
                  factors.tolerance * before.largest);
    }
  }
}

/// The scenes and their shapes, walked once for all relations.
const std::vector<std::pair<Numbers, Shape>>& walked() {
  static const auto list = [] {
    std::vector<std::pair<Numbers, Shape>> made;
    for (Numbers& numbers : scenes()) {
      Shape shape = shape_of(numbers);
      made.emplace_back(std::move(numbers), std::move(shape));
    }
    return made;
  }();
  return list;
}

void expect_relation(const std::function<void(Numbers&)>& change, const Factors& factors = {}) {
  for (const auto& [numbers, shape] : walked()) {
    SCOPED_TRACE(numbers.name);
    Numbers changed = numbers;
    change(changed);
    expect_same(shape_of(changed), shape, factors);
  }
}

/// Without normal motion: the load is constant.
void hold_the_load(Numbers& numbers) {
  for (contact::PointParameters& point : numbers.points) {
    point.normal_stiffness = 0.0;
    point.rest_load = std::abs(point.rest_load);
  }
  numbers.v.setZero();
}

/// M1, of theory 0: 1 kg, 1 m, 1 s become so many others.
void expect_no_units(double mass, double length, double time, double within) {
  const auto change = [&](Numbers& n) {
    const double root = std::sqrt(mass);
    n.frequency /= time;
    n.begin /= time;
    n.end /= time;
    n.output /= root;
    n.excitation *= root * length / (time * time);
    n.u /= root;
    n.v /= root;
    for (contact::PointParameters& point : n.points) {
      point.tangential_stiffness *= mass / (time * time);
      point.normal_stiffness *= mass / (time * time);
      point.rest_load *= mass * length / (time * time);
    }
  };
  expect_relation(change, {1.0 / time, length, within});
}

TEST(Metamorphic, UnitsDoNotMatter) { expect_no_units(1e-3, 1e3, 7.0, tolerance); }

// Powers of two, the mass one of four, nearly tonnes and millimetres: whatever is rounded, is so
// in these units too, and a tolerance that is a length, a force or a time is all that could differ.
TEST(Metamorphic, UnitsThatLeaveRoundingAloneDoNotMatterAtAll) {
  expect_no_units(0x1p-10, 0x1p+10, 0x1p+3, 1e-12);
}

TEST(Metamorphic, TheOrderOfModesAndPointsDoesNotMatter) {  // M3
  expect_relation([](Numbers& n) {
    n.frequency.reverseInPlace();
    n.damping.reverseInPlace();
    n.output.reverseInPlace();
    n.weights.reverseInPlace();
    n.excitation = n.excitation.rowwise().reverse().eval();
    n.u = n.u.reverse().eval();
    n.v = n.v.reverse().eval();
    std::ranges::reverse(n.points);
  });
}

TEST(Metamorphic, TheSignOfAModeDoesNotMatter) {  // M4
  expect_relation([](Numbers& n) {
    for (Eigen::Index mode = 0; mode < n.n_modes(); mode += 2) {
      n.output[mode] *= -1.0;
      n.excitation.col(mode) *= -1.0;
      n.u.col(mode) *= -1.0;
      n.v.col(mode) *= -1.0;
    }
  });
}

TEST(Metamorphic, TheBasisOfARepeatedPairDoesNotMatter) {  // M5, case 26
  for (const double apart : {0.0, 1e-12, 1e-6}) {
    SCOPED_TRACE(apart);
    Numbers pair =
        numbers_of("pair", tests::patch_scene({4, 8}, 200.0), 2.0 * pi * 250.0, 2.0 * pi * 400.0);
    pair.frequency[1] = pair.frequency[0] * (1.0 + apart);
    Numbers turned = pair;
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    turned.output.head(2) = turn.transpose() * pair.output.head(2);
    turned.excitation.leftCols(2) = pair.excitation.leftCols(2) * turn;
    turned.u.leftCols(2) = pair.u.leftCols(2) * turn;
    turned.v.leftCols(2) = pair.v.leftCols(2) * turn;
    const Shape before = shape_of(pair);
    const Shape now = shape_of(turned);
    if (apart < 1e-10) {
      expect_same(now, before);
    } else {  // the turned one is another scene, by so much over the damping ratio
      ASSERT_EQ(now.peaks.size(), before.peaks.size());
      for (std::size_t i = 0; i < now.peaks.size(); ++i) {
        EXPECT_NEAR(now.peaks[i].second, before.peaks[i].second,
                    10.0 * apart / pair.damping[0] * before.largest);
      }
    }
  }
}

TEST(Metamorphic, APointMayBeSplitInTwo) {  // M6
  expect_relation([](Numbers& n) {
    const Eigen::Index size = n.weights.size();
    n.weights.conservativeResize(size + 1);
    n.weights[size] = 0.3 * n.weights[0];
    n.weights[0] *= 0.7;
    n.points.push_back(n.points.front());
    n.u.conservativeResize(size + 1, Eigen::NoChange);
    n.v.conservativeResize(size + 1, Eigen::NoChange);
    n.u.row(size) = n.u.row(0);
    n.v.row(size) = n.v.row(0);
  });
}

TEST(Metamorphic, ThePhaseOfTheForceDoesNotMatter) {  // M7
  expect_relation([](Numbers& n) {
    const Eigen::RowVectorXd sine = n.excitation.row(1);
    const Eigen::RowVectorXd cosine = n.excitation.row(2);
    n.excitation.row(1) = std::cos(0.9) * sine - std::sin(0.9) * cosine;
    n.excitation.row(2) = std::sin(0.9) * sine + std::cos(0.9) * cosine;
  });
}

TEST(Metamorphic, SweepsUpAndDownMeetTheSameBranch) {  // M8
  expect_relation([](Numbers& n) { std::swap(n.begin, n.end); });
}

TEST(Metamorphic, ForcesAndLoadsTogetherScaleTheResponse) {  // M9
  for (const double factor : {1e-10, 1e-5, 1e8}) {  // case 14: amplitudes from 1e-15 m to 1e3 m
    SCOPED_TRACE(factor);
    const auto change = [&](Numbers& n) {
      n.excitation *= factor;
      for (contact::PointParameters& point : n.points) point.rest_load *= factor;
    };
    expect_relation(change, {1.0, factor});
  }
}

TEST(Metamorphic, FrictionCoefficientAndLoadActAsTheirProduct) {  // M10, constant load
  for (const auto& [numbers, shape] : walked()) {
    SCOPED_TRACE(numbers.name);
    Numbers held = numbers;
    hold_the_load(held);
    Numbers changed = held;
    for (contact::PointParameters& point : changed.points) {
      point.friction_coefficient *= 3.0;
      point.rest_load /= 3.0;
    }
    expect_same(shape_of(changed), shape_of(held));
  }
}

TEST(Metamorphic, ALargeLoadSticksAndALargeGapIsFree) {  // M11
  for (const auto& [numbers, shape] : walked()) {
    SCOPED_TRACE(numbers.name);
    const auto options = tests::frequency_range(numbers.begin, numbers.end);
    const bool moves = numbers.v.norm() > 0.0;
    for (const double load : {1e12, -1e12}) {
      if (load < 0.0 && !moves) continue;  // a gap needs normal stiffness
      Numbers limit = numbers;
      limit.excitation.row(0).setZero();
      for (contact::PointParameters& point : limit.points) point.rest_load = load;
      const auto kind = load > 0.0 ? solver::LinearLimit::stuck : solver::LinearLimit::free;
      const auto linear =
          places(solver::trace_linear(scene_of(limit), kind, options), PointMark::peak);
      expect_places(shape_of(limit).peaks, linear, {}, shape.largest);
    }
  }
}

TEST(Metamorphic, AMirroredSlipDirectionIsTheSameContact) {  // M12, constant load
  for (const auto& [numbers, shape] : walked()) {
    SCOPED_TRACE(numbers.name);
    Numbers held = numbers;
    hold_the_load(held);
    Numbers mirrored = held;
    mirrored.u *= -1.0;
    expect_same(shape_of(mirrored), shape_of(held));
  }
}

TEST(Metamorphic, AModeThatNothingMovesChangesNothing) {  // M13
  expect_relation([](Numbers& n) {
    const Eigen::Index size = n.n_modes();
    const double within = 0.5 * (n.begin + n.end);
    n.frequency.conservativeResize(size + 1);
    n.damping.conservativeResize(size + 1);
    n.output.conservativeResize(size + 1);
    n.frequency[size] = within;
    n.damping[size] = n.damping[0];
    n.output[size] = 1.0;
    for (Eigen::MatrixXd* matrix : {&n.excitation, &n.u, &n.v}) {
      matrix->conservativeResize(Eigen::NoChange, size + 1);
      matrix->col(size).setZero();
    }
  });
}

TEST(Metamorphic, TwiceTheAreaWithHalfOfEverythingOnIt) {  // M15
  expect_relation([](Numbers& n) {
    n.weights *= 2.0;
    for (contact::PointParameters& point : n.points) {
      point.tangential_stiffness /= 2.0;
      point.normal_stiffness /= 2.0;
      point.rest_load /= 2.0;
    }
  });
}

TEST(Metamorphic, WithoutDampingFrictionDoesAllTheWork) {  // M16
  // Friction bounds the peak where its limit is above π/4 of the force: μ n₀ = 1.
  for (const double normal_share : {0.0, 0.2}) {
    tests::SinglePoint single;
    single.damping_ratio = 0.0;
    single.phi_v = normal_share;
    single.point = {5.0, 5.0, 0.5, 4.0};
    const ResponseCurve curve =
        solver::trace_response(tests::single_point_scene(single), tests::frequency_range(0.5, 2.2));
    ASSERT_TRUE(curve.complete) << curve.message;
    for (const auto& point : curve.points) {
      const double brought = -pi * single.force * point.q.rows()(2, 0);  // ∮ F sin θ dy
      EXPECT_NEAR(point.report.slip_work, brought, 1e-9 * pi * single.force * point.amplitude);
    }
  }
}

}  // namespace
}  // namespace microslip::metamorphic
