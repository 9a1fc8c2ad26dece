#include "contact/patch/contact_patch.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_contact_patch {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string message_of(const Eigen::VectorXd& weights, const std::vector<PointParameters>& points) {
  try {
    const ContactPatch patch(weights, points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ContactPatch, KeepsWhatItIsGiven) {
  const ContactPatch patch(Eigen::Vector2d(1.0, 0.0), {{1.0, 2.0, 0.3, -4.0}, {}});
  EXPECT_EQ(patch.n_points(), 2);
  EXPECT_EQ(patch.weights()[0], 1.0);
  EXPECT_EQ(patch.points()[0].rest_load, -4.0);
}

TEST(ContactPatch, RefusesValuesOutOfRangeByNameAndPoint) {
  const tests::UntrappedFloatingPoint nan_is_compared;
  const PointParameters good{1.0, 1.0, 0.3, 1.0};
  const Eigen::VectorXd two = Eigen::VectorXd::Ones(2);
  const auto with = [&](auto change) {
    PointParameters bad = good;
    change(bad);
    return message_of(two, {good, bad});
  };
  EXPECT_NE(with([](auto& p) { p.tangential_stiffness = -1.0; }).find("tangential_stiffness = -1"),
            std::string::npos);
  EXPECT_NE(with([](auto& p) { p.normal_stiffness = infinity; }).find("normal_stiffness = inf"),
            std::string::npos);
  EXPECT_NE(with([](auto& p) { p.friction_coefficient = -0.1; }).find("friction_coefficient"),
            std::string::npos);
  EXPECT_NE(with([](auto& p) { p.rest_load = infinity - infinity; }).find("preload"),
            std::string::npos);
  EXPECT_NE(with([](auto& p) { p.rest_load = infinity; }).find("point 2"), std::string::npos);
  EXPECT_NE(message_of(Eigen::Vector2d(1.0, -1.0), {good, good}).find("weight = -1"),
            std::string::npos);
}

TEST(ContactPatch, RefusesSizesThatDiffer) {
  EXPECT_NE(message_of(Eigen::VectorXd(0), {}), "");
  EXPECT_NE(message_of(Eigen::VectorXd::Ones(2), {PointParameters{}}), "");
}

}  // namespace
}  // namespace microslip::contact::test_contact_patch
