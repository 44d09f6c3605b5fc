#include <gtest/gtest.h>

#include <cmath>

#include "engine/teaching/teach_move.h"
#include "tests/engine/teaching/arms.h"
#include "tests/support/kept_lines.h"
#include "tests/support/random_clip.h"

namespace etude::testing {
namespace {

// Returns moving arms, a knee and a trunk; some frames lack the body, some joints are guessed.
SkeletonStream WildStream(std::uint64_t seed, double seconds, double rate_hz, double reach) {
  Dice dice(seed);
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  const int frames = static_cast<int>(seconds * rate_hz);
  for (int t = 0; t < frames; ++t) {
    const double part = static_cast<double>(t) / frames, swing = std::sin(2 * kPi * part);
    BodyPose pose = ArmsAt(20 + reach * std::abs(swing), 30 + reach * (0.5 - 0.5 * std::cos(5 * part)));
    pose[Role::kRightKnee].z += 0.003 * reach * std::max(0.0, swing);
    pose[Role::kLeftWrist].z += 0.002 * reach * swing;
    pose[Role::kShoulderCentre].x += 0.001 * reach * swing;
    for (glm::dvec3& joint : pose.joints) joint += 0.01 * dice.Vector();
    motion.poses.push_back(pose);
  }
  SkeletonStream stream = StreamOf(motion);
  for (SensedFrame& frame : stream.frames) {
    if (dice.Below(15) == 0) frame[Role::kHead].state = TrackingState::kInferred;
    if (dice.Below(20) == 0) frame.body_seen = false;
  }
  return stream;
}

TEST(TeachMove, LearnsTheKeyPosesThatItLearnt) {
  std::vector<std::string> lines;
  for (int trial = 0; trial < 14; ++trial) {
    std::vector<SkeletonStream> right;
    const double rate_hz = trial % 4 == 3 ? 15 : 30;
    for (int person = 0; person <= trial % 4; ++person) {
      right.push_back(WildStream(10 * trial + person, 1.1 + 0.3 * ((trial + 2 * person) % 5), rate_hz,
                                 trial % 5 == 4 ? 6 : 45 + 8 * trial + 7 * person));
    }
    TeachOptions options;
    if (trial % 3 == 2) {
      options = {
          .least_range_deg = 12, .most_poses = 5, .spread = 4, .least_tolerance_deg = 9, .most_tolerance_deg = 60};
    }
    const std::vector<SkeletonStream> wrong(trial % 2, right[0]);
    const TaughtMove move = TeachMove("m", right, wrong, options).value();
    lines.push_back(fmt::format("move {}: {:.3f} s, {} right, {} wrong", trial, move.span_s, move.examples.size(),
                                move.counter_examples.size()));
    for (const TaughtPose& pose : move.poses) {
      lines.emplace_back(" ");
      for (const PoseTarget& target : pose.targets) {
        lines.back() +=
            fmt::format(" {} {:.3f}±{:.3f}", FeatureName(target.feature), target.degrees, target.tolerance_deg);
      }
    }
  }
  EXPECT_TRUE(AreKept(lines, "tests/engine/teaching/key_poses.txt"));
}

TEST(TeachMove, TakesTheShortestAndTheLongestAndSaysWhatIsBeyond) {
  const auto complaint = [](double seconds, double rate_hz) {
    const auto move = TeachMove(
        "m",
        {StreamOf({.rate_hz = rate_hz, .poses = std::vector<BodyPose>(std::lround(seconds * rate_hz), ArmsAt(9, 9))})});
    return move ? "span " + std::to_string(move->span_s) : move.error().message;
  };
  EXPECT_EQ(complaint(0.5, 30), "span 0.650000");
  EXPECT_EQ(complaint(0.4, 30), "a performance of 'm' shows a body for only 0.40 s; allowed: at least 0.5 s");
  EXPECT_EQ(complaint(50, 2), "span 60.000000");
  EXPECT_EQ(complaint(60, 2), "span 60.000000");
  EXPECT_EQ(complaint(60.5, 2),
            "a performance of 'm' lasts 60.5 s; allowed: at most 60 s; use labels to mark where each performance "
            "begins and ends");
  EXPECT_EQ(TeachMove("m", {}).error().message, "move 'm' has no right performance from which Etude could learn");
}

}  // namespace
}  // namespace etude::testing
