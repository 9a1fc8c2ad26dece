#include "tests/support/curve_relations.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>

#include "solver/continuation.hpp"
#include "tests/support/curves.hpp"

namespace microslip::tests {
namespace {

constexpr double pi = std::numbers::pi;

using Change = std::function<void(SceneNumbers&)>;
using Places = std::vector<std::pair<double, double>>;

Places places(const solver::ResponseCurve& curve, solver::PointMark mark) {
  Places list;
  for (const auto& point : marked(curve, mark)) {
    list.emplace_back(point.frequency, point.amplitude);
  }
  std::ranges::sort(list);
  return list;
}

solver::ContinuationOptions options_of(const SceneNumbers& numbers) {
  auto options = frequency_range(numbers.begin, numbers.end);
  options.n_harmonics = numbers.n_harmonics;
  options.judge_stability = false;
  return options;
}

solver::PointObserver within(double seconds) {
  const std::clock_t begin = std::clock();
  return [begin, seconds](const solver::ResponsePoint& /*point*/) {
    return seconds == 0.0 || static_cast<double>(std::clock() - begin) <
                                 seconds * static_cast<double>(CLOCKS_PER_SEC);
  };
}

std::string said_of(const solver::ResponseCurve& curve) {
  using solver::Remedy;
  std::string said = curve.complete ? "" : to_string(curve.diagnosis);
  for (const Remedy remedy :
       {Remedy::fixed_frequency, Remedy::homotopy, Remedy::other_branch, Remedy::other_end,
        Remedy::peak_unsolved, Remedy::fold_unsolved, Remedy::row_left_out, Remedy::past_loop}) {
    const bool met = std::ranges::any_of(
        curve.log, [&](const solver::SolverEvent& event) { return event.remedy == remedy; });
    if (met) said += std::string(said.empty() ? "" : ", ") + to_string(remedy);
  }
  return said;
}

/// Pairs of the two lists, and what has none.
void compare_places(const char* name, const Places& now, const Places& before,
                    const Factors& factors, double scale, Comparison& result) {
  std::ostringstream words;
  words.precision(10);
  if (now.size() != before.size()) {
    words << now.size() << " " << name << ", not " << before.size();
    const auto lacks = [&](const Places& of, const Places& one, double factor, const char* whose) {
      for (const auto& place : one) {
        const double frequency = place.first * factor;
        const bool met = std::ranges::any_of(of, [&](const auto& other) {
          return std::abs(other.first - frequency) <= 1e-6 * frequency;
        });
        if (!met) words << "; " << whose << " at " << place.first / 2.0 / pi << " Hz";
      }
    };
    lacks(now, before, factors.frequency, "lacks that");
    lacks(before, now, 1.0 / factors.frequency, "has one more");
    result.worst = std::numeric_limits<double>::infinity();
  }
  for (std::size_t i = 0; now.size() == before.size() && i < now.size(); ++i) {
    const double frequency =
        std::abs(now[i].first / factors.frequency - before[i].first) / before[i].first;
    const double amplitude = std::abs(now[i].second / factors.amplitude - before[i].second) / scale;
    const double worst = std::max(frequency, amplitude);
    result.worst = std::max(result.worst, worst);
    if (!(worst <= factors.tolerance) && words.str().empty()) {
      words << name << " at " << before[i].first / 2.0 / pi << " Hz differ by " << worst;
    }
  }
  if (!words.str().empty()) result.differs += (result.differs.empty() ? "" : "; ") + words.str();
}

Comparison after(const Walked& walked, const Change& change, const Factors& factors = {}) {
  SceneNumbers changed = walked.numbers;
  change(changed);
  return compared(shape_of(changed, walked.seconds), walked.shape, factors);
}

/// Both scenes are others than the one that was walked.
Comparison between(const Walked& walked, const SceneNumbers& base, const Change& change,
                   double tolerance = walks_differ) {
  const CurveShape before = shape_of(base, walked.seconds);
  if (!before.complete) return {.worst = 0.0, .differs = {}, .stopped = true};
  return after({base, before, walked.seconds}, change, {1.0, 1.0, tolerance});
}

Relation always(const char* name, const char* what, const Change& change,
                const Factors& factors = {}) {
  return {name, what, [=](const Walked& walked) { return after(walked, change, factors); }};
}

/// Of theory 0: 1 kg, 1 m, 1 s become so many others.
Relation other_units(const char* name, const char* what, double mass, double length, double time,
                     double tolerance) {
  const auto change = [=](SceneNumbers& n) {
    const double root = std::sqrt(mass);
    n.frequency /= time;
    n.begin /= time;
    n.end /= time;
    n.output /= root;
    n.excitation *= root * length / (time * time);
    for (Eigen::MatrixXd* shape : {&n.u, &n.v, &n.w}) *shape /= root;
    for (contact::PointParameters& point : n.points) {
      point.tangential_stiffness *= mass / (time * time);
      point.normal_stiffness *= mass / (time * time);
      point.rest_load *= mass * length / (time * time);
    }
  };
  return always(name, what, change, {1.0 / time, length, tolerance});
}

Relation scaled(const char* name, const char* what, double factor) {
  const auto change = [factor](SceneNumbers& n) {
    n.excitation *= factor;
    for (contact::PointParameters& point : n.points) point.rest_load *= factor;
  };
  return always(name, what, change, {1.0, factor});
}

void reverse_order(SceneNumbers& n) {
  n.frequency.reverseInPlace();
  n.damping.reverseInPlace();
  n.output.reverseInPlace();
  n.weights.reverseInPlace();
  n.excitation = n.excitation.rowwise().reverse().eval();
  for (Eigen::MatrixXd* shape : {&n.u, &n.v, &n.w}) *shape = shape->reverse().eval();
  std::ranges::reverse(n.points);
}

void turn_signs(SceneNumbers& n) {
  for (Eigen::Index mode = 0; mode < n.n_modes(); mode += 2) {
    n.output[mode] *= -1.0;
    n.excitation.col(mode) *= -1.0;
    n.u.col(mode) *= -1.0;
    n.v.col(mode) *= -1.0;
    if (n.is_planar()) n.w.col(mode) *= -1.0;
  }
}

void turn_pair(SceneNumbers& n) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  n.output.head(2) = (turn.transpose() * n.output.head(2)).eval();
  for (Eigen::MatrixXd* of : {&n.excitation, &n.u, &n.v, &n.w}) {
    if (of->size() > 0) of->leftCols(2) = (of->leftCols(2) * turn).eval();
  }
}

std::optional<Comparison> of_pair(const Walked& walked) {
  if (walked.numbers.n_modes() < 2) return {};
  SceneNumbers pair = walked.numbers;
  pair.frequency[1] = pair.frequency[0];
  pair.damping[1] = pair.damping[0];
  return between(walked, pair, turn_pair);
}

void split_point(SceneNumbers& n) {
  const Eigen::Index size = n.weights.size();
  n.weights.conservativeResize(size + 1);
  n.weights[size] = 0.3 * n.weights[0];
  n.weights[0] *= 0.7;
  n.points.push_back(n.points.front());
  for (Eigen::MatrixXd* shape : {&n.u, &n.v, &n.w}) {
    if (shape->size() == 0) continue;
    shape->conservativeResize(size + 1, Eigen::NoChange);
    shape->row(size) = shape->row(0);
  }
}

/// By 3/16 of a period, which instants of a sampled period fall upon.
void shift_phase(SceneNumbers& n) {
  for (Eigen::Index sine = 1; sine < n.excitation.rows(); sine += 2) {
    const double phase = 2.0 * pi * 3.0 / 16.0 * static_cast<double>((sine + 1) / 2);
    const Eigen::RowVectorXd s = n.excitation.row(sine);
    const Eigen::RowVectorXd c = n.excitation.row(sine + 1);
    n.excitation.row(sine) = std::cos(phase) * s - std::sin(phase) * c;
    n.excitation.row(sine + 1) = std::sin(phase) * s + std::cos(phase) * c;
  }
}

/// Of sweeps that begin and end with the same solutions: of several there each takes its own.
std::optional<Comparison> of_sweeps(const Walked& walked) {
  SceneNumbers turned = walked.numbers;
  std::swap(turned.begin, turned.end);
  const CurveShape now = shape_of(turned, walked.seconds);
  const CurveShape& before = walked.shape;
  const double apart =
      std::max(std::abs(now.first - before.last), std::abs(now.last - before.first));
  if (now.complete && apart > 1e-6 * before.largest) return {};
  return compared(now, before);
}

/// The load is constant.
SceneNumbers held(SceneNumbers numbers) {
  for (contact::PointParameters& point : numbers.points) {
    point.normal_stiffness = 0.0;
    point.rest_load = std::abs(point.rest_load);
  }
  numbers.v.setZero();
  return numbers;
}

std::optional<Comparison> of_product(const Walked& walked) {
  return between(walked, held(walked.numbers), [](SceneNumbers& n) {
    for (contact::PointParameters& point : n.points) {
      point.friction_coefficient *= 3.0;
      point.rest_load /= 3.0;
    }
  });
}

Comparison of_limit(const Walked& walked, double load, solver::LinearLimit kind) {
  SceneNumbers limit = walked.numbers;
  limit.excitation.row(0).setZero();
  for (contact::PointParameters& point : limit.points) point.rest_load = load;
  const auto linear = solver::trace_linear(scene_of(limit), kind, options_of(limit));
  const CurveShape shape = shape_of(limit, walked.seconds);
  Comparison result{.worst = 0.0, .differs = {}, .stopped = shape.stopped};
  compare_places("peaks", shape.peaks, places(linear, solver::PointMark::peak), {},
                 std::max(shape.largest, std::numeric_limits<double>::min()), result);
  return result;
}

double force_of(const SceneNumbers& numbers) { return numbers.excitation.cwiseAbs().maxCoeff(); }

std::optional<Comparison> of_large_load(const Walked& walked) {
  return of_limit(walked, 1e12 * force_of(walked.numbers), solver::LinearLimit::stuck);
}

/// A gap needs normal stiffness.
std::optional<Comparison> of_large_gap(const Walked& walked) {
  if (walked.numbers.v.isZero(0.0)) return {};
  return of_limit(walked, -1e12 * force_of(walked.numbers), solver::LinearLimit::free);
}

void mirror(SceneNumbers& n) { n.u *= -1.0; }

/// Axes of the patch turned; one direction becomes two. Forces of points that are sampled are
/// other ones along a line (contact/sampled): nothing is said of those.
std::optional<Comparison> of_turned_axes(const Walked& walked) {
  if (walked.numbers.is_planar() && walked.numbers.second_stiffness != 1.0) return {};
  SceneNumbers turned = walked.numbers;
  if (!turned.is_planar()) turned.w = Eigen::MatrixXd::Zero(turned.u.rows(), turned.u.cols());
  if (!walked.numbers.is_planar() && turned.is_sampled()) return {};
  const Eigen::MatrixXd u = turned.u;
  turned.second_stiffness = 1.0;
  turned.u = std::cos(0.6) * u + std::sin(0.6) * turned.w;
  turned.w = std::cos(0.6) * turned.w - std::sin(0.6) * u;
  return compared(shape_of(turned, walked.seconds), walked.shape);
}

void add_still_mode(SceneNumbers& n) {
  const Eigen::Index size = n.n_modes();
  n.frequency.conservativeResize(size + 1);
  n.damping.conservativeResize(size + 1);
  n.output.conservativeResize(size + 1);
  n.frequency[size] = 0.5 * (n.begin + n.end);
  n.damping[size] = n.damping[0];
  n.output[size] = 1.0;
  for (Eigen::MatrixXd* matrix : {&n.excitation, &n.u, &n.v, &n.w}) {
    if (matrix->size() == 0) continue;
    matrix->conservativeResize(Eigen::NoChange, size + 1);
    matrix->col(size).setZero();
  }
}

void double_area(SceneNumbers& n) {
  n.weights *= 2.0;
  for (contact::PointParameters& point : n.points) {
    point.tangential_stiffness /= 2.0;
    point.normal_stiffness /= 2.0;
    point.rest_load /= 2.0;
  }
}

/// Without damping friction does all the work, at every solution of a curve, whether it has an end
/// or not. Of located events: what slips is the work of the force to rounding (theory section 15).
/// Residuals are of the larger of the excitation and the force of a stuck contact; so are works.
std::optional<Comparison> of_work(const Walked& walked) {
  SceneNumbers undamped = walked.numbers;
  undamped.damping.setZero();
  if (undamped.is_sampled()) return {};
  const solver::Scene scene = scene_of(undamped);
  const Eigen::MatrixXd stuck = scene.contact->stuck_stiffness();
  const auto curve = solver::trace_response(scene, options_of(undamped), within(walked.seconds));
  Comparison result;
  for (const solver::ResponsePoint& point : curve.points) {
    double brought = 0.0;
    double scale = 0.0;
    for (Eigen::Index sine = 1; sine < point.q.rows().rows(); sine += 2) {
      const double k = pi * static_cast<double>((sine + 1) / 2);
      const auto motion = point.q.rows().middleRows(sine, 2);
      double largest = (motion * stuck).norm();
      if (sine < undamped.excitation.rows()) {
        const auto force = undamped.excitation.middleRows(sine, 2);
        brought += k * (force.row(1).dot(motion.row(0)) - force.row(0).dot(motion.row(1)));
        largest = std::max(largest, force.norm());
      }
      scale += k * largest * motion.norm();
    }
    if (!(scale > 0.0)) continue;
    const double apart = std::abs(point.report.slip_work - brought) / scale;
    result.worst = std::max(result.worst, apart);
    if (!(apart <= 1e-9) && result.differs.empty()) {
      std::ostringstream words;
      words << apart << ": slips " << point.report.slip_work << " J of " << brought << " at "
            << point.frequency / 2.0 / pi << " Hz";
      result.differs = words.str();
    }
  }
  return result;
}

}  // namespace

CurveShape shape_of(const SceneNumbers& numbers, double seconds) {
  const solver::Scene scene = scene_of(numbers);
  const auto options = options_of(numbers);
  const auto curve = solver::trace_response(scene, options, within(seconds));
  CurveShape shape;
  shape.peaks = places(curve, solver::PointMark::peak);
  shape.folds = places(curve, solver::PointMark::fold);
  shape.complete = curve.complete;
  shape.stopped = curve.diagnosis == solver::Diagnosis::interrupted;
  shape.said = said_of(curve);
  for (const auto& point : curve.points) shape.largest = std::max(shape.largest, point.amplitude);
  if (!curve.complete || curve.points.empty()) return shape;
  shape.first = curve.points.front().amplitude;
  shape.last = curve.points.back().amplitude;
  const double low = std::min(numbers.begin, numbers.end);
  const double width = std::abs(numbers.end - numbers.begin);
  for (const double share : fixed_shares) {
    std::vector<double> found;
    for (const auto& point :
         solver::points_at_frequency(scene, curve, low + share * width, options)) {
      found.push_back(point.amplitude);
    }
    std::ranges::sort(found);
    shape.amplitudes.push_back(std::move(found));
  }
  return shape;
}

Comparison compared(const CurveShape& now, const CurveShape& before, const Factors& factors) {
  if (now.stopped || before.stopped) return {.worst = 0.0, .differs = {}, .stopped = true};
  Comparison result;
  if (now.complete != before.complete) result.differs = "not complete";
  compare_places("peaks", now.peaks, before.peaks, factors, before.largest, result);
  compare_places("folds", now.folds, before.folds, factors, before.largest, result);
  for (std::size_t i = 0; i < std::min(now.amplitudes.size(), before.amplitudes.size()); ++i) {
    if (now.amplitudes[i].size() != before.amplitudes[i].size()) {
      result.differs += "; " + std::to_string(now.amplitudes[i].size()) + " solutions at " +
                        std::to_string(fixed_shares[i]) + " of the range, not " +
                        std::to_string(before.amplitudes[i].size());
      continue;
    }
    for (std::size_t k = 0; k < before.amplitudes[i].size(); ++k) {
      const double worst =
          std::abs(now.amplitudes[i][k] / factors.amplitude - before.amplitudes[i][k]) /
          before.largest;
      result.worst = std::max(result.worst, worst);
      if (!(worst <= factors.tolerance)) {
        result.differs += "; solutions at " + std::to_string(fixed_shares[i]) + " of the range";
        break;
      }
    }
  }
  if (!result.differs.empty()) {
    result.differs += " [" + before.said + " | " + now.said + "]";
  }
  return result;
}

const std::vector<Relation>& relations() {
  static const std::vector<Relation> all{
      other_units("M1", "another system of units", 1e-3, 1e3, 7.0, walks_differ),
      // Powers of two, the mass one of four: whatever is rounded, is so in these units too, and a
      // tolerance that is a length, a force or a time is all that could differ.
      other_units("M1 exact", "units that leave rounding alone", 0x1p-10, 0x1p+10, 0x1p+3, 1e-12),
      {"M2", "axes of the patch turned", of_turned_axes},
      always("M3", "order of modes and points", reverse_order),
      always("M4", "signs of modes", turn_signs),
      {"M5", "basis of a repeated pair", of_pair},
      always("M6", "a point split in two", split_point),
      always("M7", "phase of the force", shift_phase),
      {"M8", "sweeps up and down", of_sweeps},
      scaled("M9 down", "forces and loads times 1e-10", 1e-10),
      scaled("M9 up", "forces and loads times 1e8", 1e8),
      {"M10", "friction coefficient against load", of_product},
      {"M11 stuck", "a large load", of_large_load},
      {"M11 free", "a large gap", of_large_gap},
      always("M12", "a mirrored slip direction", mirror),
      always("M13", "a mode that nothing moves", add_still_mode),
      always("M15", "area against stiffness", double_area),
      {"M16", "without damping, work of friction", of_work}};
  return all;
}

const Relation& relation(const std::string& name) {
  for (const Relation& one : relations()) {
    if (one.name == name) return one;
  }
  throw std::out_of_range("there is no relation " + name);
}

}  // namespace microslip::tests
