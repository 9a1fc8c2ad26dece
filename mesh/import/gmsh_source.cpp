#include "mesh/import/gmsh_source.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "mesh/mesh_error.hpp"
#include "mesh/text_file.hpp"

namespace microslip::mesh {
namespace {

/// $MeshFormat, and on the line below version, 1 for binary, and the size of a number.
bool says_binary(const std::string& preface) {
  std::istringstream words(preface.substr(std::min(preface.find("$MeshFormat"), preface.size())));
  std::string name;
  std::string version;
  std::string kind;
  words >> name >> version >> kind;
  return kind == "1";
}

std::string bytes_of(const std::filesystem::path& file, std::ifstream& stream, std::uintmax_t from,
                     std::size_t size) {
  std::string bytes(size, ' ');
  stream.seekg(static_cast<std::streamoff>(from));
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw MeshError(file.string() + ": cannot be read");
  }
  return bytes;
}

/// Of a binary file: a section follows upon the first, and the last one has an end. What a lost
/// block of a disk leaves of it has none.
void require_sections(const std::string& name, std::uintmax_t size, const std::string& preface,
                      const std::string& ending) {
  const auto refuse = [&](std::uintmax_t place, const char* what) {
    throw MeshError(name + ": byte " + std::to_string(place) + ": " + what +
                    ": a part of the file is damaged or missing; copy or export it again");
  };
  constexpr std::string_view first = "$EndMeshFormat";
  const std::size_t end = preface.find(first);
  const std::size_t next =
      end == std::string::npos ? end : preface.find_first_not_of(" \t\r\n", end + first.size());
  if (next != std::string::npos && preface[next] != '$') {
    refuse(next, "expected a section, $PhysicalNames, $Entities or $Nodes");
  }
  if (ending.find("$End") == std::string::npos) refuse(size, "expected the $End of a section");
}

/// Of a file of any size: what is no mesh is told before it is read whole.
std::string content_of(const std::filesystem::path& file, const std::string& name) {
  constexpr std::size_t longest_preface = 65536;  // before the first section
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw MeshError(file.string() + ": no such file");
  if (!std::filesystem::is_regular_file(file, error))
    throw MeshError(file.string() + ": not a file");
  std::ifstream stream(file, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(file);
  const auto n = static_cast<std::size_t>(std::min<std::uintmax_t>(size, longest_preface));
  std::string preface = bytes_of(file, stream, 0, n);
  if (preface.find('$') == std::string::npos) return preface;
  if (!says_binary(preface)) {
    require_text(file);
  } else if (size > n) {
    require_sections(name, size, preface, bytes_of(file, stream, size - n, n));
  }
  return bytes_of(file, stream, 0, size);
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

GmshSource::GmshSource(const std::filesystem::path& file, const std::string& name)
    : GmshSource(content_of(file, name), name) {}

GmshSource::GmshSource(std::string text, std::string name)
    : text_(std::move(text)), name_(std::move(name)) {}

void GmshSource::fail(const std::string& message) const {
  const std::size_t end = std::min(at_, text_.size());
  std::ostringstream text;
  if (binary_) {
    text << name_ << ": byte " << end << ": " << message;
  } else {
    text << name_ << ":"
         << 1 + std::count(text_.begin(), text_.begin() + static_cast<long>(end), '\n') << ": "
         << message;
  }
  throw MeshError(text.str());
}

std::string GmshSource::next_section() {
  while (at_ < text_.size()) {
    const std::size_t found = text_.find('$', at_);
    if (found == std::string::npos) break;
    at_ = found + 1;
    if (found > 0 && text_[found - 1] != '\n') continue;
    std::size_t end = at_;
    while (end < text_.size() && !is_space(text_[end])) ++end;
    std::string name = text_.substr(at_, std::min<std::size_t>(end - at_, 64));
    at_ = end;
    if (name.starts_with("End")) continue;
    end_line();
    return name;
  }
  at_ = text_.size();
  return {};
}

void GmshSource::expect_end(const std::string& name) {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  const std::string wanted = "$End" + name;
  if (text_.compare(at_, wanted.size(), wanted) != 0) {
    fail("expected " + wanted + ": the section holds more or less than it says");
  }
}

void GmshSource::end_line() {
  const std::size_t end = text_.find('\n', at_);
  at_ = end == std::string::npos ? text_.size() : end + 1;
}

std::string_view GmshSource::line() {
  const std::size_t begin = at_;
  end_line();
  std::string_view whole = std::string_view(text_).substr(begin, at_ - begin);
  while (!whole.empty() && is_space(whole.front())) whole.remove_prefix(1);
  while (!whole.empty() && is_space(whole.back())) whole.remove_suffix(1);
  return whole;
}

std::string_view GmshSource::token() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  if (begin == at_) fail("the file ends in the middle of a section");
  return std::string_view(text_).substr(begin, at_ - begin);
}

template <typename Type>
Type GmshSource::raw() {
  if (text_.size() - at_ < sizeof(Type)) fail("the file ends in the middle of a section");
  Type value;
  std::memcpy(&value, text_.data() + at_, sizeof(Type));
  at_ += sizeof(Type);
  return value;
}

std::int64_t GmshSource::integer() {
  if (binary_) return raw<std::int32_t>();
  const std::string_view word = token();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    fail("expected a whole number, found \"" + std::string(word.substr(0, 40)) + "\"");
  }
  return value;
}

std::int64_t GmshSource::size(bool wide) {
  if (binary_ && wide) return static_cast<std::int64_t>(raw<std::uint64_t>());
  return integer();
}

double GmshSource::real() {
  double value = 0.0;
  if (binary_) {
    value = raw<double>();
  } else {
    const std::string_view word = token();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      fail("expected a number, found \"" + std::string(word.substr(0, 40)) + "\"");
    }
  }
  if (!std::isfinite(value)) fail("a coordinate is not a finite number");
  return value;
}

std::int64_t GmshSource::count(bool wide, std::int64_t least_bytes) {
  const std::int64_t value = size(wide);
  const auto left = static_cast<std::int64_t>(text_.size() - std::min(at_, text_.size()));
  if (value < 0 || value > left / std::max<std::int64_t>(least_bytes, 1) + 1) {
    fail("the count " + std::to_string(value) + " does not fit into the file");
  }
  return value;
}

}  // namespace microslip::mesh
