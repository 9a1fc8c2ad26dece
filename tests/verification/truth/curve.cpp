#include "tests/verification/truth/curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "tests/verification/truth/gmres.hpp"

namespace microslip::truth {
namespace {

using Eigen::VectorXd;

constexpr double hertz = 2.0 * std::numbers::pi;
constexpr double frequency_unit =
    5.0 * hertz;  // a change that counts as much as doubling the motion
constexpr int most_newton = 12;
constexpr int most_vectors = 150;
constexpr double linear_tolerance = 1e-4;

/// The place (x/scale, ω/unit) of a point: arclength is measured here.
struct Place {
  VectorXd x;
  double w = 0.0;
  [[nodiscard]] double dot(const Place& o) const { return x.dot(o.x) + w * o.w; }
};
Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.w - b.w}; }
Place operator*(double s, const Place& a) { return {s * a.x, s * a.w}; }

/// Newton on [R; t·(y − y_predicted)] in scaled unknowns.
class Corrector {
 public:
  Corrector(Balance& balance, double scale, double tolerance)
      : balance_(balance), scale_(scale), tolerance_(tolerance) {}

  /// @param tangent  direction along which the predicted place is kept; (0, 1) fixes the frequency.
  [[nodiscard]] bool solve(Place y, const Place& tangent, CurvePoint& out) {
    const Place predicted = y;
    double before = std::numeric_limits<double>::infinity();
    out.gmres = 0;
    for (int i = 0; i < most_newton; ++i) {
      const VectorXd x = scale_ * y.x;
      const VectorXd r = balance_.residual(x, frequency_unit * y.w) / scale_;
      const double off = tangent.dot(y - predicted);
      const double size = r.norm() / y.x.norm();
      if (size <= tolerance_) return finish(x, y.w, i, out);
      if (!(size < 1e3 * before) || i + 1 == most_newton) return false;
      before = std::min(before, size);
      if (i % 4 == 0) balance_.prepare();
      const Place step = newton_step(r, off, tangent, out.gmres);
      if (!(step.x.norm() < 2.0 * y.x.norm() + 1.0)) return false;
      y.x -= step.x;
      y.w -= step.w;
    }
    return false;
  }

 private:
  bool finish(const VectorXd& x, double w, int iterations, CurvePoint& out) {
    const Balance::Output output = balance_.output();
    out = {x,          frequency_unit * w, output.half_peak_to_peak, output.first_harmonic,
           iterations, out.gmres};
    return true;
  }

  Place newton_step(const VectorXd& r, double off, const Place& t, int& count) {
    const VectorXd rate = balance_.by_omega() * (frequency_unit / scale_);
    const VectorXd P_rate = balance_.precondition(rate);
    const double schur = t.w - t.x.dot(P_rate);
    const auto n = r.size();
    const Operator A = [&](const VectorXd& z) {
      VectorXd result(n + 1);
      result << balance_.tangent(z.head(n)) + z[n] * rate, t.x.dot(z.head(n)) + t.w * z[n];
      return result;
    };
    const Operator P = [&](const VectorXd& z) {
      const VectorXd Pz = balance_.precondition(z.head(n));
      VectorXd result(n + 1);
      result[n] = (z[n] - t.x.dot(Pz)) / schur;
      result.head(n) = Pz - result[n] * P_rate;
      return result;
    };
    VectorXd b(n + 1);
    b << r, off;
    const GmresResult solved = gmres(A, P, b, linear_tolerance, most_vectors);
    count += solved.iterations;
    return {solved.x.head(n), solved.x[n]};
  }

  Balance& balance_;
  double scale_;
  double tolerance_;
};

Place place(const CurvePoint& point, double scale) {
  return {point.x / scale, point.omega / frequency_unit};
}

/// Vertex of the parabola through three values at s₀ < s₁ < s₂.
double vertex(const std::array<double, 3>& s, const std::array<double, 3>& y) {
  const double a = (y[1] - y[0]) / (s[1] - s[0]);
  const double b = (y[2] - y[1]) / (s[2] - s[1]);
  const double c = (b - a) / (s[2] - s[0]);
  return 0.5 * (s[0] + s[1]) - 0.5 * a / c;
}

/// The local maximum between three neighbours, by two parabolas along the chord from the first to
/// the last.
CurvePoint refine(Balance& balance, const CurveOptions& options, std::array<CurvePoint, 3> p) {
  const double scale = p[1].x.norm();
  for (int pass = 0; pass < 3; ++pass) {
    const Place chord = place(p[2], scale) - place(p[0], scale);
    const Place t = (1.0 / std::sqrt(chord.dot(chord))) * chord;
    std::array<double, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) s[i] = t.dot(place(p[i], scale) - place(p[0], scale));
    const double at = vertex(s, {p[0].amplitude, p[1].amplitude, p[2].amplitude});
    if (!(at > s[0] && at < s[2]) || std::abs(at - s[1]) < 1e-4 * s[2]) break;
    const std::size_t side = at < s[1] ? 0 : 1;
    const double share = (at - s[side]) / (s[side + 1] - s[side]);
    const Place start = (1.0 - share) * place(p[side], scale);
    Place guess = share * place(p[side + 1], scale);
    guess.x += start.x;
    guess.w += start.w;
    CurvePoint found;
    if (!Corrector(balance, scale, options.tolerance).solve(guess, t, found)) break;
    if (found.amplitude > p[1].amplitude) {
      (at < s[1] ? p[2] : p[0]) = p[1];
      p[1] = found;
    } else {
      (at < s[1] ? p[0] : p[2]) = found;
    }
  }
  return p[1];
}

}  // namespace

CurvePoint solve_at(Balance& balance, const VectorXd& x, double omega, double tolerance) {
  CurvePoint result;
  const double scale = std::max(1e-7, x.norm());
  const Place t{VectorXd::Zero(x.size()), 1.0};
  if (!Corrector(balance, scale, tolerance).solve({x / scale, omega / frequency_unit}, t, result)) {
    throw std::runtime_error("truth: Newton does not converge at a fixed frequency");
  }
  return result;
}

Curve trace(Balance& balance, const CurveOptions& options) {
  Curve curve;
  const double direction = options.to_hz > options.from_hz ? 1.0 : -1.0;
  const VectorXd zero = VectorXd::Zero(balance.n_unknowns());
  const VectorXd at_rest = balance.residual(zero, hertz * options.from_hz);
  balance.prepare();  // at rest a pressed face sticks all over: this is the linear response
  const VectorXd linear = -balance.precondition(at_rest);
  curve.points.push_back(solve_at(balance, linear, hertz * options.from_hz, options.tolerance));
  double step = 0.05;
  while (static_cast<int>(curve.points.size()) < options.most_points) {
    const CurvePoint& last = curve.points.back();
    const double scale = last.x.norm();
    Place t{VectorXd::Zero(zero.size()), direction};
    if (curve.points.size() > 1) t = place(last, scale) - place(*(curve.points.end() - 2), scale);
    t = (1.0 / std::sqrt(t.dot(t))) * t;
    Place guess = place(last, scale);
    guess.x += step * t.x;
    guess.w += step * t.w;
    CurvePoint next;
    if (!Corrector(balance, scale, options.tolerance).solve(guess, t, next)) {
      step *= 0.4;
      if (step < options.smallest_step) return curve;
      continue;
    }
    if (options.verbose) {
      std::fprintf(stderr, "  %9.4f Hz %10.4f um  step %.4f newton %d gmres %d\n",
                   next.omega / hertz, 1e6 * next.amplitude, step, next.newton, next.gmres);
    }
    curve.points.push_back(std::move(next));
    const auto n = curve.points.size();
    const auto& p = curve.points;
    if (n > 2 && p[n - 2].amplitude > p[n - 3].amplitude &&
        p[n - 2].amplitude > p[n - 1].amplitude) {
      curve.peaks.push_back(refine(balance, options, {p[n - 3], p[n - 2], p[n - 1]}));
    }
    const double wish = p.back().newton <= 3 ? 1.5 : (p.back().newton <= 5 ? 1.0 : 0.6);
    step = std::min(options.largest_step, step * wish);
    if (direction * (p.back().omega / hertz - options.to_hz) >= 0.0) {
      curve.complete = true;
      return curve;
    }
    if (direction * (p.back().omega / hertz - options.from_hz) < -1.0) return curve;
  }
  return curve;
}

}  // namespace microslip::truth
