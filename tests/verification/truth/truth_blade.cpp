// The truth of the default blade: a verification program that shares nothing with contact/ and
// solver/.
//
//   build/tests/truth_blade                                   the stored table (about 20 min, one
//   core) build/tests/truth_blade --preloads 100,267 --harmonics 1,9 --directions p --csv out.csv
//   build/tests/truth_blade --help
//
// Model: the coarse default blade (10 mm), every node of the contact face kept (face_model.hpp);
// contact 1e11 N/m³ and mu 0.4 at the points of a three-point rule on the subdivided faces, a
// uniform pressure N/A, a gap -N/(k_v A) (sampled_return.hpp); harmonic balance on the freedoms of
// the face, condensed exactly (balance.hpp); whole curves by arclength (curve.hpp). 0.5 N at B and
// at B' along x or y, half peak-to-peak at A along x. Damping ratio 0.2 % of every shape,
// attachment shapes included. Directions: p has friction along p alone, pr along both.
//
// Columns: force, preload_N, directions, harmonics, peak_um, first_harmonic_um, peak_Hz, complete
// (the curve reached its end), curve_points, instants, contact_points, modes, time_um, time_Hz,
// time_periods, time_change, seconds. With --periods N the peak is solved for in time as well
// (time_march.hpp): at most N periods, of --steps steps, at each of three and more frequencies
// about that of the balance; time_change is what the amplitude changes over the last ten periods.
// 0: not asked for, or not enclosed.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/slepc_session.hpp"
#include "tests/verification/truth/curve.hpp"
#include "tests/verification/truth/time_march.hpp"

namespace microslip::truth {
namespace {

using Options = std::map<std::string, std::string>;

Options read_options(int argc, char** argv) {
  Options options{{"force", "x"},      {"preloads", ""},     {"harmonics", "1,3,5,7,9,13"},
                  {"directions", "p"}, {"instants", "512"},  {"subdivision", "2"},
                  {"modes", "60"},     {"element", "0.010"}, {"from", "285"},
                  {"to", "340"},       {"csv", ""},          {"verbose", "no"},
                  {"step", "0.4"},     {"curve", ""},        {"periods", "0"},
                  {"steps", "1024"}};
  for (int i = 1; i < argc; i += 2) {
    const std::string name =
        std::string(argv[i]).substr(std::string(argv[i]).rfind("--", 0) == 0 ? 2 : 0);
    if (!options.contains(name) || i + 1 >= argc) {
      std::string known;
      for (const auto& [key, value] : options) known += " --" + key + " (" + value + ")";
      throw std::invalid_argument("options:" + known);
    }
    options[name] = argv[i + 1];
  }
  if (options["preloads"].empty()) {
    options["preloads"] = options["force"] == "x" ? "-500,100,267,500,3000" : "-20,2,5,10,100";
  }
  return options;
}

std::vector<double> numbers(const std::string& list) {
  std::vector<double> result;
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) result.push_back(std::stod(item));
  return result;
}

FaceModel face_model(const Options& options) {
  FaceModelOptions model;
  model.element_size = std::stod(options.at("element"));
  model.n_modes = std::stol(options.at("modes"));
  model.subdivision = std::stoi(options.at("subdivision"));
  if (options.at("force") == "y") model.force_direction = {0.0, 1.0, 0.0};
  return build_face_model(model);
}

void write_curve(const std::string& file, const Curve& curve) {
  std::ofstream out(file);
  out << "frequency_Hz,amplitude_um,first_harmonic_um\n";
  for (const CurvePoint& p : curve.points) {
    out << p.omega / (2.0 * std::numbers::pi) << ',' << 1e6 * p.amplitude << ','
        << 1e6 * p.first_harmonic << '\n';
  }
}

const char* header =
    "force,preload_N,directions,harmonics,peak_um,first_harmonic_um,peak_Hz,complete,curve_points,"
    "instants,contact_points,modes,time_um,time_Hz,time_periods,time_change,seconds\n";

std::string row(const Options& options, const FaceModel& model, double preload, bool planar,
                int harmonics) {
  const auto start = std::chrono::steady_clock::now();
  ContactConstants contact;
  contact.pressure = preload / model.weights.sum();
  const int instants = std::stoi(options.at("instants"));
  Balance balance(model, contact, {.harmonics = harmonics, .instants = instants, .planar = planar});
  CurveOptions walk;
  walk.from_hz = std::stod(options.at("from"));
  walk.to_hz = std::stod(options.at("to"));
  walk.largest_step = std::stod(options.at("step"));
  walk.verbose = options.at("verbose") == "yes";
  const Curve curve = trace(balance, walk);
  if (!options.at("curve").empty()) write_curve(options.at("curve"), curve);
  CurvePoint peak;
  for (const CurvePoint& candidate : curve.peaks) {
    if (candidate.amplitude > peak.amplitude) peak = candidate;
  }
  TimePeak time;
  if (const int periods = std::stoi(options.at("periods")); periods > 0 && !curve.peaks.empty()) {
    static_cast<void>(balance.residual(peak.x, peak.omega));
    time = peak_in_time(model, contact, planar, balance.shapes(), peak.omega,
                        {.steps = std::stoi(options.at("steps")), .most_periods = periods});
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  char text[256];
  std::snprintf(
      text, sizeof text, "%s,%g,%s,%d,%.3f,%.3f,%.4f,%d,%zu,%d,%ld,%s,%.3f,%.4f,%d,%.1e,%.0f\n",
      options.at("force").c_str(), preload, planar ? "pr" : "p", harmonics, 1e6 * peak.amplitude,
      1e6 * peak.first_harmonic, peak.omega / (2.0 * std::numbers::pi), curve.complete ? 1 : 0,
      curve.points.size(), instants, static_cast<long>(model.weights.size()),
      options.at("modes").c_str(), 1e6 * time.amplitude, time.omega / (2.0 * std::numbers::pi),
      time.periods, time.change, seconds);
  return text;
}

int run(int argc, char** argv) {
  const Options options = read_options(argc, argv);
  const fem::SlepcSession session;
  const FaceModel model = face_model(options);
  std::ofstream csv;
  if (!options.at("csv").empty()) csv.open(options.at("csv"));
  csv << header;
  std::printf("%s", header);
  std::stringstream directions(options.at("directions"));
  for (std::string direction; std::getline(directions, direction, ',');) {
    for (const double preload : numbers(options.at("preloads"))) {
      for (const double harmonics : numbers(options.at("harmonics"))) {
        const std::string line =
            row(options, model, preload, direction == "pr", static_cast<int>(harmonics));
        csv << line << std::flush;
        std::printf("%s", line.c_str());
        std::fflush(stdout);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace microslip::truth

int main(int argc, char** argv) {
  try {
    return microslip::truth::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "truth_blade: %s\n", error.what());
    return 1;
  }
}
