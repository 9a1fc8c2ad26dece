#include "pipelines/scene/field_description.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "pipelines/system/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines {
namespace {

class FieldTables : public testing::Test {
 protected:
  FieldTable table(const std::string& text) {
    const std::filesystem::path file = folder_.path() / "mu.csv";
    std::ofstream(file) << text;
    return {file};
  }

 private:
  test::TemporaryFolder folder_;
};

const Eigen::VectorXd p = Eigen::Vector3d(0.0, 0.01, 0.03);
const Eigen::VectorXd r = Eigen::Vector3d(0.0, 0.01, 0.01);

template <typename Value>
FieldDescription field(Value value, double low = -unbounded) {
  return {.value = value, .place = "scene.toml:7: contact.friction_coefficient", .low = low};
}

std::string refusal(const FieldDescription& description) {
  try {
    (void)Field(description).at(p, r);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(FieldTables, AreInterpolatedAndHeldOutside) {
  const FieldDescription description =
      field(table("r,value,p\n0,0.2,0\n0,0.4,0.02\n0.02,0.6,0\n0.02,0.8,0.02\n"));
  const Eigen::VectorXd values = Field(description).at(p, r);
  EXPECT_NEAR(values[0], 0.2, 1e-15);
  EXPECT_NEAR(values[1], 0.5, 1e-15);
  EXPECT_NEAR(values[2], 0.6, 1e-15);  // p is beyond the table
}

TEST_F(FieldTables, NameWhatIsMissing) {
  EXPECT_NE(refusal(field(table("p,r,mu\n0,0,0.2\n"))).find("value"), std::string::npos);
  EXPECT_NE(refusal(field(table("p,r,value\n"))).find("mu.csv"), std::string::npos);
  EXPECT_NE(refusal(field(table("p,r,value\n0,0,1\n1,0,2\n0,0,3\n"))).find("rows 1 and 3"),
            std::string::npos);
  EXPECT_NE(refusal(field(table("p,r,value\n0,0,x\n"))).find("mu.csv:2"), std::string::npos);
  EXPECT_NE(refusal(field(FieldTable{"/nowhere/mu.csv"})).find("/nowhere/mu.csv"),
            std::string::npos);
}

TEST(FieldDescription, IsANumberOrAnExpression) {
  EXPECT_EQ(Field(field(0.4)).at(p, r), Eigen::VectorXd::Constant(3, 0.4));
  EXPECT_EQ(Field(field(FieldExpression{"p + 2*r"})).at(p, r), Eigen::VectorXd(p + 2.0 * r));
  EXPECT_NE(refusal(field(FieldExpression{"q"})).find("scene.toml:7: contact.friction_coefficient"),
            std::string::npos);
}

TEST(FieldDescription, MustStayInItsRange) {
  EXPECT_THROW(Field(field(-0.1, 0.0)), SceneError);
  const std::string said = refusal(field(FieldExpression{"0.02 - p"}, 0.0));
  EXPECT_NE(said.find("p = 0.03 m"), std::string::npos) << said;
  EXPECT_NE(said.find("at least 0"), std::string::npos) << said;
}

}  // namespace
}  // namespace microslip::pipelines
