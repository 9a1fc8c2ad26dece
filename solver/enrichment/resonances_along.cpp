#include "solver/enrichment/resonances_along.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/dense.hpp"
#include "solver/balance/harmonic_balance.hpp"

namespace microslip::solver {
namespace {

double first_harmonic(const ResponsePoint& point) {
  return std::hypot(point.q.sine().norm(), point.q.cosine().norm());
}

/// The curve where it passes a frequency.
class Passages {
 public:
  Passages(HarmonicBalance& balance, const ResponseCurve& curve, int highest)
      : balance_(balance), curve_(curve), highest_(highest) {}

  /// Of harmonic k of the contact's force along a shape, the largest of all passages.
  [[nodiscard]] double drive(double frequency, int k, const Eigen::VectorXd& shape) {
    constexpr int most = 4;  // of a curve that passes it again and again
    double largest = 0.0;
    int n = 0;
    for (std::size_t i = 0; i + 1 < curve_.points.size() && n < most; ++i) {
      const ResponsePoint& a = curve_.points[i];
      const ResponsePoint& b = curve_.points[i + 1];
      const auto [low, high] = std::minmax(a.frequency, b.frequency);
      if (!(low <= frequency && frequency < high)) continue;
      const double part = (frequency - a.frequency) / (b.frequency - a.frequency);
      const Eigen::VectorXd x =
          (1.0 - part) * balance_.unknowns(a.q) + part * balance_.unknowns(b.q);
      const Harmonics force = balance_.contact_force(x, frequency, highest_);
      largest = std::max(largest, std::hypot(force.sine(k).dot(shape), force.cosine(k).dot(shape)));
      ++n;
    }
    return largest;
  }

 private:
  HarmonicBalance& balance_;
  const ResponseCurve& curve_;
  int highest_;
};

}  // namespace

std::vector<int> resonances_along(const Scene& scene, const ContinuationOptions& range,
                                  const HarmonicSet& set, const ResponseCurve& curve) {
  if (!scene.contact || curve.points.size() < 2 || !curve.certificate.empty()) return {};
  HarmonicBalance balance(scene, set);
  const int highest = std::max({set.highest(), range.n_harmonics, range.highest_resonance});
  const auto top = std::ranges::max_element(curve.points, {}, &ResponsePoint::amplitude);
  const double of_motion = range.harmonic_tolerance * first_harmonic(*top);
  const double of_output = range.harmonic_tolerance * top->amplitude;
  const auto [low, high] = std::minmax(range.frequency_begin, range.frequency_end);
  const Eigen::Index n = scene.n_modes();
  const Eigen::VectorXd rates = 2.0 * scene.damping_ratio.cwiseProduct(scene.natural_frequency);
  Passages passages(balance, curve, highest);
  std::set<int> orders;
  for (Eigen::MatrixXd stiffness :
       {Eigen::MatrixXd(Eigen::MatrixXd::Zero(n, n)), balance.stuck_stiffness()}) {
    stiffness.diagonal() += scene.natural_frequency.cwiseAbs2();
    const auto modes = contact::symmetric_pairs(stiffness);
    if (!modes) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double natural = std::sqrt(std::max(0.0, modes->values[j]));
      const Eigen::VectorXd shape = modes->vectors.col(j);
      const double seen = std::abs(shape.dot(scene.output));
      const double rate = shape.cwiseAbs2().dot(rates);  // 2 ζ_j ω_j
      for (int k = 2; k <= highest; ++k) {
        const double frequency = natural / k;
        const bool asked = frequency > low && frequency < high && !set.contains(k);
        if (!asked || orders.contains(k)) continue;
        const double answer = passages.drive(frequency, k, shape) / (rate * natural);
        if (answer > of_motion || seen * answer > of_output) orders.insert(k);
      }
    }
  }
  return {orders.begin(), orders.end()};
}

}  // namespace microslip::solver
