#include "engine/fuzzy/fuzzy_motion.h"

#include <gtest/gtest.h>

#include "tests/engine/fuzzy/posed_body.h"

namespace etude {
namespace {

TEST(FuzzyMotion, SaysOfEveryFrameWhatItsPoseSays) {
  PosedBody body;
  BodyMotion motion{.rate_hz = 30, .poses = {body.Pose(), body.Pose()}};
  const FuzzyMotion fuzzy = FuzzifyMotion(motion, PosedBody::kStandingHipHeight);
  ASSERT_EQ(fuzzy.grades.size(), 2u);
  const PoseFeatures features = ComputeFeatures(body.Pose(), PosedBody::kStandingHipHeight);
  EXPECT_EQ(fuzzy.features[1].values, features.values);
  EXPECT_EQ(fuzzy.grades[1], Fuzzify(features));
  EXPECT_EQ(fuzzy.tags[1], ChooseTags(Fuzzify(features)));
  EXPECT_EQ(fuzzy.poses[1], "at rest");
}

TEST(FuzzyMotion, FollowsTheSystemThatItIsGiven) {
  BodyMotion motion{.rate_hz = 30, .poses = {PosedBody().Pose()}};
  FuzzySystem system = *LoadBuiltinFuzzySystem("gaussian", {});
  system.rules = {};
  const FuzzyMotion fuzzy = FuzzifyMotion(motion, PosedBody::kStandingHipHeight, system);
  EXPECT_EQ(fuzzy.poses[0], "") << "no rule";
  EXPECT_NE(fuzzy.grades[0], FuzzifyMotion(motion, PosedBody::kStandingHipHeight).grades[0]);
}

}  // namespace
}  // namespace etude
