#include "pipelines/text/csv_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/nearest_name.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::uintmax_t largest_table = 1'000'000'000;  // bytes
constexpr std::size_t longest_line = 1'000'000;          // bytes: columns for ten thousand modes

std::string_view trimmed_cell(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view cell) {
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return quoted ? cell.substr(1, cell.size() - 2) : cell;
}

/// Where the cell that begins at `begin` ends: the next comma that stands in no quotes.
std::size_t end_of_cell(std::string_view line, std::size_t begin) {
  const std::size_t first = std::min(line.find_first_not_of(" \t", begin), line.size());
  std::size_t from = begin;
  if (first < line.size() && line[first] == '"') {
    const std::size_t closing = line.find('"', first + 1);
    if (closing != std::string_view::npos) from = closing;
  }
  return std::min(line.find(',', from), line.size());
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = end_of_cell(line, begin);
    cells.push_back(unquoted(trimmed_cell(line.substr(begin, end - begin))));
    begin = end + 1;
  }
  return cells;
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::uintmax_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw SceneError(fmt::format("{}: {}", file.empty() ? "\"\"" : file.string(),
                                 error ? error.message() : "no such file"));
  }
  if (std::filesystem::is_directory(file, error)) {
    throw SceneError(fmt::format("{}: is a folder, not a file", file.string()));
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > limit) {
    throw SceneError(fmt::format("{}: {} bytes; at most {} are read", file.string(), size, limit));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw SceneError(fmt::format("{}: cannot be read", file.string()));
  std::string content;  // a pipe does not know its size beforehand
  std::array<char, 65536> part{};
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0) {
    const std::string_view read(part.data(), static_cast<std::size_t>(stream.gcount()));
    content.append(read);
    if (read.find('\0') != std::string_view::npos) {  // told before a large file is read whole
      throw SceneError(
          fmt::format("{}:{}: a byte of value 0: this is no text", file.string(),
                      1 + std::ranges::count(content.substr(0, content.find('\0')), '\n')));
    }
    if (content.size() > limit) {
      throw SceneError(
          fmt::format("{}: more than the {} bytes that are read at most", file.string(), limit));
    }
  }
  if (stream.bad()) throw SceneError(fmt::format("{}: cannot be read", file.string()));
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  return content;
}

CsvTable CsvTable::read(const std::filesystem::path& file, Tiny tiny) {
  return parse(read_text(file, largest_table), file.string(), tiny);
}

CsvTable CsvTable::parse(std::string_view text, const std::string& name, Tiny tiny) {
  CsvTable table;
  table.tiny_ = tiny;
  table.name_ = name;
  std::size_t line_number = 0;
  std::optional<std::size_t> id_column;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed_cell(text.substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.size() > longest_line) {
      throw SceneError(fmt::format("{}:{}: a line of {} bytes; at most {} are read", name,
                                   line_number, line.size(), longest_line));
    }
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cells_of(line);
    if (table.columns_.empty()) {
      table.read_header(cells, line_number);
      id_column = table.find("id");
    } else {
      table.read_row(cells, line_number, id_column);
    }
  }
  if (table.columns_.empty()) throw SceneError(fmt::format("{}: empty; expected a header", name));
  return table;
}

void CsvTable::read_header(const std::vector<std::string_view>& cells, std::size_t line) {
  if (cells.size() == 1 && cells[0].find_first_of(";\t") != std::string_view::npos) {
    throw SceneError(fmt::format(
        "{}:{}: columns are separated by {}; expected commas, and points "
        "in numbers",
        name_, line, cells[0].find(';') != std::string_view::npos ? "semicolons" : "tabs"));
  }
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].empty()) {
      throw SceneError(fmt::format("{}:{}: column {} has no name", name_, line, i + 1));
    }
    if (!seen.insert(cells[i]).second) {
      throw SceneError(fmt::format("{}:{}: column \"{}\" stands twice", name_, line, cells[i]));
    }
  }
  columns_.assign(cells.begin(), cells.end());
  header_line_ = line;
}

void CsvTable::read_row(const std::vector<std::string_view>& cells, std::size_t line,
                        std::optional<std::size_t> id_column) {
  if (cells.size() != columns_.size()) {
    throw SceneError(fmt::format("{}:{}: {} value{} under {} column names{}", name_, line,
                                 cells.size(), cells.size() == 1 ? "" : "s", columns_.size(),
                                 cells.size() == 1 ? "; values are separated by commas" : ""));
  }
  lines_.push_back(line);
  ids_.emplace_back(id_column ? cells[*id_column] : std::string_view());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    values_.push_back(id_column == i ? 0.0 : number_in(cells[i], line, i));
  }
}

double CsvTable::number_in(std::string_view cell, std::size_t line, std::size_t column) const {
  double value = 0.0;
  try {
    value = parse_number(cell);
  } catch (const UnitError& error) {
    throw SceneError(fmt::format("{}:{}: {}: {}", name_, line, columns_[column], error.what()));
  }
  if (tiny_ == Tiny::zero && std::abs(value) < 1.0 && !is_of_usable_size(value)) return 0.0;
  if (!is_of_usable_size(value)) {
    throw SceneError(fmt::format(
        "{}:{}: {}: \"{}\" is out of range: expected a finite number, 0 or of a size from "
        "1e-100 to 1e100",
        name_, line, columns_[column], cell));
  }
  return value;
}

CsvTable CsvTable::from_rows(std::string name, std::vector<std::string> columns,
                             std::vector<double> values, std::vector<std::string> places) {
  CsvTable table;
  table.name_ = std::move(name);
  table.columns_ = std::move(columns);
  table.values_ = std::move(values);
  table.ids_.resize(places.size());
  table.places_ = std::move(places);
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::require(std::string_view column) const {
  if (const auto found = find(column)) return *found;
  throw SceneError(fmt::format("{}: column \"{}\" is missing; the columns are: {}", header_place(),
                               column, fmt::join(columns_, ", ")));
}

std::string CsvTable::header_place() const {
  return header_line_ == 0 ? name_ : fmt::format("{}:{}", name_, header_line_);
}

std::string CsvTable::row_place(std::size_t row) const {
  return places_.empty() ? fmt::format("{}:{}", name_, lines_[row]) : places_[row];
}

std::string CsvTable::place(std::size_t row, std::size_t column) const {
  return fmt::format("{}: {}: ", row_place(row), columns_[column]);
}

std::string unknown_column(const CsvTable& table, const std::string& column,
                           const std::vector<std::string_view>& known) {
  const std::string near = nearest_name(column, known);
  return fmt::format("{}: unknown column \"{}\"; {}", table.header_place(), column,
                     near.empty() ? fmt::format("known: {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace microslip::pipelines
