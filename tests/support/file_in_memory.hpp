/// @file
/// A text as a file, for readers that take a path.
#pragma once

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

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

}  // namespace microslip::test
