// The golden value of capture by marks that are noisy or missing: lengths, gaps, recovery. The other tests of this
// folder check that results are right.
#include <gtest/gtest.h>

#include <vector>

#include "engine/capture/calibrate_cameras.h"
#include "engine/capture/interpolate_gaps.h"
#include "engine/capture/measure_joints.h"
#include "engine/capture/recover_frames.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/engine/kinematics/rest_bodies.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Returns marks of a dance in three cameras. Their errors are up to `noise_px` per axis, in one of 30 points up to
/// 60 pixels. Some marks are missing, also for several frames; some strokes are short.
TakeMarks CarelessMarks(testing::Dice& dice, int frames, double noise_px, double pace = 0.1) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < frames; ++k) poses.push_back(ModelPose(pace * k));
  TakeMarks marks = ExactMarks(poses, ThreeCameras());
  for (auto& of_camera : marks) {
    for (int k = 0; k < frames; ++k) {
      const auto slip = [&] {
        const double px = dice.Below(30) ? noise_px : 60;
        return px * glm::dvec2(dice.Vector());
      };
      for (std::size_t i = 0; i < kStrokeCount; ++i) {
        auto& stroke = of_camera[k].strokes[i];
        stroke->a += slip(), stroke->b += slip();
        if (dice.Below(15) == 0) stroke->b = stroke->a + 4.0 * glm::dvec2(dice.Vector());
        if (dice.Below(6) == 0 || k / 4 % 7 == static_cast<int>(i % 8)) stroke.reset();
      }
      for (std::size_t i = 0; i < kEffectorCount; ++i) {
        *of_camera[k].effectors[i] += slip();
        if (dice.Below(6) == 0 || k / 3 % 6 == static_cast<int>(i)) of_camera[k].effectors[i].reset();
      }
    }
  }
  return marks;
}

void AddSeen(Fingerprint& print, const std::optional<LimbObservation>& seen) {
  print.Add(seen.has_value());
  if (!seen) return;
  print.Add(seen->ends.joints).Add(seen->directions).Add(seen->lacks_end).Add(seen->lacks_direction);
}

void AddFrame(Fingerprint& print, const std::optional<RecoveredFrame>& frame) {
  print.Add(frame.has_value());
  if (!frame) return;
  print.Add(frame->state.root_position).Add(frame->state.root_frame[0]).Add(frame->state.angles);
  print.Add(frame->fixed.joints).Add(frame->pose.joints);
  for (const EffectorError& error : frame->errors) print.Add(error.position);
}

TEST(CaptureGolden, FramesMeasuredBridgedAndRecovered) {
  testing::Dice dice(1);
  Fingerprint print;
  for (int k = 0; k < 6; ++k) {
    TakeMarks marks = CarelessMarks(dice, 13 + k, 1 + k);
    std::vector<ProjectionMatrix> cameras = ThreeCameras();
    if (k % 2) marks.pop_back(), cameras.pop_back();
    if (k % 3) marks = AgreeingMarks(cameras, marks);
    MeasureOptions measure;
    if (k > 2) measure = {.min_plane_angle = Radians(25), .min_stroke_px = 40};
    const auto frames = MeasureFrames({.cameras = cameras, .marks = marks}, measure);
    const GapOptions gaps = k % 2 ? GapOptions{.max_gap = 1, .mark_error_px = 6, .turn_per_frame = 0.2} : GapOptions();
    const auto seen = InterpolateGaps(frames, gaps);
    for (const auto& observation : seen) AddSeen(print, observation);
    AddSeen(print, ExtrapolateLast(std::span(frames).first(7), gaps));
    const CaptureBody body = k < 4 ? PaperBody({}) : FittedBody(JointedRestBody()).value();
    RecoverOptions options{.solver = FindIkSolver(k % 3 ? "damped-least-squares" : "ccd"), .ik = {}};
    if (k % 2) options.ik.max_iterations = 3;
    std::vector<bool> marked(seen.size());
    for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = k != 2 || i % 3 == 0;
    const auto found = RecoverFrames({.body = body, .seen = seen, .marked = marked}, options);
    for (const auto& frame : found) AddFrame(print, frame);
    LiveRecovery live(body, options, {.max_gap = 2});
    for (const FrameMeasurement& frame : std::span(frames).first(8)) AddFrame(print, live.Next(frame));
    if (!found[0]) continue;
    const std::vector<TreeState> known(seen.size(), found[0]->state);
    for (const auto& frame : RecoverFrames({.body = body, .seen = seen, .known_starts = known}, options))
      AddFrame(print, frame);
    for (const auto& frame : RecoverFrames({.body = body, .seen = seen, .known_poses = known}, options))
      AddFrame(print, frame);
    for (const auto& pose : ToClip(body, RepeatLastPose(found), 30, "held").frames) {
      for (const LocalTransform& joint : pose) print.Add(joint.translation).Add(joint.rotation);
    }
  }
  EXPECT_TRUE(print.Is(98055, 977.300649032));
}

TEST(CompleteJoints, MakesNothingOfNothing) { EXPECT_FALSE(CompleteJoints({}, ModelPose(2))); }

TEST(CalibrateCameras, NamesTheCameraOfTooFewPairsByEitherMethod) {
  std::vector<std::vector<PointPair>> pairs(2);
  const Camera camera = LookAt({}, {1, 1.5, 3.5}, {0, 0.9, 0});
  testing::Dice dice(6);
  for (auto& of_camera : pairs) {
    for (int i = 0; i < 12; ++i) {
      const glm::dvec3 world = glm::dvec3(0, 0.9, 0) + dice.Vector();
      of_camera.push_back({world, *Project(camera, world)});
    }
  }
  pairs[1].resize(3);
  EXPECT_EQ(CalibrateCameras(pairs).error().message,
            "camera 2: cannot calibrate a camera: found 3 point pairs; allowed: at least 6");
  EXPECT_EQ(RefineCameras(pairs, std::vector<PictureSize>(2, PictureSize{640, 480})).error().message,
            CalibrateCameras(pairs).error().message);
}

}  // namespace
}  // namespace etude
