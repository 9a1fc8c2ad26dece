/// @file
/// The bytes of a .msh file as a stream of numbers, text or binary alike. Every read is checked
/// against the end of the file; every error tells file and place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace microslip::mesh {

class GmshSource {
 public:
  /// @param name  what messages call it.
  /// @throws MeshError  the file is missing or cannot be read.
  GmshSource(const std::filesystem::path& file, const std::string& name);
  /// @param text  content of a file. @param name  what messages call it.
  GmshSource(std::string text, std::string name);

  void set_binary(bool binary) { binary_ = binary; }
  [[nodiscard]] bool binary() const { return binary_; }

  /// Goes to the next "$Section" at the start of a line and returns its name; empty: end of file.
  [[nodiscard]] std::string next_section();
  /// The section must be over: "$EndNAME" comes next. @throws MeshError  anything else.
  void expect_end(const std::string& name);
  /// Puts the cursor behind the line that it is on: binary data begin there.
  void end_line();
  /// Rest of the present line, trimmed.
  [[nodiscard]] std::string_view line();

  /// `int` of the format.
  [[nodiscard]] std::int64_t integer();
  /// `size_t` of format 4.1, an `int` in 2.2 files. @param wide  eight bytes in binary files.
  [[nodiscard]] std::int64_t size(bool wide);
  [[nodiscard]] double real();
  /// A count of records of at least `least_bytes` each: no larger than the file can hold.
  [[nodiscard]] std::int64_t count(bool wide, std::int64_t least_bytes);

  [[noreturn]] void fail(const std::string& message) const;

 private:
  template <typename Type>
  [[nodiscard]] Type raw();
  [[nodiscard]] std::string_view token();

  std::string text_;
  std::string name_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace microslip::mesh
