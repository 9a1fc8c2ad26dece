#include "pipelines/text/csv_table.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <set>
#include <span>
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

struct Comment {
  std::string_view text;
  std::size_t line = 0;
};

bool is_number(std::string_view cell) {
  double value = 0.0;
  const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  return std::from_chars(begin, cell.data() + cell.size(), value).ec == std::errc();
}

/// numpy.savetxt writes names as a comment: names are no numbers.
bool is_row_under(const Comment& comment, const std::vector<std::string_view>& cells) {
  return comment.line > 0 && cells.size() == cells_of(comment.text).size() &&
         std::ranges::any_of(cells, is_number);
}

/// Opened without waiting: of a pipe that nobody writes to there is no end.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file)
      : name_(file.string()), descriptor_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0) throw cannot_be_read();
    std::error_code error;
    if (std::filesystem::is_fifo(file, error)) await_writer();
    static_cast<void>(fcntl(descriptor_, F_SETFL, 0));
  }
  ~InputFile() { close(descriptor_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// @return  the number of bytes; 0: the end.
  std::size_t read(std::span<char> to) {
    ssize_t n = -1;
    do n = ::read(descriptor_, to.data(), to.size());
    while (n < 0 && errno == EINTR);
    if (n < 0) throw cannot_be_read();
    return static_cast<std::size_t>(n);
  }

 private:
  void await_writer() const {
    constexpr int longest_wait = 1000;  // ms
    pollfd asked{descriptor_, POLLIN, 0};
    if (poll(&asked, 1, longest_wait) != 0) return;
    close(descriptor_);
    throw SceneError(fmt::format("{}: a pipe that nobody writes to", name_));
  }
  [[nodiscard]] SceneError cannot_be_read() const {
    return SceneError(fmt::format("{}: cannot be read", name_));
  }

  std::string name_;
  int descriptor_;
};

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
  InputFile input(file);
  std::string content;  // a pipe does not know its size beforehand
  std::array<char, 65536> part{};
  while (const std::size_t n = input.read(part)) {
    const std::string_view read(part.data(), n);
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
  Comment comment;  // the last one before the rows
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed_cell(text.substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.size() > longest_line) {
      throw SceneError(fmt::format("{}:{}: a line of {} bytes; at most {} are read", name,
                                   line_number, line.size(), longest_line));
    }
    if (line.empty()) continue;
    if (line.front() == '#') {
      if (table.columns_.empty()) comment = {trimmed_cell(line.substr(1)), line_number};
      continue;
    }
    const auto cells = cells_of(line);
    if (table.columns_.empty() && is_row_under(comment, cells)) {
      table.read_header(cells_of(comment.text), comment.line);
      id_column = table.find("id");
    }
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
