#include "support/cycle_cases.hpp"

#include <cmath>
#include <numbers>

namespace microslip::test {
namespace {

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double decades(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}
double sign(Random& random) { return uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0; }

double a(const CycleCase& c) { return std::hypot(c.motion.u_sin, c.motion.u_cos); }
double b(const CycleCase& c) { return std::hypot(c.motion.v_sin, c.motion.v_cos); }
double load_amplitude(const CycleCase& c) { return c.point.normal_stiffness * b(c); }
double bias_load(const CycleCase& c) {
  return c.point.rest_load + c.point.normal_stiffness * c.motion.v_mean;
}

void set_u(CycleCase& c, double amplitude, double angle) {
  c.motion.u_sin = amplitude * std::sin(angle);
  c.motion.u_cos = amplitude * std::cos(angle);
}
void set_v(CycleCase& c, double amplitude, double angle) {
  c.motion.v_sin = amplitude * std::sin(angle);
  c.motion.v_cos = amplitude * std::cos(angle);
}
void set_bias_load(CycleCase& c, double load) {
  c.motion.v_mean = 0.0;
  c.point.rest_load = load;
}

CycleCase drawn(Random& random, double spread) {
  CycleCase c;
  c.point.tangential_stiffness = decades(random, -spread, spread);
  c.point.normal_stiffness = decades(random, -spread, spread);
  c.point.friction_coefficient = decades(random, -1.0, 1.0);
  set_u(c, decades(random, -spread, spread), uniform(random, -4.0, 4.0));
  set_v(c, decades(random, -spread, spread), uniform(random, -4.0, 4.0));
  c.motion.u_mean = uniform(random, -1.0, 1.0) * a(c);
  c.motion.v_mean = uniform(random, -0.2, 0.2) * b(c);
  const double slip = c.point.tangential_stiffness * a(c) / c.point.friction_coefficient;
  c.point.rest_load = uniform(random, -1.2, 1.2) * load_amplitude(c) +
                      (uniform(random, 0.0, 1.0) < 0.5 ? uniform(random, 0.0, 1.5) * slip : 0.0);
  return c;
}

CycleCase separating(Random& random) {
  CycleCase c = drawn(random, 0.7);
  set_bias_load(c, uniform(random, -1.0, 1.0) * load_amplitude(c));
  return c;
}

// The part of the load that varies, times μ, of the size of the elastic force.
CycleCase comparable(Random& random) {
  CycleCase c = drawn(random, 1.0);
  const double size = c.point.tangential_stiffness * a(c) /
                      (c.point.friction_coefficient * c.point.normal_stiffness);
  set_v(c, size * decades(random, -0.5, 0.5), uniform(random, -4.0, 4.0));
  set_bias_load(c, uniform(random, -1.0, 2.0) * load_amplitude(c));
  return c;
}

CycleCase wide(Random& random) { return drawn(random, 6.0); }

CycleCase near_full_stick(Random& random) {
  CycleCase c = comparable(random);
  const double elastic = c.point.tangential_stiffness;
  const double coupled = c.point.friction_coefficient * c.point.normal_stiffness;
  const double Ps = elastic * c.motion.u_sin - coupled * c.motion.v_sin;
  const double Pc = elastic * c.motion.u_cos - coupled * c.motion.v_cos;
  const double Ns = elastic * c.motion.u_sin + coupled * c.motion.v_sin;
  const double Nc = elastic * c.motion.u_cos + coupled * c.motion.v_cos;
  const double limit = 0.5 * (std::hypot(Ps, Pc) + std::hypot(Ns, Nc));
  const double off = 1.0 + sign(random) * decades(random, -17.0, -1.0);
  set_bias_load(c, limit / c.point.friction_coefficient * off);
  return c;
}

CycleCase grazing(Random& random) {
  CycleCase c = comparable(random);
  const double off = 1.0 + sign(random) * decades(random, -17.0, -1.0);
  set_bias_load(c, sign(random) * load_amplitude(c) * off);
  return c;
}

double phase_offset(Random& random) {
  const double offsets[] = {0.0, 1e-16, -1e-16, 1e-12, 1e-8, -1e-4};
  return offsets[std::uniform_int_distribution<int>(0, 5)(random)];
}

CycleCase in_phase(Random& random) {
  CycleCase c = comparable(random);
  const double amplitude = sign(random) * b(c);
  const double cos = std::cos(phase_offset(random));
  const double sin = std::sin(phase_offset(random));
  c.motion.v_sin = amplitude / a(c) * (c.motion.u_sin * cos + c.motion.u_cos * sin);
  c.motion.v_cos = amplitude / a(c) * (c.motion.u_cos * cos - c.motion.u_sin * sin);
  return c;
}

CycleCase sine_in_phase(Random& random) {  // exactly: cosine parts are zero
  CycleCase c = comparable(random);
  c.motion.u_sin = a(c);
  c.motion.v_sin = sign(random) * b(c);
  c.motion.u_cos = 0.0;
  c.motion.v_cos = 0.0;
  return c;
}

CycleCase vanishing_slip_function(Random& random) {  // L₁ or L₂ = 0 or nearly
  CycleCase c = comparable(random);
  const double ratio = sign(random) * c.point.tangential_stiffness /
                       (c.point.friction_coefficient * c.point.normal_stiffness);
  const double off = uniform(random, 0.0, 1.0) < 0.5 ? 0.0 : decades(random, -17.0, -2.0);
  c.motion.v_sin = ratio * c.motion.u_sin * (1.0 + off);
  c.motion.v_cos = ratio * c.motion.u_cos * (1.0 + phase_offset(random));
  set_bias_load(c, uniform(random, -1.0, 1.5) * load_amplitude(c));
  return c;
}

CycleCase exact_vanishing(Random& random) {  // small integers: no rounding at all
  CycleCase c;
  c.point = {4.0, 2.0, 0.5, uniform(random, -2.0, 3.0)};
  c.motion.u_sin = 0.25;
  c.motion.v_sin = sign(random);
  return c;
}

// The rate of a slip function vanishes at touch-down.
CycleCase tie_at_touch_down(Random& random) {
  CycleCase c = comparable(random);
  const double load = uniform(random, -0.99, 0.99);
  set_bias_load(c, load * load_amplitude(c));
  const double touch = std::atan2(c.motion.v_sin, c.motion.v_cos) - std::acos(-load);
  const double v_rate = c.motion.v_sin * std::cos(touch) - c.motion.v_cos * std::sin(touch);
  const double u_rate = sign(random) * c.point.friction_coefficient * c.point.normal_stiffness /
                        c.point.tangential_stiffness * v_rate * (1.0 + phase_offset(random));
  const double u = uniform(random, -2.0, 2.0) * std::abs(u_rate);
  c.motion.u_sin = u_rate * std::cos(touch) + u * std::sin(touch);
  c.motion.u_cos = u * std::cos(touch) - u_rate * std::sin(touch);
  return c;
}

CycleCase still_tangentially(Random& random) {
  CycleCase c = comparable(random);
  const double amplitudes[] = {0.0, 1e-300, 5e-324, 1e-20};
  set_u(c, amplitudes[std::uniform_int_distribution<int>(0, 3)(random)], 1.0);
  return c;
}

CycleCase constant_load(Random& random) {
  CycleCase c = comparable(random);
  set_bias_load(c, uniform(random, -0.1, 1.3) * c.point.tangential_stiffness * a(c) /
                       c.point.friction_coefficient);
  const double amplitudes[] = {0.0, 1e-300, 1e-20};
  set_v(c, amplitudes[std::uniform_int_distribution<int>(0, 2)(random)], 2.0);
  return c;
}

CycleCase no_normal_spring(Random& random) {
  CycleCase c = comparable(random);
  set_bias_load(c, uniform(random, -0.1, 1.3) * c.point.tangential_stiffness * a(c) /
                       c.point.friction_coefficient);
  c.point.normal_stiffness = 0.0;
  return c;
}

CycleCase no_tangential_spring(Random& random) {
  CycleCase c = comparable(random);
  c.point.tangential_stiffness = 0.0;
  return c;
}

CycleCase frictionless(Random& random) {
  CycleCase c = comparable(random);
  c.point.friction_coefficient = 0.0;
  return c;
}

CycleCase no_preload(Random& random) {
  CycleCase c = comparable(random);
  set_bias_load(c, 0.0);
  return c;
}

CycleCase cancelling_preload(Random& random) {
  CycleCase c = comparable(random);
  const double load = uniform(random, -1.5, 2.0) * load_amplitude(c);
  c.point.rest_load = decades(random, 2.0, 6.0) * load_amplitude(c);
  c.motion.v_mean = (load - c.point.rest_load) / c.point.normal_stiffness;
  return c;
}

CycleCase scaled(CycleCase c, double factor) {
  for (double* x : {&c.motion.u_mean, &c.motion.u_sin, &c.motion.u_cos, &c.motion.v_mean,
                    &c.motion.v_sin, &c.motion.v_cos, &c.point.rest_load}) {
    *x *= factor;
  }
  return c;
}

CycleCase tiny(Random& random) {
  return scaled(comparable(random), decades(random, -100.0, -50.0));
}
CycleCase huge(Random& random) {
  CycleCase c = scaled(comparable(random), 1e3 * 1e12);
  return c;
}

CycleCase strong_friction(Random& random) {
  CycleCase c = separating(random);
  c.point.friction_coefficient = 1e6;
  return c;
}

CycleCase grazing_in_phase(Random& random) {
  CycleCase c = sine_in_phase(random);
  const double off = uniform(random, 0.0, 1.0) < 0.5 ? 0.0 : decades(random, -17.0, -8.0);
  set_bias_load(c, sign(random) * load_amplitude(c) * (1.0 + sign(random) * off));
  return c;
}

// Small exact numbers: every coincidence of limits occurs, without rounding of the input.
CycleCase lattice(Random& random) {
  const auto pick = [&](const std::vector<double>& values) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
  };
  const std::vector<double> parts{0.0, 0.5, -0.5, 1.0, -1.0, 2.0, -2.0};
  CycleCase c;
  c.point = {pick({0.0, 1.0, 1.0, 2.0}), pick({0.0, 1.0, 1.0, 2.0}), pick({0.0, 0.5, 1.0, 2.0}),
             pick({-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0})};
  c.motion = {pick(parts), pick(parts), pick(parts), pick({0.0, 0.0, 0.5, -1.0}),
              pick(parts), pick(parts)};
  return c;
}

CycleCase beside_lattice(Random& random) {
  CycleCase c = lattice(random);
  const double size = decades(random, -17.0, -8.0);
  for (double* x :
       {&c.motion.u_sin, &c.motion.u_cos, &c.motion.v_sin, &c.motion.v_cos, &c.point.rest_load}) {
    *x += uniform(random, -1.0, 1.0) * size;
  }
  return c;
}

}  // namespace

double friction_scale(const CycleCase& c) {
  return c.point.tangential_stiffness * a(c) + c.point.friction_coefficient * normal_scale(c);
}

double normal_scale(const CycleCase& c) { return std::abs(bias_load(c)) + load_amplitude(c); }

CycleCase generic_case(Random& random) { return drawn(random, 1.0); }

const std::vector<Stratum>& strata() {
  static const std::vector<Stratum> all{
      {"generic", generic_case},
      {"separating", separating},
      {"comparable", comparable},
      {"wide", wide},
      {"near_full_stick", near_full_stick},
      {"grazing", grazing},
      {"grazing_in_phase", grazing_in_phase},
      {"lattice", lattice},
      {"beside_lattice", beside_lattice},
      {"in_phase", in_phase},
      {"sine_in_phase", sine_in_phase},
      {"vanishing_slip_function", vanishing_slip_function},
      {"exact_vanishing", exact_vanishing},
      {"tie_at_touch_down", tie_at_touch_down},
      {"still_tangentially", still_tangentially},
      {"constant_load", constant_load},
      {"no_normal_spring", no_normal_spring},
      {"no_tangential_spring", no_tangential_spring},
      {"frictionless", frictionless},
      {"no_preload", no_preload},
      {"cancelling_preload", cancelling_preload},
      {"tiny", tiny},
      {"huge", huge},
      {"strong_friction", strong_friction},
  };
  return all;
}

}  // namespace microslip::test
