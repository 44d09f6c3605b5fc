#include "engine/capture/live_recovery.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/capture/marked_body.h"

namespace etude {
namespace {

constexpr int kFrames = 12;

std::vector<FrameMeasurement> Measured(double phase_step, const std::vector<int>& unmarked) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < kFrames; ++k) poses.push_back(ModelPose(phase_step * k));
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  TakeMarks marks = ExactMarks(poses, cameras);
  for (auto& of_camera : marks) {
    for (const int k : unmarked) of_camera[static_cast<std::size_t>(k)] = {};
  }
  MeasureOptions options;
  options.smallest_plane_angle = Radians(0.1);  // exact marks need no margin
  return MeasureFrames({.cameras = cameras, .marks = marks}, options);
}

RecoverOptions Options() { return {.solver = FindIkSolver("ccd"), .ik = {}}; }

std::vector<std::optional<RecoveredFrame>> Live(const CaptureBody& body,
                                                const std::vector<FrameMeasurement>& measured) {
  LiveRecovery live(body, Options(), {});
  std::vector<std::optional<RecoveredFrame>> frames;
  for (const FrameMeasurement& frame : measured) frames.push_back(live.Next(frame));
  return frames;
}

std::vector<std::optional<RecoveredFrame>> Whole(const CaptureBody& body,
                                                 const std::vector<FrameMeasurement>& measured) {
  const auto seen = BridgeGaps(measured);
  return RecoverFrames({.body = body, .seen = seen}, Options());
}

TEST(LiveRecovery, GivesWhatTheWholeTakeGivesWhereEveryFrameShowsEverything) {
  const CaptureBody body = PaperBody({});
  const auto measured = Measured(0.1, {});
  const auto live = Live(body, measured), whole = Whole(body, measured);
  for (int k = 0; k < kFrames; ++k) EXPECT_EQ(live[k]->pose.joints, whole[k]->pose.joints) << k;
}

TEST(LiveRecovery, IsNotChangedByLaterFramesAsTheWholeTakeIs) {
  const CaptureBody body = PaperBody({});
  auto measured = Measured(0.1, {5, 6}), other = measured;
  const auto later = Measured(0.3, {});
  for (int k = 7; k < kFrames; ++k) other[k] = later[k];
  const auto live = Live(body, measured), live_other = Live(body, other);
  for (int k = 0; k < 7; ++k) EXPECT_EQ(live[k]->pose.joints, live_other[k]->pose.joints) << k;
  EXPECT_NE(live[8]->pose.joints, live_other[8]->pose.joints);
  const auto whole = Whole(body, measured), whole_other = Whole(body, other);
  EXPECT_NE(whole[5]->pose.joints, whole_other[5]->pose.joints) << "the control: it looks ahead";
}

TEST(BridgeLast, IsWhatGapsAreBridgedWithWhenNothingFollowsHoweverFewFramesAreKept) {
  auto measured = Measured(0.1, {3, 4, 9, 10, 11});
  const BridgeOptions options{.longest_gap = 3};
  for (std::size_t count = 1; count <= measured.size(); ++count) {
    const std::span<const FrameMeasurement> first(measured.data(), count);
    const auto last = BridgeLast(first, options), whole = BridgeGaps(first, options).back();
    const auto kept = BridgeLast(first.last(std::min<std::size_t>(count, 4)), options);
    ASSERT_EQ(last.has_value(), whole.has_value());
    if (!last) continue;
    EXPECT_EQ(last->ends.joints, whole->ends.joints) << count;
    EXPECT_EQ(last->ends.joints, kept->ends.joints) << count;
    EXPECT_EQ(last->directions, whole->directions) << count;
  }
}

}  // namespace
}  // namespace etude
