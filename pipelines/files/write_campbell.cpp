#include "pipelines/files/write_campbell.hpp"

#include <numbers>

#include <fmt/format.h>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {

void write_campbell(const std::filesystem::path& folder, const CampbellDiagram& diagram,
                    const std::vector<Crossing>& crossings) {
  std::string table = header_of(campbell_columns()) + "\n";
  for (Eigen::Index i = 0; i < diagram.speeds.size(); ++i) {
    for (Eigen::Index mode = 0; mode < diagram.frequency.cols(); ++mode) {
      const CampbellRow row{diagram.speeds[i], mode, diagram.frequency(i, mode)};
      table += row_of(campbell_columns(), row) + "\n";
    }
  }
  write_whole(folder / "frequencies.csv", table);
  table = header_of(crossing_columns()) + "\n";
  for (const Crossing& crossing : crossings) table += row_of(crossing_columns(), crossing) + "\n";
  write_whole(folder / "crossings.csv", table);
}

std::string crossings_text(const std::vector<Crossing>& crossings) {
  if (crossings.empty()) return "no engine order meets a mode between these speeds\n";
  std::string text;
  for (const Crossing& crossing : crossings) {
    text += fmt::format("engine order {} meets mode {} at {:.6g} rpm, {:.6g} Hz\n",
                        crossing.engine_order, crossing.mode + 1,
                        30.0 * crossing.speed / std::numbers::pi,
                        0.5 * crossing.engine_order * crossing.speed / std::numbers::pi);
  }
  return text;
}

}  // namespace microslip::pipelines
