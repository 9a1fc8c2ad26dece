/// @file
/// `init`: a commented scene with every key, its unit, default and range.
#pragma once

#include <string>
#include <string_view>

namespace microslip::pipelines {

/// @param kind  blade, mesh, modal, bar, chain or block.
/// @throws SceneError  another kind.
/// @note read_scene takes the template as it is (a mesh scene once its file is there).
[[nodiscard]] std::string scene_template(std::string_view kind);

}  // namespace microslip::pipelines
