/// @file
/// Content of a .msh file → Mesh, by way of a file in memory.
#pragma once

#include <string>
#include <string_view>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

#include "mesh/mesh_reader.hpp"

namespace microslip::test {

class FileInMemory {
 public:
  explicit FileInMemory(std::string_view content) : descriptor_(::memfd_create("content", 0)) {
    while (descriptor_ >= 0 && !content.empty()) {
      const ::ssize_t n = ::write(descriptor_, content.data(), content.size());
      if (n < 0) break;
      content.remove_prefix(static_cast<std::size_t>(n));
    }
    if (descriptor_ < 0 || !content.empty()) {
      throw std::system_error(errno, std::generic_category(), "file in memory");
    }
  }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory() { ::close(descriptor_); }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// @param name  what messages call it.
inline mesh::Mesh read_gmsh_text(std::string_view content, const std::string& name,
                                 double length_unit = 1.0) {
  return mesh::read_gmsh(FileInMemory(content).path(), length_unit, name);
}

}  // namespace microslip::test
