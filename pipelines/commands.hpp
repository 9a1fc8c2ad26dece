/// @file
/// The commands of the program: what was typed, and the studies it asks for.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fem/ranks.hpp"
#include "pipelines/study.hpp"

namespace microslip::pipelines {

struct Arguments {
  std::string command;
  std::string input;          // scene, table, kind or folder
  std::string mesh_file;      // of `init mesh`, `init step`, `init modes`
  std::string mesh_of_modes;  // of `init modes`
  std::string output;
  std::vector<std::string> overrides;
  /// A rank is bound to a core of its own at first (fem::meet_ranks()).
  int jobs = fem::started_in_parallel() ? fem::n_cores() : fem::usable_cores();
  std::optional<int> harmonics;
  std::optional<std::string> plot_folder;
  std::optional<std::string> picture;  // of `check`
  std::vector<std::string> without;    // of parts_of_a_run
  std::vector<std::string> speeds;     // of `campbell`: from, to, how many
  int engine_orders = 8;               // of `campbell`: the highest
  std::string tolerance;
  std::string budget;
  double repeat_seconds = 240.0;    // of converge
  std::vector<std::string> meshes;  // of converge
  std::vector<std::string> sizes;   // of converge: lengths
  std::vector<std::string> knobs;   // of converge
  bool resume = false;
  bool no_cache = false;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  nlohmann::ordered_json findings = nlohmann::ordered_json::object();  // results, for --json
};

/// Options this version does not have, or that say nothing to the command: refused, never ignored.
/// @throws SceneError  one of them is given.
void refuse_idle_options(const Arguments& arguments);

// One command each. All return the exit code and throw what exit_code_of() knows.
int check(Arguments& arguments);
/// `run`, `modes`, by the study.
using Study = std::function<int(const SceneDescription&, const RunOptions&)>;
int run_scene(Arguments& arguments, const Study& study);
/// Natural frequencies over speed.
int campbell(Arguments& arguments);
/// What accuracy costs; with --dry-run what is asked for is looked at all the same.
int converge(Arguments& arguments);
int mesh(Arguments& arguments);
/// What names a mesh file has.
int surfaces(Arguments& arguments);
/// What faces a STEP file has; a VTK file and a picture of them.
int faces(Arguments& arguments);
int init(const Arguments& arguments);
/// Every column and array of the files, as Markdown.
int columns(const Arguments& arguments);
int cycle(const Arguments& arguments);

/// What a rank above 0 of an MPI start does while rank 0 answers a command.
/// @return the exit code of rank 0.
int serve_rank_zero();

/// Whether another of its kind has started the program to solve beside it: no command of its own.
/// @param words  of the command line.
[[nodiscard]] bool is_solver(std::span<char* const> words);
/// @return exit code; what is wrong is told on standard error.
int serve_as_solver(std::span<char* const> words);

}  // namespace microslip::pipelines
