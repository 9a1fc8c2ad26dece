#include "contact/patch/preload_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Householder>
#include <Eigen/SVD>

#include "contact/numerics/plane_hull.hpp"

namespace microslip::contact {
namespace {

// (2) without units: forces by F_N, lengths in the plane by the radius of the area, around its
// mean.
struct Problem {
  const ContactArea& area;
  const CellSprings& springs;
  double force;
  Eigen::Vector2d middle;      // y, z [m]
  double radius;               // [m]
  Eigen::Matrix3Xd arms;       // (1, z', −y') of each cell
  Eigen::Vector3d load;        // (1, M_y', M_z') asked for
  Eigen::Matrix3d directions;  // tilts the cells can tell, then columns of zeros
};

// Imbalance and its derivative by (u₀, φ_y radius, φ_z radius) at the middle [1/m].
struct Balance {
  Eigen::Vector3d residual;
  Eigen::Matrix3d slope;
};

Balance balance(const Problem& problem, const Eigen::Vector3d& tilt) {
  Balance b{-problem.load, Eigen::Matrix3d::Zero()};
  const Eigen::VectorXd& weights = problem.area.cells().weights;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    const Eigen::Vector3d arm = problem.arms.col(i);
    const NormalResponse n = problem.springs(i, arm.dot(tilt));
    const double share = weights[i] / problem.force;
    b.residual += share * n.load * arm;
    b.slope += (share * n.stiffness) * arm * arm.transpose();
  }
  return b;
}

Eigen::Matrix2Xd loaded_centres(const PlanarCells& cells) {
  Eigen::Matrix2Xd centres(2, cells.weights.size());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < cells.weights.size(); ++i) {
    if (cells.weights[i] > 0.0) centres.col(n++) = Eigen::Vector2d(cells.y[i], cells.z[i]);
  }
  return centres.leftCols(n);
}

// In the order of scenes.
std::string described(const PreloadRequest& request) {
  std::ostringstream text;
  text.precision(6);
  text << "preload of " << request.force << " N with moments " << request.moment_z << " and "
       << request.moment_y << " N m about p and r";
  return text.str();
}

[[noreturn]] void refuse_pull(const PreloadRequest& request) {
  throw PreloadError(described(request) + ": a contact cannot pull");
}

// The resultant has to act inside the hull of the centres, not on its edge.
void require_inside(const PlaneHull& hull, const PreloadRequest& request) {
  const Eigen::Vector2d moment(-request.moment_z, request.moment_y);
  const Eigen::Vector2d at = moment / request.force;
  const double distance = hull.signed_distance(at);
  // What rounding of the centres and of the quotient can move it by.
  const double rounding = hull.corners().cols() < 3 ? 0.0
                                                    : 4.0 * std::numeric_limits<double>::epsilon() *
                                                          hull.corners().cwiseAbs().maxCoeff();
  if (distance < -rounding) return;
  const double smallest = 1.0 / hull.reach(moment);
  std::ostringstream message;
  message.precision(6);
  message << described(request) << " acts at p = " << at.y() << " m, r = " << at.x() << " m, "
          << std::max(distance, 0.0)
          << " m outside the hull of the contact points: no pressure balances it";
  if (std::isfinite(smallest)) message << "; these moments need more than " << smallest << " N";
  throw PreloadError(message.str());
}

[[noreturn]] void refuse_unbalanced(const PreloadRequest& request, double imbalance) {
  std::ostringstream message;
  message << "preload of " << request.force << " N: an imbalance of " << imbalance
          << " of it is left; the load of a cell must rise continuously and without bound, and the "
             "points that carry must not be lighter than the others by many orders";
  throw PreloadError(message.str());
}

// R of A = QR by Householder's reflections; Eigen's own class brings the code for blocks of large
// matrices along.
Eigen::Matrix3d triangle(Eigen::MatrixX3d A) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  Eigen::RowVector3d work;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index below = A.rows() - k;
    double factor = 0.0;
    A.col(k).tail(below).makeHouseholderInPlace(factor, R(k, k));
    A.bottomRightCorner(below, 2 - k)
        .applyHouseholderOnTheLeft(A.col(k).tail(below - 1), factor, work.data());
    R.row(k).tail(2 - k) = A.row(k).tail(2 - k);
  }
  return R;
}

// Tilts that move the cells by one in the mean square, and no other: flat areas are as well
// conditioned as square ones, and a tilt about a line on which all cells lie, which moves nothing,
// is no unknown.
Eigen::Matrix3d visible_directions(const Eigen::Matrix3Xd& arms, const Eigen::VectorXd& weights,
                                   Eigen::Index n_corners) {
  const Eigen::VectorXd loaded = (weights.array() > 0.0).cast<double>();
  // Of the arms, not of their squares: an area may be flatter than the root of rounding.
  Eigen::MatrixX3d tall = Eigen::MatrixX3d::Zero(std::max<Eigen::Index>(arms.cols(), 3), 3);
  tall.topRows(arms.cols()) = loaded.asDiagonal() * arms.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> axes(triangle(std::move(tall)), Eigen::ComputeFullV);
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(n_corners, 3); ++i) {
    directions.col(i) =
        (std::sqrt(loaded.sum()) / axes.singularValues()[i]) * axes.matrixV().col(i);
  }
  return directions;
}

Problem without_units(const ContactArea& area, const CellSprings& springs, const PlaneHull& hull,
                      const PreloadRequest& request) {
  const PlanarCells& cells = area.cells();
  const Eigen::Vector2d middle(cells.y.dot(cells.weights) / cells.weights.sum(),
                               cells.z.dot(cells.weights) / cells.weights.sum());
  const double radius = hull.radius() > 0.0 ? hull.radius() : 1.0;
  Eigen::Matrix3Xd arms(3, area.n_cells());
  arms.row(0).setOnes();
  arms.row(1) = (cells.z.transpose().array() - middle.y()) / radius;
  arms.row(2) = (middle.x() - cells.y.transpose().array()) / radius;
  const Eigen::Vector3d load(1.0, (request.moment_y / request.force - middle.y()) / radius,
                             (request.moment_z / request.force + middle.x()) / radius);
  const auto directions = visible_directions(arms, cells.weights, hull.corners().cols());
  return {area, springs, request.force, middle, radius, arms, load, directions};
}

// A common approach under which the cells carry between half and twice the force: from a micrometre
// in steps that square, then halved in logarithms, so that no unit of length costs many
// evaluations.
double common_approach(const Problem& problem) {
  const auto total = [&](double u) { return 1.0 + balance(problem, {u, 0.0, 0.0}).residual[0]; };
  const double sign = total(0.0) > 2.0 ? -1.0 : 1.0;  // heights may carry too much at approach 0
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  double size = 1e-6;
  double factor = 2.0;
  for (;;) {
    const double carried = total(sign * size);
    if (carried >= 0.5 && carried <= 2.0) return sign * size;
    ((carried > 2.0) == (sign > 0.0) ? high : low) = size;
    if (low > 0.0 && std::isfinite(high)) {
      size = high > 4.0 * low ? std::sqrt(low) * std::sqrt(high) : 0.5 * (low + high);
    } else {
      size = low > 0.0 ? size * factor : size / factor;
      factor *= factor;
    }
    if (!(size > low && size < high)) {
      throw std::invalid_argument("preload equilibrium: the cells do not reach the force");
    }
  }
}

// Along a direction of descent the slope of the potential, residual · direction, rises from below 0
// through 0. Takes the whole step if that leaves less than half of it, else looks for such a place.
double step_length(const Problem& problem, const Eigen::Vector3d& tilt,
                   const Eigen::Vector3d& direction, double slope_at_0) {
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  double step = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double slope = balance(problem, tilt + step * direction).residual.dot(direction);
    if (std::abs(slope) <= 0.5 * std::abs(slope_at_0)) break;
    (slope < 0.0 ? low : high) = step;
    step = std::isinf(high) ? 4.0 * step : 0.5 * (low + high);
  }
  return step;
}

// Newton on the potential, with a multiple of the unit matrix that vanishes with the imbalance:
// while few cells are loaded they may not resist every tilt, and none resists those it cannot tell.
Eigen::Vector3d solve(const Problem& problem) {
  const auto& Q = problem.directions;
  Eigen::Vector3d tilt(common_approach(problem), 0.0, 0.0);
  Eigen::Vector3d best = tilt;
  double smallest = std::numeric_limits<double>::infinity();
  int stalled = 0;
  for (int i = 0; i < 200 && stalled < 3; ++i) {
    const Balance now = balance(problem, tilt);
    const Eigen::Vector3d residual = Q.transpose() * now.residual;
    const double size = residual.norm();
    // Rounding turns the last steps round: stop when three in a row bring nothing.
    stalled = size < smallest || size > 1e-10 ? 0 : stalled + 1;
    if (size < smallest) {
      smallest = size;
      best = tilt;
    }
    if (size == 0.0) break;
    Eigen::Matrix3d slope = Q.transpose() * now.slope * Q;
    const double unit = slope.trace() > 0.0 ? slope.trace() : 1.0;
    slope.diagonal().array() += 1e-4 * std::min(size, 1.0) * unit;
    const Eigen::Vector3d direction = -(Q * slope.ldlt().solve(residual));
    // Below 1e-12 the slope along the direction is that of rounding.
    const double step =
        size < 1e-12 ? 1.0 : step_length(problem, tilt, direction, now.residual.dot(direction));
    tilt += step * direction;
  }
  return best;
}

PreloadEquilibrium with_units(const Problem& problem, const Eigen::Vector3d& tilt) {
  PreloadEquilibrium result;
  const Eigen::Index n = problem.area.n_cells();
  result.rotation_y = tilt[1] / problem.radius;
  result.rotation_z = tilt[2] / problem.radius;
  result.approach =
      tilt[0] - problem.middle.y() * result.rotation_y + problem.middle.x() * result.rotation_z;
  result.approaches = problem.arms.transpose() * tilt;
  result.pressures.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    result.pressures[i] = problem.springs(i, result.approaches[i]).load;
    if (result.pressures[i] > 0.0) ++result.n_loaded;
  }
  const Eigen::Vector3d left = balance(problem, tilt).residual;
  result.imbalance = std::max(left.cwiseAbs().maxCoeff(),
                              (problem.directions.transpose() * left).cwiseAbs().maxCoeff());
  return result;
}

}  // namespace

CellSprings one_sided_springs(Eigen::VectorXd stiffness) {
  return [stiffness = std::move(stiffness)](Eigen::Index cell, double approach) {
    return approach > 0.0 ? NormalResponse{stiffness[cell] * approach, stiffness[cell]}
                          : NormalResponse{};
  };
}

PreloadEquilibrium preload_equilibrium(const ContactArea& area, const CellSprings& springs,
                                       const PreloadRequest& request) {
  if (!std::isfinite(request.force) || !std::isfinite(request.moment_y) ||
      !std::isfinite(request.moment_z)) {
    throw std::invalid_argument("preload equilibrium: force and moments must be finite");
  }
  const bool moments = request.moment_y != 0.0 || request.moment_z != 0.0;
  if (request.force < 0.0 || (request.force == 0.0 && moments)) refuse_pull(request);
  if (request.force == 0.0) {
    PreloadEquilibrium nothing;
    nothing.pressures = nothing.approaches = Eigen::VectorXd::Zero(area.n_cells());
    return nothing;
  }
  const PlaneHull hull(loaded_centres(area.cells()));
  require_inside(hull, request);
  const Problem problem = without_units(area, springs, hull, request);
  PreloadEquilibrium result = with_units(problem, solve(problem));
  if (!(result.imbalance <= 1e-9)) refuse_unbalanced(request, result.imbalance);
  return result;
}

}  // namespace microslip::contact
