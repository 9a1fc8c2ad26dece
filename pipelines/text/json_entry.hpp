/// @file
/// Values of a JSON file that know where they stand in it, so that a damaged file is told by its
/// place: "summary.json: curves[2].peak.frequency_Hz: expected a number, found null".
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace microslip::pipelines {

/// Borrows the document, which must outlive it.
class JsonEntry {
 public:
  /// @param path  how messages call the value: the file, then the keys that lead to it.
  JsonEntry(const nlohmann::ordered_json& value, std::string path)
      : value_(&value), path_(std::move(path)) {}

  /// Whether the key is there and holds anything: files of older versions lack some.
  /// @throws SceneError  this is no object.
  [[nodiscard]] bool has(const std::string& key) const;
  /// All below throw SceneError where the key is missing or holds something else; the message names
  /// the place, what was expected and what was found.
  [[nodiscard]] JsonEntry at(const std::string& key) const;
  [[nodiscard]] double number(const std::string& key) const { return at(key).as_number(); }
  [[nodiscard]] long integer(const std::string& key) const;
  [[nodiscard]] std::string text(const std::string& key) const { return at(key).as_text(); }
  [[nodiscard]] bool truth(const std::string& key) const;
  /// No entries where the key is missing or null.
  [[nodiscard]] std::vector<JsonEntry> list(const std::string& key) const;

  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] bool is_number() const { return value_->is_number(); }
  [[nodiscard]] double as_number() const;
  [[nodiscard]] std::string as_text() const;

 private:
  [[noreturn]] void expected(const char* what) const;

  const nlohmann::ordered_json* value_;
  std::string path_;
};

/// @param name  how messages call the file.
/// @throws SceneError  not JSON: "name:line:column: …".
[[nodiscard]] nlohmann::ordered_json parse_json(const std::string& text, const std::string& name);

}  // namespace microslip::pipelines
