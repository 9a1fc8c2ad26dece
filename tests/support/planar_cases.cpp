#include "support/planar_cases.hpp"

#include <cmath>
#include <numbers>

namespace microslip::test {
namespace {

using contact::Harmonics;

double gauss(std::mt19937_64& random) { return std::normal_distribution<double>()(random); }

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

int count(std::mt19937_64& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Coefficients that fall with the harmonic; means as large as the first.
Harmonics random_motion(std::mt19937_64& random, int n_harmonics) {
  Harmonics motion(n_harmonics, 3);
  for (Eigen::Index row = 0; row < motion.rows().rows(); ++row) {
    for (Eigen::Index signal = 0; signal < 3; ++signal) {
      motion.rows()(row, signal) = gauss(random) / (1.0 + static_cast<double>(row / 2));
    }
  }
  return motion;
}

/// Preload that keeps the point in contact, least load `share` of the greatest variation or more.
void close_contact(PlanarCase& c, double share) {
  const auto& rows = c.motion.rows();
  double variation = 0.0;
  for (int h = 1; h <= c.motion.n_harmonics(); ++h) {
    variation += std::hypot(rows(2 * h - 1, 1), rows(2 * h, 1));
  }
  const double k = c.point.normal_stiffness;
  c.point.rest_load = k * ((1.0 + share) * variation - rows(0, 1)) + 0.1 * k;
}

/// Tangential amplitudes and means in parts of μn₀/k at the mean load.
void scale_tangential(PlanarCase& c, double amplitude, double mean) {
  auto& rows = c.motion.rows();
  const double load = c.point.rest_load + c.point.normal_stiffness * rows(0, 1);
  const double limit = c.point.friction_coefficient * load;
  const Eigen::Vector2d k(c.point.tangential_stiffness, c.second_stiffness);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Index signal = 2 * i;
    rows.col(signal).tail(rows.rows() - 1) *= amplitude * limit / k[i];
    rows(0, signal) *= mean * limit / k[i];
  }
}

PlanarCase closed_planar(std::mt19937_64& random, double amplitude, double mean) {
  PlanarCase c = generic_planar(random);
  close_contact(c, uniform(random, 0.05, 2.0));
  scale_tangential(c, amplitude, mean);
  return c;
}

PlanarCase grazing_planar(std::mt19937_64& random) {
  PlanarCase c = closed_planar(random, std::exp(uniform(random, -1.0, 2.0)), 1.0);
  c.motion.rows().col(1).tail(c.motion.rows().rows() - 3).setZero();
  const auto& rows = c.motion.rows();
  const double side = count(random, 0, 1) == 0 ? -1.0 : 1.0;
  const double aside = side * std::pow(10.0, uniform(random, -9.0, -1.0));
  const double variation = std::hypot(rows(1, 1), rows(2, 1));
  c.point.rest_load = c.point.normal_stiffness * (variation * (1.0 + aside) - rows(0, 1));
  return c;
}

}  // namespace

PlanarCase generic_planar(std::mt19937_64& random) {
  PlanarCase c;
  c.motion = random_motion(random, count(random, 1, 3));
  c.point = {std::exp(gauss(random)), std::exp(gauss(random)), std::exp(0.7 * gauss(random) - 0.5),
             1.5 * gauss(random) + 0.7};
  const bool round = count(random, 0, 3) == 0;
  c.second_stiffness = round ? c.point.tangential_stiffness : std::exp(gauss(random));
  return c;
}

PlanarCase slipping_planar(std::mt19937_64& random) {
  return closed_planar(random, std::exp(uniform(random, -0.5, 3.0)), std::exp(gauss(random)));
}

PlanarCase dragged_planar(std::mt19937_64& random) {
  return closed_planar(random, std::exp(uniform(random, -4.0, -1.2)), 2.0);
}

PlanarCase creeping_planar(std::mt19937_64& random) {
  return closed_planar(random, std::exp(uniform(random, -1.6, -0.2)), 2.0);
}

PlanarCase onset_planar(std::mt19937_64& random) {
  PlanarCase c = generic_planar(random);
  c.motion = Harmonics(1, 3);
  c.point.normal_stiffness = 0.0;
  c.point.rest_load = 1.0;
  auto& rows = c.motion.rows();
  const double turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const double phase = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const double minor = count(random, 0, 1) == 0 ? 0.0 : uniform(random, 0.0, 1.0);
  const double side = count(random, 0, 1) == 0 ? -1.0 : 1.0;
  const double size = 1.0 + side * std::pow(10.0, uniform(random, -9.0, -1.0));
  const Eigen::Vector2d along(std::cos(turn), std::sin(turn));
  const Eigen::Vector2d across(-along[1], along[0]);
  // K x runs along an ellipse of half-axes `size` and `minor` times μn: it is stuck up to size 1.
  const Eigen::Vector2d sine = size * std::cos(phase) * along - minor * std::sin(phase) * across;
  const Eigen::Vector2d cosine = size * std::sin(phase) * along + minor * std::cos(phase) * across;
  for (Eigen::Index i = 0; i < 2; ++i) {
    rows(0, 2 * i) = gauss(random);
    rows(1, 2 * i) = sine[i];
    rows(2, 2 * i) = cosine[i];
  }
  scale_tangential(c, 1.0, 1.0);
  return c;
}

const std::vector<PlanarStratum>& planar_strata() {
  static const std::vector<PlanarStratum> strata{
      {"generic", generic_planar}, {"slipping", slipping_planar}, {"creeping", creeping_planar},
      {"dragged", dragged_planar}, {"onset", onset_planar},       {"grazing", grazing_planar}};
  return strata;
}

}  // namespace microslip::test
