#include "pipelines/studies/campbell_study.hpp"

#include <functional>
#include <iostream>
#include <numbers>
#include <vector>

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
namespace {

using Say = std::function<void(const std::string&)>;

/// The diagram; of one that stops on its way what was found is written before the error goes on.
CampbellDiagram solved_diagram(const mesh::Mesh& mesh, const SceneDescription& scene,
                               const CampbellRequest& request, const std::filesystem::path& folder,
                               const Say& say) {
  std::vector<Eigen::VectorXd> found;
  try {
    return campbell_diagram(
        mesh, scene, request.speeds, [&](double speed, const Eigen::VectorXd& frequency) {
          say(fmt::format("{:10.6g} rpm: {:.6g} Hz\n", 30.0 * speed / std::numbers::pi,
                          fmt::join(frequency / (2.0 * std::numbers::pi), ", ")));
          found.push_back(frequency);
        });
  } catch (...) {
    if (!found.empty()) {
      const auto n = static_cast<Eigen::Index>(found.size());
      CampbellDiagram part{request.speeds.head(n), Eigen::MatrixXd(n, found.front().size())};
      for (Eigen::Index i = 0; i < n; ++i)
        part.frequency.row(i) = found[static_cast<std::size_t>(i)];
      write_campbell(folder, part, crossings(part, request.highest_engine_order));
      std::cerr << fmt::format("the first {} of {} speeds are written: {}\n", n,
                               request.speeds.size(), folder.string());
    }
    throw;
  }
}

}  // namespace

int campbell_study(const SceneDescription& scene, const CampbellRequest& request,
                   const RunOptions& options) {
  require_rotation(scene);
  const std::filesystem::path folder = options.output / "campbell";
  const FolderToFill to_fill(folder);
  const Say say = [&](const std::string& sentence) {
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
  const CampbellDiagram diagram = solved_diagram(mesh, scene, request, folder, say);
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
