/// @file
/// Tables of a Campbell diagram.
#pragma once

#include <filesystem>
#include <vector>

#include "pipelines/structure/campbell.hpp"

namespace microslip::pipelines {

/// FOLDER/frequencies.csv and crossings.csv. @throws ExhaustedError  cannot be written.
void write_campbell(const std::filesystem::path& folder, const CampbellDiagram& diagram,
                    const std::vector<Crossing>& crossings);

/// The crossings as lines for people.
[[nodiscard]] std::string crossings_text(const std::vector<Crossing>& crossings);

}  // namespace microslip::pipelines
