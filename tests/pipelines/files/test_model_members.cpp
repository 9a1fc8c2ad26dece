#include "pipelines/files/model_members.hpp"

#include <gtest/gtest.h>

#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_model_members {
namespace {

std::string bytes_of(const ReducedModel& model) {
  ByteWriter bytes;
  bytes(model);
  return bytes.bytes();
}

ReducedModel read_back(const ReducedModel& model) {
  const std::string bytes = bytes_of(model);
  ByteReader reader(bytes);
  ReducedModel read;
  reader(read);
  return read;
}

TEST(ModelMembers, AModelIsReadBackBitForBit) {
  ReducedModel model = synthetic::model();
  model.static_preload = 12.5;
  model.effects.motion_ratio = 0.1;
  const ReducedModel read = read_back(model);
  EXPECT_EQ(bytes_of(read), bytes_of(model));
  EXPECT_EQ(read.patches[0].cells.shapes.u, model.patches[0].cells.shapes.u);
  EXPECT_EQ(read.static_preload, model.static_preload);
  EXPECT_EQ(read.effects.motion_ratio, model.effects.motion_ratio);
}

TEST(ModelMembers, LawsOfThePatchAreReadBack) {
  ReducedModel model = synthetic::model();
  model.patches[0].rules.friction = contact::FrictionLaw::exponential(0.5, 0.3, 2.0);
  model.patches[0].rules.roughness = contact::RoughSurface::matching_gaussian(1e-5);
  const contact::SurfaceRules rules = read_back(model).patches[0].rules;
  EXPECT_EQ(rules.friction->at(0.7).value, model.patches[0].rules.friction->at(0.7).value);
  EXPECT_EQ(rules.roughness->at(1e-6).compression,
            model.patches[0].rules.roughness->at(1e-6).compression);
  EXPECT_FALSE(read_back(synthetic::model()).patches[0].rules.friction.has_value());
}

}  // namespace
}  // namespace microslip::pipelines::test_model_members
