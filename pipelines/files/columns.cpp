#include "pipelines/files/columns.hpp"

#include <array>
#include <numbers>

#include <fmt/core.h>

#include "pipelines/system/output_file.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

using contact::ContactMap;
using contact::CycleReport;
using contact::PatchSamples;
using solver::ResponsePoint;

constexpr double two_pi = 2.0 * std::numbers::pi;
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
        "amplitude_low_m", "m", "`amplitude_m` less the error of the curve's highest peak",
        [](const auto& a) { return format_number(std::max(0.0, a.amplitude * (1.0 - a.bar))); }},
    Column<TrustedAmplitude>{
        "amplitude_high_m", "m", "the same added",
        [](const auto& a) { return format_number(a.amplitude * (1.0 + a.bar)); }},
};

std::string number_or_nothing(const std::optional<double>& number) {
  return number ? format_number(*number) : "";
}

constexpr std::array ladder_table{
    Column<RungResult>{"value", "", "of the knob; sizes in m",
                       [](const auto& r) { return r.value; }},
    Column<RungResult>{"seconds", "s", "mesh, modes and this curve, wall time",
                       [](const auto& r) { return format_number(r.seconds); }},
    Column<RungResult>{"cpu_seconds", "s", "the same, processor time",
                       [](const auto& r) { return format_number(r.cpu_seconds); }},
    Column<RungResult>{"peak_amplitude_m", "m", "highest peak",
                       [](const auto& r) { return format_number(r.amplitude); }},
    Column<RungResult>{"peak_frequency_Hz", "Hz", "where it is",
                       [](const auto& r) { return format_number(in_hertz(r.frequency)); }},
    Column<RungResult>{"true_error", "1", "amplitude over that of the finest value, less 1",
                       [](const auto& r) { return number_or_nothing(r.true_error); }},
    Column<RungResult>{"estimated_error", "1", "the same as the error budget tells it",
                       [](const auto& r) { return number_or_nothing(r.estimated_error); }},
    Column<RungResult>{"order", "1", "of the true error in the size, from the value before",
                       [](const auto& r) { return number_or_nothing(r.order); }},
    Column<RungResult>{"curve", "", "its name", [](const auto& r) { return r.curve; }},
};

constexpr std::array campbell_table{
    Column<CampbellRow>{"speed_rpm", "rpm", "of rotation",
                        [](const auto& r) { return format_number(60.0 * r.speed / two_pi); }},
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
                     [](const auto& c) { return format_number(60.0 * c.speed / two_pi); }},
    Column<Crossing>{
        "frequency_Hz", "Hz", "of both",
        [](const auto& c) { return format_number(c.engine_order * c.speed / two_pi); }},
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
    MapArray<Eigen::VectorXd>{"slip_guard_Pa", "Pa",
                              "above 0 the point slips at some time of the period",
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

constexpr std::array sample_table{
    SampleArray{"friction_coefficient", "1", "that at rest where it depends on the slip speed",
                [](const PatchSamples& s) { return s.friction; }},
    SampleArray{"tangential_stiffness", "N/m^3", "along p, flexibility of omitted modes included",
                stiffness<0>},
    SampleArray{"normal_stiffness", "N/m^3", "likewise along q", stiffness<1>},
    SampleArray{"tangential_stiffness_r", "N/m^3", "likewise along r", stiffness<2>},
    SampleArray{"preload", "Pa", "at unit load: 1 N over the patch, or as given; negative: a gap",
                [](const PatchSamples& s) { return s.preload; }},
};

template <typename Rows>
void add_table(std::string& text, const std::string& title, const Rows& rows,
               const char* prefix = "") {
  text += fmt::format("\n## {}\n\n| name | unit | what it is |\n|---|---|---|\n", title);
  for (const auto& row : rows) {
    text += fmt::format("| `{}{}` | {} | {} |\n", prefix, row.name, row.unit, row.doc);
  }
}

}  // namespace

std::span<const Column<ResponsePoint>> curve_columns() { return point_table; }
std::span<const Column<CycleReport>> patch_columns() { return patch_table; }
std::span<const Column<TrustedAmplitude>> trust_columns() { return trust_table; }
std::span<const Column<RungResult>> ladder_columns() { return ladder_table; }
std::span<const Column<CampbellRow>> campbell_columns() { return campbell_table; }
std::span<const Column<Crossing>> crossing_columns() { return crossing_table; }
std::span<const Column<ModeRow>> mode_columns() { return mode_table; }
std::span<const Column<OptimumRow>> optimum_columns(bool of_preload) {
  return of_preload ? std::span<const Column<OptimumRow>>(preload_table) : parameter_table;
}
std::span<const MapArray<Eigen::MatrixXd>> instant_arrays() { return instant_table; }
std::span<const MapArray<Eigen::VectorXd>> cycle_arrays() { return cycle_table; }
std::span<const SampleArray> sample_arrays() { return sample_table; }

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
      "(`pipelines/files/columns.cpp`); a test keeps the two the same.\n";
  add_table(text, "curves/NAME.csv", point_table);
  add_table(text, "curves/NAME.csv, where its error is told ([accuracy])", trust_table);
  add_table(text, "curves/NAME.csv, for each of several contacts", patch_table, "CONTACT.");
  add_table(text, "converge/KNOB.csv", ladder_table);
  add_table(text, "campbell/frequencies.csv", campbell_table);
  add_table(text, "campbell/crossings.csv", crossing_table);
  add_table(text, "modes.csv", mode_table);
  add_table(text, "peak_against_preload.csv (peak_against_parameter.csv: `value` in front)",
            preload_table);
  add_table(text, "maps/NAME_*.vtp and maps/NAME.h5: at each phase", instant_table);
  add_table(text, "maps/NAME_*.vtp and maps/NAME.h5: of the period", cycle_table);
  add_table(text, "model.h5: at the points of a contact (`vertex_` in front: at its vertices)",
            sample_table, "/contact/");
  return text;
}

}  // namespace microslip::pipelines
