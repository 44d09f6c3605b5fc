#include "engine/transitions/joins/crossfade.h"

#include <gtest/gtest.h>

#include "engine/fuzzy/features.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

double ArmDegrees(const BodyPose& pose) { return ComputeFeatures(pose, PosedBody::kStandingHipHeight)[Feature::kRH]; }

/// The arms hang at the transition point; `continuation` is the old motion's next frames.
Blend FadeOutOf(const std::vector<BodyPose>& continuation, const BodyPose& target) {
  const BodyPose hanging = StandingClip(1, 0).poses[0];
  return Crossfade({.shown = {hanging, hanging},
                    .target = {target, target},
                    .continuation = [&](std::size_t) { return continuation; }},
                   {.blend_s = 1});
}

TEST(Crossfade, ShowsSmoothlyMoreOfTheNewMotion) {
  const BodyPose raised = StandingClip(1, 80).poses[0];
  const Blend blend = FadeOutOf({}, raised);
  EXPECT_NEAR(ArmDegrees(blend(raised, 15)), 40, 1e-9) << "half of both after half the time";
  EXPECT_NEAR(ArmDegrees(blend(raised, 3)), 80 * (3 * 0.01 - 2 * 0.001), 1e-9) << "3t² − 2t³ at t = 0.1";
  ExpectSamePose(blend(raised, 30), raised, 0);
}

TEST(Crossfade, LetsTheOldMotionGoOnAndThenHoldsItsLastFrame) {
  const BodyPose hanging = StandingClip(1, 0).poses[0];
  const std::vector<BodyPose> rising = {StandingClip(1, 10).poses[0], StandingClip(1, 20).poses[0]};
  const Blend blend = FadeOutOf(rising, hanging);
  const auto old_share = [](double t) { return 1 - t * t * (3 - 2 * t); };
  EXPECT_NEAR(ArmDegrees(blend(hanging, 1)), 10 * old_share(1 / 30.0), 1e-9);
  EXPECT_NEAR(ArmDegrees(blend(hanging, 2)), 20 * old_share(2 / 30.0), 1e-9);
  EXPECT_NEAR(ArmDegrees(blend(hanging, 10)), 20 * old_share(10 / 30.0), 1e-9);
}

}  // namespace
}  // namespace etude
