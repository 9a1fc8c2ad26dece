// Scripts of share/scripts: where one is missing, the user is told what and where it should be.
#include "pipelines/system/script.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_script {
namespace {

TEST(Script, IsFoundBesideItsPackage) {
  const std::vector<std::string> command = script_command("convert_mesh.py");
  ASSERT_EQ(command.size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(command.back()));
}

TEST(Script, MissingOneIsNoInternalError) {
  try {
    static_cast<void>(script_command("gone.py"));
    FAIL() << "found";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("gone.py"), std::string::npos) << message;
    EXPECT_NE(message.find("share/scripts"), std::string::npos) << message;
    EXPECT_NE(message.find("share/python/microslip"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_script
