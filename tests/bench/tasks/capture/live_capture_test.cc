#include "bench/tasks/capture/live_capture.h"

#include <gtest/gtest.h>

#include "bench/tasks/capture/run.h"
#include "io/clips/clip_library.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

const WorldKey kLiveKey{.suite_seed = 5, .scenario = "live-capture-test", .trial = 0};

using Told = std::vector<std::optional<BodyPose>>;

std::vector<BodyPose> Boxing(std::size_t frames) {
  std::vector<BodyPose> poses = LoadClips({"builtin:boxing"}, {})->clips[0].motion.poses;
  poses.resize(frames);
  return poses;
}

FilmedPerson BookingOf(const std::vector<BodyPose>& motion) {
  const std::span<const BodyPose> first(motion.data(), 1);
  return {.poses = first, .body = RestBodyOf(first), .lengths = MeasureLimbLengths(first), .frames = motion.size()};
}

Told PosesOf(const std::vector<std::optional<RecoveredFrame>>& frames) {
  Told poses;
  for (const auto& frame : frames) poses.push_back(frame ? std::optional(frame->pose) : std::nullopt);
  return poses;
}

Told Whole(const StudioOptions& options, const CaptureMethod& method, const std::vector<BodyPose>& motion) {
  CaptureWorld world = MakeStudio(options, BookingOf(motion), kLiveKey);
  world.truth = motion;
  const std::vector<PersonSource> sources = {PersonSourceOf(method)};
  CaptureStages stages(options, std::move(world), kLiveKey, sources, false);
  const auto run = RunCapture(stages, method);
  EXPECT_TRUE(run) << ToString(run.error());
  return PosesOf(run->frames);
}

/// Captures frame by frame: requests each frame as soon as the two poses after it have been added.
Told Live(const StudioOptions& options, const CaptureMethod& method, const std::vector<BodyPose>& motion) {
  auto live = LiveCapture::Begin(options, method, BookingOf(motion), kLiveKey);
  EXPECT_TRUE(live) << ToString(live.error());
  std::vector<std::optional<RecoveredFrame>> frames;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    (*live)->Add(motion[k]);
    if (k >= 2) frames.push_back((*live)->Next());
  }
  return PosesOf(frames);
}

std::size_t CountEqual(const Told& a, const Told& b) {
  std::size_t equal = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    equal += a[k].has_value() == b[k].has_value() && (!a[k] || a[k]->joints == b[k]->joints);
  }
  return equal;
}

CaptureMethod Causal(Recovery recovery) {
  CaptureMethod method{.recovery = recovery, .causal = true};
  method.start = SilhouetteStart::kNear;
  return method;
}

TEST(LiveCapture, GivesFrameByFrameWhatTheWholeTakeGives) {
  const std::vector<BodyPose> motion = Boxing(9);
  for (const int every : {1, 2}) {
    const StudioOptions options{.picture_every = every};
    for (const Recovery recovery : {Recovery::kIk, Recovery::kSilhouettes}) {
      const Told live = Live(options, Causal(recovery), motion), whole = Whole(options, Causal(recovery), motion);
      ASSERT_EQ(live.size(), 7u);
      EXPECT_TRUE(live[6]);
      EXPECT_EQ(CountEqual(live, whole), 7u) << every;
      if (every == 2) {
        EXPECT_EQ(live[5]->joints, live[4]->joints) << "between pictures the last skeleton stands";
      }
    }
  }
}

TEST(LiveCapture, IsNotChangedByWhatFollowsAsMethodsAreThatLookAhead) {
  constexpr std::size_t kSame = 6;
  const std::vector<BodyPose> motion = Boxing(9);
  std::vector<BodyPose> other = motion;
  for (std::size_t k = kSame; k < other.size(); ++k) {
    for (glm::dvec3& joint : other[k].joints) joint.x += 0.2;
  }
  const StudioOptions options{.mark_every = 4};
  for (const Recovery recovery : {Recovery::kIk, Recovery::kSilhouettes}) {
    CaptureMethod method = Causal(recovery);
    const Told whole = Whole(options, method, motion), changed = Whole(options, method, other);
    EXPECT_GE(CountEqual(whole, changed), kSame);
    EXPECT_LT(CountEqual(whole, changed), motion.size());
    method.causal = false;
    EXPECT_LT(CountEqual(Whole(options, method, motion), Whole(options, method, other)), kSame) << "the control";
  }
}

}  // namespace
}  // namespace etude
