#include "pipelines/studies/report_study.hpp"

#include <optional>
#include <string>
#include <vector>

#include "pipelines/files/write_report.hpp"
#include "pipelines/record/run_folder.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

int report_study(const std::filesystem::path& folder) {
  const std::string summary = read_summary(folder);
  std::optional<RunFolder> place;
  if (RunFolder::has_list(folder)) place.emplace(folder, RunStart::resumed);
  const auto told = [&](const std::string& message) {
    return place ? place->in_place(message) : message;
  };
  std::vector<std::string> warnings;
  try {
    warnings = write_report(folder, place ? place->staged() : folder, summary);
  } catch (const ExhaustedError& error) {
    throw ExhaustedError(told(error.what()));
  }
  if (place) place->publish();
  if (!warnings.empty()) throw SceneError(folder.string() + ": " + told(warnings.front()));
  return static_cast<int>(ExitCode::complete);
}

}  // namespace microslip::pipelines
