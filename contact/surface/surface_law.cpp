#include "contact/surface/surface_law.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace microslip::contact {
namespace {

[[noreturn]] void refuse(const char* quantity, double value, const char* allowed) {
  std::ostringstream message;
  message.precision(17);
  message << "SurfaceLaw: " << quantity << " = " << value << ", must be " << allowed;
  throw std::invalid_argument(message.str());
}

// Deviations from the mean within which Gaussian heights count. φ(9)/81 = 1.3e-20: where contact
// begins the load is nothing, of k_v s, and the share in contact 1.1e-19; on the other side 1 to
// the last bit.
constexpr double farthest_height = 9.0;

// c k, after a check that 1/k + c > 0.
double compliance_ratio(const char* direction, double stiffness, double compliance) {
  if (!(std::isfinite(stiffness) && stiffness >= 0.0)) {
    refuse("stiffness", stiffness, "finite and at least 0");
  }
  const double ratio = compliance * stiffness;
  if (!(std::isfinite(ratio) && ratio > -1.0)) refuse(direction, ratio, "finite and above -1");
  return ratio;
}

// g of (3) for γ = c k_T: h(1 + γ)/(1 + γh), and n/g with their derivatives by u; δ = h · reach.
struct Tangential {
  double ratio;
  double ratio_by_u;
  double reach;  // δ/g
  double reach_by_u;
};

Tangential in_series(const RoughState& s, double gamma) {
  if (gamma == 0.0) return {s.share, s.share_by_approach, s.reach, s.reach_by_approach};
  const double whole = 1.0 + gamma;
  const double part = 1.0 + gamma * s.share;
  return {s.share * (whole / part), s.share_by_approach * whole / (part * part),
          (s.reach + gamma * s.compression) / whole,
          (s.reach_by_approach + gamma * s.share) / whole};
}

}  // namespace

SurfaceLaw::SurfaceLaw(const PointParameters& point, double second_stiffness)
    : SurfaceLaw(point, second_stiffness, FrictionLaw::constant(point.friction_coefficient)) {}

SurfaceLaw::SurfaceLaw(const PointParameters& point, double second_stiffness,
                       const FrictionLaw& friction, const std::optional<RoughSurface>& roughness,
                       const SeriesCompliance& series)
    : point_(point),
      second_stiffness_(second_stiffness),
      friction_(friction),
      local_stiffness_(point.normal_stiffness),
      compliance_ratio_(compliance_ratio("c k along q", point.normal_stiffness, series.q)),
      first_ratio_(compliance_ratio("c k along p", point.tangential_stiffness, series.p)),
      second_ratio_(compliance_ratio("c k along r", second_stiffness, series.r)) {
  if (!std::isfinite(point.rest_load)) refuse("preload", point.rest_load, "finite");
  point_.normal_stiffness /= 1.0 + compliance_ratio_;
  point_.tangential_stiffness /= 1.0 + first_ratio_;
  second_stiffness_ /= 1.0 + second_ratio_;
  point_.friction_coefficient = friction.at_rest();
  reference_load_ = std::max(point.rest_load, 0.0);
  if (!roughness.has_value() || roughness->height() == 0.0) return;
  if (point.normal_stiffness == 0.0) {
    refuse("normal stiffness of rough surfaces", point.normal_stiffness, "above 0");
  }
  roughness_ = roughness;
  if (roughness_->law() == HeightLaw::gaussian) {
    first_touch_ = roughness_->mean() - farthest_height * roughness_->deviation();
  }
  start_at_rest(point.rest_load);
}

void SurfaceLaw::start_at_rest(double pressure) {
  const double compression = pressure / local_stiffness_;
  rest_ = pressure > 0.0 ? roughness_->approach(compression) + compliance_ratio_ * compression
                         : compression * (1.0 + compliance_ratio_);
  reference_load_ = at(0.0, 0.0).load;  // n − n_ref is to vanish at rest to the last bit
}

// u + γδ(u) is increasing, convex for γ > 0 and concave for γ < 0. With a start above the root in
// the first case and below it in the second Newton is monotone; where rounding turns it round it
// has arrived.
double SurfaceLaw::surface_approach(double closure) const {
  const double gamma = compliance_ratio_;
  if (gamma == 0.0) return closure;
  const bool cubic = roughness_->law() == HeightLaw::cubic;
  if (cubic && closure <= 0.0) return closure;
  double u = closure;
  // Where u ≥ 0, δ(u) ≤ closure/γ: a close bound where the bodies are much softer.
  if (gamma > 0.0 && closure > 0.0) {
    u = std::min(u, std::max(0.0, roughness_->approach(closure / gamma)));
  }
  const double direction = gamma > 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 100; ++i) {
    const RoughState s = roughness_->at(u);
    const double step = (closure - u - gamma * s.compression) / (1.0 + gamma * s.share);
    if (!(step * direction > 0.0) || u + step == u) break;
    u += step;
  }
  return u;
}

void SurfaceLaw::add_rough_state(double approach, SurfaceState& state) const {
  const double closure = approach + rest_;
  const bool open = closure <= first_touch_;
  const RoughState s = open ? RoughState{} : roughness_->at(surface_approach(closure));
  const double du = 1.0 / (1.0 + compliance_ratio_ * s.share);  // du/dv
  state.load = local_stiffness_ * s.compression;
  state.load_by_approach = local_stiffness_ * s.share * du;
  state.gap_load = open ? point_.normal_stiffness * (closure - first_touch_) : state.load;
  const Tangential p = in_series(s, first_ratio_);
  state.stiffness_ratio = p.ratio;
  state.stiffness_ratio_by_approach = p.ratio_by_u * du;
  state.load_per_ratio = local_stiffness_ * p.reach;
  state.load_per_ratio_by_approach = local_stiffness_ * p.reach_by_u * du;
  const Tangential r = second_ratio_ == first_ratio_ ? p : in_series(s, second_ratio_);
  state.second_stiffness_ratio = r.ratio;
  state.second_stiffness_ratio_by_approach = r.ratio_by_u * du;
  state.second_load_per_ratio = local_stiffness_ * r.reach;
  state.second_load_per_ratio_by_approach = local_stiffness_ * r.reach_by_u * du;
  add_ratio_of_stiffness(s.share, s.share_by_approach * du, state);
}

void SurfaceLaw::add_ratio_of_stiffness(double share, double share_by_approach,
                                        SurfaceState& state) const {
  if (first_ratio_ == second_ratio_) return;
  const double whole = (1.0 + second_ratio_) / (1.0 + first_ratio_);
  const double part = 1.0 + second_ratio_ * share;
  state.ratio_of_stiffness = whole * (1.0 + first_ratio_ * share) / part;
  state.ratio_of_stiffness_by_approach =
      whole * (first_ratio_ - second_ratio_) / (part * part) * share_by_approach;
}

SurfaceState SurfaceLaw::at(double approach, double rate) const {
  SurfaceState state;
  const FrictionCoefficient mu = friction_.at(rate);
  state.friction_coefficient = mu.value;
  state.friction_coefficient_by_rate = mu.by_rate;
  if (roughness_.has_value()) {
    add_rough_state(approach, state);
    return state;
  }
  state.gap_load = point_.rest_load + point_.normal_stiffness * approach;
  state.load = std::max(state.gap_load, 0.0);
  state.load_by_approach = state.gap_load > 0.0 ? point_.normal_stiffness : 0.0;
  state.load_per_ratio = state.second_load_per_ratio = state.load;
  state.load_per_ratio_by_approach = state.second_load_per_ratio_by_approach =
      state.load_by_approach;
  return state;
}

LinearRange SurfaceLaw::linear_range() const {
  const double k_v = point_.normal_stiffness;
  if (!is_smooth()) {
    return {{0.0, k_v, 0.0}, -k_v * kinks().front(), friction_, false};
  }
  const bool rubs = has_friction();
  return {{rubs ? point_.tangential_stiffness : 0.0, k_v, rubs ? second_stiffness_ : 0.0},
          point_.rest_load,
          friction_};
}

std::vector<double> SurfaceLaw::kinks() const {
  if (roughness_.has_value()) {
    const double last = roughness_->law() == HeightLaw::cubic
                            ? roughness_->height()
                            : roughness_->mean() + farthest_height * roughness_->deviation();
    return {first_touch_ - rest_, last + compliance_ratio_ * (last - roughness_->mean()) - rest_};
  }
  if (point_.normal_stiffness == 0.0) return {};
  return {-point_.rest_load / point_.normal_stiffness};
}

}  // namespace microslip::contact
