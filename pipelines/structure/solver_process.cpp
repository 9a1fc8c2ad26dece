#include "pipelines/structure/solver_process.hpp"

#include <sys/prctl.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "fem/blas_threads.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/mesher_process.hpp"
#include "pipelines/structure/solver_memory.hpp"
#include "pipelines/structure/structure_members.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"
#include "pipelines/system/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

constexpr const char* of_task = "microslip " MICROSLIP_VERSION " task";
constexpr const char* of_modes = "microslip " MICROSLIP_VERSION " modes";
constexpr std::chrono::hours no_limit{24 * 365};

}  // namespace

fs::path solver_program() { return mesh::mesher_program().parent_path() / "microslip"; }

StructureModes solve_in_process(const StructureTask& task, const fs::path& program) {
  const TemporaryFolder folder;
  const fs::path task_file = folder.path() / "task";
  const fs::path modes_file = folder.path() / "modes";
  write_whole(task_file, sealed(of_task, bytes_of(task)));
  const ChildResult ended =
      run_child({program.string(), solver_word, task_file.string(), modes_file.string()}, no_limit);
  if (!ended.succeeded) throw std::runtime_error(ended.message);
  const std::string content = bytes_of(modes_file);
  const Unsealed modes = unsealed(of_modes, content);
  if (!modes.fault.empty()) throw std::runtime_error("modes of another process: " + modes.fault);
  StructureModes result;
  ByteReader reader(modes.bytes);
  reader(result);
  return result;
}

void solve_task_file(const fs::path& task_file, const fs::path& modes_file) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const std::string content = bytes_of(task_file);
  const Unsealed given = unsealed(of_task, content);
  if (!given.fault.empty() || given.bytes.empty()) {
    throw SceneError(fmt::format("{}: no task of this program{}{}", task_file.string(),
                                 given.fault.empty() ? "" : ": ", given.fault));
  }
  const StructureTask task = structure_task(given.bytes);
  const fem::SlepcSession session;
  fem::use_one_blas_thread();
  require_memory(task.mesh, task.basis.solver);
  ByteWriter bytes;
  bytes(solve(task));
  write_whole(modes_file, sealed(of_modes, bytes.bytes()));
}

}  // namespace microslip::pipelines
