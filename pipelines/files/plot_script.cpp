#include "pipelines/files/plot_script.hpp"

#include <stdexcept>

#include "pipelines/system/child_process.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/script.hpp"

namespace microslip::pipelines {
std::string run_plot_script(const std::string& name, const std::vector<std::string>& arguments,
                            std::chrono::milliseconds limit) {
  try {
    std::vector<std::string> command = script_command(name);
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ChildResult result = run_child(command, limit);
    if (result.succeeded) return "";
    if (result.exit_code == static_cast<int>(ExitCode::exhausted)) {
      throw ExhaustedError(result.message);
    }
    return "not every plot was made: " + result.message;
  } catch (const InterruptedError&) {
    throw;
  } catch (const ExhaustedError&) {
    throw;
  } catch (const std::runtime_error& error) {
    return std::string("not every plot was made: ") + error.what();
  }
}

}  // namespace microslip::pipelines
