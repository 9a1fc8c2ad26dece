#include "pipelines/command_line/command_options.hpp"

#include <string>
#include <utility>

#include "pipelines/cycle/cycle_columns.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

CLI::App* add_command(CLI::App& app, Arguments& a, Action& chosen, const char* name,
                      const char* what, Action action) {
  CLI::App* command = app.add_subcommand(name, what);
  command->fallthrough();
  command->footer([&app] {  // the help of a command is complete
    const auto* format = dynamic_cast<const CLI::Formatter*>(app.get_formatter().get());
    return format == nullptr
               ? std::string("More options: microslip --help")
               : "Of every command:\n" + format->make_groups(&app, CLI::AppFormatMode::Normal);
  });
  command->callback([&a, &chosen, name, action = std::move(action)] {
    a.command = name;
    chosen = action;
  });
  return command;
}

/// As of a variable of the shell that is not set. @return what CLI11 says of it.
std::string not_empty(const std::string& value) { return value.empty() ? "expected a value" : ""; }

CLI::App* with_scene(CLI::App* command, Arguments& a) {
  command->add_option("scene", a.input, "scene file (TOML)")->required();
  return command;
}

CLI::App* with_output(CLI::App* command, Arguments& a, const char* what) {
  command->add_option("-o,--output", a.output, what)->check([](const std::string& name) {
    return name.empty() ? std::string("expected a name") : std::string();
  });
  return command;
}

void add_init(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = add_command(app, a, chosen, "init", "print a commented template scene",
                              [&] { return init(a); });
  command->add_option("kind", a.input, "blade, step, mesh, modes, modal, bar, chain or block")
      ->default_str("blade");
  command->add_option(
      "file", a.mesh_file,
      "with kind mesh, step or modes: a file whose names or faces, size and unit the scene begins "
      "with; of matrices their stiffness (.mtx)");
  command->add_option("mesh", a.mesh_of_modes,
                      "with kind modes: their mesh; else the one that lies beside them");
  with_output(command, a, "file to write; it must not exist");
}

CLI::App* with_parts(CLI::App* command, Arguments& a) {
  command
      ->add_option("--without", a.without,
                   "leaves a part out; may be repeated: plots (and report.html), maps (and the "
                   "motion at the peaks), bracket (of a search for a best value)")
      ->take_all()
      ->expected(1)
      ->check(CLI::IsMember({"plots", "maps", "bracket"}));
  return command;
}

void add_check(CLI::App& app, Arguments& a, Action& chosen) {
  with_scene(with_parts(add_command(app, a, chosen, "check",
                                    "parse, check units and names, show mesh, effects and "
                                    "forecast; question what is unusual; solve nothing",
                                    [&] { return check(a); }),
                        a),
             a)
      ->add_option("--plot", a.picture,
                   "picture of the blade with supports, contacts, forces and output marked, for "
                   "kinds with a mesh (.png, .svg, .pdf)");
}

void add_surfaces(CLI::App& app, Arguments& a, Action& chosen) {
  add_command(
      app, a, chosen, "surfaces",
      "names of a mesh file: surfaces, node sets and points, with area, centre, normal, flatness",
      [&] { return surfaces(a); })
      ->add_option("file", a.input,
                   "mesh: .msh, .inp, .bdf, .nas, .fem, .unv, .med, .vtu, .vtk, .e, .exo, .ex2")
      ->required();
}

void add_faces(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = add_command(
      app, a, chosen, "faces",
      "faces of a STEP file with number, kind, area, centre, normal; a VTK file and a picture",
      [&] { return faces(a); });
  command->add_option("file", a.input, "STEP: .step, .stp")->required();
  with_output(command, a, "folder for STEM_faces.vtp and .png; default the working folder");
}

void add_mesh(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = with_scene(
      add_command(app, a, chosen, "mesh", "geometry to mesh", [&] { return mesh(a); }), a);
  with_output(command, a, "gmsh file to write (.msh); of kind blade also its geometry (.step)")
      ->get_option("--output")
      ->required();
}

void add_modes(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command =
      with_scene(add_command(app, a, chosen, "modes", "mesh to modes and residual flexibility",
                             [&] { return run_scene(a, modes_study); }),
                 a);
  with_output(command, a, "run folder; default runs/SCENE");
}

void add_run(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command =
      with_scene(add_command(app, a, chosen, "run", "everything: modes, curves, maps, report",
                             [&] { return run_scene(a, run_study); }),
                 a);
  with_output(with_parts(command, a), a, "run folder; default runs/SCENE");
}

void add_campbell(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = with_scene(
      add_command(
          app, a, chosen, "campbell",
          "natural frequencies over the speed of rotation, and where engine orders meet them",
          [&] { return campbell(a); }),
      a);
  command
      ->add_option("--speeds", a.speeds,
                   "FROM TO N: so many speeds, e.g. 0 \"6000 rpm\" 13; rpm, rad/s, or Hz for turns "
                   "per second; a number alone is in rad/s. The axis is the scene's [static] axis")
      ->expected(3)
      ->required();
  command->add_option("--engine-orders", a.engine_orders, "the highest of the lines ω = kΩ")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  with_output(command, a, "folder for campbell/; default runs/SCENE");
}

void add_cycle(CLI::App& app, Arguments& a, Action& chosen) {
  auto* cycle_command =
      add_command(app, a, chosen, "cycle", "steady friction cycles of single contact points",
                  [&] { return cycle(a); });
  cycle_command
      ->add_option("table", a.input,
                   "CSV file, SI units, one point per row; columns tangential_stiffness, "
                   "normal_stiffness, friction_coefficient, preload, u_sin, u_cos, "
                   "v_mean, v_sin, v_cos, optional id, u_mean and harmonics u_sin2, "
                   "u_cos2, v_sin2, ..., second direction w_sin, w_cos, ... "
                   "and tangential_stiffness_r, in any order")
      ->required();
  with_output(cycle_command, a, "JSON file to write; default standard output");
  cycle_command
      ->add_option("--harmonics", a.harmonics,
                   "highest harmonic of the forces put out; default the highest of the table")
      ->check(CLI::Range(1, largest_harmonic));
  cycle_command->add_option("--plot", a.plot_folder,
                            "folder for loops of every row: sampled CSV, SVG and PNG by its id");
}

void add_converge(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = with_scene(
      add_command(app, a, chosen, "converge",
                  "what accuracy costs: every choice of the discretisation from coarse to fine",
                  [&] { return converge(a); }),
      a);
  with_output(command, a, "folder for converge/; default runs/SCENE");
  command
      ->add_option("--meshes", a.meshes,
                   "of kind mesh: two files or more from coarse to fine, of the same body with "
                   "the same names, in place of one mesh")
      ->expected(1, 1000);
  command
      ->add_option("--sizes", a.sizes,
                   "of kind blade and step: two element sizes or more from coarse to fine, e.g. "
                   "6mm 4mm 3mm, in place of 4, 2, 1 and 2/3 times that of the scene")
      ->expected(1, 1000);
  command
      ->add_option("--knobs", a.knobs,
                   "the only ones to go over, e.g. harmonics cells; default all that the scene has")
      ->expected(1, 1000);
  command
      ->add_option("--repeat", a.repeat_seconds,
                   "seconds to spend on timing stages again, for the median of three; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void add_columns(CLI::App& app, Arguments& a, Action& chosen) {
  with_output(add_command(app, a, chosen, "columns",
                          "print every column and array of the files a run writes, with units",
                          [&] { return columns(a); }),
              a, "file to write; default standard output");
}

void add_report(CLI::App& app, Arguments& a, Action& chosen) {
  auto* command = add_command(app, a, chosen, "report", "rebuild plots and report of a run folder",
                              [&] { return report_study(a.input); });
  command->add_option("folder", a.input, "run folder")->required();
}

}  // namespace

void add_global_options(CLI::App& app, Arguments& a) {
  app.add_option("--set", a.overrides,
                 "key.path=value: overrides any key of the scene; may be repeated")
      ->take_all()
      ->expected(1);
  app.add_option("-j,--jobs", a.jobs,
                 "curves traced at the same time; the numbers do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--resume", a.resume, "go on with a run that was interrupted or killed");
  app.add_flag(
      "--no-cache", a.no_cache,
      "mesh and solve anew: take nothing of earlier runs and keep nothing for later ones (the "
      "folder: MICROSLIP_CACHE, else XDG_CACHE_HOME/microslip, else ~/.cache/microslip)");
  app.add_option("--tolerance", a.tolerance,
                 "accuracy asked for of every peak, e.g. 1%: accuracy.tolerance of the scene")
      ->check(not_empty);
  app.add_option("--budget", a.budget, "wall time allowed, e.g. 60s: accuracy.budget of the scene")
      ->check(not_empty);
  app.add_flag("--dry-run", a.dry_run, "check the scene and stop, as `check` does");
  auto* quiet = app.add_flag("-q,--quiet", a.quiet, "warnings and errors only");
  app.add_flag("-v,--verbose", a.verbose, "one line per solution point")->excludes(quiet);
  app.add_flag("--json", a.json, "last line on standard output is one JSON object");
}

void add_commands(CLI::App& app, Arguments& a, Action& chosen) {
  for (const auto add : {add_init, add_check, add_surfaces, add_faces, add_mesh, add_modes, add_run,
                         add_campbell, add_cycle, add_converge, add_columns, add_report}) {
    add(app, a, chosen);
  }
}

}  // namespace microslip::pipelines
