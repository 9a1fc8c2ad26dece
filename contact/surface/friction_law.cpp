#include "contact/surface/friction_law.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace microslip::contact {
namespace {

void require_not_negative(const char* quantity, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  std::ostringstream message;
  message.precision(17);
  message << "FrictionLaw: " << quantity << " = " << value << ", must be finite and at least 0";
  throw std::invalid_argument(message.str());
}

}  // namespace

FrictionLaw FrictionLaw::constant(double coefficient) {
  require_not_negative("friction coefficient", coefficient);
  return {Kind::constant, coefficient, coefficient, 0.0};
}

FrictionLaw FrictionLaw::exponential(double at_rest, double at_speed, double decay) {
  require_not_negative("friction coefficient at rest", at_rest);
  require_not_negative("friction coefficient at speed", at_speed);
  require_not_negative("decay", decay);
  const bool varies = decay > 0.0 && at_rest != at_speed;
  return {varies ? Kind::exponential : Kind::constant, at_rest, at_speed, decay};
}

FrictionLaw FrictionLaw::hyperbolic(double at_rest, double decay) {
  require_not_negative("friction coefficient at rest", at_rest);
  require_not_negative("decay", decay);
  const bool varies = decay > 0.0 && at_rest > 0.0;
  return {varies ? Kind::hyperbolic : Kind::constant, at_rest, 0.0, decay};
}

FrictionCoefficient FrictionLaw::at(double rate) const {
  switch (kind_) {
    case Kind::exponential: {
      const double fade = std::exp(-decay_ * rate);
      // Two terms that are not negative: (1) as printed would lose a μ₀ far below μ∞.
      return {at_rest_ * fade - at_speed_ * std::expm1(-decay_ * rate),
              (at_speed_ - at_rest_) * (decay_ * fade)};
    }
    case Kind::hyperbolic: {
      const double growth = 1.0 + decay_ * rate;
      return {at_rest_ / growth, -(at_rest_ / growth) * (decay_ / growth)};
    }
    case Kind::constant:
      break;
  }
  return {at_rest_, 0.0};
}

void FrictionLaw::grades(double fastest, std::vector<double>& speeds) const {
  speeds.clear();
  if (!is_rate_dependent()) return;
  constexpr double flat = 40.0;  // e⁻⁴⁰ is rounding
  constexpr double small = 1e6;
  constexpr double largest = std::numeric_limits<double>::max() / 64.0;
  for (double grade = 1.0; grade / decay_ < fastest; grade *= grade < small ? 4.0 : 64.0) {
    if (kind_ == Kind::exponential && grade > flat) grade = flat;
    speeds.push_back(grade / decay_);
    if ((kind_ == Kind::exponential && grade >= flat) || grade > largest) return;
  }
}

}  // namespace microslip::contact
