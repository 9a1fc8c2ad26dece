#include "pipelines/import/conversion.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mesh/mesh_error.hpp"
#include "mesh/text_file.hpp"
#include "pipelines/system/child_process.hpp"
#include "pipelines/system/mesh_format.hpp"
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

/// What no reader makes anything of, told before a gigabyte of it is read.
void require_plausible_begin(const fs::path& file) {
  constexpr std::array<std::string_view, 4> without_lines{"<", "\x89HDF", "CDF", "PK"};
  constexpr std::size_t longest_line = 65536;
  std::string begin(longest_line, ' ');
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  if (begin.starts_with('\0')) {
    throw SceneError(
        fmt::format("{}: begins with a byte of value 0, as no format does", file.string()));
  }
  if (begin.starts_with("\x1f\x8b")) {
    throw SceneError(fmt::format("{}: is packed by gzip; unpack it first (gunzip)", file.string()));
  }
  const bool is_text = std::ranges::none_of(
      without_lines, [&](std::string_view mark) { return begin.starts_with(mark); });
  if (is_text && begin.size() == longest_line && begin.find_first_of("\r\n") == std::string::npos) {
    throw SceneError(fmt::format("{}:1: a line of more than {} bytes, as no format has",
                                 file.string(), longest_line));
  }
}

/// At most 4096 bytes of a file, from a place up to another.
std::string bytes_between(const fs::path& file, std::uintmax_t begin, std::uintmax_t end) {
  constexpr std::uintmax_t most = 4096;
  std::string bytes(std::min(end - begin, most), ' ');
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(begin));
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

/// Data behind these marks are binary: the third line of a .vtk, the end of a .vtu.
bool holds_binary_data(const fs::path& file, std::uintmax_t zero) {
  const std::uintmax_t near = zero - std::min<std::uintmax_t>(zero, 4096);
  return bytes_between(file, 0, zero).find("\nBINARY") != std::string::npos ||
         bytes_between(file, near, zero).find("<AppendedData") != std::string::npos;
}

/// Those that may hold binary data are asked where the first of them is.
void require_text_in(const fs::path& file) {
  const std::string ending = ending_of(file);
  const auto is_one_of = [&](std::initializer_list<std::string_view> endings) {
    return std::ranges::find(endings, ending) != endings.end();
  };
  if (is_one_of({".inp", ".bdf", ".nas", ".fem", ".unv", ".frd", ".pch", ".csv"})) {
    mesh::require_text(file);
  } else if (is_one_of({".vtk", ".vtu"})) {
    const auto zero = mesh::first_zero_byte(file);
    if (zero && !holds_binary_data(file, zero->offset)) mesh::require_text(file);
  }
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
                            const ConverterLimits& limits, const fs::path& deck) {
  require_file(file);
  if (!deck.empty()) require_file(deck);
  require_plausible_begin(file);
  for (const fs::path& read : {file, deck}) require_text_in(read);
  const fs::path facts = output.string() + ".json";
  const std::uintmax_t size = fs::file_size(file) + (deck.empty() ? 0 : fs::file_size(deck));
  const double megabytes = static_cast<double>(size) / 1e6;
  const double seconds = limits.seconds + megabytes;
  const double memory = limits.memory_mb + 40.0 * megabytes;
  std::vector<std::string> command = converter(script);
  for (const std::string& word : {file.string(), output.string(), facts.string(),
                                  fmt::format("{}", seconds), fmt::format("{}", memory)}) {
    command.push_back(word);
  }
  if (!deck.empty()) command.push_back(deck.string());
  const auto limit = std::chrono::milliseconds(static_cast<long>(1e3 * seconds));
  const ChildResult result = run_child(command, limit);
  if (result.succeeded && fs::exists(output) && fs::exists(facts)) {
    return nlohmann::json::parse(std::ifstream(facts));
  }
  if (result.exit_code == static_cast<int>(ExitCode::exhausted)) {
    throw ExhaustedError(result.message);
  }
  for (const fs::path& named : {file, deck}) {
    if (!named.empty() && result.message.starts_with(named.string()))
      throw SceneError(result.message);
  }
  throw SceneError(
      fmt::format("{}: it cannot be converted: {}", file.string(),
                  result.message.empty() ? "the converter left nothing" : result.message));
}

}  // namespace microslip::pipelines
