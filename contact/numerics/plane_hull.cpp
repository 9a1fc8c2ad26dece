#include "contact/numerics/plane_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace microslip::contact {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Adds the points to a chain that turns left by more than rounding at every point but its first,
// `start`.
void extend(Points& chain, std::size_t start, const Eigen::Vector2d& point, double smallest_bulge) {
  while (chain.size() > start + 1) {
    const Eigen::Vector2d from = chain[chain.size() - 2];
    const Eigen::Vector2d along = point - from;
    if (cross(chain.back() - from, along) > smallest_bulge * along.norm()) break;
    chain.pop_back();
  }
  chain.push_back(point);
}

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

}  // namespace

PlaneHull::PlaneHull(const Eigen::Ref<const Eigen::Matrix2Xd>& points) {
  Points sorted;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    sorted.emplace_back(points.col(i));
  }
  std::ranges::sort(sorted, [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const double extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).cwiseAbs().maxCoeff();
  Points chain;
  for (const Eigen::Vector2d& point : sorted) {  // lower side, left to right
    extend(chain, 0, point, 1e-13 * extent);
  }
  const std::size_t turn = chain.size() - 1;
  for (auto point = sorted.rbegin() + 1; point < sorted.rend(); ++point) {  // and back
    extend(chain, turn, *point, 1e-13 * extent);
  }
  if (chain.size() > 1) chain.pop_back();  // the first once more
  corners_.resize(2, static_cast<Eigen::Index>(chain.size()));
  for (std::size_t i = 0; i < chain.size(); ++i) {
    corners_.col(static_cast<Eigen::Index>(i)) = chain[i];
  }
  radius_ = (corners_.colwise() - corners_.rowwise().mean()).colwise().norm().maxCoeff();
}

Eigen::Vector2d PlaneHull::corner_after(Eigen::Index i) const {
  return corners_.col((i + 1) % corners_.cols());
}

Eigen::Vector2d PlaneHull::normal(Eigen::Index i) const {
  const Eigen::Vector2d along = (corner_after(i) - corners_.col(i)).normalized();
  return {along.y(), -along.x()};
}

double PlaneHull::distance_of_line(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d a = corners_.col(0);
  const Eigen::Vector2d b = corners_.col(corners_.cols() - 1);
  const double away = distance_to_segment(point, a, b);
  const double size = std::max(corners_.cwiseAbs().maxCoeff(), point.cwiseAbs().maxCoeff());
  if (away > 1e-12 * size) return away;
  if (corners_.cols() == 1) return -std::numeric_limits<double>::min();
  return -std::min((point - a).norm(), (point - b).norm());
}

double PlaneHull::signed_distance(const Eigen::Vector2d& point) const {
  if (corners_.cols() < 3) return distance_of_line(point);
  double highest = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < corners_.cols(); ++i) {
    const Eigen::Vector2d corner = corners_.col(i);
    highest = std::max(highest, normal(i).dot(point - corner));
    nearest = std::min(nearest, distance_to_segment(point, corner, corner_after(i)));
  }
  return highest > 0.0 ? nearest : highest;
}

double PlaneHull::reach(const Eigen::Vector2d& direction) const {
  if (corners_.cols() < 3 || !(signed_distance(Eigen::Vector2d::Zero()) < 0.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double t = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < corners_.cols(); ++i) {
    const double slope = normal(i).dot(direction);
    if (slope > 0.0) t = std::min(t, normal(i).dot(corners_.col(i)) / slope);
  }
  return t;
}

}  // namespace microslip::contact
