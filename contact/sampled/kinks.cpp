#include "contact/sampled/kinks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/sampled/step_spline.hpp"

namespace microslip::contact::sampled {
namespace {

double at(const double* column, std::size_t i) { return column[i * block_size]; }

/// The step in which a run ends.
class Step {
 public:
  Step(const SmoothPoint& point, const LineColumns& columns, std::size_t now, std::size_t n)
      : point_(point), columns_(columns), now_(now), before_((now + n - 1) % n), n_(n) {}

  [[nodiscard]] RunEnd end(const Run& from, const Run& to) const {
    if (from.state == InstantState::separated) return {{}, closes()};
    if (to.state == InstantState::separated) return opens(from.state);
    if (slips(to.state) || to.turned) return {begins_to_slip(from.state), {}};
    return {};
  }

 private:
  /// Where it slips that way already it goes on until it turns.
  [[nodiscard]] Kink begins_to_slip(InstantState from) const {
    const double slider = at(columns_.slider, before_);
    const double up = std::min(slider, at(columns_.high, now_));
    const double down = std::max(slider, at(columns_.low, now_));
    if (from != InstantState::positive_slip && band_end(now_, -1.0) > up) return slip(1.0, up);
    if (from != InstantState::negative_slip && band_end(now_, 1.0) < down) return slip(-1.0, down);
    return {};
  }

  [[nodiscard]] Kink slip(double side, double slider) const {
    Kink kink = kink_of(Kink::Kind::slips);
    const double first = band_end(before_, -side);
    kink.side = side;
    kink.rise = band_end(now_, -side) - first;
    place(kink, slider - first);
    damp(kink, end_of_band(point_, columns_, -side, now_, n_), side);
    kink.friction = -point_.tangential_stiffness *
                    (kink.weight() * kink.rise - kink.damping * kink.slope / 12.0);
    return kink;
  }

  /// In line to the friction at the instant behind, whatever it does there.
  [[nodiscard]] Kink closes() const {
    Kink kink = contact(Kink::Kind::closes, 1.0);
    const double k_u = point_.tangential_stiffness;
    const StepSpline u(around_step(columns_.u, now_, n_));
    kink.force = k_u * (at(columns_.u, now_) - at(columns_.slider, now_));
    kink.stick_slope = u.slope_at(kink.share);
    kink.stick_bend = u.bend_at(kink.share);
    const double limit = point_.friction_coefficient * std::max(kink.slope, 0.0);
    const double pull = k_u * kink.stick_slope;
    if (std::abs(pull) >= limit) kink.side = pull < 0.0 ? -1.0 : 1.0;
    const double late = kink.side == 0.0 ? pull : kink.side * limit;
    kink.friction = 0.5 * kink.share * kink.force - kink.damping * late / 12.0;
    return kink;
  }

  [[nodiscard]] RunEnd opens(InstantState from) const {
    RunEnd end{{}, contact(Kink::Kind::opens, -1.0)};
    Kink& kink = end.contact;
    kink.side = from == InstantState::negative_slip ? -1.0 : 1.0;
    if (from == InstantState::stick) {
      const double slider = at(columns_.slider, before_);
      const double u =
          at(columns_.u, before_) + kink.share * (at(columns_.u, now_) - at(columns_.u, before_));
      kink.side = u < slider ? -1.0 : 1.0;
      end.slip = slip(kink.side, slider);
    }
    kink.friction = kink.side * point_.friction_coefficient * kink.load;
    return end;
  }

  /// The load.
  [[nodiscard]] Kink contact(Kink::Kind kind, double direction) const {
    Kink kink = kink_of(kind);
    const std::array<double, 4> r = around_step(columns_.closeness, now_, n_);
    kink.rise = r[2] - r[1];
    place(kink, -r[1]);
    damp(kink, r, direction);
    kink.load = direction * (kink.weight() * kink.rise - kink.damping * kink.slope / 12.0);
    return kink;
  }

  [[nodiscard]] Kink kink_of(Kink::Kind kind) const {
    return {.kind = kind, .before = before_, .now = now_};
  }

  static void place(Kink& kink, double way) {
    kink.share = kink.rise == 0.0 ? 0.5 : std::clamp(way / kink.rise, 0.0, 1.0);
  }

  /// The slope of a signal at the kink, damped to 0 where it does not go in the direction it met
  /// the kink.
  static void damp(Kink& kink, const std::array<double, 4>& w, double direction) {
    const StepSpline signal(w);
    const double x = kink.share;
    kink.slope = signal.slope_at(x);
    kink.bend = signal.bend_at(x);
    const double rise = std::max(direction * kink.slope, 0.0);
    // That of the spline jumps from one step to the next.
    const double bend = (1.0 - x) * (w[0] - 2.0 * w[1] + w[2]) + x * (w[1] - 2.0 * w[2] + w[3]);
    kink.damping = rise >= std::abs(bend) ? 1.0 : rise / std::abs(bend);
    if (rise == 0.0) kink.damping = 0.0;
  }

  [[nodiscard]] double band_end(std::size_t i, double side) const {
    return at(columns_.u, i) + side * point_.compliance() * at(columns_.closeness, i);
  }

  const SmoothPoint& point_;
  const LineColumns& columns_;
  std::size_t now_;
  std::size_t before_;
  std::size_t n_;
};

void add(double* column, const Kink& kink, double error) {
  column[kink.before * block_size] -= error * (1.0 - kink.share);
  column[kink.now * block_size] -= error * kink.share;
}

}  // namespace

std::array<double, 4> end_of_band(const SmoothPoint& point, const LineColumns& columns, double side,
                                  std::size_t now, std::size_t n) {
  std::array<double, 4> w = around_step(columns.u, now, n);
  const std::array<double, 4> r = around_step(columns.closeness, now, n);
  for (std::size_t j = 0; j < w.size(); ++j) w[j] += side * point.compliance() * r[j];
  return w;
}

void find_kinks(const SmoothPoint& point, const std::vector<Run>& runs, const LineColumns& columns,
                std::size_t n, std::vector<RunEnd>& ends) {
  ends.clear();
  if (runs.size() < 2) return;
  for (std::size_t j = 0; j < runs.size(); ++j) {
    const Run& next = runs[j + 1 < runs.size() ? j + 1 : 0];
    ends.push_back(Step(point, columns, next.begin, n).end(runs[j], next));
  }
}

void mend(const std::vector<RunEnd>& ends, double* friction, double* normal) {
  for (const RunEnd& end : ends) {
    for (const Kink& kink : {end.slip, end.contact}) {
      if (kink.kind == Kink::Kind::none) continue;
      add(friction, kink, kink.friction);
      add(normal, kink, kink.load);
    }
  }
}

}  // namespace microslip::contact::sampled
