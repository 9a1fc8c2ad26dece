/// @file
/// Texts with a few bytes changed, put in, taken out or written twice, the same in every run.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace microslip::test {

class MutatedText {
 public:
  /// @param bytes  that may come in.
  MutatedText(unsigned seed, std::string_view bytes) : state_(seed), bytes_(bytes) {}

  /// One to `most_changes` of them; of pieces taken out or repeated so many bytes at most.
  [[nodiscard]] std::string of(std::string text, unsigned most_changes, std::size_t taken_out,
                               std::size_t repeated) {
    for (unsigned n = 1 + below(most_changes); n > 0; --n) {
      switch (below(4)) {
        case 0:
          text[below(text.size())] = bytes_[below(bytes_.size())];
          break;
        case 1:
          text.insert(below(text.size()), 1, bytes_[below(bytes_.size())]);
          break;
        case 2:
          text.erase(below(text.size()), 1 + below(taken_out));
          break;
        default:
          text.insert(below(text.size()), text.substr(below(text.size()), below(repeated)));
      }
    }
    return text;
  }

 private:
  /// A linear congruence.
  unsigned below(std::size_t n) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8) % static_cast<unsigned>(n);
  }

  unsigned state_;
  std::string_view bytes_;
};

}  // namespace microslip::test
