/// @file
/// Divisions by zero, invalid operations and overflows end the tests of contact and solver, and the
/// hard cases that need no more than these, where they happen (SIGFPE), instead of going on as
/// infinities and NaN.
#pragma once

#include <cfenv>
#include <filesystem>
#include <set>
#include <string>

namespace microslip::tests {

/// None of them ends the program as long as this lives: what is tested is to reach infinity,
/// or takes NaN.
class UntrappedFloatingPoint {
 public:
  UntrappedFloatingPoint() { std::feholdexcept(&before_); }
  ~UntrappedFloatingPoint() { std::fesetenv(&before_); }
  UntrappedFloatingPoint(const UntrappedFloatingPoint&) = delete;
  UntrappedFloatingPoint& operator=(const UntrappedFloatingPoint&) = delete;

 private:
  std::fenv_t before_{};
};

/// The same for all tests of a file: `const UntrappedFile this_file(__FILE__);`
class UntrappedFile {
 public:
  explicit UntrappedFile(const char* file) { files().insert(stem(file)); }
  [[nodiscard]] static bool is(const char* file) { return files().contains(stem(file)); }

 private:
  static std::string stem(const char* file) { return std::filesystem::path(file).stem().string(); }
  static std::set<std::string>& files() {
    static std::set<std::string> all;
    return all;
  }
};

}  // namespace microslip::tests
