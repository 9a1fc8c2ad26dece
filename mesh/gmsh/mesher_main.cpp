/// @file
/// The program microslip-mesher: reads a job from standard input, does it, writes one file.
///   microslip-mesher SCRATCH OUTPUT MEMORY_MB PARENT_PID < job
/// The first word of the job is its kind (blade, step_faces, step_mesh); lines of "key value"
/// follow. It limits its own memory, and when its parent dies or it is asked to end, it goes and
/// takes what it has written along: gmsh can crash, hang or eat memory on bad geometry. It puts
/// the whole file in its place itself, so that a parent that dies meanwhile leaves nothing beside.

#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "mesh/gmsh/gmsh_mesher.hpp"
#include "mesh/gmsh/step_mesher.hpp"
#include "mesh/mesh_error.hpp"

namespace {

using microslip::mesh::BladeGeometry;

std::map<std::string, double*> names_of(BladeGeometry& g) {
  return {{"root_width", &g.root_width},
          {"root_height", &g.root_height},
          {"root_length", &g.root_length},
          {"platform_width", &g.platform_width},
          {"platform_height", &g.platform_height},
          {"platform_length", &g.platform_length},
          {"span", &g.span},
          {"root_chord", &g.root_chord},
          {"tip_chord", &g.tip_chord},
          {"root_thickness", &g.root_thickness},
          {"tip_thickness", &g.tip_thickness},
          {"root_stagger", &g.root_stagger},
          {"tip_stagger", &g.tip_stagger},
          {"camber", &g.camber},
          {"lean", &g.lean}};
}

void limit_memory([[maybe_unused]] double megabytes) {
#if !defined(__SANITIZE_ADDRESS__)  // that reserves terabytes
  const auto bytes = static_cast<rlim_t>(megabytes * 1e6);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

const char* scratch = nullptr;

extern "C" void leave_nothing(int /*signal*/) {
  ::unlink(scratch);
  ::_exit(1);
}

void end_with(pid_t parent) {
  struct sigaction action = {};
  action.sa_handler = leave_nothing;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaction(signal, &action, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // it died before it could be watched
}

void mesh_blade(std::istream& job, const std::string& file) {
  BladeGeometry geometry;
  double element_size = 0.0;
  double edge_size = 0.0;
  auto names = names_of(geometry);
  names["element_size"] = &element_size;
  names["edge_size"] = &edge_size;
  for (std::string key; job >> key;) {
    const auto found = names.find(key);
    if (found == names.end()) throw std::invalid_argument("unknown parameter " + key);
    if (!(job >> *found->second)) throw std::invalid_argument(key + ": expected a number");
  }
  microslip::mesh::mesh_blade_with_gmsh(geometry, {element_size, edge_size}, file);
}

void do_job(const std::string& file) {
  std::string kind;
  std::cin >> kind;
  if (kind == "blade") {
    mesh_blade(std::cin, file);
  } else if (kind == "step_faces") {
    microslip::mesh::list_step_faces(std::cin, file);
  } else if (kind == "step_mesh") {
    microslip::mesh::mesh_step_with_gmsh(std::cin, file);
  } else {
    throw std::invalid_argument("unknown job " + kind);
  }
}

/// Starts this program anew with memory at the same addresses every time: gmsh's optimisers of
/// curved elements take them in the order of their addresses, and what they leave depends on it.
/// Where the system does not allow that, meshes that need mending differ a little from run to run.
void keep_addresses(char** argv) {
  const int now = ::personality(0xffffffff);
  if (now < 0 || (now & ADDR_NO_RANDOMIZE) != 0) return;
  if (::personality(static_cast<unsigned>(now) | ADDR_NO_RANDOMIZE) < 0) return;
  ::execv("/proc/self/exe", argv);
}

}  // namespace

int main(int argc, char** argv) {
  keep_addresses(argv);
  if (argc != 5) {
    std::cerr << "usage: microslip-mesher SCRATCH OUTPUT MEMORY_MB PARENT_PID < job\n";
    return 1;
  }
  scratch = argv[1];
  end_with(std::atoi(argv[4]));
  const double memory = std::atof(argv[3]);
  if (!(memory > 0.0)) {
    std::cerr << "the memory limit must be a number above 0\n";
    return 1;
  }
  limit_memory(memory);
  try {
    do_job(scratch);
    std::filesystem::rename(scratch, argv[2]);
  } catch (const std::bad_alloc&) {
    std::cerr << "out of memory\n";
    return 4;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << error.code().message() << '\n';
    return 5;
  } catch (const microslip::mesh::MeshRoomError& error) {
    std::cerr << error.what() << '\n';
    return 5;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    std::cerr << text << '\n';
    return text.find("out of memory") != std::string::npos ? 4 : 1;
  } catch (const std::string& error) {  // some versions of gmsh throw their message bare
    std::cerr << error << '\n';
    return 1;
  }
  return 0;
}
