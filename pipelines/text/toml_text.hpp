/// @file
/// The text of a scene as TOML, with mistakes told by line, column and the key they stand under.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace microslip::pipelines {

/// To be asked before a text is parsed: the parser descends by a call for each part of a dotted
/// key, and its stack ends.
/// @throws SceneError  a key of more than 100 parts.
void require_shallow_keys(std::string_view text, const std::string& name);

/// TOML has no letters beyond ASCII outside of quotes and comments, and what the parser does with
/// one is not defined.
/// @return offset of the first; npos: none.
[[nodiscard]] std::size_t foreign_letter(std::string_view text);

/// @param name  how messages call the text, e.g. the file.
/// @throws SceneError  not TOML: "name:line:column: section.key: …".
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& name);

/// What is wrong, in the words of scenes: numbers too large for their type are told as such.
[[nodiscard]] std::string description_of(const toml::parse_error& error);

}  // namespace microslip::pipelines
