/// @file
/// Derivatives of the sampled force of one point in two directions, exactly those of the sums over
/// instants (theory section 23.1):
///
///   stick   df = K (dx − ds) + K' dv (x − s)          slip   df = e dL + L e_⊥ dα,   L = μ n   (1)
///   ds  after slip at i   dx − dW e − W e_⊥ dα  there,  after touch-down  that of the landing  (2)
///   dα  from instant to instant by the numbers of linearise() (lanes/plane_kernels.hpp)
///
/// What a point remembers is ds in stick, dα in slip, nothing apart. A period is walked from a
/// touch-down, or from slip, where it is one number: dα₀ = D + M dα₀ closes it. A point that never
/// slips remembers what pushed it.
///
/// (1) is a sum of products, T_k(θ_i) of what has the memory by the derivatives of the memory, and
/// moments of weights for the rest (instants.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "contact/lanes/plane_kernels.hpp"
#include "contact/lanes/product_kernels.hpp"
#include "contact/sampled/instants.hpp"
#include "contact/sampled/kinks.hpp"
#include "contact/sampled/plane_corner.hpp"
#include "contact/sampled/runs.hpp"

namespace microslip::contact::sampled {

/// What an instant of a point answers to its motion.
struct PlaneSlopes {
  std::array<double, 2> stiffness{};              ///< K [N/m³]
  std::array<double, 2> stiffness_by_approach{};  ///< dK/dv
  double limit = 0.0;                             ///< L [Pa]
  double limit_by_approach = 0.0;
  double limit_by_rate = 0.0;  ///< dL/dσ
  std::array<double, 2> width_by_approach{};
  std::array<double, 2> width_by_rate{};
  double load_by_approach = 0.0;          ///< dn/dv
  std::array<double, 2> rate_by_speed{};  ///< ∂σ/∂(u', w'), σ = ω |x'|
  double rate_by_frequency = 0.0;         ///< |x'|
};

/// The slider of one point at instant 0 before a period, where that differs from the one after it.
struct PlaneStart {
  std::array<double, 2> slider{};
  std::array<double, 2> pull{};
  InstantState state = InstantState::stick;
};

class PlaneDerivatives {
 public:
  /// @param slopes  of the n instants; one for all where `constant`.
  /// @param closeness_by_approach  dr/dv.
  struct Point {
    const PlaneArrays* arrays = nullptr;  ///< of linearise()
    std::size_t place = 0;
    const PlaneSlopes* slopes = nullptr;
    bool constant = false;
    double closeness_by_approach = 0.0;
  };

  void reset(const Instants& instants);
  /// The memory of a virgin slider at instant 0. @param start  what became of it.
  void begin_history(const Point& point, const PlaneStart& start);
  /// The memory of a slider in a corner instead.
  void begin_corner(const Point& point, const PlaneCorner& corner);
  /// One period further. @param start  before it.
  void carry_history(const Point& point, const PlaneStart& start);
  /// Of the period that follows on the history. @param start  before it.
  void after_history(const Point& point, const PlaneStart& start, const std::vector<Run>& runs);
  /// Of a steady cycle with slip or separation.
  void steady(const Point& point, const std::vector<Run>& runs);
  /// After either, what mend() takes off. @param kinks  of the load of a smooth surface.
  void mend_load(const Kinks& kinks, double normal_stiffness);

  /// ∂f̂_k/∂(û, v̂, ŵ) in split order, without the norm of row k [N/m³].
  /// @param direction  0 p, 1 r.
  [[nodiscard]] const double* by(std::size_t direction, std::size_t signal) const {
    return by_[direction][signal].data();
  }
  /// ∂f̂_k/∂ω, likewise.
  [[nodiscard]] const double* by_frequency(std::size_t direction) const {
    return by_frequency_[direction].data();
  }
  /// Moments of dn/dv, those of Instants.
  [[nodiscard]] const double* normal_moments() const { return normal_.data(); }

 private:
  enum class Memory { none, slider, angle };
  using Row = std::vector<double>;

  [[nodiscard]] double at(const double* values, std::size_t i) const {
    return values[i * block_size + point_.place];
  }
  [[nodiscard]] std::array<double, 2> at(const double* p, const double* r, std::size_t i) const {
    return {at(p, i), at(r, i)};
  }
  [[nodiscard]] const PlaneSlopes& slopes(std::size_t i) const {
    return point_.slopes[point_.constant ? 0 : i];
  }
  [[nodiscard]] std::array<double, 2> slider_before(std::size_t i) const;
  [[nodiscard]] std::array<double, 2> pull_before(std::size_t i) const;
  [[nodiscard]] InstantState state(std::size_t i) const {
    return instant_state(at(point_.arrays->state, i));
  }
  [[nodiscard]] double share_apart(std::size_t before, std::size_t now) const;

  void add_position(Row& row, std::size_t i, double by_p, double by_r) const;
  void add_width(Row& row, std::size_t i, double by_p, double by_r) const;
  void add_share_apart(Row& row, std::size_t before, std::size_t now, double factor) const;
  void advance(std::size_t i, InstantState before);
  void leave_slip(std::size_t i);
  void land(std::size_t before, std::size_t now);
  void go_on(std::size_t before, std::size_t now);
  void begin_slip(std::size_t before, std::size_t now);
  void settle(const std::array<double, 2>& b, std::size_t now);
  void slip_from_landing(std::size_t before, std::size_t now);

  void clear();
  double* push(const Row& memory);
  void flush();
  void add_stick(const Run& run);
  void add_slip(std::size_t i);
  void add_constant_stick(const Run& run);
  void walk(const std::vector<Run>& runs, InstantState before);
  void close();
  void collect();

  const Instants* instants_ = nullptr;
  Point point_;
  const PlaneStart* start_ = nullptr;
  std::size_t n_rows_ = 0;
  std::size_t n_columns_ = 0;
  Memory memory_ = Memory::none;
  Row angle_, next_;           // dα: by û, v̂, ŵ, α₀, ω
  std::array<Row, 2> slider_;  // ds
  std::array<double, 2> settled_{};
  ProductSizes size_;
  std::size_t n_waiting_ = 0;
  std::vector<double> left_, right_, sum_;
  std::array<Row, 2> stick_, limit_;  // moments of ∂f_p/∂u, ∂f_r/∂w; of ∂f/∂v
  Row normal_;
  std::array<std::array<Row, 3>, 2> by_;
  std::array<Row, 2> by_frequency_;
  Row product_row_;
  Products products_;
};

}  // namespace microslip::contact::sampled
