#include "pipelines/scene/matrix_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/csv_table.hpp"

namespace microslip::pipelines {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr std::uintmax_t largest_file = 8'000'000'000;  // bytes
constexpr double asymmetry = 1e-9;                      // of the largest entry

/// Lines of a file with their number.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& file)
      : name_(file.string()), text_(read_text(file, largest_file)) {}

  /// The next line that is not empty. @throws SceneError  there is none.
  std::string next(const std::string& expected) {
    for (std::string line; std::getline(text_, line);) {
      ++number_;
      if (line.find_first_not_of(" \t\r") != std::string::npos) return line;
    }
    throw SceneError(
        fmt::format("{}: the file ends at line {}; expected {}", name_, number_, expected));
  }

  /// That nothing but empty lines follows. @throws SceneError  there is more.
  void require_end(const std::string& expected) {
    for (std::string line; std::getline(text_, line);) {
      ++number_;
      if (line.find_first_not_of(" \t\r") != std::string::npos) fail("expected " + expected);
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(fmt::format("{}:{}: {}", name_, number_, message));
  }

 private:
  std::string name_;
  std::istringstream text_;
  std::size_t number_ = 0;
};

/// Nothing is left of a line: of "1.9D+07" or "1,9" a part would be taken for the number.
bool is_at_end(std::istringstream& words) { return (words >> std::ws).eof(); }

bool read_is_symmetric(Lines& lines) {
  std::string header = lines.next("a header");
  std::ranges::transform(header, header.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::istringstream words(header);
  std::array<std::string, 5> word;
  for (std::string& w : word) words >> w;
  const bool real = word[3] == "real" || word[3] == "integer";
  const bool known = word[4] == "symmetric" || word[4] == "general";
  if (word[0] != "%%matrixmarket" || word[2] != "coordinate" || !real || !known) {
    lines.fail("expected \"%%MatrixMarket matrix coordinate real symmetric\" (or general)");
  }
  return word[4] == "symmetric";
}

/// Rows, columns, number of entries.
std::array<Eigen::Index, 3> read_size(Lines& lines) {
  std::string line = lines.next("the size");
  while (line.front() == '%') line = lines.next("the size");
  std::array<Eigen::Index, 3> size{};
  std::istringstream words(line);
  const bool has_all = static_cast<bool>(words >> size[0] >> size[1] >> size[2]);
  if (!has_all || !is_at_end(words) || size[0] < 1 || size[2] < 0) {
    lines.fail("expected numbers of rows, columns and entries");
  }
  if (size[0] != size[1])
    lines.fail(fmt::format("{} rows, {} columns: not square", size[0], size[1]));
  if (size[0] > size[2]) {  // told before room is made for them
    lines.fail(fmt::format("{} rows, {} entries: there are rows without any", size[0], size[2]));
  }
  return size;
}

Eigen::Triplet<double> read_entry(Lines& lines, Eigen::Index n) {
  const std::string line = lines.next("more entries, as the size says");
  std::istringstream words(line);
  Eigen::Index i = 0;
  Eigen::Index j = 0;
  double value = 0.0;
  const bool has_all = static_cast<bool>(words >> i >> j >> value);
  if (!has_all || !is_at_end(words) || !std::isfinite(value)) {
    lines.fail(fmt::format(
        "expected row, column and a finite number, as 1 1 1.9e7; found \"{:.40}\"", line));
  }
  if (i < 1 || j < 1 || i > n || j > n) {
    lines.fail(fmt::format("entry ({}, {}) lies outside of {} rows and columns", i, j, n));
  }
  return {static_cast<int>(i - 1), static_cast<int>(j - 1), value};
}

/// Of a symmetric matrix one half is given: both would count each entry twice. Entries that stand
/// twice in one half are parts of a sum, as an assembly writes them.
void require_one_half(const Triplets& given, const std::filesystem::path& file) {
  std::vector<std::array<int, 3>> places;  // the larger number, the smaller, in which half
  places.reserve(given.size());
  for (const auto& entry : given) {
    const auto [smaller, larger] = std::minmax({entry.row(), entry.col()});
    if (smaller != larger) places.push_back({larger, smaller, entry.row() == larger ? 1 : 0});
  }
  std::ranges::sort(places);
  const auto both = std::ranges::adjacent_find(places, [](const auto& one, const auto& next) {
    return one[0] == next[0] && one[1] == next[1] && one[2] != next[2];
  });
  if (both == places.end()) return;
  throw SceneError(fmt::format(
      "{}: the matrix is symmetric, and entries ({}, {}) and ({}, {}) are both there; write one",
      file.string(), (*both)[1] + 1, (*both)[0] + 1, (*both)[0] + 1, (*both)[1] + 1));
}

void add_other_half(Triplets& entries) {
  const std::size_t n = entries.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto entry = entries[k];
    if (entry.row() != entry.col()) entries.emplace_back(entry.col(), entry.row(), entry.value());
  }
}

void require_symmetric(const Sparse& matrix, const std::filesystem::path& file) {
  const Sparse transposed = matrix.transpose();
  const double largest = matrix.coeffs().cwiseAbs().maxCoeff();
  const Sparse difference = matrix - transposed;
  for (int row = 0; row < difference.outerSize(); ++row) {
    for (Sparse::InnerIterator entry(difference, row); entry; ++entry) {
      if (std::abs(entry.value()) <= asymmetry * largest) continue;
      throw SceneError(fmt::format(
          "{}: the matrix is not symmetric: entry ({}, {}) is {:.6g}, ({}, {}) is {:.6g}",
          file.string(), entry.row() + 1, entry.col() + 1, matrix.coeff(entry.row(), entry.col()),
          entry.col() + 1, entry.row() + 1, matrix.coeff(entry.col(), entry.row())));
    }
  }
}

/// A pipe that nobody writes to would be waited for.
void require_regular_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error)) return;
  if (std::filesystem::is_regular_file(file, error)) return;
  throw SceneError(fmt::format("{}: not a file; write it to one", file.string()));
}

Eigen::Index row_in(const CsvTable& table, std::size_t line, std::size_t column, Eigen::Index n) {
  const double value = table.at(line, column);
  if (value == std::floor(value) && value >= 0.0 && value <= static_cast<double>(n)) {
    return static_cast<Eigen::Index>(value) - 1;
  }
  throw SceneError(fmt::format("{}{:g} is no row of the matrices; expected 1 to {}, or 0 (held)",
                               table.place(line, column), value, n));
}

}  // namespace

Sparse read_matrix_market(const std::filesystem::path& file) {
  require_regular_file(file);
  Lines lines(file);
  const bool symmetric = read_is_symmetric(lines);
  const auto [n, columns, n_entries] = read_size(lines);
  Triplets entries;
  for (Eigen::Index k = 0; k < n_entries; ++k) {
    entries.push_back(read_entry(lines, n));
  }
  lines.require_end(fmt::format("no more than {} entries, as the size says", n_entries));
  if (symmetric) {
    require_one_half(entries, file);
    add_other_half(entries);
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!symmetric) require_symmetric(matrix, file);
  return matrix;
}

NodeRows read_node_rows(const std::filesystem::path& file, Eigen::Index n) {
  require_regular_file(file);
  const CsvTable table = CsvTable::read(file);
  const std::array<const char*, 3> axes{"x", "y", "z"};
  const auto n_nodes = static_cast<Eigen::Index>(table.n_rows());
  NodeRows nodes{Eigen::MatrixX3d(n_nodes, 3), {}};
  nodes.row.resize(n_nodes, 3);
  std::vector<std::size_t> line_of(static_cast<std::size_t>(n), table.n_rows());
  for (int d = 0; d < 3; ++d) {
    const std::size_t place = table.require(axes[static_cast<std::size_t>(d)]);
    const std::size_t row = table.require(fmt::format("u{}", axes[static_cast<std::size_t>(d)]));
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
      const auto node = static_cast<Eigen::Index>(i);
      nodes.places(node, d) = table.at(i, place);
      nodes.row(node, d) = row_in(table, i, row, n);
      if (nodes.row(node, d) < 0) continue;
      std::size_t& line = line_of[static_cast<std::size_t>(nodes.row(node, d))];
      if (line != table.n_rows()) {
        throw SceneError(fmt::format("{}row {} is that of another displacement already, at {}",
                                     table.place(i, row), nodes.row(node, d) + 1,
                                     table.row_place(line)));
      }
      line = i;
    }
  }
  const auto missing = std::ranges::find(line_of, table.n_rows());
  if (missing != line_of.end()) {
    throw SceneError(fmt::format("{}: row {} of the matrices belongs to no node", file.string(),
                                 missing - line_of.begin() + 1));
  }
  return nodes;
}

}  // namespace microslip::pipelines
