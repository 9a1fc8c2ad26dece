/// @file
/// `init`: a commented scene with every key, its unit, default and range.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// By the path of a key: "contact.surface"; of names of the user all lines of the section: "faces".
using TemplateTexts = std::map<std::string, std::string, std::less<>>;

/// @param kind     blade, step, mesh, modes, modal, bar, chain or block.
/// @param values   that stand in place of the examples, as TOML;
///                 an empty one leaves an optional key out.
/// @param remarks  lines more above a key.
/// @throws SceneError  another kind.
/// @note read_scene takes the template as it is (a mesh scene once its file is there).
[[nodiscard]] std::string scene_template(std::string_view kind, const TemplateTexts& values = {},
                                         const TemplateTexts& remarks = {});

}  // namespace microslip::pipelines
