/// @file
/// Peaks with many harmonics over a parameter, out of peaks that few of them have followed.
///
/// At a few values p every high peak f with few harmonics, a_f(p), is carried to the one with all
/// of them, A_f(p) (enrichment/carried_peak.hpp). Their ratio varies slowly along a family, so that
/// between and beside these values
///
///   A(p) ≈ max over f of a_f(p) c_f(p),     log c_f linear between the values with log (A_f / a_f)
///
/// which costs what following with few harmonics costs. Where a peak cannot be carried, the highest
/// of the whole curve with all harmonics stands for it.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "solver/optimum.hpp"

namespace microslip::solver {

/// Curves say what peaks with few harmonics do not know of, or a value lies out of bounds.
struct NeedsOtherSearch {};

/// Positions are parameters on the scale of the options.
class CorrectedPeaks {
 public:
  using FamilyPeaks = std::map<std::size_t, LocalPeak>;

  /// A value of the parameter where the peaks have all harmonics.
  struct Value {
    FamilyPeaks few;
    FamilyPeaks all;                           ///< where they could be carried
    std::map<std::size_t, double> correction;  ///< log (A / a)
    PeakOfParameter highest;
    std::optional<ResponsePoint> top;            ///< of the whole curve, where it was traced
    std::shared_ptr<const ResponseCurve> curve;  ///< where `top` is its highest point
    int n_curves = 0;
    PeakWork work;
  };

  /// @param few      with peaks followed by search_followed(); more are followed. Borrowed, as
  ///                 family, range and options are.
  /// @param family   that of `few`.
  /// @param range    with all harmonics, given.
  /// @param options  bounds; `search_starts` of whole curves.
  CorrectedPeaks(PeakFamilies& few, const SceneFamily& family, const ContinuationOptions& range,
                 const OptimumOptions& options)
      : few_(few), family_(family), range_(range), options_(options) {}

  /// Peaks at values are carried to all harmonics, several values side by side; where one is lost
  /// the whole curve is traced.
  /// @throws NeedsOtherSearch, SearchStopped
  void solve(const std::vector<double>& positions);
  /// The same of values that need not be known: where a peak is lost they are left out.
  /// @throws SearchStopped
  void solve_if_carried(const std::vector<double>& positions);
  /// A value is solved again from what its neighbours are by now. @return  whether it has become
  /// higher.
  bool is_raised(double position);
  /// What a curve has told of a value is followed to its neighbours on one side, as far as it
  /// raises them.
  void spread(double position, double direction);
  /// @return  whether the whole curve at a value has no higher peak than the one carried to it; the
  ///          curve's own is kept.
  bool agrees_with_curve(double position);
  /// From now on: the top of a peak may be several, of which the one carried need not be the
  /// highest.
  void trust_curves_alone();
  [[nodiscard]] bool trusts_curves_alone() const { return curves_alone_; }

  /// The highest peak with all harmonics, as far as the values solved for tell it; +∞ where no peak
  /// with few is known.
  [[nodiscard]] double amplitude(double position);
  /// By position.
  [[nodiscard]] const std::map<double, Value>& values() const { return values_; }
  [[nodiscard]] double nearest(double position) const;
  /// The next value on one side of one that is solved for; empty: there is none.
  [[nodiscard]] std::optional<double> neighbour(double position, double direction) const;
  [[nodiscard]] int n_curves() const { return n_curves_; }
  /// Beside that of the peaks with few harmonics.
  [[nodiscard]] const PeakWork& work() const { return work_; }

 private:
  [[nodiscard]] double parameter(double position) const {
    return parameter_at(options_.scale, position);
  }
  [[nodiscard]] std::optional<FamilyPeaks> high_peaks(double position);
  [[nodiscard]] bool carry(double position, Value& value) const;
  void trace(double position, Value& value) const;
  [[nodiscard]] ContinuationOptions range_with_starts() const;
  void count(Value& value);
  void keep(double position, Value value);
  [[nodiscard]] std::optional<LocalPeak> carried(const Scene& scene, double position,
                                                 std::size_t family, const LocalPeak& peak,
                                                 PeakWork& work) const;
  [[nodiscard]] std::vector<const Value*> beside_with(std::size_t family, double position) const;
  [[nodiscard]] double correction(std::size_t family, double position) const;

  PeakFamilies& few_;
  const SceneFamily& family_;
  const ContinuationOptions& range_;
  const OptimumOptions& options_;
  std::map<double, Value> values_;
  std::map<double, std::vector<std::pair<std::size_t, double>>> few_at_;
  bool curves_alone_ = false;  // peaks that were carried have been refuted
  int n_curves_ = 0;
  PeakWork work_;
};

}  // namespace microslip::solver
