
#include <gtest/gtest.h>

#include "bench/tasks/sensing/camera_stream.h"
#include "io/clips/clip_library.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

const WorldKey kKey{.suite_seed = 2, .scenario = "camera-sensor-test", .trial = 0};

BodyMotion Clap(std::size_t frames) {
  BodyMotion motion = LoadClips({"builtin:clap"}, {})->clips[0].motion;
  motion.poses.resize(frames);
  return motion;
}

/// Returns paper B's method with every stage replaced by its truth.
CaptureMethod Perfect() {
  CaptureMethod method{.causal = true, .oracle = {true, true, true, true, true, true, true, true}};
  return method;
}

SkeletonStream Live(const StudioOptions& studio, const CaptureMethod& method, const BodyMotion& motion) {
  auto sensor = CameraSensor::Make(studio, method, motion.poses.front(), motion.poses.size(), kKey);
  EXPECT_TRUE(sensor) << ToString(sensor.error());
  SkeletonStream stream;
  for (const BodyPose& pose : motion.poses) {
    if (const auto frame = (*sensor)->Update(pose)) stream.frames.push_back(*frame);
  }
  return stream;
}

double FarthestFrom(const BodyPose& truth, const SensedFrame& frame) {
  double farthest = 0;
  for (const Role role : AllRoles()) farthest = std::max(farthest, glm::distance(truth[role], frame[role].position));
  return farthest;
}

TEST(CameraSensor, TellsTheTruthWhenEveryStageIsOneAndNotWhenMarksAreDrawn) {
  const BodyMotion motion = Clap(12);
  const SkeletonStream perfect = Live({}, Perfect(), motion);
  ASSERT_EQ(perfect.frames.size(), motion.poses.size() - LiveSensor::kAhead);
  const SkeletonStream seen = Live({}, {.causal = true}, motion);
  for (std::size_t k = 0; k < perfect.frames.size(); ++k) {
    EXPECT_TRUE(perfect.frames[k].body_seen);
    EXPECT_LT(FarthestFrom(motion.poses[k], perfect.frames[k]), 1e-3) << k;
    EXPECT_GT(FarthestFrom(motion.poses[k], seen.frames[k]), 5e-3) << "the control";
  }
}

TEST(CameraSensor, SeesWhatTheTakeOfTheSameMotionShows) {
  const BodyMotion motion = Clap(11);
  CaptureMethod method{.causal = true};
  CameraSensing sensing{.studio = {.picture_every = 2}, .sources = {PersonSourceOf(method)}};
  CameraTake take(sensing, motion, kKey);
  const auto& whole = take.See(method);
  ASSERT_TRUE(whole) << ToString(whole.error());
  const SkeletonStream live = Live(sensing.studio, method, motion);
  ASSERT_EQ(live.frames.size(), 4u);
  for (std::size_t k = 0; k < live.frames.size(); ++k) {
    EXPECT_EQ(PoseOf(live.frames[k]).joints, PoseOf(whole->frames[k]).joints) << k;
  }
  EXPECT_EQ(&take.See(method), &whole) << "what was captured is kept";
}

TEST(SensedOf, TellsNobodyWhereThereIsNoSkeleton) {
  SensedFrame last;
  last[Role::kHead] = {{1, 2, 3}, TrackingState::kTracked};
  last.body_seen = true;
  const SensedFrame lost = SensedOf(std::nullopt, last);
  EXPECT_FALSE(lost.body_seen);
  EXPECT_EQ(lost[Role::kHead].state, TrackingState::kNotTracked);
  EXPECT_EQ(lost[Role::kHead].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(SensedOf(RecoveredFrame{}, last)[Role::kHead].state, TrackingState::kTracked);
}

}  // namespace
}  // namespace etude
