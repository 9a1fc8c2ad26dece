#include "pipelines/model/conversion.hpp"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mesh/mesh_error.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/script.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

void require_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw mesh::MeshError(file.string() + ": no such file");
  if (!fs::is_regular_file(file, error)) throw mesh::MeshError(file.string() + ": not a file");
}

/// MICROSLIP_CONVERTER stands in for the script, as MICROSLIP_MESHER does for the mesher.
std::vector<std::string> converter(const std::string& script) {
  std::vector<std::string> command = script_command(script);
  if (const char* given = std::getenv("MICROSLIP_CONVERTER")) command.back() = given;
  // Neither PYTHONPATH nor modules of the user may change what is read.
  command.insert(command.begin() + 1, "-I");
  return command;
}

}  // namespace

nlohmann::json convert_file(const std::string& script, const fs::path& file, const fs::path& output,
                            const ConverterLimits& limits) {
  require_file(file);
  const fs::path facts = output.string() + ".json";
  const double megabytes = static_cast<double>(fs::file_size(file)) / 1e6;
  const double seconds = limits.seconds + megabytes;
  const double memory = limits.memory_mb + 40.0 * megabytes;
  std::vector<std::string> command = converter(script);
  for (const std::string& word : {file.string(), output.string(), facts.string(),
                                  fmt::format("{}", seconds), fmt::format("{}", memory)}) {
    command.push_back(word);
  }
  const auto limit = std::chrono::milliseconds(static_cast<long>(1e3 * seconds));
  const ChildResult result = run_child(command, limit);
  if (result.succeeded && fs::exists(output) && fs::exists(facts)) {
    return nlohmann::json::parse(std::ifstream(facts));
  }
  if (result.message.starts_with(file.string())) throw SceneError(result.message);
  throw SceneError(
      fmt::format("{}: it cannot be converted: {}", file.string(),
                  result.message.empty() ? "the converter left nothing" : result.message));
}

}  // namespace microslip::pipelines
