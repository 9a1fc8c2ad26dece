/// @file
/// Elastic contact of rough surfaces: what approach makes of the load and of the stiffness.
///
/// Of a rough surface under a flat plate only the share h* of the area is in contact. With the
/// approach u counted from the first touch and the stiffnesses k_N, k_T of full contact
///
///   F_N(u) = k_N δ(u),   δ = ∫ h* du,       k_t(u) = k_T h*(u)                        (1)
///   cubic      h* = 0 | 3x² − 2x³ | 1,   δ = R (0 | x³ − x⁴/2 | x − ½),  x = u/R   (2) [B-eq 1, 2]
///   Gaussian   h* = Φ(ζ),                δ = s [ζΦ(ζ) + φ(ζ)],      ζ = (u − ū)/s  (3)
///
/// x below 0 | from 0 to 1 | above 1; Φ, φ are the normal distribution and its density, ū and s
/// mean and standard deviation of the heights. The cubic law is a height density 6x(1 − x) of mean
/// R/2 and variance R²/20; the Gaussian with ū = R/2, s = R/√20 matches it, and both share the
/// asymptote F_N = k_N (u − R/2). The Gaussian load never vanishes:
/// it falls below the smallest number at ζ = −38.
///
/// This header knows geometry only; δ [m] times k_N per area is a pressure, times k_N of an element
/// a force.
///
/// Source: paper B, section 2.1, eqs 1, 2; theory section 11.
#pragma once

namespace microslip::contact {

/// (1) at one approach, with derivatives.
struct RoughState {
  double compression = 0.0;        ///< δ = F_N/k_N [m]
  double share = 0.0;              ///< h* = dδ/du = k_t/k_T [-], in [0, 1]
  double share_by_approach = 0.0;  ///< dh*/du [1/m]
  /// δ/h* [m], finite where both vanish: μ k_N/k_T times this is the slider's half-width.
  double reach = 0.0;
  double reach_by_approach = 0.0;  ///< d(δ/h*)/du [-]
};

enum class HeightLaw : unsigned char { cubic, gaussian };

class RoughSurface {
 public:
  /// (2). R = 0 is the one-sided spring δ = max(0, u).
  /// @param height  R ≥ 0 [m].
  /// @throws std::invalid_argument  not finite or negative; names it.
  [[nodiscard]] static RoughSurface cubic(double height);
  /// (3) matching the cubic law of the same R.   @param height, @throws  as for cubic().
  [[nodiscard]] static RoughSurface matching_gaussian(double height);

  /// Relative accuracy of (3) at its ζ: 4e-15. ζ itself is rounded, which costs ζ² units of the
  /// last place of δ and h* in the tail and is the conditioning of the law.
  /// @param approach  u [m], finite.
  [[nodiscard]] RoughState at(double approach) const;
  /// The u at which δ(u) = compression [m].
  /// @param compression  ≥ 0, finite. 0: the largest u without load, 0 for (2); −∞ for (3).
  [[nodiscard]] double approach(double compression) const;

  [[nodiscard]] HeightLaw law() const { return law_; }
  /// R [m]; for (3) √20 s, the R of the cubic law with the same variance.
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double deviation() const { return deviation_; }

 private:
  RoughSurface(HeightLaw law, double height, double mean, double deviation)
      : law_(law), height_(height), mean_(mean), deviation_(deviation) {}

  HeightLaw law_;
  double height_;
  double mean_;
  double deviation_;
};

}  // namespace microslip::contact
