#include "pipelines/record/failed_start.hpp"

#include <fmt/format.h>

#include "pipelines/files/checkpoint.hpp"
#include "pipelines/record/failure_in_place.hpp"
#include "pipelines/record/run_folder.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"
#include "pipelines/text/json_entry.hpp"

namespace microslip::pipelines {

std::string summary_of_failed_start(const std::filesystem::path& summary, ExitCode code,
                                    const std::string& message) {
  nlohmann::ordered_json document = parse_json(bytes_of(summary), summary.string());
  if (!document.contains("earlier")) {
    document["earlier"] = {
        {"exit_code", JsonEntry(document, summary.string()).integer("exit_code")},
        {"message", document.value("message", "")}};
  }
  document["exit_code"] = static_cast<int>(code);
  document["message"] = fmt::format(
      "{}; nothing was solved: what stands here is of an earlier run, which ended with exit code "
      "{}",
      message, document["earlier"]["exit_code"].get<int>());
  return document.dump(2) + '\n';
}

void tell_failed_start(const std::filesystem::path& folder, ExitCode code,
                       const std::string& message) {
  const std::filesystem::path summary = folder / "summary.json";
  const bool has_ended = RunFolder::has_list(folder) && std::filesystem::exists(summary) &&
                         !is_begun(folder) && !RunFolder::is_held(folder);
  if (!has_ended) return;
  const std::string text = summary_of_failed_start(summary, code, message);
  try {
    write_whole(summary, text);
  } catch (const ExhaustedError&) {
    tell_failed_start_in_place(summary);
    throw;
  }
}

}  // namespace microslip::pipelines
