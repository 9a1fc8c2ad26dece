#include "tests/support/sampled/sampled_history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/sampled/sampled_force.hpp"

namespace microslip::contact {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

bool is_slip(ContactState state) {
  return state == ContactState::positive_slip || state == ContactState::negative_slip;
}

double sign_of(ContactState state) { return state == ContactState::negative_slip ? -1.0 : 1.0; }

// End of the band that pushes in a slip state, counted in that direction.
double pushing_end(const ContactSample& at, ContactState state) {
  return sign_of(state) * at.u - at.half_width;
}

// Where the state of j − 1 becomes that of j, as a share of the step from j − 1.
class Change {
 public:
  Change(const SampledMotion& motion, const SampledSlider& slider, int j)
      : motion_(motion), slider_(slider), j_(j), i_(motion.before(j)) {}

  [[nodiscard]] double share() const {
    const ContactState before = slider_[i_].state;
    const ContactState after = slider_[j_].state;
    if (before == ContactState::separated || after == ContactState::separated) {
      return motion_.touch_share(j_);
    }
    if (before == ContactState::stick) {
      return onset(after);
    }
    return after == ContactState::stick ? end(before) : 0.5;
  }

 private:
  // The band reaches the slider.
  [[nodiscard]] double onset(ContactState slip) const {
    const double rest = sign_of(slip) * slider_[i_].slider;
    const double before = rest - pushing_end(motion_[i_], slip);
    const double after = pushing_end(motion_[j_], slip) - rest;
    return before + after > 0.0 ? std::clamp(before / (before + after), 0.0, 1.0) : 0.5;
  }

  // The pushing end turns about the last sample of slip: its speed in the middle of the step before
  // that and of the step after.
  [[nodiscard]] double end(ContactState slip) const {
    const double first = pushing_end(motion_[motion_.before(i_)], slip);
    const double middle = pushing_end(motion_[i_], slip);
    const double speed_before = middle - first;
    const double speed_after = pushing_end(motion_[j_], slip) - middle;
    const double fall = speed_before - speed_after;
    return fall > 0.0 ? std::clamp(speed_before / fall - 0.5, -0.5, 0.5) : 0.0;
  }

  const SampledMotion& motion_;
  const SampledSlider& slider_;
  int j_;
  int i_;
};

double wrapped(double phase) {
  const double turned = phase - two_pi * std::floor(phase / two_pi);
  return turned >= 0.0 && turned < two_pi ? turned : 0.0;
}

// What the slider does on one step in contact: the way and the mean of μ n and n over it.
void add_step(const SampledMotion& motion, const SampledSlider& slider, int j, SampledWork& work) {
  const int i = motion.before(j);
  const bool was_open = slider[i].state == ContactState::separated;
  const bool is_open = slider[j].state == ContactState::separated;
  if (was_open && is_open) {
    return;
  }
  double from = slider[i].slider;
  double to = slider[j].slider;
  if (was_open || is_open) {
    const double x = motion.touch_share(j);
    const double touching = (1.0 - x) * motion[i].u + x * motion[j].u;
    (was_open ? from : to) = touching;
  }
  const double way = std::abs(to - from);
  work.slip_distance += way;
  work.normal_slip += 0.5 * way * (motion[i].load + motion[j].load);
  work.dissipated_energy += 0.5 * way * (motion[i].limit() + motion[j].limit());
}

}  // namespace

std::vector<CycleSegment> sampled_segments(const SampledMotion& motion, const SampledSlider& slider,
                                           bool has_spring) {
  const auto state = [&](int j) {
    const ContactState now = slider[j].state;
    return !has_spring && is_slip(now) ? ContactState::stick : now;
  };
  std::vector<CycleSegment> segments;
  for (int j = 0; j < motion.size(); ++j) {
    const int i = motion.before(j);
    if (state(i) == state(j)) {
      continue;
    }
    const double share = has_spring || !is_slip(slider[i].state) || !is_slip(slider[j].state)
                             ? Change(motion, slider, j).share()
                             : 0.5;
    segments.push_back({state(j), wrapped(motion.step() * (j - 1 + share)), 0.0});
  }
  if (segments.empty()) {
    return {{state(0), 0.0, two_pi}};
  }
  std::sort(segments.begin(), segments.end(),
            [](const CycleSegment& a, const CycleSegment& b) { return a.start < b.start; });
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const bool last = k + 1 == segments.size();
    segments[k].length =
        (last ? segments[0].start + two_pi : segments[k + 1].start) - segments[k].start;
  }
  std::erase_if(segments, [](const CycleSegment& s) { return s.length <= 0.0; });
  return segments;
}

SampledWork sampled_work(const SampledMotion& motion, const SampledSlider& slider) {
  SampledWork work;
  for (int j = 0; j < motion.size(); ++j) {
    add_step(motion, slider, j, work);
  }
  return work;
}

PointInstant sampled_instant(const SurfaceLaw& law, const Harmonics& motion,
                             const SampledMotion& samples, const SampledSlider& slider,
                             double phase) {
  const double position = wrapped(phase) / samples.step();
  const int i = std::min(static_cast<int>(position), samples.size() - 1);
  PointInstant now;
  now.motion = motion.at(phase);
  double rate = 0.0;
  for (int h = 1; h <= motion.n_harmonics(); ++h) {
    rate +=
        h * (motion.sine(h)[0] * std::cos(h * phase) - motion.cosine(h)[0] * std::sin(h * phase));
  }
  const ContactSample at =
      contact_sample(law, samples.frequency(), now.motion[0], rate, now.motion[1]);
  SliderSample here = slider[i];
  if (at.is_open()) {
    here = {ContactState::separated, at.u, {}};
  } else {
    if (here.state == ContactState::separated) {
      const double x = samples.touch_share((i + 1) % samples.size());
      here.slider = (1.0 - x) * samples[i].u + x * samples[(i + 1) % samples.size()].u;
    }
    here = clipped(here, at, {}, {});
  }
  const bool has_spring = law.first_stiffness() > 0.0;
  now.state = !has_spring && is_slip(here.state) ? ContactState::stick : here.state;
  const double friction = here.state == ContactState::separated ? 0.0 : sampled_friction(at, here);
  now.traction = {std::clamp(friction, -at.limit(), at.limit()),
                  here.state == ContactState::separated ? 0.0 : at.load, 0.0};
  now.slider = {has_spring ? here.slider : 0.0, now.motion[2]};
  return now;
}

}  // namespace microslip::contact
