#include "engine/motion/displacements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/motion/moving_body.h"

namespace etude {
namespace {

using enum Role;
using ::testing::IsEmpty;

constexpr double kRate_hz = 30, kJump_m = 0.5;

BodyMotion Reversed(BodyMotion motion) {
  std::ranges::reverse(motion.poses);
  return motion;
}

/// Moves these joints, from frame `first` to frame `last`, by `by`.
BodyMotion Moved(BodyMotion motion, const std::vector<Role>& joints, int first, int last, const glm::dvec3& by) {
  for (int f = first; f <= last; ++f) {
    for (const Role joint : joints) motion.poses[static_cast<std::size_t>(f)][joint] += by;
  }
  return motion;
}

std::vector<MotionFault> Displaced(const BodyMotion& motion) {
  std::vector<MotionFault> faults = FindMotionFaults(motion).faults;
  std::erase_if(faults, [](const MotionFault& fault) {
    return fault.kind != FaultKind::kJumps && fault.kind != FaultKind::kPops;
  });
  return faults;
}

/// A dancer who swings both arms by 70° and sways.
BodyMotion Dancing(double rate_hz, double swings_hz, double seconds = 8) {
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  for (int f = 0; f < seconds * rate_hz; ++f) {
    const double t = f / rate_hz, sway = 0.1 * std::sin(3 * t);
    // The arms rest during every other second.
    const double swing = std::fmod(t, 2) < 1 ? std::sin(2 * kPi * swings_hz * t) : 0;
    motion.poses.push_back(Posed(0.86 + 0.02 * std::sin(3 * t), 0, sway, 1.2 * swing * swing));
  }
  return motion;
}

/// A jump for good or for one frame has the same size in every step, and the reversed motion has the mirrored fault.
TEST(Displacements, HaveOneSizeInEveryStepAndInReversedTime) {
  const BodyMotion still = Swaying(kRate_hz, 2);
  const int end = static_cast<int>(still.poses.size()) - 1;
  const std::vector<Role> arm = {kLeftWrist, kLeftHand};
  int checked = 0;
  for (const std::vector<Role>& joints : {std::vector<Role>(AllRoles().begin(), AllRoles().end()), arm}) {
    for (int at = 0; at < end; ++at) {
      // Frames up to `at`, and frame `at` alone.
      for (const int first : {0, at}) {
        const BodyMotion motion = Moved(still, joints, first, at, {0.4, 0, 0.3});
        const auto found = Displaced(motion), mirrored = Displaced(Reversed(motion));
        ASSERT_EQ(found.size(), 1u) << first << " to " << at << ", " << joints.size() << " joints";
        ASSERT_EQ(mirrored.size(), 1u) << first << " to " << at;
        EXPECT_NEAR(found[0].size, kJump_m, 0.02) << first << " to " << at << ": " << found[0].text;
        EXPECT_EQ(found[0].joint, joints.size() == arm.size() ? std::optional(kLeftWrist) : std::nullopt);
        EXPECT_NEAR(mirrored[0].size, found[0].size, 1e-6);
        EXPECT_EQ(mirrored[0].kind, found[0].kind);
        EXPECT_EQ(mirrored[0].joint, found[0].joint);
        EXPECT_NEAR(mirrored[0].from_s, end / kRate_hz - found[0].to_s, 1e-9) << first << " to " << at;
        EXPECT_NEAR(mirrored[0].to_s, end / kRate_hz - found[0].from_s, 1e-9) << first << " to " << at;
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 4 * end);
  EXPECT_THAT(Displaced(still), IsEmpty()) << "the control";
}

TEST(Displacements, AreNoneOfHonestMotionAtAnyRate) {
  for (const double rate : {5.0, 6.0, 8.0, 10.0, 12.5, 15.0, 20.0, 24.0, 30.0, 60.0, 120.0, 250.0}) {
    for (const double swings_hz : {0.5, 1.0, 1.5}) {
      EXPECT_THAT(FaultSentences(Displaced(Dancing(rate, swings_hz))), IsEmpty()) << rate << ", " << swings_hz;
      EXPECT_THAT(FaultSentences(Displaced(Reversed(Dancing(rate, swings_hz)))), IsEmpty()) << rate;
    }
    EXPECT_THAT(FaultSentences(Displaced(Hopping(rate))), IsEmpty()) << rate;
    EXPECT_THAT(FaultSentences(Displaced(Swaying(rate))), IsEmpty()) << rate;
  }
}

/// A wrist or a body that is displaced for good is found with the same size at every rate at which the honest motion
/// does not come near this size.
TEST(Displacements, HaveOneSizeAtEveryRate) {
  for (const double rate : {10.0, 12.5, 15.0, 20.0, 30.0, 60.0, 120.0, 250.0}) {
    const BodyMotion still = Swaying(rate);
    const int end = static_cast<int>(still.poses.size()) - 1, at = static_cast<int>(3 * rate);
    const auto jumps = Displaced(Moved(still, {AllRoles().begin(), AllRoles().end()}, at, end, {0.4, 0, 0.3}));
    ASSERT_EQ(jumps.size(), 1u) << rate;
    EXPECT_NEAR(jumps[0].size, kJump_m, 0.03) << rate;
    EXPECT_NEAR(jumps[0].to_s, at / rate, 1e-9);
    const auto pops = Displaced(Moved(still, {kLeftWrist, kLeftHand}, at, end, {0.4, 0, 0.3}));
    ASSERT_EQ(pops.size(), 1u) << rate;
    EXPECT_EQ(pops[0].joint, kLeftWrist);
    EXPECT_NEAR(pops[0].size, kJump_m, 0.06) << rate;
    EXPECT_NEAR(pops[0].to_s, at / rate, 1e-9);
  }
}

TEST(Displacements, ThatComeBackByAnotherAmountHaveOneSizeInReversedTime) {
  BodyMotion motion = Moved(Swaying(kRate_hz, 2), {AllRoles().begin(), AllRoles().end()}, 30, 30, {0.5, 0, 0});
  motion = Moved(motion, {AllRoles().begin(), AllRoles().end()}, 31, 59, {0.2, 0, 0});
  for (const BodyMotion& either : {motion, Reversed(motion)}) {
    const auto found = Displaced(either);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].size, 0.5, 0.02);
  }
}

}  // namespace
}  // namespace etude
