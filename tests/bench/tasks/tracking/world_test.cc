#include "bench/tasks/tracking/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/metrics/pose_error.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/start_angles.h"
#include "tests/bench/tasks/tracking/some_clips.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kTrackingKey{.suite_seed = 1, .scenario = "tracking-world", .trial = 0};

TrackingWorld MakeWorld(const TrackingOptions& options, const LibraryClip& clip) {
  auto world = MakeTrackingWorld(options, clip, kTrackingKey);
  EXPECT_TRUE(world) << ToString(world.error());
  return *std::move(world);
}

double LargestStepDeg(const std::vector<TreeState>& motion) {
  double largest = 0;
  for (std::size_t k = 1; k < motion.size(); ++k) {
    for (std::size_t i = 0; i < motion[k].angles.size(); ++i) {
      largest = std::max(largest, Degrees(std::abs(motion[k].angles[i] - motion[k - 1].angles[i])));
    }
  }
  return largest;
}

TEST(TrackingWorld, FindsAMotionOfTheBodyItselfAgain) {
  const KinematicTree tree = MakeBodyTree({});
  const LibraryClip clip = ClipOf(tree, SwingingStates(tree, 40));
  const TrackingWorld world = MakeWorld({.duration_s = 60}, clip);
  ASSERT_EQ(world.truth.size(), 40u) << "taken whole";
  std::vector<BodyPose> found, expected;
  const FloorMove to_origin = ToOrigin(clip.motion.poses[20]);
  for (const TreeState& state : world.truth) found.push_back(ToBodyPose(world.tree, state));
  for (const BodyPose& pose : clip.motion.poses) expected.push_back(to_origin.Apply(pose));
  EXPECT_LT(ComparePoses(found, expected).mpjpe_mm, 1e-6);
}

TEST(TrackingWorld, TargetsAreMetByATruthWithinTheLimits) {
  for (const char* name : {"builtin:boxing", "builtin:puzzled"}) {
    const TrackingWorld world = MakeWorld({}, BuiltinClipOf(name));
    ASSERT_EQ(world.targets.size(), world.truth.size());
    for (std::size_t k = 0; k < world.truth.size(); ++k) {
      const TreeFrames frames = ComputeFrames(world.tree, world.truth[k]);
      for (std::size_t e = 0; e < 4; ++e) {
        EXPECT_EQ(world.targets[k][e].position, frames.effectors[e].position);
        EXPECT_EQ(world.targets[k][e].axes, frames.effectors[e].axes);
      }
      for (std::size_t i = 0; i < world.tree.limits.size(); ++i) {
        EXPECT_GE(world.truth[k].angles[i], world.tree.limits[i].lower);
        EXPECT_LE(world.truth[k].angles[i], world.tree.limits[i].upper);
      }
    }
  }
}

TEST(TrackingWorld, ASecretOneIsDisguisedWithItsTargetsMetWithinTheLimits) {
  const WorldKey secret{.suite_seed = Seed::Secret({1, 2, 3, 4}), .scenario = "tracking-world"};
  for (const char* name : {"builtin:boxing", "builtin:stretch"}) {
    const LibraryClip clip = BuiltinClipOf(name);
    const auto world = MakeTrackingWorld({}, clip, secret), again = MakeTrackingWorld({}, clip, secret);
    ASSERT_TRUE(world && again);
    EXPECT_LE(LargestStepDeg(world->truth), 1200.0 / 30 + 1e-9);
    const double plain = MakeWorld({}, clip).tree.joints[kTreeLeftKnee].p_PJ.z;
    EXPECT_GT(std::abs(world->tree.joints[kTreeLeftKnee].p_PJ.z / plain - 1), 1e-4) << "another size";
    EXPECT_GT(std::abs(glm::dot(Facing(ToBodyPose(world->tree, world->truth[0])), glm::dvec3(1, 0, 0))), 1e-3);
    for (std::size_t k = 0; k < world->truth.size(); ++k) {
      EXPECT_EQ(world->truth[k].angles, again->truth[k].angles);
      EXPECT_EQ(world->targets[k][0].position, ComputeFrames(world->tree, world->truth[k]).effectors[0].position);
      for (std::size_t i = 0; i < 29; ++i) {
        EXPECT_GE(world->truth[k].angles[i], world->tree.limits[i].lower - 1e-12);
        EXPECT_LE(world->truth[k].angles[i], world->tree.limits[i].upper + 1e-12);
      }
    }
  }
}

// An arm that scratches the head leaves its range and comes back at the other end of the range.
TEST(TrackingWorld, NoJointTurnsFasterThanItCan) {
  const LibraryClip clip = BuiltinClipOf("builtin:puzzled");
  const TrackingWorld world = MakeWorld({.duration_s = 60}, clip);
  EXPECT_LE(LargestStepDeg(world.truth), 1200.0 / 30 + 1e-9);
  std::vector<TreeState> frame_by_frame;
  for (const BodyPose& pose : clip.motion.poses) {
    frame_by_frame.push_back(*FindStartState(world.tree, pose, world.tree.limits));
  }
  EXPECT_GT(LargestStepDeg(frame_by_frame), 180) << "a control: what the limit is for";
}

TEST(TrackingWorld, RepeatsMovesThatLoopAndTakesShortClipsWhole) {
  const LibraryClip loop = BuiltinClipOf("builtin:sway");
  LibraryClip once = loop;
  once.move.reset();
  const double clip_s = loop.motion.DurationSeconds();
  const TrackingOptions options{.duration_s = 3 * clip_s};
  const TrackingWorld repeated = MakeWorld(options, loop);
  const std::size_t period = loop.motion.poses.size();
  ASSERT_EQ(repeated.truth.size(), 3 * period);
  for (std::size_t i = 0; i < 29; ++i) {
    EXPECT_NEAR(repeated.truth[7].angles[i], repeated.truth[7 + period].angles[i], 1e-9);
  }
  EXPECT_EQ(MakeWorld(options, once).truth.size(), period);
}

TEST(TrackingWorld, AtHalfTheRateHasEverySecondFrame) {
  const LibraryClip loop = BuiltinClipOf("builtin:sway");
  const TrackingWorld full = MakeWorld({.duration_s = 2}, loop);
  const TrackingWorld half = MakeWorld({.duration_s = 2, .rate_hz = 15}, loop);
  ASSERT_EQ(half.truth.size(), 30u);
  for (std::size_t k = 0; k < 30; ++k) {
    for (std::size_t i = 0; i < 29; ++i) {
      EXPECT_NEAR(half.truth[k].angles[i], full.truth[2 * k].angles[i], 1e-9) << k;
    }
  }
}

TEST(TrackingWorld, BeginsStandingOrNearTheTruth) {
  const LibraryClip clip = BuiltinClipOf("builtin:boxing");
  const TrackingWorld standing = MakeWorld({}, clip);
  EXPECT_EQ(standing.first_angles, StandingState(standing.tree).angles);
  const TrackingWorld exact = MakeWorld({.joint_noise_deg = 0}, clip);
  EXPECT_EQ(exact.first_angles, exact.truth[0].angles);
  const TrackingWorld near = MakeWorld({.joint_noise_deg = 3}, clip);
  double squares = 0;
  for (std::size_t i = 0; i < 29; ++i) {
    squares += std::pow(Degrees(near.first_angles[i] - near.truth[0].angles[i]), 2);
    EXPECT_GE(near.first_angles[i], near.tree.limits[i].lower);
    EXPECT_LE(near.first_angles[i], near.tree.limits[i].upper);
  }
  EXPECT_NEAR(std::sqrt(squares / 29), 3, 1.2);
}

TEST(TrackingWorld, NoiseMovesTargetsAndNotTheTruth) {
  const LibraryClip clip = BuiltinClipOf("builtin:boxing");
  const TrackingWorld clean = MakeWorld({}, clip);
  const TrackingWorld noisy = MakeWorld({.target_noise = {.position_cm = 1, .orientation_deg = 3}}, clip);
  double squares = 0;
  glm::dvec3 last(0);
  double with_last = 0;
  for (std::size_t k = 0; k < clean.truth.size(); ++k) {
    EXPECT_EQ(clean.truth[k].angles, noisy.truth[k].angles);
    for (std::size_t e = 0; e < 4; ++e) {
      const glm::dvec3 cm = 100.0 * (noisy.targets[k][e].position - clean.targets[k][e].position);
      squares += glm::dot(cm, cm);
      if (e != 0) continue;
      with_last += glm::dot(cm, last);
      last = cm;
    }
  }
  const auto frames = static_cast<double>(clean.truth.size());
  EXPECT_NEAR(std::sqrt(squares / (12 * frames)), 1, 0.06);
  EXPECT_LT(std::abs(with_last) / (3 * frames), 0.2) << "anew in every frame";
}

TEST(TrackingWorld, RefusesAClipThatIsTooShortOrHasNoPose) {
  const KinematicTree tree = MakeBodyTree({});
  const auto complaint = [&](const LibraryClip& clip) {
    return testing::Message(MakeTrackingWorld({}, clip, kTrackingKey));
  };
  EXPECT_THAT(complaint(ClipOf(tree, SwingingStates(tree, 3))), HasSubstr(": 3 at 30 Hz; tracking needs 4"));
  EXPECT_EQ(complaint(ClipOf(tree, SwingingStates(tree, 4))), "accepted");
  LibraryClip folded = ClipOf(tree, SwingingStates(tree, 10));
  folded.motion.poses[6][Role::kLeftHand] = folded.motion.poses[6][Role::kLeftWrist];
  EXPECT_THAT(complaint(folded), HasSubstr("frame 6 of the window of clip swing cannot be converted to a pose"));
}

}  // namespace
}  // namespace etude
