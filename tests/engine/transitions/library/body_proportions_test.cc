#include "engine/transitions/library/body_proportions.h"

#include <gtest/gtest.h>

#include "engine/fuzzy/features.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

TEST(PerformedBy, GivesEveryClipTheCharactersLimbsAndHeight) {
  BodyMotion small = WavingClip(40);
  for (BodyPose& pose : small.poses) {
    for (glm::dvec3& joint : pose.joints) joint = 0.6 * joint + glm::dvec3(0, 0.3, 0);
  }
  const BodyProportions character = MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9);
  const BodyMotion performed = PerformedBy(character, small);
  const BodyMotion full_size = PerformedBy(character, WavingClip(40));
  EXPECT_NEAR(StandingHipHeight(performed.poses[0]), 0.9, 1e-12);
  for (std::size_t f = 0; f < performed.poses.size(); ++f) {
    ExpectSamePose(performed.poses[f], full_size.poses[f], 1e-9);
  }
  EXPECT_NEAR(performed.poses[0][Role::kLeftFoot].y, 0, 1e-12) << "set down on the floor";
}

}  // namespace
}  // namespace etude
