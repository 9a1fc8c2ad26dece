#include "contact/sampled/patch_force.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/force/cycle_report.hpp"
#include "contact/patch/mode_shape_check.hpp"

namespace microslip::contact::sampled {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("sampled::PatchForce: " + message);
}

SleepingLaws sleeping_laws(const Eigen::VectorXd& weights, const std::vector<SurfaceLaw>& surfaces,
                           const ModalShapes& shapes) {
  Eigen::VectorXd load_at_rest(weights.size());
  std::vector<std::optional<LinearRange>> ranges;
  for (const SurfaceLaw& surface : surfaces) {
    load_at_rest[static_cast<Eigen::Index>(ranges.size())] = surface.load_at_rest();
    ranges.push_back(surface.linear_range());
    if (shapes.w.size() == 0) ranges.back()->stiffness[2] = 0.0;
  }
  return {weights, std::move(load_at_rest), std::move(ranges), shapes};
}

void add_sleeping(ForceAndJacobian& result, const SleepingPart& part, const Harmonics& q,
                  std::size_t n_rows) {
  const Eigen::Index n = part.mean.size();
  result.force.rows().topRows(q.rows().rows()).noalias() += q.rows() * part.stiffness;  // symmetric
  result.force.rows().row(0) += part.mean.transpose();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(n_rows); ++k) {
    result.jacobian.block(k * n, k * n, n, n) += part.stiffness;
  }
}

}  // namespace

PatchForce::PatchForce(Eigen::VectorXd weights, std::vector<SurfaceLaw> surfaces,
                       ModalShapes shapes, const Options& options)
    : weights_(std::move(weights)),
      surfaces_(std::move(surfaces)),
      shapes_(std::move(shapes)),
      options_(options) {
  const Eigen::Index n = weights_.size();
  require(n >= 1 && static_cast<Eigen::Index>(surfaces_.size()) == n,
          std::to_string(n) + " weights for " + std::to_string(surfaces_.size()) + " surfaces");
  require(weights_.allFinite() && weights_.minCoeff() >= 0.0, "a weight is negative or not finite");
  require(options.instants >= 16,
          std::to_string(options.instants) + " instants, must be 16 or more");
  require_mode_shape("sampled::PatchForce", "u", shapes_.u, n, shapes_.u.cols());
  require_mode_shape("sampled::PatchForce", "v", shapes_.v, n, shapes_.u.cols());
  if (shapes_.w.size() > 0) {
    require_mode_shape("sampled::PatchForce", "w", shapes_.w, n, shapes_.u.cols());
  }
  sleep_ = sleeping_laws(weights_, surfaces_, shapes_);
  cycles_.resize(surfaces_.size());
}

/// Grows with the harmonics in steps of two, so that what is chosen for few is not upset by many.
PatchForce::Grid PatchForce::grid(int instants, int n_harmonics, int force_harmonics) const {
  int n = instants;
  while (n < 8 * (n_harmonics + 1) || n < 4 * (force_harmonics + 1)) n *= 2;
  const auto table = [&](int harmonics) {
    auto found = tables_.find({n, harmonics});
    if (found == tables_.end()) {
      found = tables_.emplace(std::pair(n, harmonics), Instants(n, harmonics)).first;
    }
    return &found->second;
  };
  return {table(n_harmonics), table(force_harmonics)};
}

bool PatchForce::is_frictionless(Eigen::Index point) const {
  const auto& range = sleep_.range(point);
  const SurfaceLaw& surface = surfaces_[static_cast<std::size_t>(point)];
  if (surface.is_smooth()) return !range->rubs();
  return !surface.is_rate_dependent() && surface.friction().at_rest() == 0.0;
}

void PatchForce::sum_plane(double frequency, bool derivatives, const Grid& grid) const {
  const std::span<const Eigen::Index> awake(sleep_.awake());
  const auto ask = derivatives ? PlaneBlock::Ask::derivatives : PlaneBlock::Ask::force;
  for (std::size_t begin = 0; begin < awake.size(); begin += block_size) {
    const auto points = awake.subspan(begin, std::min(block_size, awake.size() - begin));
    plane_.evaluate(surfaces_, motion_, points, frequency, ask, *grid.of_motion, *grid.of_force);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Index i = points[p];
      const auto& surface = surfaces_[static_cast<std::size_t>(i)];
      const CycleStates states = cycle_states(plane_.runs(p), grid.of_motion->size());
      cycles_[static_cast<std::size_t>(i)] = is_frictionless(i) ? states.without_slip() : states;
      defect_ += weights_[i] * plane_.defect(p) *
                 std::hypot(shapes_.u.row(i).norm(), shapes_.w.row(i).norm());
      PointDerivatives of_point;
      if (derivatives) {
        const PlaneDerivatives& J = plane_.derivatives(p);
        for (std::size_t d = 0; d < 2; ++d) {
          for (std::size_t s = 0; s < 3; ++s) of_point.friction[d][s] = J.by(d, s);
          if (surface.is_rate_dependent()) of_point.by_frequency[d] = J.by_frequency(d);
        }
        of_point.normal_moments = J.normal_moments();
      }
      projection_.add(i, weights_[i], surface.load_at_rest(),
                      {plane_.sums(0) + p, plane_.sums(1) + p, plane_.sums(2) + p}, block_size,
                      derivatives ? &of_point : nullptr);
    }
  }
}

void PatchForce::sum_line(double frequency, bool derivatives, const Grid& grid) const {
  const std::span<const Eigen::Index> awake(sleep_.awake());
  const std::size_t n = grid.of_motion->size();
  for (std::size_t begin = 0; begin < awake.size(); begin += block_size) {
    const auto points = awake.subspan(begin, std::min(block_size, awake.size() - begin));
    line_.evaluate(surfaces_, motion_, points, frequency, *grid.of_motion, *grid.of_force);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Index i = points[p];
      const CycleStates states = cycle_states(line_.runs(p), n);
      cycles_[static_cast<std::size_t>(i)] = is_frictionless(i) ? states.without_slip() : states;
      PointDerivatives of_point;
      if (derivatives) {
        const LineDerivatives& J = line_.derivatives(p);
        of_point.friction[0] = {J.by_u(0), J.by_v(0), nullptr};
        of_point.normal_moments = J.normal_moments();
        const auto& surface = surfaces_[static_cast<std::size_t>(i)];
        if (surface.is_rate_dependent()) of_point.by_frequency[0] = J.by_frequency();
      }
      projection_.add(i, weights_[i], surfaces_[static_cast<std::size_t>(i)].load_at_rest(),
                      {line_.friction_sums() + p, line_.normal_sums() + p, nullptr}, block_size,
                      derivatives ? &of_point : nullptr);
    }
  }
}

ForceAndJacobian PatchForce::sum(const Harmonics& q, double frequency,
                                 const std::vector<Eigen::Index>& rows, const Grid& grid) const {
  motion_.set(shapes_, q);
  sleep_.look_at(motion_, frequency, shapes_);
  projection_.start(shapes_, *grid.of_motion, *grid.of_force, rows);
  keep_states(q, frequency);
  defect_ = 0.0;
  if (shapes_.w.size() > 0) {
    sum_plane(frequency, !rows.empty(), grid);
  } else {
    sum_line(frequency, !rows.empty(), grid);
  }
  ForceAndJacobian result = projection_.take();
  result.defect = defect_;
  if (const SleepingPart* part = sleep_.part()) add_sleeping(result, *part, q, rows.size());
  return result;
}

ForceAndJacobian PatchForce::evaluate(const Harmonics& q, double frequency) const {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(q.rows().rows()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return evaluate_rows(q, frequency, all);
}

ForceAndJacobian PatchForce::evaluate_rows(const Harmonics& q, double frequency,
                                           const std::vector<Eigen::Index>& rows) const {
  return sum(q, frequency, rows, grid(options_.instants, q.n_harmonics(), q.n_harmonics()));
}

Harmonics PatchForce::force_up_to(const Harmonics& q, double frequency, int n_harmonics) const {
  return sum(q, frequency, {}, grid(options_.instants, q.n_harmonics(), n_harmonics)).force;
}

/// Those of the points asleep; the others follow as they are evaluated.
void PatchForce::keep_states(const Harmonics& q, double frequency) const {
  states_q_ = q;
  states_frequency_ = frequency;
  for (std::size_t i = 0; i < cycles_.size(); ++i) {
    const SleepState state = sleep_.state(static_cast<Eigen::Index>(i));
    if (state == SleepState::awake) continue;
    const bool stuck = state == SleepState::stuck;
    cycles_[i] = {stuck ? CycleRegime::full_stick : CycleRegime::separated,
                  PeriodStates(stuck ? ContactState::stick : ContactState::separated)};
  }
}

void PatchForce::states(const Harmonics& q, double frequency, ContactStates& result) const {
  const bool known = frequency == states_frequency_ && q.rows().rows() == states_q_.rows().rows() &&
                     q.vector() == states_q_.vector();
  if (!known) static_cast<void>(evaluate_rows(q, frequency, {}));
  const double area = weights_.sum();
  result.clear();
  for (std::size_t i = 0; i < cycles_.size(); ++i) {
    const double weight = weights_[static_cast<Eigen::Index>(i)];
    if (weight > 0.0) result.push_back({weight / area, cycles_[i]});
  }
}

CycleReport PatchForce::report(const Harmonics& q, double frequency) const {
  const Grid grid = this->grid(options_.instants, q.n_harmonics(), q.n_harmonics());
  motion_.set(shapes_, q);
  sleep_.look_at(motion_, frequency, shapes_);
  states_q_ = Harmonics();  // another motion than the last evaluated
  constexpr double two_pi = 2.0 * std::numbers::pi;
  ReportSum sum;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const SleepState state = sleep_.state(i);
    if (weights_[i] == 0.0 || state == SleepState::awake) continue;
    // Without friction a point in contact counts as slipping without force.
    const bool stuck = state == SleepState::stuck;
    const ContactState kind = !stuck               ? ContactState::separated
                              : is_frictionless(i) ? ContactState::positive_slip
                                                   : ContactState::stick;
    const CycleSegment whole{kind, 0.0, two_pi, 0.0};
    sum.add({&whole, 1}, 0.0, weights_[i]);
  }
  const std::span<const Eigen::Index> awake(sleep_.awake());
  for (std::size_t begin = 0; begin < awake.size(); begin += block_size) {
    const auto points = awake.subspan(begin, std::min(block_size, awake.size() - begin));
    const bool planar = shapes_.w.size() > 0;
    if (planar) {
      plane_.evaluate(surfaces_, motion_, points, frequency, PlaneBlock::Ask::force,
                      *grid.of_motion, *grid.of_force);
    } else {
      line_.evaluate(surfaces_, motion_, points, frequency, *grid.of_motion, *grid.of_force);
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double weight = weights_[points[p]];
      if (weight == 0.0) continue;
      sum.add(cycle_segments(planar ? plane_.runs(p) : line_.runs(p), grid.of_motion->size()),
              planar ? plane_.slip_work(p) : line_.slip_work(p), weight);
    }
  }
  CycleReport report = sum.result();
  report.awake_share = static_cast<double>(awake.size()) / static_cast<double>(surfaces_.size());
  return report;
}

LinearState PatchForce::linear_state(const Harmonics& centre, double radius) const {
  return sleep_.linear_state(shapes_, centre, radius);
}

Eigen::MatrixXd PatchForce::stuck_stiffness() const {
  const bool planar = shapes_.w.size() > 0;
  Eigen::MatrixX3d k = Eigen::MatrixX3d::Zero(weights_.size(), 3);
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const SurfaceLaw& surface = surfaces_[static_cast<std::size_t>(i)];
    const SurfaceState rest = surface.at(0.0, 0.0);
    const bool rubs = !is_frictionless(i);
    const double closed =
        surface.is_smooth() ? surface.point().normal_stiffness : rest.load_by_approach;
    k.row(i) << (rubs ? surface.first_stiffness() * rest.stiffness_ratio : 0.0), closed,
        (rubs && planar ? surface.second_stiffness() * rest.second_stiffness_ratio : 0.0);
  }
  k.array().colwise() *= weights_.array();
  Eigen::MatrixXd stiffness = shapes_.u.transpose() * k.col(0).asDiagonal() * shapes_.u;
  stiffness += shapes_.v.transpose() * k.col(1).asDiagonal() * shapes_.v;
  if (planar) stiffness += shapes_.w.transpose() * k.col(2).asDiagonal() * shapes_.w;
  return stiffness;
}

double PatchForce::estimated_error(const Harmonics& q, double frequency) const {
  const int H = q.n_harmonics();
  const Harmonics coarse = sum(q, frequency, {}, grid(options_.instants, H, H)).force;
  const Harmonics fine = sum(q, frequency, {}, grid(2 * options_.instants, H, H)).force;
  const double stuck = (q.rows() * stuck_stiffness()).norm();
  const double scale = std::max(fine.rows().norm(), stuck);
  return scale > 0.0 ? (fine.rows() - coarse.rows()).norm() / scale : 0.0;
}

std::unique_ptr<PatchForce> PatchForce::with_instants(int n) const {
  Options options = options_;
  options.instants = n;
  return std::make_unique<PatchForce>(weights_, surfaces_, shapes_, options);
}

int PatchForce::instants_for(const Harmonics& q, double frequency, double tolerance,
                             int most) const {
  int n = 32;
  while (n < most && with_instants(n)->estimated_error(q, frequency) > tolerance) n *= 2;
  return n;
}

}  // namespace microslip::contact::sampled
