/// @file
/// The band that holds the slider of a point with one tangential direction, for any surface law,
/// and where it turns (theory sections 3, 4.6, 8, 10, 11).
///
///   w_P = u − r  ≤  s  ≤  w_N = u + r,      r = μ(ω|u'|) n/(k_u g)                             (1)
///
/// s moves only where a rising w_P or a falling w_N takes it along. (1) is smooth between edges:
/// touch-down and lift-off, kinks of a rough law, and with a coefficient that depends on the rate
/// where u' = 0; edges are sign changes of trigonometric polynomials (sign_changes.hpp), none is
/// missed. Where the coefficient changes within thin layers their stops are nodes as well, and
/// phases are counted from the place where the layer is (band_layers.hpp). Between nodes w_P' and
/// w_N' are polynomials in Chebyshev form to 1e-10, or far from zero, whose sign changes are
/// isolated, not looked for (smooth_signs.hpp). What remains are stretches on which both ends of
/// the band are monotone.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/harmonics.hpp"
#include "contact/line/band_kernels.hpp"
#include "contact/line/band_layers.hpp"
#include "contact/numerics/sign_changes.hpp"
#include "contact/numerics/smooth_signs.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact {

/// The motion at one phase and what the law makes of it; rates by θ.
struct BandInstant {
  double phase = 0.0;
  double position = 0.0;       ///< u without its mean [m]
  double velocity = 0.0;       ///< u' [m]
  double acceleration = 0.0;   ///< u'' [m]; only where friction depends on the rate
  double approach = 0.0;       ///< v [m]
  double approach_rate = 0.0;  ///< v' [m]
  SurfaceState surface;
  double reach = 0.0;              ///< r [m]
  double reach_by_approach = 0.0;  ///< ∂r/∂v
  double reach_by_rate = 0.0;      ///< ∂r/∂σ [s]
  double reach_rate = 0.0;         ///< r' [m]

  [[nodiscard]] double lower() const { return position - reach; }
  [[nodiscard]] double upper() const { return position + reach; }
};

/// Twelve instants of one stretch side by side, each as BandInstant has it.
struct BandInstants {
  BandMotion motion;
  BandValues friction_coefficient, friction_coefficient_by_rate;
  BandValues load, load_by_approach;
  BandValues stiffness_ratio, stiffness_ratio_by_approach;
  BandValues reach, reach_by_approach, reach_by_rate, reach_rate;
};

/// Places middle + half · share, counted from one anchor.
struct BandPlaces {
  BandAnchor anchor;
  double middle = 0.0;                 ///< offset [rad]
  double half = 0.0;                   ///< [rad], at most longest_band_arc
  const BandValues* shares = nullptr;  ///< in [−1, 1]
};

/// Where a stretch begins or ends.
struct BandNode {
  double phase = 0.0;
  double lower = 0.0;  ///< w_P [m]
  double upper = 0.0;  ///< w_N [m]
  bool edge = false;   ///< (1) has a kink
  bool turns = false;  ///< the kink of |u'|: u' = 0
  BandPlace place;     ///< the phase once more
};

/// From one node to the next, counted from one anchor.
struct BandStretch {
  BandAnchor anchor;
  double begin = 0.0;  ///< offset [rad]
  double end = 0.0;
};
[[nodiscard]] BandStretch stretch_between(const BandNode& from, const BandNode& to);

/// Contact from one node to the last.
struct ContactRun {
  bool touches_down = false;  ///< else there is no separation, and the run is the period [0, 2π]
  std::vector<BandNode> nodes;
};

/// Motion and law of one point; keeps its storage for the next motion.
class SliderBand {
 public:
  /// @param law      outlives the use.
  /// @param motion   u and v in columns 0 and 1; column 2 is not seen.
  void set(const SurfaceLaw& law, const Harmonics& motion, double frequency);

  /// @param phase  any [rad].
  [[nodiscard]] BandInstant at(double phase) { return at(BandPlace{{}, phase}); }
  [[nodiscard]] BandInstant at(const BandPlace& place);
  /// The same where |u'| has its kink: u' = 0 to the last bit for the law.
  [[nodiscard]] BandInstant at_turn(double phase);
  /// Twelve at once; what depends on the slider's spring is 0 without one.
  void at(const BandPlaces& places, BandInstants& now) { at(places, 0, nullptr, now); }
  /// @param basis  → 1, sin θ, cos θ, … up to n_basis, [2 n_basis + 1][n_band_nodes].
  void at(const BandPlaces& places, int n_basis, double* basis, BandInstants& now);
  /// 1, sin θ, cos θ, … of the last single instant.
  [[nodiscard]] const Eigen::VectorXd& basis() const { return basis_; }

  /// Runs of contact in order of time, found again with every call.
  [[nodiscard]] const std::vector<ContactRun>& find_runs();

  [[nodiscard]] const SurfaceLaw& law() const { return *law_; }
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] int n_harmonics() const { return static_cast<int>(u_.size() / 2); }
  /// Mean of u [m].
  [[nodiscard]] double position_mean() const { return position_mean_; }
  /// Bounds of k_u |u| + μ n and of n [Pa], the mean of u apart.
  [[nodiscard]] double friction_size() const { return friction_size_; }
  [[nodiscard]] double load_size() const { return load_size_; }
  /// Of the rates of w by θ, a bound where the coefficient is constant [m].
  [[nodiscard]] double rate_size() const { return size_; }
  [[nodiscard]] bool has_spring() const { return law_->first_stiffness() > 0.0; }

 private:
  /// Where the motion of a phase is known.
  void set_motion(double phase, BandInstant& now);
  void set_band(double speed, BandInstant& now);
  void set_surface(BandInstants& now) const;
  void set_band(BandInstants& now) const;
  [[nodiscard]] BandNode edge_at(double phase, bool touches);
  [[nodiscard]] std::vector<BandNode> inner_edges(double begin, double end);
  void find_edges();
  void add_run(double begin, double end, bool touches_down);
  void add_turns(const BandNode& from, const BandNode& to, std::vector<BandNode>& nodes);

  const SurfaceLaw* law_ = nullptr;
  double frequency_ = 0.0;
  double position_mean_ = 0.0;
  double size_ = 0.0;  // of rates of w [m]
  double friction_size_ = 0.0;
  double load_size_ = 0.0;
  Eigen::VectorXd u_, u_rate_, u_second_, v_, v_rate_;
  Eigen::VectorXd basis_;
  TrigonometricPolynomial polynomial_;
  std::vector<SignChange> changes_;
  std::vector<SignChange> contact_;
  std::vector<double> edges_;  // of a rough law, in [0, 2π]
  BandLayers layers_;
  std::vector<SmoothSign> signs_;
  std::vector<ContactRun> runs_;
};

}  // namespace microslip::contact
