#include "pipelines/files/write_ladder.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {
namespace {

std::string signed_percent(const std::optional<double>& error) {
  constexpr double percent = 100.0;
  return error ? fmt::format("{:+.3g} %", percent * *error) : "–";
}

/// Of the first column: file names are long.
std::size_t width_of_values(const std::vector<RungResult>& rungs) {
  std::size_t width = 18;
  for (const RungResult& rung : rungs) width = std::max(width, rung.value.size() + 2);
  return width;
}

}  // namespace

void write_ladder_csv(const std::filesystem::path& file, const std::vector<RungResult>& rungs) {
  std::string table = header_of(ladder_columns()) + "\n";
  for (const RungResult& rung : rungs) table += row_of(ladder_columns(), rung) + "\n";
  write_whole(file, table);
}

std::string ladder_text(const std::string& knob, const std::vector<RungResult>& rungs) {
  const std::size_t width = width_of_values(rungs);
  std::string text =
      fmt::format("{:<{}}{:<16}{:>10}{:>6}{:>14}{:>12}{:>12}{:>7}\n", knob, width, "curve",
                  "seconds", "of", "peak [m]", "true error", "told", "order");
  for (const RungResult& rung : rungs) {
    text += fmt::format("{:<{}}{:<16}{:>10.2f}{:>6}{:>14.6g}{:>12}{:>12}{:>7}\n", rung.value, width,
                        rung.curve, rung.seconds, rung.runs, rung.amplitude,
                        signed_percent(rung.true_error), signed_percent(rung.estimated_error),
                        rung.order ? fmt::format("{:.1f}", *rung.order) : "–");
  }
  return text;
}

}  // namespace microslip::pipelines
