/// @file
/// Steady cycles of a block of points in two directions: motion in, Fourier sums of friction and
/// load, states and derivatives out (lanes/plane_kernels.hpp, plane_point.hpp;
/// theory section 23.1).
///
/// The virgin slider, s = 0 at instant 0, is marched through the period. A period that parts and
/// touches down, or without slip, has settled it; else period follows on period, s ← Φ(s), and the
/// last two of them tell where the sequence goes:
///
///   s ← Φ(s) − γ (Φ(s) − Φ(s')),   γ = g·(g − g')/|g − g'|²,   g = Φ(s) − s                    (1)
///
/// (after slip the slider has one coordinate, and (1) is the secant of one equation). Where that
/// leads to a slider at rest, the march is gone through without it: where a slider comes to rest is
/// history. Where two stretches of slip push it in turn into the corner of their ellipses it goes
/// there at once (plane_corner.hpp): by itself it comes near like 1/periods.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contact/force/sleeping_set.hpp"
#include "contact/lanes/plane_kernels.hpp"
#include "contact/sampled/instants.hpp"
#include "contact/sampled/kinks.hpp"
#include "contact/sampled/plane_corner.hpp"
#include "contact/sampled/plane_point.hpp"
#include "contact/surface/surface_law.hpp"

namespace microslip::contact::sampled {

class PlaneBlock {
 public:
  enum class Ask { force, derivatives };

  /// @param points  1 to block_size of them.
  /// @param of_motion, of_force  as many instants, the harmonics of each.
  /// @param surfaces, motion  of all points of the patch.
  void evaluate(const std::vector<SurfaceLaw>& surfaces, const PatchMotion& motion,
                std::span<const Eigen::Index> points, double frequency, Ask ask,
                const Instants& of_motion, const Instants& of_force);

  /// Σ_i f_i T_k(θ_i) of f_p, n, f_r: [row of of_force][point].
  [[nodiscard]] const double* sums(std::size_t signal) const { return sums_[signal].data(); }
  /// Of the point in this place of the block.
  [[nodiscard]] const std::vector<Run>& runs(std::size_t place) const { return runs_[place]; }
  /// ∫ μ n |ds| over the period [J/m²].
  [[nodiscard]] double slip_work(std::size_t place) const;
  /// Force by which the slider has not come back to where it was [Pa]: 0 where that is settled.
  [[nodiscard]] double defect(std::size_t place) const { return defect_[place]; }
  /// Good until the next call; of an evaluation that asked for derivatives.
  [[nodiscard]] const PlaneDerivatives& derivatives(std::size_t place);

 private:
  using State = std::array<double, n_state_numbers * block_size>;

  void resize();
  void load_motion(const PatchMotion& motion);
  void load_constants();
  void load_smooth();
  void mend_load();
  void ask_surfaces();
  void smooth_slopes(std::size_t place);
  void begin_search();
  void settle();
  void record(Ask ask);
  static void copy(const State& from, std::size_t p, State& to);
  [[nodiscard]] bool looks_for_corners(int period) const;
  void rest_in_corners(const State& end, std::span<const double> slips, bool is_slow);
  [[nodiscard]] bool rest_in_corner(std::size_t p, std::array<std::size_t, 2> instants, State state,
                                    bool is_slow);
  [[nodiscard]] bool march_what_rests();
  [[nodiscard]] bool jump(std::size_t p, const State& before, const State& end, State& next);
  void step_on(const State& before, const State& end, std::span<const double> slips);
  [[nodiscard]] PlaneStart start_of(const State& state, std::size_t place) const;
  [[nodiscard]] State virgin() const;
  [[nodiscard]] bool has_history(std::size_t place) const;
  void keep_histories();
  [[nodiscard]] PlaneDerivatives::Point point_of(std::size_t place) const;
  [[nodiscard]] Eigen::Index point(std::size_t place) const {
    return points_[place < points_.size() ? place : 0];
  }

  /// What the search for the periodic slider knows of a point.
  struct Search {
    bool parts = false;
    bool settled = false;
    bool marches = false;            // without (1)
    bool jumped = false;             // the last period began at (1)
    int periods = 0;                 // marched from the virgin slider
    std::array<double, 2> change{};  // g' of (1)
    std::array<double, 2> end{};     // Φ(s')
    double change_size = 0.0;        // |g|
    double reach = 0.0;              // what the slider may still go
    std::optional<PlaneCorner> corner;
  };

  const std::vector<SurfaceLaw>* surfaces_ = nullptr;
  std::span<const Eigen::Index> points_;
  const Instants* instants_ = nullptr;
  double frequency_ = 0.0;
  bool simple_ = true;  // smooth surfaces, constant coefficient
  bool equal_ = true;   // widths along p and r
  std::vector<double> coefficients_;
  std::vector<double> u_, v_, w_, rate_u_, rate_w_, closeness_, normal_, limit_, width_p_, width_r_,
      inverse_p_, inverse_r_, slider_p_, slider_r_, pull_p_, pull_r_, force_p_, force_r_, state_,
      entry_, turns_;
  std::array<std::vector<double>, 3> sums_;
  std::array<double, block_size> rest_load_{}, normal_stiffness_{}, coefficient_{}, stiffness_p_{},
      stiffness_r_{}, closeness_by_approach_{}, defect_{};
  PlaneArrays arrays_;
  State start_{};
  State march_{};  // where the marches without (1) have come
  std::array<Search, block_size> search_;
  std::array<std::vector<PlaneSlopes>, block_size> slopes_;
  std::array<std::vector<Run>, block_size> runs_;
  std::array<Kinks, block_size> load_kinks_;  // of smooth surfaces
  std::array<PlaneDerivatives, block_size> derivatives_;
};

}  // namespace microslip::contact::sampled
