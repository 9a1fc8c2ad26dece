/// @file
/// Peak against parameter: the largest amplitude over a frequency range of a family of scenes,
/// carried from value to value as an unknown (local_peak.hpp) instead of being searched on a whole
/// curve for each.
///
/// Every peak of the curves at a few values of the parameter ("checks"), and the solution at either
/// end of the range, is followed both ways; the result is the highest of all. Peaks thus may enter
/// and leave the range: there an end is the highest. What following alone cannot see is caught by
/// the checks:
///
///   a peak that appears or overtakes   it stands on the curve of a check and is followed back from
///                                      there
///   a peak that enters the range       the amplitude at the end grows into it: the curve is traced
///                                      whole
///   a peak that vanishes or jumps      following stops, the curve there is traced whole
///   a branch that comes off the curve  its peak is missing on the curve of the next check: higher
///                                      than all of that curve it counts and is told, else all
///                                      values up to the last agreement are traced whole; with
///                                      an amplitude_tolerance above rounding it goes there alone
///
/// and named in `notes`. A search for detached branches (ContinuationOptions::search_starts) is
/// made with every whole curve, from the first on that finds one; a peak it finds counts like one
/// of the curve. At worst every value is traced whole, which is what a search on curves costs.
///
/// Where harmonics are chosen, all peaks have those that the peaks of the checks need
/// (common_harmonics.hpp); a curve whose highest peak needs more is named in `notes`.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "solver/optimum/parameter_scale.hpp"
#include "solver/peak/high_points.hpp"
#include "solver/peak/local_peak.hpp"

namespace microslip::solver {

/// Scene for a value of the parameter.
using SceneFamily = std::function<Scene(double parameter)>;

/// Runs task(i) for every i < n, in any order and on any thread.
using Together = std::function<void(std::size_t n, const std::function<void(std::size_t)>& task)>;
void one_by_one(std::size_t n, const std::function<void(std::size_t)>& task);

struct PeakOfParameter {
  double parameter = 0.0;
  double frequency = 0.0;  ///< [rad/s]
  double amplitude = 0.0;  ///< [m]
  bool whole_curve =
      false;  ///< the peak is the highest of a complete curve, not only of those followed
  PeakPlace place = PeakPlace::peak;  ///< what has this amplitude
  /// It was found on a branch that the sweep does not meet; told where the curve was traced whole.
  bool detached = false;
};

struct PeakTraceOptions {
  double lower = 0.0;  ///< of the parameter; > 0 on the logarithmic scale
  double upper = 0.0;  ///< > lower
  int n_values = 30;   ///< spread evenly on the scale, both bounds included, ≥ 2
  int n_checks = 4;    ///< whole curves, spread evenly, both bounds included, ≥ 2
  /// In their place: one whole curve, at the value nearest to this, between the bounds.
  std::optional<double> only_check;
  ParameterScale scale = ParameterScale::logarithmic;
  /// Relative: amplitudes that close are the same. Above rounding, a peak that is as high as the
  /// highest of a curve need not be that peak, and what is lower than it is dropped without a word.
  double amplitude_tolerance = 1e-7;
  Together together = one_by_one;  ///< curves, or peaks, that do not wait for one another
};

struct PeakTrace {
  std::vector<PeakOfParameter>
      peaks;                       ///< sorted by parameter; values without a solution are left out
  std::vector<std::string> notes;  ///< what following met, in words; the fall-backs among them
  std::vector<std::string> warnings;  ///< the notes that tell of peaks beside the curves
  int n_curves = 0;                   ///< traced whole
  long iterations = 0;
  long contact_evaluations = 0;
};

/// Thrown where ContinuationOptions::stop asks for an end; what was found until then is there.
struct SearchStopped {};

/// The peaks of a family that have been found so far, each followed as far as asked for.
class PeakFamilies {
 public:
  /// @param family  borrowed.
  /// @throws std::invalid_argument  bounds or counts out of range.
  PeakFamilies(const SceneFamily& family, const ContinuationOptions& range,
               const PeakTraceOptions& options);

  /// Follows all peaks over all values.
  void trace();
  /// The highest of peaks and ends at any value between the bounds, followed from the nearest
  /// values; +∞ amplitude where no solution is known.
  [[nodiscard]] PeakOfParameter highest(double parameter);
  /// A peak that is followed, with the number of its family.
  struct FamilyPeak {
    std::size_t family;
    LocalPeak peak;
  };
  /// Those that highest() has reached at a value, from the highest down.
  [[nodiscard]] std::vector<FamilyPeak> followed_to(double parameter) const;
  /// Traces the curve at a value whole. True: it confirms what highest() says there; else the peaks
  /// missing are followed from here on.
  /// @param search_starts  of a search for detached branches there,
  ///                       beside what the options ask for.
  bool confirm(double parameter, int search_starts = 0);
  /// Whether a curve was traced there, and ended before the whole range was.
  [[nodiscard]] bool is_cut_short(double parameter) const;
  /// Of the curve traced there; nullptr: none was, or it has none.
  [[nodiscard]] const ResponsePoint* highest_point(double parameter) const;
  /// Traces the curves that confirm() will ask for, together.
  void prepare(const std::vector<double>& parameters, int search_starts);

  [[nodiscard]] PeakTrace result() const;
  /// Of the harmonics that all peaks have; empty: those of the scene.
  [[nodiscard]] const std::vector<int>& orders() const { return range_.orders; }
  [[nodiscard]] const ContinuationOptions& range() const { return range_; }

 private:
  using Peaks = std::map<double, LocalPeak>;  // by position
  /// The nearest positions to which a peak could not be followed.
  struct Reach {
    double below = -std::numeric_limits<double>::infinity();
    double above = std::numeric_limits<double>::infinity();
  };
  /// What one peak or end is.
  struct Followed {
    Peaks peaks;
    std::map<double, Reach> reach;            // by position
    std::set<double> met;                     // positions where it is a peak of another family
    std::set<double> refuted;                 // positions whose curve does not have it
    std::map<double, std::size_t> unreached;  // positions, and how many peaks were known then
    PeakWork work;
  };
  struct Curve {
    ResponseCurve traced;
    std::vector<HighPoint> high;  // from the highest down
    int search_starts = 0;
  };

  // Positions are parameters on the scale of the options.
  [[nodiscard]] double position(double parameter) const;
  [[nodiscard]] double known_position(double parameter) const;
  [[nodiscard]] double parameter(double position) const;
  [[nodiscard]] double value_position(int index) const;
  [[nodiscard]] std::vector<double> check_positions() const;
  [[nodiscard]] const LocalPeak* highest_followed(double position) const;
  [[nodiscard]] PeakOfParameter highest_at(double position) const;
  [[nodiscard]] bool needs_curve(double position) const;
  [[nodiscard]] bool is_detached(const Curve& curve, double amplitude) const;
  [[nodiscard]] ResponseCurve traced(double position, const ContinuationOptions& range) const;
  /// What it has cost to trace, once.
  void count(const ResponseCurve& curve, double position);
  void trace_ahead(const std::vector<double>& positions, int search_starts);
  [[nodiscard]] ContinuationOptions range_with(int search_starts) const;
  const Curve& curve_at(double position, int search_starts);
  void seed(double position, int search_starts = 0);
  void settle();
  void follow_values(std::size_t family, double from, double direction);
  [[nodiscard]] long curve_cost() const;
  bool follow_to(Followed& family, double target) const;
  bool is_reached(Followed& family, double target) const;
  bool follow_from(Followed& family, Peaks::const_iterator nearest, double target) const;
  [[nodiscard]] std::optional<LocalPeak> followed(const Peaks& peaks, Peaks::const_iterator nearest,
                                                  double target, PeakWork& work) const;
  [[nodiscard]] std::vector<std::size_t> highest_near(double position) const;
  void follow_near(double position);
  void follow_to_asked();
  [[nodiscard]] bool hides_lost(double position) const;
  [[nodiscard]] bool known_elsewhere(std::size_t family, double position) const;
  bool left_to_another(std::size_t family, double position);
  [[nodiscard]] static bool is_anothers(const Followed& family, Peaks::const_iterator nearest,
                                        double position);
  void search_everywhere(int search_starts);
  [[nodiscard]] bool agrees(const Peaks& peaks, double position) const;
  [[nodiscard]] bool cut(Followed& family, double position);
  void note(const std::string& text, double position);
  void warn(const std::string& text, double position);

  const SceneFamily& family_;
  ContinuationOptions choosing_;  ///< as given
  ContinuationOptions range_;     ///< with the harmonics that all peaks have
  PeakTraceOptions options_;
  double spacing_;
  std::vector<Followed> families_;
  std::map<double, Curve> curves_;
  /// Traced ahead of what asks for them: by position and number of starts of their search.
  std::map<std::pair<double, int>, ResponseCurve> ahead_;
  std::set<double> asked_;    // positions whose highest peak is known
  std::set<double> pending_;  // positions whose curve is to be traced whole
  bool told_detached_ = false;
  PeakTrace result_;
};

}  // namespace microslip::solver
