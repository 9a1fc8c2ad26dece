#include "contact/force/sleeping_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contact/closed_form/slip_functions.hpp"
#include "contact/force/block_kernels.hpp"
#include "contact/patch/point_motions.hpp"

namespace microslip::contact {
namespace {

constexpr auto lanes = static_cast<Eigen::Index>(lane_points);
// More sums than this cost more memory than they save time.
constexpr Eigen::Index largest_n_groups = 256;
// Proofs are made in doubles: a margin below this share of its terms proves nothing.
constexpr double rounding = 1e-12;
constexpr double root_two = 1.4142135623730951;
// Referring to a new motion costs about half an evaluation: it must leave a quarter of the points
// asleep.
constexpr double least_asleep = 0.25;
constexpr long largest_patience = 64;

}  // namespace

SleepProof prove_asleep(const PointParameters& point, const PointMotion& motion, double size_u,
                        double size_v) {
  const SlipFunctions w = slip_functions(point, motion);
  const double load = point.normal_stiffness * size_v;
  const double load_terms = std::abs(w.mean_load) + w.load_amplitude;
  const auto radius = [](double margin, double change) {
    return change > 0.0 ? margin / change : std::numeric_limits<double>::infinity();
  };
  if (w.above_open < -rounding * load_terms) {
    return {SleepState::open, radius(-w.above_open, root_two * load)};
  }
  if (!(w.below_closed < -rounding * load_terms)) {
    return {};
  }
  SleepProof proof{SleepState::stuck, radius(-w.below_closed, root_two * load)};
  if (point.friction_coefficient == 0.0 || point.tangential_stiffness == 0.0) {
    return proof;  // no friction to change its state
  }
  const double mean = point.tangential_stiffness * motion.u_mean;
  const double band = std::min(mean - (w.negative - w.limit), w.limit - w.positive - mean);
  const double force_terms = w.positive + w.negative + std::abs(w.limit) + std::abs(mean);
  if (!(std::min(-w.excess, band) > rounding * force_terms)) {
    return {};
  }
  const double friction = point.tangential_stiffness * size_u;
  const double limit = point.friction_coefficient * load;
  proof.radius = std::min({proof.radius, radius(-w.excess, 2.0 * (friction + root_two * limit)),
                           radius(band, root_two * (friction + limit))});
  return proof;
}

SleepingPoints::SleepingPoints(const ContactPatch& patch, const ModalShapes& shapes)
    : size_u_(shapes.u.rowwise().norm()),
      size_v_(shapes.v.rowwise().norm()),
      order_(static_cast<std::size_t>(patch.n_points())) {
  const Eigen::Index n_lanes = (patch.n_points() + lanes - 1) / lanes;
  group_ = lanes * ((n_lanes + largest_n_groups - 1) / largest_n_groups);
  wake_all();
}

void SleepingPoints::wake_all() {
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  radius_.clear();
  part_.clear();
  n_awake_ = static_cast<Eigen::Index>(order_.size());
  n_awake_at_reference_ = n_awake_;
}

const SleepingPart* SleepingPoints::part() const {
  const auto n = static_cast<Eigen::Index>(order_.size());
  return n_awake_ < n ? &part_[static_cast<std::size_t>(n_awake_ / group_)] : nullptr;
}

Eigen::Index SleepingPoints::awake_at(const Harmonics& q) const {
  const auto n = static_cast<Eigen::Index>(order_.size());
  if (radius_.empty()) {
    return n;
  }
  const double distance = (q.vector() - reference_.vector()).norm() * (1.0 + rounding);
  const auto first = std::upper_bound(radius_.begin(), radius_.end(), distance);
  const Eigen::Index awake = first - radius_.begin();
  return std::min(n, (awake + group_ - 1) / group_ * group_);
}

double SleepingPoints::awake_share_at(const Harmonics& q) const {
  return static_cast<double>(awake_at(q)) / static_cast<double>(order_.size());
}

bool SleepingPoints::look_at(const Harmonics& q, const ContactPatch& patch,
                             const ModalShapes& shapes) {
  ++calls_;
  n_awake_ = awake_at(q);
  const auto n = static_cast<Eigen::Index>(order_.size());
  const bool woken = radius_.empty() || n_awake_ > n_awake_at_reference_ + n / 8;
  if (!woken || calls_ < next_reference_ || n < 2 * lanes) {
    return false;
  }
  refer_to(q, patch, shapes);
  const bool pays =
      static_cast<double>(n - n_awake_at_reference_) >= least_asleep * static_cast<double>(n);
  patience_ = pays ? 2 : std::min(2 * patience_, largest_patience);
  next_reference_ = calls_ + patience_;
  if (!pays) {
    wake_all();
  }
  return true;
}

void SleepingPoints::refer_to(const Harmonics& q, const ContactPatch& patch,
                              const ModalShapes& shapes) {
  const std::vector<PointMotion> motions = point_motions(shapes, q);
  std::vector<SleepProof> proof(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    proof[i] = prove_asleep(patch.points()[i], motions[i], size_u_[point], size_v_[point]);
  }
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  std::stable_sort(order_.begin(), order_.end(), [&](Eigen::Index a, Eigen::Index b) {
    return proof[static_cast<std::size_t>(a)].radius < proof[static_cast<std::size_t>(b)].radius;
  });
  radius_.resize(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) {
    radius_[place] = proof[static_cast<std::size_t>(order_[place])].radius;
  }
  reference_ = q;
  add_up(proof, patch, shapes);
  n_awake_ = awake_at(q);
  n_awake_at_reference_ = n_awake_;
}

void SleepingPoints::add_up(const std::vector<SleepProof>& proof, const ContactPatch& patch,
                            const ModalShapes& shapes) {
  const auto n = static_cast<Eigen::Index>(order_.size());
  const Eigen::Index n_modes = shapes.u.cols();
  const Eigen::Index n_groups = (n + group_ - 1) / group_;
  part_.resize(static_cast<std::size_t>(n_groups));
  SleepingPart sum{Eigen::MatrixXd::Zero(n_modes, n_modes), Eigen::VectorXd::Zero(n_modes)};
  for (Eigen::Index g = n_groups - 1; g >= 0; --g) {
    for (Eigen::Index place = g * group_; place < std::min(n, (g + 1) * group_); ++place) {
      const Eigen::Index i = order_[static_cast<std::size_t>(place)];
      const PointParameters& point = patch.points()[static_cast<std::size_t>(i)];
      const double weight = patch.weights()[i];
      const SleepState state = proof[static_cast<std::size_t>(i)].state;
      if (state == SleepState::stuck) {
        const double k_u = point.friction_coefficient > 0.0 ? point.tangential_stiffness : 0.0;
        sum.stiffness.noalias() += (weight * k_u) * shapes.u.row(i).transpose() * shapes.u.row(i);
        sum.stiffness.noalias() +=
            (weight * point.normal_stiffness) * shapes.v.row(i).transpose() * shapes.v.row(i);
        sum.mean += (weight * std::min(point.preload, 0.0)) * shapes.v.row(i).transpose();
      } else if (state == SleepState::open) {
        sum.mean -= (weight * std::max(point.preload, 0.0)) * shapes.v.row(i).transpose();
      }
    }
    part_[static_cast<std::size_t>(g)] = sum;
  }
}

}  // namespace microslip::contact
