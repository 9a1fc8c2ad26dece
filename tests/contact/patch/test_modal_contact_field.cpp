#include "contact/patch/modal_contact_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace microslip::contact::test_modal_contact_field {
namespace {

struct Samples {
  Eigen::VectorXd p;
  Eigen::VectorXd r;
  Eigen::VectorXd weights;
};

Samples scattered(Eigen::Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Samples s{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    s.p[i] = 0.01 + 0.03 * u(random);  // a patch in metres, away from the origin
    s.r[i] = -0.5 + 0.01 * u(random);
    s.weights[i] = 1e-6 * (0.2 + u(random));
  }
  return s;
}

// A polynomial of degree 3 and something smooth, as two modes.
ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  const Eigen::ArrayXd x = (p.array() - 0.02) / 0.02;
  const Eigen::ArrayXd y = (r.array() + 0.495) / 0.005;
  ModalShapes s{Eigen::MatrixXd(p.size(), 2), Eigen::MatrixXd(p.size(), 2),
                Eigen::MatrixXd(p.size(), 2)};
  s.u.col(0) = 1.0 + x - 2.0 * x * y + x * x * y;
  s.v.col(0) = y * y * y - 0.5;
  s.w.col(0) = x * x - y;
  s.u.col(1) = (x + 0.4 * y).sin();
  s.v.col(1) = (0.8 * x).cos();
  s.w.col(1) = (x - y).exp();
  return s;
}

ModalShapes first_mode(const ModalShapes& s) {
  return {s.u.leftCols(1), s.v.leftCols(1), s.w.leftCols(1)};
}

// Nodes of a strip of quadratic elements, one element wide: three lines, which a turned slip
// direction crosses askew. Between them a polynomial of high degree is free.
TEST(ModalContactField, StaysWithTheModesBetweenTheNodesOfATurnedStrip) {
  const auto turned = [](Eigen::Index along, Eigen::Index across, double degrees) {
    const double angle = degrees * M_PI / 180.0;
    Eigen::MatrixX2d places(along * across, 2);
    for (Eigen::Index i = 0; i < places.rows(); ++i) {
      const double x = 0.03 * static_cast<double>(i % along) / static_cast<double>(along - 1);
      const double y = 0.006 * static_cast<double>(i / along) / static_cast<double>(across - 1);
      places.row(i) << std::cos(angle) * x - std::sin(angle) * y,
          std::sin(angle) * x + std::cos(angle) * y;
    }
    return places;
  };
  const auto shapes = [](const Eigen::MatrixX2d& at, double degrees) {
    const double angle = -degrees * M_PI / 180.0;
    const Eigen::ArrayXd x =
        std::cos(angle) * at.col(0).array() - std::sin(angle) * at.col(1).array();
    const Eigen::ArrayXd y =
        std::sin(angle) * at.col(0).array() + std::cos(angle) * at.col(1).array();
    ModalShapes s{Eigen::MatrixXd(at.rows(), 1), Eigen::MatrixXd(at.rows(), 1), {}};
    s.u.col(0) = (60.0 * x).sin() + 20.0 * y;
    s.v.col(0) = (40.0 * x).cos() * (1.0 + 30.0 * y);
    return s;
  };
  for (const double degrees : {0.0, 1e-6, 1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 30.0, 45.0, -5.0, 90.0}) {
    const Eigen::MatrixX2d nodes = turned(31, 3, degrees);
    const Eigen::MatrixX2d dense = turned(101, 21, degrees);
    const ModalContactField field(nodes.col(0), nodes.col(1), Eigen::VectorXd::Ones(nodes.rows()),
                                  shapes(nodes, degrees), {}, dense);
    const ModalShapes expected = shapes(dense, degrees);
    const ModalShapes ours = field.at(dense.col(0), dense.col(1));
    const double error = (ours.u - expected.u).norm() / expected.u.norm() +
                         (ours.v - expected.v).norm() / expected.v.norm();
    // 1e-8 where the lines are axes; else terms are missing that only the lines tell from others.
    EXPECT_LE(error, degrees == 0.0 || degrees == 90.0 ? 1e-6 : 1e-3)
        << degrees << " degrees, degree " << field.degree();
  }
}

TEST(ModalContactField, PolynomialsAreReproducedAndTheirDegreeIsFound) {
  const Samples s = scattered(200, 1);
  const ModalContactField field(s.p, s.r, s.weights, first_mode(shapes_at(s.p, s.r)), {});
  EXPECT_EQ(field.degree(), 3);
  EXPECT_LE(field.fit_error()[0], 1e-13);  // 200 samples, ten terms: rounding of least squares
  const Samples t = scattered(50, 2);
  const ModalShapes expected = first_mode(shapes_at(t.p, t.r));
  const ModalShapes ours = field.at(t.p, t.r);
  EXPECT_LE((ours.u - expected.u).cwiseAbs().maxCoeff(), 1e-12);  // the same, outside the samples
  EXPECT_LE((ours.v - expected.v).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((ours.w - expected.w).cwiseAbs().maxCoeff(), 1e-12);
}

// Row 20. Hard: a steep gradient in a mode shape, which no polynomial follows.
// Met in: the edge of a contact.
// Right: the error that is told is that of fits without the sample.
TEST(ModalContactField, LeaveOneOutErrorIsThatOfFitsWithoutTheSample) {
  const Samples s = scattered(12, 3);
  const ModalShapes shapes = shapes_at(s.p, s.r);
  const ModalContactField field(s.p, s.r, s.weights, shapes, 1);
  // Refitting with one weight at zero is leaving that sample out; scales stay those of all samples.
  double squares = 0.0;
  double size = 0.0;
  for (Eigen::Index i = 0; i < 12; ++i) {
    Eigen::VectorXd weights = s.weights;
    weights[i] = 0.0;
    const ModalShapes at =
        ModalContactField(s.p, s.r, weights, shapes, 1).at(s.p.segment(i, 1), s.r.segment(i, 1));
    squares += s.weights[i] * (std::pow(at.u(0, 1) - shapes.u(i, 1), 2) +
                               std::pow(at.v(0, 1) - shapes.v(i, 1), 2) +
                               std::pow(at.w(0, 1) - shapes.w(i, 1), 2));
    size += s.weights[i] * (std::pow(shapes.u(i, 1), 2) + std::pow(shapes.v(i, 1), 2) +
                            std::pow(shapes.w(i, 1), 2));
  }
  EXPECT_NEAR(field.fit_error()[1], std::sqrt(squares / size), 1e-12);  // well-conditioned 12 × 3
}

TEST(ModalContactField, ErrorFallsWithTheDegreeForSmoothShapes) {
  const Samples s = scattered(400, 4);
  const ModalShapes shapes = shapes_at(s.p, s.r);
  const double two = ModalContactField(s.p, s.r, s.weights, shapes, 2).fit_error()[1];
  const double four = ModalContactField(s.p, s.r, s.weights, shapes, 4).fit_error()[1];
  const double eight = ModalContactField(s.p, s.r, s.weights, shapes, 8).fit_error()[1];
  EXPECT_LT(four, 0.1 * two);
  EXPECT_LT(eight, 0.01 * four);
}

TEST(ModalContactField, NoiseIsNotFitted) {
  const Samples s = scattered(60, 5);
  ModalShapes shapes = first_mode(shapes_at(s.p, s.r));
  std::mt19937_64 random(6);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (Eigen::Index i = 0; i < 60; ++i) {
    shapes.u(i, 0) += noise(random);
    shapes.v(i, 0) += noise(random);
    shapes.w(i, 0) += noise(random);
  }
  const ModalContactField field(s.p, s.r, s.weights, shapes, {});
  EXPECT_GE(field.degree(), 2);
  EXPECT_LE(field.degree(), 4);
}

TEST(ModalContactField, SamplesOnALineCarryAFieldAlongIt) {
  Samples s = scattered(30, 7);
  s.r.setConstant(-0.497);
  ModalShapes shapes{Eigen::MatrixXd(30, 1), Eigen::MatrixXd(30, 1), {}};
  shapes.u.col(0) = s.p.array().square() * 1e3;
  shapes.v.col(0) = s.p.array() * 10.0;
  for (const std::optional<int> degree : {std::optional<int>(), std::optional<int>(5)}) {
    const ModalContactField field(s.p, s.r, s.weights, shapes, degree);
    const ModalShapes ours = field.at(s.p, s.r);
    EXPECT_LE((ours.u - shapes.u).cwiseAbs().maxCoeff(), 1e-12);  // rounding of least squares
    EXPECT_LE((ours.v - shapes.v).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(ours.w.size(), 0);
  }
}

// Row 15. Hard: a patch of one sample of a mode shape: nothing to fit by.
// Met in: faces of one element.
// Right: a constant field with the value of the sample.
TEST(ModalContactField, OneSampleGivesAConstant) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  const ModalShapes shapes{Eigen::MatrixXd::Constant(1, 2, 3.0), Eigen::MatrixXd::Zero(1, 2), {}};
  for (const std::optional<int> degree : {std::optional<int>(), std::optional<int>(4)}) {
    const ModalContactField field(one, one, one, shapes, degree);
    EXPECT_EQ(field.degree(), 0);
    EXPECT_NEAR(field.at(2.0 * one, one).u(0, 1), 3.0, 1e-15);
    EXPECT_TRUE(field.fit_error().allFinite());
  }
}

// Row 24. Hard: a degree that asks for more coefficients than there are samples.
// Met in: fine fits on coarse meshes.
// Right: the degree is lowered until the samples carry it, never a singular fit.
TEST(ModalContactField, DegreeTheSamplesCannotCarryIsLowered) {
  const Samples s = scattered(7, 8);
  const ModalContactField field(s.p, s.r, s.weights, shapes_at(s.p, s.r), 12);
  EXPECT_LE(field.degree(), 3);
  EXPECT_TRUE(field.at(s.p, s.r).u.allFinite());
}

TEST(ModalContactField, RefusesWhatDoesNotFit) {
  const Samples s = scattered(5, 9);
  const ModalShapes shapes = shapes_at(s.p, s.r);
  EXPECT_THROW(ModalContactField(s.p, s.r.head(4), s.weights, shapes, {}), std::invalid_argument);
  EXPECT_THROW(ModalContactField(s.p, s.r, -s.weights, shapes, {}), std::invalid_argument);
  EXPECT_THROW(ModalContactField(s.p, s.r, 0.0 * s.weights, shapes, {}), std::invalid_argument);
  EXPECT_THROW(ModalContactField(s.p, s.r, s.weights, shapes, 13), std::invalid_argument);
  EXPECT_THROW(ModalContactField(s.p, s.r, s.weights, shapes, -1), std::invalid_argument);
  ModalShapes broken = shapes;
  broken.w(2, 1) = std::nan("");
  EXPECT_THROW(ModalContactField(s.p, s.r, s.weights, broken, {}), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact::test_modal_contact_field
