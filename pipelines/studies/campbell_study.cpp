#include "pipelines/studies/campbell_study.hpp"

#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/files/plot_script.hpp"
#include "pipelines/files/write_campbell.hpp"
#include "pipelines/questions/questions.hpp"
#include "pipelines/structure/memory_before_mesh.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {

int campbell_study(const SceneDescription& scene, const CampbellRequest& request,
                   const RunOptions& options) {
  require_rotation(scene);
  const std::filesystem::path folder = options.output / "campbell";
  const FolderToFill to_fill(folder);
  const auto say = [&](const std::string& sentence) {
    if (options.verbosity != Verbosity::quiet) std::cout << sentence << std::flush;
  };
  const ResultCache cache(options.cache, [&](const std::string& line) { say(line + '\n'); });
  const TemporaryFolder scratch;
  require_memory_before_mesh(scene);
  const mesh::Mesh mesh = obtain_mesh(scene, scratch.path() / "mesh.msh");
  check_names(mesh, scene);
  SceneDescription fastest = scene;
  fastest.rotation->speed = request.speeds.maxCoeff();
  for (const std::string& question : questions(fastest, mesh)) {
    std::cerr << "warning: " << question << '\n';
  }
  const CampbellDiagram diagram = campbell_diagram(
      mesh, scene, request.speeds, [&](double speed, const Eigen::VectorXd& frequency) {
        say(fmt::format("{:10.6g} rpm: {:.6g} Hz\n", 30.0 * speed / std::numbers::pi,
                        fmt::join(frequency / (2.0 * std::numbers::pi), ", ")));
      });
  const std::vector<Crossing> found = crossings(diagram, request.highest_engine_order);
  write_campbell(folder, diagram, found);
  say(crossings_text(found));
  const std::string failure = run_plot_script(
      "plot_campbell.py", {folder.string(), std::to_string(request.highest_engine_order)},
      std::chrono::seconds(120));
  if (!failure.empty()) std::cerr << "warning: " << failure << '\n';
  say("written: " + folder.string() + '\n');
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
