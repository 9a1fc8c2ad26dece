#include "pipelines/import/face_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

// Of the longest side of the body.
constexpr double on_the_face = 5e-3;
constexpr double told_apart = 1e-3;

double distance_of_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) {
  const double square = (b - a).squaredNorm();
  const double share = square > 0.0 ? std::clamp((x - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
  return (x - a - share * (b - a)).norm();
}

/// @param corners  one per row.
double distance_of_triangle(const Eigen::Vector3d& x, const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d a = corners.row(0);
  const Eigen::Vector3d b = corners.row(1);
  const Eigen::Vector3d c = corners.row(2);
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const auto inside = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return (to - from).cross(x - from).dot(normal) >= 0.0;
  };
  if (normal.norm() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)) {
    return std::abs((x - a).dot(normal.normalized()));
  }
  return std::min(
      {distance_of_segment(x, a, b), distance_of_segment(x, b, c), distance_of_segment(x, c, a)});
}

std::string text_of(const Eigen::Vector3d& x) {
  const auto clean = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", clean(x.x()), clean(x.y()), clean(x.z()));
}

std::string text_of(const mesh::StepFace& face) {
  return fmt::format("{} ({}, {:.3g} m^2 at {} m)", face.number, face.kind, face.area,
                     text_of(face.centre));
}

/// A face that may be meant, and how far it is from that.
struct Candidate {
  const mesh::StepFace* face;
  double distance;
};
using Candidates = std::vector<Candidate>;

std::string listed(const Candidates& candidates, bool with_distance) {
  constexpr std::size_t most = 4;
  std::string text;
  for (const Candidate& candidate :
       std::span(candidates).first(std::min(most, candidates.size()))) {
    text += (text.empty() ? "" : "; ") + text_of(*candidate.face);
    if (with_distance) text += fmt::format(", {:.3g} m away", candidate.distance);
  }
  if (candidates.size() > most) text += fmt::format("; and {} more", candidates.size() - most);
  return text;
}

constexpr const char* remedy = "`microslip faces` lists and draws them all with their numbers";

/// The nearest, if it is so by far enough. @param candidates  not empty.
int nearest(Candidates candidates, double side, const std::string& what) {
  std::ranges::sort(candidates, {}, &Candidate::distance);
  const double limit = candidates.front().distance + told_apart * side;
  const auto n = std::ranges::count_if(
      candidates, [&](const Candidate& other) { return other.distance <= limit; });
  if (n == 1) return candidates.front().face->number;
  candidates.resize(static_cast<std::size_t>(n));
  throw SceneError(
      fmt::format("{} fits {} faces: {}; choose a point farther inside one, or give "
                  "the number: {}",
                  what, n, listed(candidates, false), remedy));
}

Candidates all_at(const mesh::StepGeometry& geometry, const Eigen::Vector3d& point) {
  Candidates candidates;
  const std::vector<double> away = distances(geometry, point);
  for (std::size_t i = 0; i < geometry.faces.size(); ++i) {
    candidates.push_back({&geometry.faces[i], away[i]});
  }
  return candidates;
}

int face_at(const mesh::StepGeometry& geometry, const Eigen::Vector3d& point,
            const std::string& place) {
  const double side = longest_side(geometry);
  Candidates candidates = all_at(geometry, point);
  std::ranges::sort(candidates, {}, &Candidate::distance);
  if (candidates.front().distance > on_the_face * side) {
    throw SceneError(fmt::format(
        "{}: the point {} m is on no face; nearest is {}. Lengths without unit are metres. {}",
        place, text_of(point), listed({candidates.front()}, true), remedy));
  }
  return nearest(candidates, side, fmt::format("{}: the point {} m", place, text_of(point)));
}

int face_with(const mesh::StepGeometry& geometry, const FaceChoice& choice,
              const std::string& place) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  constexpr double largest_angle = 2.0 / degrees;
  const double side = longest_side(geometry);
  const std::string what = fmt::format("{}: the normal {}", place, text_of(*choice.normal));
  Candidates candidates;
  for (const mesh::StepFace& face : geometry.faces) {
    if (face.normal.isZero()) continue;
    const double cosine = std::clamp(face.normal.dot(*choice.normal), -1.0, 1.0);
    candidates.push_back({&face, std::acos(cosine)});
  }
  std::ranges::sort(candidates, {}, &Candidate::distance);
  const auto fits = [&](const Candidate& c) { return c.distance <= largest_angle; };
  if (candidates.empty() || !fits(candidates.front())) {
    throw SceneError(fmt::format(
        "{} fits no face{}. {}", what,
        candidates.empty()
            ? ""
            : fmt::format("; nearest is {}, {:.3g} degrees away", text_of(*candidates.front().face),
                          degrees * candidates.front().distance),
        remedy));
  }
  std::erase_if(candidates, [&](const Candidate& c) { return !fits(c); });
  if (candidates.size() == 1) return candidates.front().face->number;
  if (!choice.near) {
    throw SceneError(
        fmt::format("{} fits {} faces: {}; add near = [x, y, z], or give the number: {}", what,
                    candidates.size(), listed(candidates, false), remedy));
  }
  for (const Candidate& other : all_at(geometry, *choice.near)) {
    for (Candidate& c : candidates) {
      if (c.face == other.face) c.distance = other.distance;
    }
  }
  return nearest(candidates, side, fmt::format("{} near {} m", what, text_of(*choice.near)));
}

}  // namespace

double longest_side(const mesh::StepGeometry& geometry) {
  return (geometry.nodes.colwise().maxCoeff() - geometry.nodes.colwise().minCoeff()).maxCoeff();
}

std::vector<double> distances(const mesh::StepGeometry& geometry, const Eigen::Vector3d& point) {
  std::vector<double> result;
  std::size_t triangle = 0;
  for (const mesh::StepFace& face : geometry.faces) {
    double& least = result.emplace_back(std::numeric_limits<double>::infinity());
    for (; triangle < geometry.owner.size() && geometry.owner[triangle] == face.number;
         ++triangle) {
      const auto corners = geometry.triangles.row(static_cast<Eigen::Index>(triangle));
      least = std::min(least, distance_of_triangle(point, geometry.nodes(corners, Eigen::all)));
    }
  }
  return result;
}

int chosen_face(const mesh::StepGeometry& geometry, const FaceChoice& choice,
                const std::string& place) {
  if (choice.point) return face_at(geometry, *choice.point, place);
  if (choice.normal) return face_with(geometry, choice, place);
  const auto found = std::ranges::find(geometry.faces, *choice.number, &mesh::StepFace::number);
  if (found != geometry.faces.end()) return found->number;
  throw SceneError(fmt::format("{}: there is no face {}; the body has {} to {}. {}", place,
                               *choice.number, geometry.faces.front().number,
                               geometry.faces.back().number, remedy));
}

std::vector<int> chosen_faces(const mesh::StepGeometry& geometry, const FaceDescription& face) {
  std::vector<int> numbers;
  for (const FaceChoice& choice : face.choices) {
    const int number = chosen_face(geometry, choice, face.place);
    if (std::ranges::find(numbers, number) != numbers.end()) {
      throw SceneError(fmt::format("{}: face {} is meant twice", face.place, number));
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace microslip::pipelines
