// What is hard: patches that are large, not convex, or carry shapes that no polynomial follows
// (rows 16, 18 and 20). Met in: rings of bolts, L-shaped shrouds, edges of contact; fine meshes of
// whole blades. Right: memory in proportion, one point of the same area gives the same force; a fit
// errs by what it says, and says so where it is poor.

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact/force/patch_force.hpp"
#include "contact/patch/modal_contact_field.hpp"
#include "tests/support/asked_force.hpp"

namespace microslip::contact::contact_patch {
namespace {

double megabytes_used() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmHWM:") {
      double kilobytes = 0.0;
      status >> kilobytes;
      return kilobytes / 1e3;
    }
  }
  return 0.0;
}

PatchForce equal_points(Eigen::Index n) {
  const double share = 1.0 / static_cast<double>(n);
  const Eigen::RowVector3d u(0.8, -0.5, 0.3);
  const Eigen::RowVector3d v(0.1, 0.2, -0.3);
  std::vector<PointParameters> points(static_cast<std::size_t>(n), {1e4, 2e4, 0.3, 2.0});
  return {ContactPatch(Eigen::VectorXd::Constant(n, share), std::move(points)),
          ModalShapes{u.replicate(n, 1), v.replicate(n, 1), {}}};
}

TEST(ContactPatchHard, AMillionPointsAreThePointOfTheirArea) {  // row 16
  Harmonics motion(1, 3);
  motion.rows() << 1e-5, 0, 2e-5, 3e-4, -1e-4, 2e-4, 1e-4, 2e-4, 0;
  const ForceAndJacobian one = tests::evaluate(equal_points(1), motion, 100.0);
  const ForceAndJacobian many = tests::evaluate(equal_points(1'000'000), motion, 100.0);
  EXPECT_GT(one.force.vector().norm(), 0.0);
  // A sum of a million equal terms.
  EXPECT_LT((many.force.vector() - one.force.vector()).norm(), 1e-10 * one.force.vector().norm());
  EXPECT_LT((many.jacobian - one.jacobian).norm(), 1e-10 * one.jacobian.norm());
  EXPECT_LT(megabytes_used(), 1000.0);
}

struct Places {
  Eigen::VectorXd p, r;
};

/// Of a grid over the square of half side 1, those inside.
Places grid(int n, const std::function<bool(double, double)>& inside) {
  std::vector<double> p;
  std::vector<double> r;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double x = 2.0 * (i + 0.5) / n - 1.0;
      const double y = 2.0 * (k + 0.5) / n - 1.0;
      if (!inside(x, y)) continue;
      p.push_back(x);
      r.push_back(y);
    }
  }
  const auto size = static_cast<Eigen::Index>(p.size());
  return {Eigen::Map<Eigen::VectorXd>(p.data(), size), Eigen::Map<Eigen::VectorXd>(r.data(), size)};
}

bool in_ring(double x, double y) {
  const double radius = std::hypot(x, y);
  return radius > 0.6 && radius < 1.0;
}
bool in_l(double x, double y) { return x < -0.3 || y < -0.3; }

using Shape = std::function<double(double, double)>;

Eigen::MatrixXd values(const Places& at, const Shape& shape) {
  Eigen::MatrixXd result(at.p.size(), 1);
  for (Eigen::Index i = 0; i < at.p.size(); ++i) result(i, 0) = shape(at.p[i], at.r[i]);
  return result;
}

struct Fit {
  double told = 0.0;    ///< leave-one-out error, relative
  double actual = 0.0;  ///< at places between the samples, relative
};

Fit fit_of(const std::function<bool(double, double)>& inside, const Shape& shape) {
  const Places samples = grid(16, inside);
  const Places between = grid(37, inside);
  const ModalShapes given{values(samples, shape), values(samples, shape), {}};
  Eigen::MatrixX2d places(between.p.size(), 2);
  places << between.p, between.r;
  const ModalContactField field(samples.p, samples.r, Eigen::VectorXd::Ones(samples.p.size()),
                                given, std::nullopt, places);
  const Eigen::MatrixXd truth = values(between, shape);
  return {field.fit_error()[0], (field.at(between.p, between.r).u - truth).norm() / truth.norm()};
}

TEST(ContactPatchHard, FacesThatAreNotConvexAreFittedAsWellAsTold) {  // row 18
  const Shape smooth = [](double x, double y) { return std::cos(2.0 * x) * std::exp(0.7 * y); };
  for (const auto& inside : {in_ring, in_l}) {
    const Fit fit = fit_of(inside, smooth);
    EXPECT_LT(fit.told, 1e-4);
    EXPECT_LT(fit.actual, 3.0 * fit.told);
  }
}

TEST(ContactPatchHard, AShapeWithASteepEdgeIsToldToBeFittedPoorly) {  // row 20
  // Within one distance of samples. Leaving out one of a row along the edge shows less than lies
  // between the rows.
  const Shape edge = [](double x, double /*y*/) { return std::tanh(10.0 * (x - 0.7)); };
  for (const auto& inside : {in_ring, in_l}) {
    const Fit fit = fit_of(inside, edge);
    EXPECT_GT(fit.told, 0.02);
    EXPECT_LT(fit.actual, 4.0 * fit.told);
  }
}

}  // namespace
}  // namespace microslip::contact::contact_patch
