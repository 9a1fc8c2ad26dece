/// @file
/// Every key of a scene file, once: name, unit, default, range, meaning. Reading, checking, the
/// templates of `init` and the completed scene all come from this table.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace microslip::pipelines {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

enum class KeyType {
  number,  ///< a number, or a string with a unit
  integer,
  text,
  direction,  ///< three numbers
  other,      ///< lists, tables, alternatives: read by code of their own
};

struct KeySpec {
  std::string_view name;
  KeyType type = KeyType::number;
  std::string_view unit = "1";
  std::string_view preset;  ///< default as it would be written; empty: the key must be given
  double low = -unbounded;  ///< range of a number: low ≤ value ≤ high,
  double high = unbounded;
  bool above_low = false;  ///< … or low < value
  std::string_view meaning;
  bool optional = false;  ///< may be absent without a default
};

struct SectionSpec {
  std::string_view name;  ///< as written in [ ]
  std::span<const KeySpec> keys;
};

/// Keys of a section by the name of its table: "material"; "model.blade" and the like where a kind
/// has keys of its own; "face", "force", "output", "contact.chain.point" and their like the inline
/// tables of that name; "modal.point" the columns of contact points,
/// where "phi_u_N" stands for one of every mode.
/// @throws std::logic_error  no such section: a mistake of the program.
[[nodiscard]] SectionSpec section_spec(std::string_view name);

/// Keys of a section as scenes of a kind know it: "section.kind" where there is one,
/// else "section".
/// @throws std::logic_error  as above.
[[nodiscard]] SectionSpec section_spec(std::string_view section, std::string_view kind);

/// An entry of [points], whose keys are names of the user.
[[nodiscard]] KeySpec point_key(std::string_view name);

/// An entry of [faces], the same.
[[nodiscard]] KeySpec face_key(std::string_view name);

/// Sections a scene of a kind may have, in the order of a template.
[[nodiscard]] std::span<const std::string_view> sections_of_kind(std::string_view kind);

/// "0.004 or above", "between -1 and 0.5", …: how messages and templates tell a range.
[[nodiscard]] std::string range_text(const KeySpec& key);

}  // namespace microslip::pipelines
