/// @file
/// One section of a scene against its table of keys: unknown and missing keys, types, units and
/// ranges are told here, with file and line; what was read is written into the completed scene.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <toml++/toml.h>
#include <Eigen/Core>

#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {

class SectionReader {
 public:
  /// @param table     the section; nullptr: absent, every key takes its default.
  /// @param path      as users write it, e.g. "contact".
  /// @param file      the scene file, for messages.
  /// @param complete  receives every key, given or default.
  /// @throws SceneError  an unknown key, with the nearest known one.
  SectionReader(const toml::table* table, SectionSpec spec, std::string path, std::string file,
                toml::table& complete);

  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] int integer(std::string_view key) const;
  [[nodiscard]] std::string text(std::string_view key) const;
  /// One of the words given. @throws SceneError  another; the message lists them.
  [[nodiscard]] std::string word(std::string_view key,
                                 std::span<const std::string_view> allowed) const;
  /// A number in a node that might have been one of the words instead: a text that begins with no
  /// number is told the words. @throws SceneError  as number_in().
  [[nodiscard]] double number_or_word_in(const toml::node& node, std::string_view key,
                                         std::span<const std::string_view> words) const;
  /// Without value: "off". @throws SceneError  as number_in().
  [[nodiscard]] std::optional<double> number_or_off(std::string_view key) const;
  /// Unit vector. @throws SceneError  not three finite numbers, or zero.
  [[nodiscard]] Eigen::Vector3d direction(std::string_view key) const;
  /// The node as given, or its default; nullptr for an optional key that is absent.
  [[nodiscard]] const toml::node* node(std::string_view key) const;
  [[nodiscard]] bool given(std::string_view key) const;

  /// Reads a list of tables one by one and completes them.
  /// @param keys     name of their keys, as section_spec() has it.
  /// @param example  what a table looks like, for messages: "{ at = …, … }".
  /// @throws SceneError  no list of tables; an unknown key in one.
  void tables(std::string_view key, std::string_view keys, std::string_view example,
              const std::function<void(const SectionReader&)>& read);

  /// A number in a node, with or without a unit, finite and in the range of the key.
  [[nodiscard]] double number_in(const toml::node& node, std::string_view key) const;
  /// Replaces a key in the completed scene: where its value holds defaults of its own, or a path.
  template <typename Value>
  void complete(std::string_view key, Value&& value) {
    complete_.insert_or_assign(key, std::forward<Value>(value));
  }
  /// "file:line: path.key: message" as a SceneError.
  [[noreturn]] void fail(std::string_view key, const std::string& message,
                         const toml::node* at = nullptr) const;
  /// "file:line: path.key", what messages about the value of a key begin with.
  [[nodiscard]] std::string place(std::string_view key) const;
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] const KeySpec& spec_of(std::string_view key) const;
  [[nodiscard]] const toml::node& required(std::string_view key) const;

  SectionSpec spec_;
  const toml::table* given_;
  std::string path_;
  std::string file_;
  toml::table& complete_;
};

/// "file:line" of a node, or "--set key.path=value" when it came from an override.
[[nodiscard]] std::string place_of(const toml::node* node, const std::string& file);

}  // namespace microslip::pipelines
