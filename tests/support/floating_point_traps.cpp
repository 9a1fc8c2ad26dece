#include "tests/support/floating_point_traps.hpp"

#include <cfenv>

#include <gtest/gtest.h>

namespace microslip::tests {
namespace {

constexpr int trapped = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;

class FloatingPointTraps : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    if (UntrappedFile::is(test.file())) return;
    std::feclearexcept(trapped);
    feenableexcept(trapped);  // of glibc
  }
  void OnTestEnd(const testing::TestInfo& /*test*/) override { fedisableexcept(trapped); }
};

[[maybe_unused]] const bool registered = [] {
  // GoogleTest deletes it.
  testing::UnitTest::GetInstance()->listeners().Append(new FloatingPointTraps);
  return true;
}();

}  // namespace
}  // namespace microslip::tests
