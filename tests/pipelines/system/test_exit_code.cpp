#include "pipelines/system/exit_code.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_exit_code {
namespace {

TEST(ExitCode, MessagesHoldNoControlCharacters) {
  EXPECT_EQ(message_of(SceneError("no surface \"\x1b[31mred\x7f\", \u03ba\n\tof these")),
            "no surface \"\\x1b[31mred\\x7f\", \u03ba\n\tof these");
  EXPECT_EQ(message_of(std::logic_error("\a")), "internal error: \\x07");
}

}  // namespace
}  // namespace microslip::pipelines::test_exit_code
