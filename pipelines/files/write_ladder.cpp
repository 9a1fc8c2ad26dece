#include "pipelines/files/write_ladder.hpp"

#include <fmt/format.h>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {
namespace {

std::string signed_percent(const std::optional<double>& error) {
  constexpr double percent = 100.0;
  return error ? fmt::format("{:+.3g} %", percent * *error) : "–";
}

}  // namespace

void write_ladder_csv(const std::filesystem::path& file, const std::vector<RungResult>& rungs) {
  std::string table = header_of(ladder_columns()) + "\n";
  for (const RungResult& rung : rungs) table += row_of(ladder_columns(), rung) + "\n";
  write_whole(file, table);
}

std::string ladder_text(const std::string& knob, const std::vector<RungResult>& rungs) {
  std::string text = fmt::format("{:<18}{:<16}{:>10}{:>6}{:>14}{:>12}{:>12}{:>7}\n", knob, "curve",
                                 "seconds", "of", "peak [m]", "true error", "told", "order");
  for (const RungResult& rung : rungs) {
    text += fmt::format("{:<18}{:<16}{:>10.2f}{:>6}{:>14.6g}{:>12}{:>12}{:>7}\n", rung.value,
                        rung.curve, rung.seconds, rung.runs, rung.amplitude,
                        signed_percent(rung.true_error), signed_percent(rung.estimated_error),
                        rung.order ? fmt::format("{:.1f}", *rung.order) : "–");
  }
  return text;
}

}  // namespace microslip::pipelines
