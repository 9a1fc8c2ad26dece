#include "contact/sampled/patch_force.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/phase.hpp"
#include "contact/spare_cores.hpp"

namespace microslip::contact::sampled {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("sampled::PatchForce: " + message);
}

Eigen::RowVector3d stuck_stiffness(const SurfaceLaw& surface, bool planar) {
  const SurfaceState rest = surface.at(0.0, 0.0);
  const double closed =
      surface.is_smooth() ? surface.point().normal_stiffness : rest.load_by_approach;
  if (!surface.has_friction()) return {0.0, closed, 0.0};
  return {surface.first_stiffness() * rest.stiffness_ratio, closed,
          planar ? surface.second_stiffness() * rest.second_stiffness_ratio : 0.0};
}

/// Without a spring along the face nothing slips, whatever its slider does:
/// as by the other methods.
std::vector<CycleSegment> told(std::vector<CycleSegment> segments, const SurfaceLaw& surface,
                               bool planar) {
  const bool has_spring =
      surface.first_stiffness() > 0.0 || (planar && surface.second_stiffness() > 0.0);
  if (has_spring) return segments;
  for (CycleSegment& segment : segments) {
    if (segment.state != ContactState::separated) segment.state = ContactState::stick;
  }
  return joined_segments(segments, 0.0);
}

RestingPoints at_rest(Eigen::VectorXd weights, const std::vector<SurfaceLaw>& surfaces,
                      bool planar) {
  const auto n = static_cast<Eigen::Index>(surfaces.size());
  RestingPoints points{std::move(weights), Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const SurfaceLaw& surface = surfaces[static_cast<std::size_t>(i)];
    LinearRange range = surface.linear_range();
    if (!planar) range.stiffness[2] = 0.0;
    points.reference_load[i] = surface.reference_load();
    points.stuck_stiffness.row(i) = stuck_stiffness(surface, planar);
    points.ranges.emplace_back(range);
  }
  return points;
}

}  // namespace

PatchForce::PatchForce(Eigen::VectorXd weights, std::vector<SurfaceLaw> surfaces,
                       ModalShapes shapes, int instants)
    : PointwiseForce(at_rest(std::move(weights), surfaces, shapes.w.size() > 0), std::move(shapes)),
      surfaces_(std::move(surfaces)),
      instants_(instants) {
  require(instants_ >= 16, std::to_string(instants_) + " instants, must be 16 or more");
}

std::unique_ptr<ModalForce::Workspace> PatchForce::workspace() const {
  return std::make_unique<Work>(*this);
}

/// Grows with the harmonics by halves, so that what is chosen for few is not upset by many.
int PatchForce::instants_for(int n_harmonics, int force_harmonics) const {
  const int needed = std::max(8 * (n_harmonics + 1), 4 * (force_harmonics + 1));
  int n = instants_;
  while (n + n / 2 < needed) n *= 2;
  return n < needed ? n + n / 2 : n;
}

PatchForce::Grid PatchForce::grid(int n_harmonics, int force_harmonics, Work& work) const {
  const int n = instants_for(n_harmonics, force_harmonics);
  const auto table = [&](int harmonics) {
    auto found = work.tables.find({n, harmonics});
    if (found == work.tables.end()) {
      found = work.tables.emplace(std::pair(n, harmonics), Instants(n, harmonics)).first;
    }
    return &found->second;
  };
  return {table(n_harmonics), table(force_harmonics)};
}

/// Of a few thousand random motions of a point, of every kind, none differed by more than a quarter
/// of this (test_work_error.cpp). Steps pass over layers in which a coefficient changes with the
/// speed.
PatchForce::WorkPrecision PatchForce::work_precision(Eigen::Index point, int n_harmonics) const {
  const double step = two_pi / instants_for(n_harmonics, n_harmonics);
  const bool along_a_line = shapes().w.size() == 0;
  const bool by_rate = surfaces_[static_cast<std::size_t>(point)].is_rate_dependent();
  WorkPrecision precision{.friction = step, .load = step * step};
  if (along_a_line) precision.friction = 6.0 * step * step * step;
  if (by_rate) precision.friction = 1.5 * std::sqrt(step);
  return precision;
}

/// As many parts as there may be cores, of as many points each as pay for joining their sums.
void PatchForce::Work::divide() {
  constexpr std::size_t points_of_two = 4 * block_size;
  constexpr std::size_t most = 8;
  const std::span<const Eigen::Index> awake(sleep.awake());
  n_parts = std::clamp<std::size_t>(awake.size() / points_of_two * 2, 1, most);
  if (parts.size() < n_parts) parts.resize(n_parts);
  const std::size_t blocks = (awake.size() + block_size - 1) / block_size;
  const auto begin = [&](std::size_t i) {
    return std::min(awake.size(), i * blocks / n_parts * block_size);
  };
  for (std::size_t i = 0; i < n_parts; ++i) {
    parts[i].points = awake.subspan(begin(i), begin(i + 1) - begin(i));
  }
}

void PatchForce::sum_plane(Part& part, double frequency, bool derivatives, const Grid& grid,
                           Work& work) const {
  PlaneBlock& plane = part.plane;
  const auto ask = derivatives ? PlaneBlock::Ask::derivatives : PlaneBlock::Ask::force;
  for (std::size_t begin = 0; begin < part.points.size(); begin += block_size) {
    const auto block = part.points.subspan(begin, std::min(block_size, part.points.size() - begin));
    plane.evaluate(surfaces_, work.motion, block, frequency, ask, *grid.of_motion, *grid.of_force);
    for (std::size_t p = 0; p < block.size(); ++p) {
      const Eigen::Index i = block[p];
      const auto& surface = surfaces_[static_cast<std::size_t>(i)];
      keep(i, cycle_states(plane.runs(p), grid.of_motion->size()), work);
      part.defect += points().weights[i] * plane.defect(p) *
                     std::hypot(shapes().u.row(i).norm(), shapes().w.row(i).norm());
      PointDerivatives of_point;
      if (derivatives) {
        const PlaneDerivatives& J = plane.derivatives(p);
        of_point.stride = grid.of_motion->n_rows();
        for (std::size_t d = 0; d < 2; ++d) {
          for (std::size_t s = 0; s < 3; ++s) of_point.friction[d][s] = J.by(d, s);
          if (surface.is_rate_dependent()) of_point.by_frequency[d] = J.by_frequency(d);
        }
        of_point.normal_moments = J.normal_moments();
      }
      part.projection.add(i, points().weights[i], surface.reference_load(),
                          {plane.sums(0) + p, plane.sums(1) + p, plane.sums(2) + p}, block_size,
                          derivatives ? &of_point : nullptr);
    }
  }
}

void PatchForce::sum_line(Part& part, double frequency, bool derivatives, const Grid& grid,
                          Work& work) const {
  LineBlock& line = part.line;
  const std::size_t n = grid.of_motion->size();
  for (std::size_t begin = 0; begin < part.points.size(); begin += block_size) {
    const auto block = part.points.subspan(begin, std::min(block_size, part.points.size() - begin));
    line.evaluate(surfaces_, work.motion, block, frequency, *grid.of_motion, *grid.of_force);
    for (std::size_t p = 0; p < block.size(); ++p) {
      const Eigen::Index i = block[p];
      const auto& surface = surfaces_[static_cast<std::size_t>(i)];
      keep(i, cycle_states(line.runs(p), n), work);
      PointDerivatives of_point;
      if (derivatives) {
        const LineDerivatives& J = line.derivatives(p);
        of_point.friction[0] = {J.by_u(), J.by_v(), nullptr};
        of_point.stride = J.row_stride();
        of_point.normal_moments = J.normal_moments();
        if (surface.is_rate_dependent()) of_point.by_frequency[0] = J.by_frequency();
      }
      part.projection.add(i, points().weights[i], surface.reference_load(),
                          {line.friction_sums() + p, line.normal_sums() + p, nullptr}, block_size,
                          derivatives ? &of_point : nullptr);
    }
  }
}

ForceAndJacobian PatchForce::awake_force(double frequency, const Asked& asked,
                                         PointwiseWork& own) const {
  Work& work = static_cast<Work&>(own);
  const int n_harmonics = work.motion.n_harmonics();
  const Grid grid = this->grid(n_harmonics, std::max(n_harmonics, asked.n_harmonics), work);
  const bool derivatives = !asked.rows.empty();
  work.divide();
  run_on_spare_cores(work.n_parts, [&](std::size_t i) {
    Part& part = work.parts[i];
    part.defect = 0.0;
    part.projection.start(shapes(), *grid.of_motion, *grid.of_force, asked.rows);
    if (shapes().w.size() > 0) {
      sum_plane(part, frequency, derivatives, grid, work);
    } else {
      sum_line(part, frequency, derivatives, grid, work);
    }
  });
  Part& whole = work.parts.front();
  for (std::size_t i = 1; i < work.n_parts; ++i) {
    whole.projection.join(work.parts[i].projection);
    whole.defect += work.parts[i].defect;
  }
  ForceAndJacobian result = whole.projection.take();
  result.defect = whole.defect;
  return result;
}

void PatchForce::add_cycles(std::span<const Eigen::Index> points, double frequency,
                            PointwiseWork& own, ReportSum& sum) const {
  Work& work = static_cast<Work&>(own);
  const int n_harmonics = work.motion.n_harmonics();
  const Grid grid = this->grid(n_harmonics, n_harmonics, work);
  const bool planar = shapes().w.size() > 0;
  PlaneBlock& plane = work.parts.front().plane;
  LineBlock& line = work.parts.front().line;
  for (std::size_t begin = 0; begin < points.size(); begin += block_size) {
    const auto block = points.subspan(begin, std::min(block_size, points.size() - begin));
    if (planar) {
      plane.evaluate(surfaces_, work.motion, block, frequency, PlaneBlock::Ask::force,
                     *grid.of_motion, *grid.of_force);
    } else {
      line.evaluate(surfaces_, work.motion, block, frequency, *grid.of_motion, *grid.of_force);
    }
    for (std::size_t p = 0; p < block.size(); ++p) {
      const auto& surface = surfaces_[static_cast<std::size_t>(block[p])];
      const auto& runs = planar ? plane.runs(p) : line.runs(p);
      sum.add(told(cycle_segments(runs, grid.of_motion->size()), surface, planar),
              planar ? plane.slip_work(p) : line.slip_work(p), this->points().weights[block[p]]);
    }
  }
}

}  // namespace microslip::contact::sampled
