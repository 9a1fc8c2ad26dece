#include "mesh/import/step_statements.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <system_error>
#include <unordered_set>
#include <vector>

#include "mesh/mesh_error.hpp"

namespace microslip::mesh {
namespace {

constexpr int deepest = 100;  // parentheses: lists of lists of typed values are four

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class StatementReader {
 public:
  StatementReader(std::string_view text, const std::filesystem::path& file)
      : text_(text), file_(file) {}

  void read() {
    while (skip_blanks(), at_ < text_.size()) {
      statement_ = {};
      if (text_[at_] == '#') {
        define();
      } else {
        skip_to_end();  // of the header, or a mark
      }
    }
    for (const Reference& reference : references_) {
      if (defined_.contains(reference.to)) continue;
      line_ = reference.line;
      statement_ = reference.from;
      fail("refers to #" + std::to_string(reference.to) + ", which the file does not define");
    }
  }

 private:
  using Number = std::uint64_t;
  struct Reference {
    Number from;
    Number to;
    long line;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw MeshError(file_.string() + ':' + std::to_string(line_) + ": " +
                    (statement_ > 0 ? '#' + std::to_string(statement_) + ' ' : std::string()) +
                    what + "; a part of the file is damaged or missing, export it again");
  }

  [[nodiscard]] char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void next() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_])) {
        next();
      } else if (text_.substr(at_, 2) == "/*") {
        skip_past("*/");
      } else {
        return;
      }
    }
  }

  /// From an opening mark to beyond the closing one.
  void skip_past(std::string_view mark) {
    const std::size_t end = text_.find(mark, at_ + 1);
    if (end == text_.npos) fail("opens what is not closed");
    const std::size_t stop = end + mark.size();
    while (at_ < stop) next();
  }

  void skip_to_end() {
    while (skip_blanks(), at_ < text_.size() && now() != ';') {
      now() == '\'' ? skip_past("'") : next();
    }
    if (at_ < text_.size()) ++at_;
  }

  /// #12
  Number reference() {
    ++at_;
    Number number = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (error != std::errc()) fail("has a # without a number");
    at_ += static_cast<std::size_t>(end - begin);
    return number;
  }

  void define() {
    const Number number = reference();
    statement_ = number;
    skip_blanks();
    if (now() != '=') fail("has no = after it");
    next();
    skip_blanks();
    if (!defined_.insert(number).second) fail("is defined twice");
    if (now() == '<') return skip_to_end();  // in another file
    read_values();
  }

  void read_values() {
    int depth = 0;
    while (skip_blanks(), now() != ';') {
      const char c = now();
      if (at_ >= text_.size()) fail("does not end");
      if (c == '(') {
        if (++depth > deepest) fail("has parentheses too deep");
        next();
      } else if (c == ')') {
        if (--depth < 0) fail("closes a parenthesis that is not open");
        next();
      } else {
        read_value(c);
      }
    }
    if (depth != 0) fail("leaves a parenthesis open");
    next();
  }

  void read_value(char c) {
    if (c == '#') {
      references_.push_back({statement_, reference(), line_});
    } else if (c == '\'' || c == '"') {
      skip_past(std::string_view(&c, 1));
    } else if (c == ',' || c == '$' || c == '*') {
      next();
    } else if (c == '.' && at_ + 1 < text_.size() && !is_digit(text_[at_ + 1])) {
      read_enumerator();
    } else if (is_digit(c) || c == '+' || c == '-') {
      read_number();
    } else {
      read_keyword();
    }
  }

  /// .MILLI.
  void read_enumerator() {
    next();
    while (is_word(now())) next();
    if (now() != '.') fail("has an enumerator without its second point");
    next();
  }

  void read_number() {
    const std::size_t begin = at_;
    while (is_digit(now()) || now() == '+' || now() == '-' || now() == '.' || now() == 'E' ||
           now() == 'e') {
      ++at_;
    }
    std::string_view digits = text_.substr(begin, at_ - begin);
    const std::string shown(digits.substr(0, 30));
    if (digits.front() == '+') digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_small_or_large = error == std::errc::result_out_of_range;
    if (is_small_or_large) value = std::strtod(std::string(digits).c_str(), nullptr);
    const bool is_whole =
        end == digits.data() + digits.size() && (error == std::errc() || is_small_or_large);
    if (!is_whole || !std::isfinite(value)) fail("has " + shown + ", which is no number");
  }

  /// LENGTH_MEASURE(…
  void read_keyword() {
    const std::size_t begin = at_;
    if (now() == '!') next();
    while (is_word(now())) next();
    const std::string word(text_.substr(begin, std::min<std::size_t>(at_ - begin, 30)));
    skip_blanks();
    if (word.empty()) fail("has a character that belongs to no value");
    if (now() != '(') fail("has " + word + ", which is no value");
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  long line_ = 1;
  Number statement_ = 0;
  std::unordered_set<Number> defined_;
  std::vector<Reference> references_;
};

}  // namespace

void require_sound_statements(std::string_view text, const std::filesystem::path& file) {
  StatementReader(text, file).read();
}

}  // namespace microslip::mesh
