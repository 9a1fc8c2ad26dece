#include "contact/line/band_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/phase.hpp"

namespace microslip::contact {
namespace {

/// Where u' is small next to its terms the digits of a double are not those of the sum.
double value_in_long_double(const TrigonometricPolynomial& p, double phase) {
  long double sum = 0.0L;
  for (int h = 1; h <= p.degree(); ++h) {
    const long double x = static_cast<long double>(h) * static_cast<long double>(phase);
    sum += p.sin(h) * std::sin(x) + p.cos(h) * std::cos(x);
  }
  return static_cast<double>(sum);
}

}  // namespace

void BandLayers::set(const Eigen::VectorXd& u, const FrictionLaw& friction, double frequency) {
  stands_.clear();
  stops_.clear();
  anchors_.clear();
  if (!friction.is_rate_dependent()) return;
  const int H = static_cast<int>(u.size() / 2);
  rate_.reset(H);
  rate_coefficients_.assign(static_cast<std::size_t>(2 * H + 1), 0.0);
  for (int h = 1; h <= H; ++h) {
    rate_.set(h, -h * u[2 * h], h * u[2 * h - 1]);
    rate_coefficients_[static_cast<std::size_t>(2 * h - 1)] = rate_.sin(h);
    rate_coefficients_[static_cast<std::size_t>(2 * h)] = rate_.cos(h);
  }
  find_sign_changes(rate_, changes_);
  for (const SignChange& change : changes_) stands_.push_back(change.phase);
  friction.grades(frequency * rate_.bound(0), grades_);
  if (grades_.empty()) return;
  find_anchors(grades_.back() / frequency);
  for (std::size_t i = 0; i < turning_.size(); ++i) {
    const bool last = i + 1 == turning_.size();
    const BandAnchor& a = turning_[i];
    const BandAnchor& b = last ? turning_.front() : turning_[i + 1];
    const double length = b.phase - a.phase + (last ? two_pi : 0.0);
    const bool rises = std::abs(a.velocity) <= std::abs(b.velocity);
    add_stops(rises ? a : b, rises ? length : -length, std::abs((rises ? b : a).velocity),
              frequency);
  }
}

void BandLayers::find_anchors(double slowest) {
  turning_.clear();
  for (const double phase : stands_) turning_.push_back({phase, 0.0, true});
  second_.set_derivative(rate_);
  find_sign_changes(second_, changes_);
  for (const SignChange& change : changes_) {
    turning_.push_back({change.phase, value_in_long_double(rate_, change.phase), true});
  }
  std::sort(turning_.begin(), turning_.end(),
            [](const BandAnchor& a, const BandAnchor& b) { return a.phase < b.phase; });
  for (const BandAnchor& anchor : turning_) {
    if (std::abs(anchor.velocity) < slowest) anchors_.push_back(anchor);
  }
}

void BandLayers::add_stops(const BandAnchor& anchor, double length, double fastest,
                           double frequency) {
  for (const double grade : grades_) {
    const double speed = grade / frequency;
    if (speed <= std::abs(anchor.velocity)) continue;
    if (speed >= fastest) break;
    stops_.push_back({anchor, offset_of(anchor, length, speed)});
  }
}

// Grades need not be met closely: Newton's method within a bracket, to a twentieth of the speed.
double BandLayers::offset_of(const BandAnchor& anchor, double length, double speed) const {
  double low = 0.0;
  double high = length;
  const double slope = std::abs(second_.value(anchor.phase));
  double x = slope > 0.0 ? std::copysign((speed - std::abs(anchor.velocity)) / slope, length)
                         : 0.5 * length;
  for (int i = 0; i < 1100; ++i) {  // halving passes all exponents of a double
    if (!((x - low) * (high - x) > 0.0)) x = 0.5 * (low + high);
    const double beyond = std::abs(velocity({anchor, x})) - speed;
    if (std::abs(beyond) <= 0.05 * speed || x == low || x == high) break;
    (beyond > 0.0 ? high : low) = x;
    x -= std::copysign(1.0, length) * beyond / std::abs(second_.value(anchor.phase + x));
  }
  return x;
}

BandPlace BandLayers::place(double phase) const {
  BandPlace nearest{{}, phase};
  double distance = std::numeric_limits<double>::infinity();
  for (const BandAnchor& anchor : anchors_) {
    const double turns = std::round((phase - anchor.phase) / two_pi);
    const double from = anchor.phase + two_pi * turns;
    if (!(std::abs(phase - from) < distance)) continue;
    distance = std::abs(phase - from);
    nearest = {{from, anchor.velocity, true}, phase - from};
  }
  return nearest;
}

bool BandLayers::is_near(const BandPlace& place) const {
  return place.anchor.layered && std::abs(place.offset) * rate_.degree() < 0.25;
}

void BandLayers::correct(const BandAnchor& anchor, const BandValues& offsets,
                         BandValues& velocity) const {
  const auto near = [&](double offset) { return is_near({anchor, offset}); };
  if (!anchor.layered || std::ranges::none_of(offsets, near)) return;
  BandValues closer;
  band_kernels().layer(rate_coefficients_.data(), rate_.degree(),
                       {std::sin(anchor.phase), std::cos(anchor.phase)}, anchor.velocity,
                       offsets.data(), closer.data());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (near(offsets[i])) velocity[i] = closer[i];
  }
}

double BandLayers::velocity(const BandPlace& place) const {
  const double half = 0.5 * place.offset;
  const double middle = place.anchor.phase + half;
  const double s1 = std::sin(half);
  const double c1 = std::cos(half);
  const double S1 = std::sin(middle);
  const double C1 = std::cos(middle);
  double s = s1;
  double c = c1;
  double S = S1;
  double C = C1;
  double sum = 0.0;
  for (int h = 1; h <= rate_.degree(); ++h) {
    sum += s * (rate_.sin(h) * C - rate_.cos(h) * S);
    double next = s * c1 + c * s1;
    c = c * c1 - s * s1;
    s = next;
    next = S * C1 + C * S1;
    C = C * C1 - S * S1;
    S = next;
  }
  return place.anchor.velocity + 2.0 * sum;
}

}  // namespace microslip::contact
