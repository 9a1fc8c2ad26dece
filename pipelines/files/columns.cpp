#include "pipelines/files/columns.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include <fmt/core.h>

#include "contact/phase.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

using contact::ContactMap;
using contact::CycleReport;
using contact::Patch;
using contact::PatchSamples;
using solver::ResponsePoint;

constexpr double degrees = 180.0 / std::numbers::pi;

const char* mark_name(solver::PointMark mark) {
  switch (mark) {
    case solver::PointMark::peak:
      return "peak";
    case solver::PointMark::fold:
      return "fold";
    case solver::PointMark::none:
      break;
  }
  return "";
}

/// How many harmonics were unknowns at a point.
std::size_t n_harmonics(const ResponsePoint& point) {
  return point.orders.empty() ? static_cast<std::size_t>(point.q.n_harmonics())
                              : point.orders.size();
}

/// In quotes where it would be several columns.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted.append(letter == '"' ? 2 : 1, letter);
  return quoted + '"';
}

std::string or_empty(const std::optional<double>& value) {
  return value ? format_number(*value) : std::string();
}

constexpr std::array point_table{
    Column<ResponsePoint>{"frequency_Hz", "Hz", "of the excitation",
                          [](const auto& p) { return format_number(in_hertz(p.frequency)); }},
    Column<ResponsePoint>{"amplitude_m", "m",
                          "half the peak-to-peak value of the output over the period",
                          [](const auto& p) { return format_number(p.amplitude); }},
    Column<ResponsePoint>{"amplitude_1_m", "m", "first harmonic of the output",
                          [](const auto& p) { return format_number(p.first_amplitude); }},
    Column<ResponsePoint>{"mean_m", "m", "mean of the output",
                          [](const auto& p) { return format_number(p.mean); }},
    Column<ResponsePoint>{"phase_deg", "deg", "of the first harmonic, atan2(y_c, y_s)",
                          [](const auto& p) { return format_number(p.phase * degrees); }},
    Column<ResponsePoint>{
        "stable", "", "1 stable, 0 unstable, -1 not assessed",
        [](const auto& p) { return fmt::format("{}", static_cast<int>(p.stability)); }},
    Column<ResponsePoint>{"stick_share", "1", "of (contact area x period) that sticks",
                          [](const auto& p) { return format_number(p.report.stick_share); }},
    Column<ResponsePoint>{"slip_share", "1", "the same that slips",
                          [](const auto& p) { return format_number(p.report.slip_share); }},
    Column<ResponsePoint>{"separated_share", "1", "the same that is separated; the three sum to 1",
                          [](const auto& p) { return format_number(p.report.separated_share); }},
    Column<ResponsePoint>{
        "three_states_share", "1",
        "largest over the phase of the smallest of the three area fractions at one instant",
        [](const auto& p) { return format_number(p.report.three_states_share); }},
    Column<ResponsePoint>{
        "residual", "1",
        "of the equations, relative to max(excitation, contact force of the stuck limit)",
        [](const auto& p) { return format_number(p.residual); }},
    Column<ResponsePoint>{
        "energy_imbalance", "1",
        "abs(W_exc - W_damp - W_fric) over max(abs(W_exc), W_damp + W_fric) of one period",
        [](const auto& p) { return format_number(p.energy_imbalance); }},
    Column<ResponsePoint>{
        "dissipation_mismatch", "1",
        "work of the modal friction force against that of the slip phases, over the same",
        [](const auto& p) { return format_number(p.dissipation_mismatch); }},
    Column<ResponsePoint>{"mark", "", "peak, fold or empty",
                          [](const auto& p) { return std::string(mark_name(p.mark)); }},
    Column<ResponsePoint>{"awake_share", "1", "of the contact points, evaluated one by one",
                          [](const auto& p) { return format_number(p.report.awake_share); }},
    Column<ResponsePoint>{"iterations", "1", "of Newton's method",
                          [](const auto& p) { return fmt::format("{}", p.iterations); }},
    Column<ResponsePoint>{"harmonics", "1", "that were unknowns, the mean not counted",
                          [](const auto& p) { return fmt::format("{}", n_harmonics(p)); }},
    Column<ResponsePoint>{"amplitude_slope_m_per_Hz", "m/Hz",
                          "of the branch: change of `amplitude_m` with the frequency; empty at a "
                          "fold, and of motions that are integrated",
                          [](const auto& p) {
                            return p.slope ? format_number(p.slope->amplitude * contact::two_pi)
                                           : std::string();
                          }},
    Column<ResponsePoint>{"phase_slope_deg_per_Hz", "deg/Hz", "the same of `phase_deg`",
                          [](const auto& p) {
                            return p.slope ? format_number(p.slope->phase * 360.0) : std::string();
                          }},
};

/// Of the column of that name in curves/NAME.csv.
constexpr std::size_t place_of(std::string_view name) {
  const auto* const found = std::ranges::find(point_table, name, &Column<ResponsePoint>::name);
  return static_cast<std::size_t>(found - point_table.begin());
}

/// A column of a curve in the history of its run.
template <std::size_t place>
constexpr Column<HistoryRow> of_point{
    point_table[place].name, point_table[place].unit, point_table[place].doc,
    [](const auto& row) { return point_table[place].text(row.point); }};

constexpr std::array history_table{
    Column<HistoryRow>{"curve", "", "its name", [](const auto& row) { return row.curve; }},
    Column<HistoryRow>{
        "frequency_Hz", "Hz", "of the excitation",
        [](const auto& row) { return format_number(row.point.frequency / contact::two_pi); }},
    of_point<place_of("amplitude_m")>,
    of_point<place_of("stable")>,
    of_point<place_of("stick_share")>,
    of_point<place_of("slip_share")>,
    of_point<place_of("separated_share")>,
    of_point<place_of("iterations")>,
    of_point<place_of("mark")>,
    Column<HistoryRow>{"seconds", "s", "wall time since the program began",
                       [](const auto& row) { return fmt::format("{:.3f}", row.seconds); }},
};

constexpr std::array patch_table{
    Column<CycleReport>{"stick_share", "1", "of (area of the patch x period) that sticks",
                        [](const auto& r) { return format_number(r.stick_share); }},
    Column<CycleReport>{"slip_share", "1", "the same that slips",
                        [](const auto& r) { return format_number(r.slip_share); }},
    Column<CycleReport>{"separated_share", "1", "the same that is separated",
                        [](const auto& r) { return format_number(r.separated_share); }},
};

constexpr std::array trust_table{
    Column<TrustedAmplitude>{
        "amplitude_low_m", "m",
        "the least amplitude at this frequency by the errors that the run tells",
        [](const auto& a) { return format_number(a.low); }},
    Column<TrustedAmplitude>{"amplitude_high_m", "m", "the largest",
                             [](const auto& a) { return format_number(a.high); }},
};

constexpr std::array ladder_table{
    Column<RungResult>{"value", "", "of the knob; sizes in m, mesh files by name",
                       [](const auto& r) { return csv_text(r.value); }},
    Column<RungResult>{"seconds", "s", "mesh, modes and this curve, wall time, median of the runs",
                       [](const auto& r) { return format_number(r.seconds); }},
    Column<RungResult>{"cpu_seconds", "s", "the same, processor time",
                       [](const auto& r) { return format_number(r.cpu_seconds); }},
    Column<RungResult>{"peak_amplitude_m", "m", "highest peak",
                       [](const auto& r) { return format_number(r.amplitude); }},
    Column<RungResult>{"peak_frequency_Hz", "Hz", "where it is",
                       [](const auto& r) { return format_number(in_hertz(r.frequency)); }},
    Column<RungResult>{"true_error", "1", "amplitude over that of the finest value, less 1",
                       [](const auto& r) { return or_empty(r.true_error); }},
    Column<RungResult>{"estimated_error", "1", "the same as the error budget tells it",
                       [](const auto& r) { return or_empty(r.estimated_error); }},
    Column<RungResult>{"order", "1", "of the true error in the size, from the value before",
                       [](const auto& r) { return or_empty(r.order); }},
    Column<RungResult>{"curve", "", "its name", [](const auto& r) { return r.curve; }},
    Column<RungResult>{"runs", "1", "how often mesh, modes and curve were timed, the least of them",
                       [](const auto& r) { return fmt::format("{}", r.runs); }},
    Column<RungResult>{"at", "",
                       "peak, or range_end where the highest place is an end of the range",
                       [](const auto& r) { return std::string(r.is_peak ? "peak" : "range_end"); }},
};

constexpr std::array campbell_table{
    Column<CampbellRow>{
        "speed_rpm", "rpm", "of rotation",
        [](const auto& r) { return format_number(60.0 * r.speed / contact::two_pi); }},
    Column<CampbellRow>{"mode", "1", "number at this speed, from 1",
                        [](const auto& r) { return fmt::format("{}", r.mode + 1); }},
    Column<CampbellRow>{"frequency_Hz", "Hz", "natural frequency without contact",
                        [](const auto& r) { return format_number(in_hertz(r.frequency)); }},
};

constexpr std::array crossing_table{
    Column<Crossing>{"engine_order", "1", "excitations per turn",
                     [](const auto& c) { return fmt::format("{}", c.engine_order); }},
    Column<Crossing>{"mode", "1", "number, from 1",
                     [](const auto& c) { return fmt::format("{}", c.mode + 1); }},
    Column<Crossing>{"speed_rpm", "rpm", "at which they meet",
                     [](const auto& c) { return format_number(60.0 * c.speed / contact::two_pi); }},
    Column<Crossing>{
        "frequency_Hz", "Hz", "of both",
        [](const auto& c) { return format_number(c.engine_order * c.speed / contact::two_pi); }},
};

constexpr std::array mode_table{
    Column<ModeRow>{"mode", "1", "number, from 1",
                    [](const auto& m) { return fmt::format("{}", m.mode); }},
    Column<ModeRow>{"frequency_Hz", "Hz", "natural frequency without contact",
                    [](const auto& m) { return format_number(in_hertz(m.frequency)); }},
    Column<ModeRow>{"residual", "1",
                    "of the eigenpair; empty for modes that were given and attachment shapes",
                    [](const auto& m) { return or_empty(m.residual); }},
    Column<ModeRow>{"damping_ratio", "1", "of critical damping",
                    [](const auto& m) { return or_empty(m.damping_ratio); }},
    Column<ModeRow>{"fit_error", "1",
                    "of the fitted mode shape on the contact, relative; the largest of the patches",
                    [](const auto& m) { return or_empty(m.fit_error); }},
    Column<ModeRow>{
        "kind", "", "free, or attachment (a static shape)",
        [](const auto& m) { return std::string(m.is_attachment ? "attachment" : "free"); }},
};

constexpr Column<OptimumRow> preload_column{
    "preload_N", "N", "total normal force (a factor where loads are scales)",
    [](const auto& row) { return format_number(row.peak.parameter); }};
constexpr Column<OptimumRow> value_column{
    "value", "", "of the key that is searched, in SI",
    [](const auto& row) { return format_number(row.peak.parameter); }};
constexpr Column<OptimumRow> peak_frequency_column{
    "frequency_Hz", "Hz", "of the highest peak",
    [](const auto& row) { return format_number(in_hertz(row.peak.frequency)); }};
constexpr Column<OptimumRow> peak_amplitude_column{
    "amplitude_m", "m", "there", [](const auto& row) { return format_number(row.peak.amplitude); }};
constexpr Column<OptimumRow> place_column{
    "at", "", "peak, range_end (of the frequency range) or unsolved",
    [](const auto& row) { return std::string(to_string(row.peak.place)); }};
constexpr Column<OptimumRow> optimum_mark_column{
    "mark", "", "optimum, flat (as good as it), or empty", [](const auto& row) {
      const solver::Optimum& optimum = row.optimum;
      const double value = row.peak.parameter;
      if (optimum.found && value == optimum.best.parameter) return std::string("optimum");
      const bool flat = optimum.flat && value >= (*optimum.flat)[0] && value <= (*optimum.flat)[1];
      return std::string(flat ? "flat" : "");
    }};
constexpr std::array preload_table{preload_column, peak_frequency_column, peak_amplitude_column,
                                   place_column, optimum_mark_column};
constexpr std::array parameter_table{value_column, peak_frequency_column, peak_amplitude_column,
                                     place_column, optimum_mark_column};

constexpr std::array sampled_cycle_table{
    Column<CycleInstant>{"phase_deg", "deg", "from 0 to 360",
                         [](const auto& i) {
                           return format_number(i.phase < contact::two_pi ? i.phase * degrees
                                                                          : 360.0);
                         }},
    Column<CycleInstant>{"u_m", "m", "relative displacement along p, mean included",
                         [](const auto& i) { return format_number(i.at.motion[0]); }},
    Column<CycleInstant>{"v_m", "m", "along q, mean included, positive when it closes",
                         [](const auto& i) { return format_number(i.at.motion[1]); }},
    Column<CycleInstant>{"w_m", "m", "along r, mean included",
                         [](const auto& i) { return format_number(i.at.motion[2]); }},
    Column<CycleInstant>{"friction_Pa", "Pa",
                         "friction along p; in N where the stiffness of the point is in N/m",
                         [](const auto& i) { return format_number(i.at.traction[0]); }},
    Column<CycleInstant>{"normal_Pa", "Pa", "normal load, likewise",
                         [](const auto& i) { return format_number(i.at.traction[1]); }},
    Column<CycleInstant>{"friction_w_Pa", "Pa", "friction along r, likewise",
                         [](const auto& i) { return format_number(i.at.traction[2]); }},
    Column<CycleInstant>{"slip_m", "m", "position of the slider along p",
                         [](const auto& i) { return format_number(i.at.slider[0]); }},
    Column<CycleInstant>{"slip_w_m", "m", "position of the slider along r",
                         [](const auto& i) { return format_number(i.at.slider[1]); }},
    Column<CycleInstant>{
        "state", "",
        "stick, positive_slip, negative_slip, slip (in two directions) or separated, from here on",
        [](const auto& i) { return std::string(i.state); }},
};

constexpr std::array instant_table{
    MapArray<Eigen::MatrixXd>{"normal_traction_Pa", "Pa", "pressure, n",
                              &ContactMap::normal_traction},
    MapArray<Eigen::MatrixXd>{"friction_traction_Pa", "Pa", "friction along p",
                              &ContactMap::friction_traction},
    MapArray<Eigen::MatrixXd>{"relative_displacement_m", "m", "along p, mean included",
                              &ContactMap::relative_displacement},
    MapArray<Eigen::MatrixXd>{"approach_m", "m", "along q, mean included, positive when it closes",
                              &ContactMap::approach},
    MapArray<Eigen::MatrixXd>{"slip_m", "m", "position of the slider along p", &ContactMap::slip},
    MapArray<Eigen::MatrixXd>{"friction_traction_r_Pa", "Pa", "friction along r, where simulated",
                              &ContactMap::friction_traction_r},
    MapArray<Eigen::MatrixXd>{"relative_displacement_r_m", "m", "along r, where simulated",
                              &ContactMap::relative_displacement_r},
    MapArray<Eigen::MatrixXd>{"slip_r_m", "m", "position of the slider along r, where simulated",
                              &ContactMap::slip_r},
};

constexpr std::array cycle_table{
    MapArray<Eigen::VectorXd>{
        "slip_guard_Pa", "Pa",
        "above 0 a point that touches and rubs slips at some time of the period",
        &ContactMap::slip_guard},
    MapArray<Eigen::VectorXd>{"smallest_load_Pa", "Pa", "below 0 it is open at some time",
                              &ContactMap::smallest_load},
    MapArray<Eigen::VectorXd>{"largest_load_Pa", "Pa", "below 0 it is open throughout",
                              &ContactMap::largest_load},
    MapArray<Eigen::VectorXd>{"friction_coefficient", "1",
                              "of the point, that at rest where it depends on the slip speed",
                              &ContactMap::friction_coefficient},
    MapArray<Eigen::VectorXd>{"dissipated_energy_J_per_m2", "J/m^2", "by friction in one period",
                              &ContactMap::dissipated_energy},
    MapArray<Eigen::VectorXd>{"slip_distance_m", "m", "in contact, in one period",
                              &ContactMap::slip_distance},
    MapArray<Eigen::VectorXd>{"wear_depth_m", "m", "Archard's, in one period",
                              &ContactMap::wear_depth},
    MapArray<Eigen::VectorXd>{"slip_duration", "1", "share of the period in slip",
                              &ContactMap::slip_duration},
    MapArray<Eigen::VectorXd>{"separation_duration", "1", "share of the period without contact",
                              &ContactMap::separation_duration},
};

template <int axis>
Eigen::VectorXd stiffness(const PatchSamples& samples) {
  return samples.stiffness.col(axis);
}

using Fields = Dataset<PatchSamples, Eigen::VectorXd>;
constexpr std::array sample_table{
    Fields{"friction_coefficient", "1", "that at rest where it depends on the slip speed",
           [](const PatchSamples& s) { return s.friction; }},
    Fields{"tangential_stiffness", "N/m^3", "along p, flexibility of omitted modes included",
           stiffness<0>},
    Fields{"normal_stiffness", "N/m^3", "likewise along q", stiffness<1>},
    Fields{"tangential_stiffness_r", "N/m^3", "likewise along r", stiffness<2>},
    Fields{"preload", "Pa",
           "preload field: rest load at a load of one (1 N over the patch, or the points as "
           "given); negative: a gap",
           [](const PatchSamples& s) { return s.preload_field; }},
};

using Shapes = Dataset<PatchSamples, Eigen::MatrixXd>;
constexpr std::array shape_table{
    Shapes{"phi_u", "1/kg^0.5", "relative mode shapes along p, places x modes",
           [](const PatchSamples& s) { return s.shapes.u; }},
    Shapes{"phi_v", "1/kg^0.5", "along q, positive when it closes",
           [](const PatchSamples& s) { return s.shapes.v; }},
    Shapes{"phi_w", "1/kg^0.5", "along r", [](const PatchSamples& s) { return s.shapes.w; }},
};

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

using OfModel = Dataset<ReducedModel, Eigen::VectorXd>;
constexpr std::array model_table{
    OfModel{"frequency_Hz", "Hz", "natural frequencies without contact",
            [](const ReducedModel& m) -> Eigen::VectorXd { return m.frequency / contact::two_pi; }},
    OfModel{"angular_frequency", "rad/s", "the same", [](const auto& m) { return m.frequency; }},
    OfModel{"damping_ratio", "1", "of critical damping",
            [](const auto& m) { return m.damping_ratio; }},
    OfModel{"n_attachment", "1", "so many of the modes, the last, are static shapes",
            [](const auto& m) { return one(static_cast<double>(m.n_attachment)); }},
    OfModel{"force_sine", "N/kg^0.5", "modal excitation, sine of the first harmonic",
            [](const auto& m) { return m.force_sine; }},
    OfModel{"force_cosine", "N/kg^0.5", "its cosine", [](const auto& m) { return m.force_cosine; }},
    OfModel{"force_static", "N/kg^0.5", "its mean", [](const auto& m) { return m.force_static; }},
    OfModel{"output", "1/kg^0.5", "the output is this times the modal coordinates",
            [](const auto& m) { return m.output; }},
};

/// @param own  of points with axes of their own, else without rows.
Eigen::MatrixXd axis_of_points(const Patch& patch, const Eigen::MatrixX3d& own, Eigen::Index axis) {
  if (own.rows() > 0) return own;
  return patch.frame.row(axis).replicate(patch.cells.weights.size(), 1);
}

using Places = Dataset<Patch, Eigen::MatrixXd>;
constexpr std::array patch_place_table{
    Places{"points", "m", "contact points, n x 3",
           [](const Patch& p) -> Eigen::MatrixXd { return p.cells.points; }},
    Places{"frame", "1", "rows p, q (normal), r",
           [](const Patch& p) -> Eigen::MatrixXd { return p.frame; }},
    Places{"vertices", "m", "of the cells, n x 3",
           [](const Patch& p) -> Eigen::MatrixXd { return p.vertices.points; }},
    Places{"slip_directions", "1", "p of each contact point, n x 3: that of the frame, or its own",
           [](const Patch& p) { return axis_of_points(p, p.cells.slip_directions, 0); }},
    Places{"normals", "1", "q of each contact point, n x 3, likewise",
           [](const Patch& p) { return axis_of_points(p, p.cells.normals, 1); }},
};

/// Coordinates (p, r) in the plane of the patch, from its centroid where it has cells.
Eigen::MatrixXd in_plane(const contact::Patch& patch, const Eigen::MatrixX3d& positions) {
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();
  if (patch.connectivity.rows() > 0 && patch.cells.weights.sum() > 0.0) {
    origin = contact::centroid(patch).transpose();
  }
  const Eigen::MatrixX3d local = (positions.rowwise() - origin) * patch.frame.transpose();
  Eigen::MatrixXd plane(local.rows(), 2);
  plane << local.col(0), local.col(2);
  return plane;
}

constexpr std::array map_place_table{
    Places{"points", "m",
           "(p, r) of the contact points in the plane of the contact, from its centroid",
           [](const Patch& p) { return in_plane(p, point_positions(p)); }},
    Places{"vertices", "m", "the same of the vertices of their cells",
           [](const Patch& p) { return in_plane(p, p.vertices.points); }},
};

using OfPatch = Dataset<Patch, Eigen::VectorXd>;
constexpr std::array weight_table{
    OfPatch{"weights", "m^2", "area of each contact point",
            [](const Patch& p) { return p.cells.weights; }},
};
constexpr std::array fit_table{
    OfPatch{"fit_degree", "1", "of the polynomials fitted to the mode shapes; -1: none",
            [](const Patch& p) { return one(static_cast<double>(p.fit_degree)); }},
    OfPatch{"load_share", "1",
            "of a load that presses, relative to the other contacts: what the preload field is "
            "multiplied by is the load times this over the sum of all; moments tilt the bodies, "
            "which no field says",
            [](const Patch& p) { return one(p.load_share); }},
    OfPatch{"fit_error", "1", "of them, relative, one per mode",
            [](const Patch& p) { return p.fit_error; }},
};
constexpr std::array cell_table{
    Dataset<Patch, Indices>{
        "cells", "1", "vertices of the cell of each contact point, from 0",
        [](const Patch& p) -> Indices { return p.connectivity.cast<std::int64_t>(); }},
};

using OfMap = Dataset<NamedMap, Eigen::VectorXd>;
constexpr std::array map_table{
    OfMap{"frequency_Hz", "Hz", "of the excitation",
          [](const NamedMap& m) { return one(m.frequency_hz); }},
    OfMap{"amplitude_m", "m", "of the output, half peak-to-peak",
          [](const NamedMap& m) { return one(m.amplitude); }},
    OfMap{"stable", "1", "1 stable, 0 unstable, -1 not assessed",
          [](const NamedMap& m) { return one(static_cast<double>(m.stability)); }},
    OfMap{"phase_deg", "deg", "of the columns of the fields below",
          [](const NamedMap& m) -> Eigen::VectorXd { return m.points.phase * degrees; }},
};

constexpr double degree = std::numbers::pi / 180.0;

/// Angles; −1 where there is none: readers of files stumble over NaN.
Eigen::MatrixXd begins_in_degrees(const Eigen::MatrixXd& begins) {
  return (begins.array() == begins.array()).select(begins.array() / degree, -1.0);
}

using Transitions = Dataset<ContactMap, Eigen::MatrixXd>;
constexpr std::array transition_table{
    Transitions{
        "state_start_deg", "deg",
        "where each state first begins, places x 5; -1: never, or it lasts throughout",
        [](const ContactMap& m) -> Eigen::MatrixXd { return begins_in_degrees(m.state_start); }},
    Transitions{
        "state_starts_deg", "deg", "all its begins, m columns for each state; -1 beyond",
        [](const ContactMap& m) -> Eigen::MatrixXd { return begins_in_degrees(m.state_starts); }},
    Transitions{"state_share", "1", "of the period in each state, places x 5",
                [](const ContactMap& m) { return m.state_share; }},
};

constexpr std::array<const char*, 5> stem_table{"stick", "positive_slip", "negative_slip",
                                                "separation", "slip"};
using OfState = StateArray<Eigen::VectorXd>;
constexpr std::array state_table{
    OfState{"start_deg", "deg", "where it first begins; -1: never, or it lasts throughout",
            [](const ContactMap& m, Eigen::Index state) -> Eigen::VectorXd {
              return begins_in_degrees(m.state_start.col(state));
            }},
    OfState{"share", "1", "of the period",
            [](const ContactMap& m, Eigen::Index state) -> Eigen::VectorXd {
              return m.state_share.col(state);
            }},
};
constexpr std::array count_table{
    StateArray<Eigen::VectorXi>{"starts", "1", "how often it begins",
                                [](const ContactMap& m, Eigen::Index state) -> Eigen::VectorXi {
                                  const Eigen::Index most =
                                      m.state_starts.cols() / m.state_share.cols();
                                  const auto starts =
                                      m.state_starts.middleCols(state * most, most).array();
                                  return (starts == starts).cast<int>().rowwise().sum().matrix();
                                }},
};

template <typename Row>
void add_row(std::string& text, const Row& row, const char* prefix = "", const char* suffix = "") {
  text += fmt::format("| `{}{}{}` | {} | {} |\n", prefix, row.name, suffix, row.unit, row.doc);
}

void add_title(std::string& text, const std::string& title) {
  text += fmt::format("\n## {}\n\n| name | unit | what it is |\n|---|---|---|\n", title);
}

/// One after the other.
template <typename... Rows>
void add_rows(std::string& text, const char* prefix, const Rows&... tables) {
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows) add_row(text, row, prefix);
  };
  (add(tables), ...);
}

template <typename Rows>
void add_table(std::string& text, const std::string& title, const Rows& rows,
               const char* prefix = "") {
  add_title(text, title);
  add_rows(text, prefix, rows);
}

void add_map_tables(std::string& text) {
  add_table(text, "maps/NAME_*.vtp and maps/NAME.h5: at each phase", std::array{state_entry});
  add_rows(text, "", instant_table);
  add_table(text, "maps/NAME_*.vtp and maps/NAME.h5: of the period", cycle_table);
  std::string stems;
  for (const char* stem : stem_table)
    stems += fmt::format("{}`{}`", stems.empty() ? "" : ", ", stem);
  add_table(
      text,
      fmt::format(
          "maps/NAME_*.vtp: of the period, of each STATE of {} (the last in two directions; the "
          "`slip_share` of a curve has all three)",
          stems),
      state_table, "STATE_");
  add_rows(text, "STATE_", count_table);
  add_table(text, "maps/NAME.h5: of the map", map_table);
  add_rows(text, "", map_place_table, weight_table, cell_table);
  add_table(text,
            "maps/NAME.h5: at its points (`vertex_` in front, and before `state` and what is of "
            "the period: at its vertices)",
            transition_table);
}

void add_model_tables(std::string& text) {
  add_table(text, "model.h5: modes, excitation and output", model_table, "/");
  add_table(text, "model.h5: of a contact (`/contact_2/`, … further ones)", patch_place_table,
            "/contact/");
  add_rows(text, "/contact/", weight_table, cell_table, fit_table);
  add_table(text, "model.h5: at the points of a contact (`vertex_` in front: at its vertices)",
            shape_table, "/contact/");
  add_rows(text, "/contact/", sample_table);
}

}  // namespace

std::span<const Column<ResponsePoint>> curve_columns() { return point_table; }
std::span<const Column<CycleReport>> patch_columns() { return patch_table; }
std::span<const Column<TrustedAmplitude>> trust_columns() { return trust_table; }
std::span<const Column<HistoryRow>> history_columns() { return history_table; }
std::span<const Column<RungResult>> ladder_columns() { return ladder_table; }
std::span<const Column<CampbellRow>> campbell_columns() { return campbell_table; }
std::span<const Column<Crossing>> crossing_columns() { return crossing_table; }
std::span<const Column<ModeRow>> mode_columns() { return mode_table; }
std::span<const Column<OptimumRow>> optimum_columns(bool of_preload) {
  return of_preload ? std::span<const Column<OptimumRow>>(preload_table) : parameter_table;
}
std::span<const Column<CycleInstant>> cycle_columns() { return sampled_cycle_table; }
std::span<const MapArray<Eigen::MatrixXd>> instant_arrays() { return instant_table; }
std::span<const MapArray<Eigen::VectorXd>> cycle_arrays() { return cycle_table; }
std::span<const StateArray<Eigen::VectorXd>> state_arrays() { return state_table; }
std::span<const StateArray<Eigen::VectorXi>> state_counts() { return count_table; }
std::span<const char* const> state_stems() { return stem_table; }
std::span<const Dataset<NamedMap, Eigen::VectorXd>> map_arrays() { return map_table; }
std::span<const Dataset<ContactMap, Eigen::MatrixXd>> transition_arrays() {
  return transition_table;
}
std::span<const Dataset<Patch, Eigen::MatrixXd>> map_places() { return map_place_table; }
std::span<const Dataset<ReducedModel, Eigen::VectorXd>> model_arrays() { return model_table; }
std::span<const Dataset<Patch, Eigen::MatrixXd>> patch_places() { return patch_place_table; }
std::span<const Dataset<Patch, Eigen::VectorXd>> fit_arrays() { return fit_table; }
std::span<const Dataset<PatchSamples, Eigen::VectorXd>> sample_arrays() { return sample_table; }
std::span<const Dataset<PatchSamples, Eigen::MatrixXd>> shape_arrays() { return shape_table; }
std::span<const Dataset<Patch, Eigen::VectorXd>> weight_arrays() { return weight_table; }
std::span<const Dataset<Patch, Indices>> cell_arrays() { return cell_table; }

/// Positions of the contact points [m]; a row along p where the model has none.
Eigen::MatrixX3d point_positions(const contact::Patch& patch) {
  const Eigen::MatrixX3d& points = patch.cells.points;
  const Eigen::Index n = patch.cells.weights.size();
  const bool given = points.rows() == n &&
                     (n < 2 || (points.rowwise() - points.row(0)).cwiseAbs().maxCoeff() > 0.0);
  if (given) return points;
  constexpr double spacing = 1e-3;  // [m]: a scale for pictures, nothing is computed from it
  Eigen::MatrixX3d row(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    row.row(i) = spacing * static_cast<double>(i) * patch.frame.row(0);
  }
  return row;
}

const char* to_string(solver::PeakPlace place) {
  switch (place) {
    case solver::PeakPlace::peak:
      return "peak";
    case solver::PeakPlace::range_end:
      return "range_end";
    case solver::PeakPlace::unsolved:
      break;
  }
  return "unsolved";
}

std::string columns_text() {
  std::string text =
      "# Columns and arrays\n\n"
      "Printed by `microslip columns` from the tables the files are written from "
      "(`pipelines/files/columns.cpp`); a test keeps the two the same. Pictures of a whole mesh "
      "carry the names of "
      "its surfaces and modes ([interfaces](interfaces.md)).\n";
  add_table(text, "curves/NAME.csv", point_table);
  add_table(text, "curves/NAME.csv, where its error is told ([accuracy])", trust_table);
  add_table(text, "curves/NAME.csv, for each of several contacts", patch_table, "CONTACT.");
  add_title(text, "curves/NAME.states.csv, of every MODE from 1 and harmonic K");
  add_row(text, point_table.front());
  add_row(text, mean_entry, "", "_MODE");
  add_row(text, sine_entry, "", "K_MODE");
  add_row(text, cosine_entry, "", "K_MODE");
  add_table(text, "history.csv", history_table);
  add_table(text, "converge/KNOB.csv", ladder_table);
  add_table(text, "campbell/frequencies.csv", campbell_table);
  add_table(text, "campbell/crossings.csv", crossing_table);
  add_table(text, "modes.csv", mode_table);
  add_table(text, "peak_against_preload.csv (peak_against_parameter.csv: `value` in front)",
            preload_table);
  add_table(text, "DIR/ID.csv of `cycle --plot DIR`", sampled_cycle_table);
  add_map_tables(text);
  add_model_tables(text);
  return text;
}

}  // namespace microslip::pipelines
