/// @file
/// What is drawn of one curve, as files that another run can write again.
#pragma once

#include <string>
#include <vector>

namespace microslip::pipelines {

struct PictureFile {
  std::string name;  ///< within the run folder, e.g. "maps/preload_100_peak.h5"
  std::string bytes;
};

struct Pictures {
  std::vector<std::string> maps;   ///< their names
  std::vector<PictureFile> files;  ///< of the maps, and of the motion at the peak
};

}  // namespace microslip::pipelines
