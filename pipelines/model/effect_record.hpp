/// @file
/// One row of the table of effects.
#pragma once

#include <string>

namespace microslip::pipelines {

struct EffectRecord {
  std::string name;
  std::string setting;  ///< auto | on | off
  bool simulated = false;
  std::string reason;
};

}  // namespace microslip::pipelines
