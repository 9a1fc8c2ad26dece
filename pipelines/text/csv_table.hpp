/// @file
/// Tables of numbers as users give them: a header with names, then rows of numbers. Lines that
/// begin with # are comments; the last one before the rows is the header where they have none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microslip::pipelines {

/// What a number below 1e-100 in size is.
enum class Tiny { refused, zero };

class CsvTable {
 public:
  /// @param name  how messages call the table, e.g. the file.
  /// @throws SceneError  "name:line: …": no header, a name twice, a line of over 1 MB, a row of
  ///         another length, a cell that is neither 0 nor of a size from 1e-100 to 1e100 (the
  ///         column `id` may hold any text).
  static CsvTable parse(std::string_view text, const std::string& name, Tiny tiny = Tiny::refused);
  /// @throws SceneError  the file is missing or over 1 GB; otherwise as parse().
  static CsvTable read(const std::filesystem::path& file, Tiny tiny = Tiny::refused);

  /// Rows that come from elsewhere.
  /// @param values  row by row, n × columns, finite.
  /// @param places  where each row stands, for messages: n, e.g. "scene.toml:12".
  static CsvTable from_rows(std::string name, std::vector<std::string> columns,
                            std::vector<double> values, std::vector<std::string> places);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t n_rows() const { return ids_.size(); }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;
  /// @throws SceneError  no such column; the message lists the columns there are.
  [[nodiscard]] std::size_t require(std::string_view column) const;
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return values_[row * columns_.size() + column];
  }
  /// Text of the column `id`; empty without one.
  [[nodiscard]] const std::string& id(std::size_t row) const { return ids_[row]; }
  /// "name:line" of the header, for messages.
  [[nodiscard]] std::string header_place() const;
  /// "name:line" of a row.
  [[nodiscard]] std::string row_place(std::size_t row) const;
  /// "name:line: column: " of a cell, for messages.
  [[nodiscard]] std::string place(std::size_t row, std::size_t column) const;

 private:
  void read_header(const std::vector<std::string_view>& cells, std::size_t line);
  void read_row(const std::vector<std::string_view>& cells, std::size_t line,
                std::optional<std::size_t> id_column);
  [[nodiscard]] double number_in(std::string_view cell, std::size_t line, std::size_t column) const;

  std::string name_;
  std::vector<std::string> columns_;
  std::vector<double> values_;
  std::vector<std::string> ids_;
  Tiny tiny_ = Tiny::refused;
  std::size_t header_line_ = 0;      // 0: none, the table comes from elsewhere
  std::vector<std::size_t> lines_;   // of each row in the file,
  std::vector<std::string> places_;  // or where each row stands, when it comes from elsewhere
};

/// What to say about a column nobody knows: its nearest name, or all of them.
[[nodiscard]] std::string unknown_column(const CsvTable& table, const std::string& column,
                                         const std::vector<std::string_view>& known);

/// Content of a text file without a byte-order mark.
/// @throws SceneError  missing, unreadable, larger than `limit` bytes,
///                     or a pipe to which nobody writes for a second.
[[nodiscard]] std::string read_text(const std::filesystem::path& file, std::uintmax_t limit);

}  // namespace microslip::pipelines
