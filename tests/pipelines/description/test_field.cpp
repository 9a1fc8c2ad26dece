#include "pipelines/description/field.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "pipelines/system/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_field {
namespace {

const Eigen::VectorXd p = Eigen::Vector3d(0.0, 0.01, 0.03);
const Eigen::VectorXd r = Eigen::Vector3d(0.0, 0.01, 0.01);
constexpr const char* place = "scene.toml:7: contact.friction_coefficient";

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "not refused";
}

class FieldTables : public testing::Test {
 protected:
  FieldFunction table(const std::string& text) {
    const std::filesystem::path file = folder_.path() / "mu.csv";
    std::ofstream(file) << text;
    return field_of_table(file);
  }

  std::string refused_table(const std::string& text) {
    return refusal([&] { static_cast<void>(table(text)); });
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(FieldTables, AreInterpolatedAndHeldOutside) {
  const Eigen::VectorXd values =
      table("r,value,p\n0,0.2,0\n0,0.4,0.02\n0.02,0.6,0\n0.02,0.8,0.02\n")(p, r);
  EXPECT_NEAR(values[0], 0.2, 1e-15);
  EXPECT_NEAR(values[1], 0.5, 1e-15);
  EXPECT_NEAR(values[2], 0.6, 1e-15);  // p is beyond the table
}

TEST_F(FieldTables, NameWhatIsMissing) {
  EXPECT_NE(refused_table("p,r,mu\n0,0,0.2\n").find("value"), std::string::npos);
  EXPECT_NE(refused_table("p,r,value\n").find("mu.csv"), std::string::npos);
  EXPECT_NE(refused_table("p,r,value\n0,0,1\n1,0,2\n0,0,3\n").find("rows 1 and 3"),
            std::string::npos);
  EXPECT_NE(refused_table("p,r,value\n0,0,x\n").find("mu.csv:2"), std::string::npos);
  const std::string said = refusal([] { static_cast<void>(field_of_table("/nowhere/mu.csv")); });
  EXPECT_NE(said.find("/nowhere/mu.csv"), std::string::npos);
}

TEST(Field, IsANumberOrAnExpression) {
  const Field number{.value = 0.4, .place = place};
  EXPECT_EQ(number.at(p, r), Eigen::VectorXd::Constant(3, 0.4));
  const Field expression{.value = field_of_expression("p + 2*r", place), .place = place};
  EXPECT_EQ(expression.at(p, r), Eigen::VectorXd(p + 2.0 * r));
  const std::string said = refusal([] { static_cast<void>(field_of_expression("q", place)); });
  EXPECT_NE(said.find(place), std::string::npos) << said;
}

TEST(Field, MustStayInItsRange) {
  const auto said_of = [](Field field) {
    field.low = 0.0;
    return refusal([&] { static_cast<void>(field.at(p, r)); });
  };
  const std::string below = said_of({.value = -0.1, .place = place});
  EXPECT_NE(below.find(place), std::string::npos) << below;
  const std::string said =
      said_of({.value = field_of_expression("0.02 - p", place), .place = place});
  EXPECT_NE(said.find("p = 0.03 m"), std::string::npos) << said;
  EXPECT_NE(said.find("at least 0"), std::string::npos) << said;
}

}  // namespace
}  // namespace microslip::pipelines::test_field
