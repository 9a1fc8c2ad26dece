/// @file
/// Layers of time in which a coefficient that depends on the rate changes: next to where the motion
/// turns, and where it nearly stands.
///
/// |u'| is monotone between the zeros of u' and u''. From the smaller end of such an interval, its
/// anchor, stops are set where |u'| passes the grades of the law (friction_law.hpp); between two of
/// them μ is a polynomial of low degree however thin the layer is. Next to an anchor a the speed is
///
///   u'(a + x) = u'(a) + Σ_h 2h sin(hx/2) [ −u_sh sin h(a + x/2) − u_ch cos h(a + x/2) ]        (1)
///
/// which keeps its digits where a phase counted from 0 would lose them;
/// x is what stops are told by.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/line/band_kernels.hpp"
#include "contact/numerics/sign_changes.hpp"
#include "contact/numerics/trigonometric_polynomial.hpp"
#include "contact/surface/friction_law.hpp"

namespace microslip::contact {

/// Where phases are counted from; without `layered` it is 0 and (1) is not used.
struct BandAnchor {
  double phase = 0.0;     ///< a [rad]
  double velocity = 0.0;  ///< u'(a) [m]
  bool layered = false;
};

struct BandPlace {
  BandAnchor anchor;
  double offset = 0.0;  ///< x [rad]

  [[nodiscard]] double phase() const { return anchor.phase + offset; }
};

class BandLayers {
 public:
  /// @param u  coefficients of u: mean, sin, cos, sin 2, …; the mean is not seen.
  void set(const Eigen::VectorXd& u, const FrictionLaw& friction, double frequency);

  /// Sign changes of u' [rad], in [0, 2π]; none where the coefficient is constant.
  [[nodiscard]] const std::vector<double>& stands() const { return stands_; }
  /// Anchors apart; in [0, 2π] or just outside. None where the coefficient changes too slowly to
  /// matter.
  [[nodiscard]] const std::vector<BandPlace>& stops() const { return stops_; }
  /// The phase counted from the nearest anchor, if there is one.
  [[nodiscard]] BandPlace place(double phase) const;
  /// Whether (1) is the better way to u'.
  [[nodiscard]] bool is_near(const BandPlace& place) const;
  /// (1).
  [[nodiscard]] double velocity(const BandPlace& place) const;
  /// (1) in the place of u' at those of twelve offsets from one anchor where it is the better way.
  void correct(const BandAnchor& anchor, const BandValues& offsets, BandValues& velocity) const;

 private:
  void find_anchors(double slowest);
  void add_stops(const BandAnchor& anchor, double length, double fastest, double frequency);
  [[nodiscard]] double offset_of(const BandAnchor& anchor, double length, double speed) const;

  TrigonometricPolynomial rate_, second_;  // u', u''
  std::vector<double> rate_coefficients_;  // of u': 0, sin, cos, sin 2, …
  std::vector<double> stands_;
  std::vector<BandAnchor> turning_;  // zeros of u' and u'', in order
  std::vector<BandAnchor> anchors_;
  std::vector<BandPlace> stops_;
  std::vector<double> grades_;
  std::vector<SignChange> changes_;
};

}  // namespace microslip::contact
