#include "pipelines/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/scene_error.hpp"
#include "pipelines/units.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::uintmax_t largest_table = 1'000'000'000;  // bytes

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::uintmax_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw SceneError(fmt::format("{}: no such file", file.string()));
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw SceneError(fmt::format("{}: not a file", file.string()));
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > limit) {
    throw SceneError(fmt::format("{}: {} bytes; at most {} are read", file.string(), size, limit));
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream || (text.str().empty() && size > 0)) {
    throw SceneError(fmt::format("{}: cannot be read", file.string()));
  }
  std::string content = text.str();
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  return content;
}

CsvTable CsvTable::read(const std::filesystem::path& file) {
  return parse(read_text(file, largest_table), file.string());
}

CsvTable CsvTable::parse(std::string_view text, const std::string& name) {
  CsvTable table;
  table.name_ = name;
  std::size_t line_number = 0;
  std::optional<std::size_t> id_column;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cells_of(line);
    if (table.columns_.empty()) {
      table.columns_.assign(cells.begin(), cells.end());
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].empty()) {
          throw SceneError(fmt::format("{}:{}: column {} has no name", name, line_number, i + 1));
        }
        if (std::count(cells.begin(), cells.end(), cells[i]) > 1) {
          throw SceneError(
              fmt::format("{}:{}: column \"{}\" stands twice", name, line_number, cells[i]));
        }
      }
      id_column = table.find("id");
      continue;
    }
    if (cells.size() != table.columns_.size()) {
      throw SceneError(fmt::format("{}:{}: {} values under {} column names", name, line_number,
                                   cells.size(), table.columns_.size()));
    }
    table.lines_.push_back(line_number);
    table.ids_.emplace_back(id_column ? cells[*id_column] : std::string_view());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (id_column == i) {
        table.values_.push_back(0.0);
        continue;
      }
      double value = 0.0;
      try {
        value = parse_number(cells[i]);
      } catch (const UnitError& error) {
        throw SceneError(
            fmt::format("{}:{}: {}: {}", name, line_number, table.columns_[i], error.what()));
      }
      if (!std::isfinite(value)) {
        throw SceneError(fmt::format("{}:{}: {}: \"{}\" is not a finite number", name, line_number,
                                     table.columns_[i], cells[i]));
      }
      table.values_.push_back(value);
    }
  }
  if (table.columns_.empty()) throw SceneError(fmt::format("{}: empty; expected a header", name));
  return table;
}

CsvTable CsvTable::from_rows(std::string name, std::vector<std::string> columns,
                             std::vector<double> values) {
  CsvTable table;
  table.name_ = std::move(name);
  const std::size_t n_rows = columns.empty() ? 0 : values.size() / columns.size();
  table.columns_ = std::move(columns);
  table.values_ = std::move(values);
  table.ids_.resize(n_rows);
  for (std::size_t i = 1; i <= n_rows; ++i) table.lines_.push_back(i);
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::require(std::string_view column) const {
  if (const auto found = find(column)) return *found;
  throw SceneError(fmt::format("{}:1: column \"{}\" is missing; the columns are: {}", name_, column,
                               fmt::join(columns_, ", ")));
}

std::string CsvTable::place(std::size_t row, std::size_t column) const {
  return fmt::format("{}:{}: {}: ", name_, lines_[row], columns_[column]);
}

}  // namespace microslip::pipelines
