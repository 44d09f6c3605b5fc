#include <gtest/gtest.h>

#include "engine/capture/calibrate_cameras.h"
#include "engine/capture/interpolate_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/recover_frames.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<BodyPose> Dance() {
  std::vector<BodyPose> poses;
  for (int k = 0; k < 6; ++k) poses.push_back(ModelPose(0.1 * k));
  return poses;
}

double MeanDistance(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (Role role : AllRoles()) sum += glm::distance(a[role], b[role]) / static_cast<double>(kRoleCount);
  return sum;
}

/// The results of every stage, one entry per frame.
struct CapturedMotion {
  std::vector<FrameMeasurement> measured;
  std::vector<std::optional<LimbObservation>> seen;
  std::vector<std::optional<RecoveredFrame>> frames;
};

/// Runs the stages in sequence, as the task `capture` does.
struct Stages {
  MeasureOptions measure;
  GapOptions gaps;
  RecoverOptions recover;

  CapturedMotion Run(const MeasureInputs& pictures, const CaptureBody& body,
                     const std::vector<bool>& marked = {}) const {
    CapturedMotion motion{.measured = MeasureFrames(pictures, measure)};
    motion.seen = InterpolateGaps(motion.measured, gaps);
    motion.frames = RecoverFrames({.body = body, .seen = motion.seen, .marked = marked}, recover);
    return motion;
  }
};

/// Calibration points and marks become a clip, by this folder's functions alone.
TEST(MarkedTake, MakesAClipOfMarkedPicturesOfTwoCamerasOrThree) {
  const std::vector<BodyPose> truth = Dance();
  for (std::size_t camera_count : {2u, 3u}) {
    std::vector<ProjectionMatrix> studio = ThreeCameras();
    studio.resize(camera_count);
    std::vector<std::vector<PointPair>> pairs(camera_count);
    for (std::size_t i = 0; i < camera_count; ++i) {
      for (Role role : AllRoles()) pairs[i].push_back({truth[0][role], *Project(studio[i], truth[0][role])});
    }
    const TakeMarks marks = ExactMarks(truth, studio);

    ASSERT_OK(cameras, CalibrateCameras(pairs));
    const CaptureBody body = PaperBody(MeasureLimbLengths(truth));
    Stages stages;
    stages.measure.min_plane_angle = Radians(1);  // exact marks need no margin
    stages.recover.solver = FindIkSolver("damped-least-squares");
    const CapturedMotion motion = stages.Run({.cameras = *cameras, .marks = marks}, body);
    ASSERT_EQ(motion.frames.size(), truth.size());
    const Clip clip = ToClip(body, RepeatLastPose(motion.frames), kJudgedRateHz, "dance");

    ASSERT_EQ(clip.frames.size(), truth.size());
    const int head = clip.skeleton.Find("Head");
    ASSERT_GE(head, 0);
    std::vector<GlobalTransform> joints;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      ASSERT_TRUE(motion.frames[k]) << k;
      EXPECT_LT(MeanDistance(motion.frames[k]->pose, truth[k]), 0.001) << k;
      ComputeGlobals(clip.skeleton, clip.frames[k], joints);
      EXPECT_LT(glm::distance(joints[head].position, truth[k][Role::kHead]), 0.001) << k;
    }
  }
}

struct Studio {
  std::vector<BodyPose> truth = Dance();
  std::vector<ProjectionMatrix> cameras = {ThreeCameras()[0], ThreeCameras()[1]};
  TakeMarks marks = ExactMarks(truth, cameras);
  std::vector<KnownMeasurement> known;
  std::vector<bool> marked;
  CaptureBody body = PaperBody({});
  Stages stages;

  Studio() { stages.recover.solver = FindIkSolver("ccd"); }
  CapturedMotion Capture() const {
    return stages.Run({.cameras = cameras, .marks = marks, .known = known}, body, marked);
  }
};

TEST(MarkedTake, HasASkeletonAsLongAsThereAreMarks) {
  Studio studio;
  studio.stages.gaps.max_gap = 2;
  studio.marked.assign(6, true);
  for (std::size_t k = 1; k < 6; ++k) {
    studio.marks[0][k].effectors[0].reset();
    studio.marked[k] = false;
  }
  const CapturedMotion motion = studio.Capture();
  ASSERT_EQ(motion.frames.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    ASSERT_TRUE(motion.frames[k]) << k;
    EXPECT_EQ(motion.seen[k]->lacks_end[Index(EffectorMarks()[0].role)], k > 2) << k;
    EXPECT_LT(MeanDistance(motion.frames[k]->pose, studio.truth[k]), 0.05) << k;
  }
  for (std::vector<Marks>& of_camera : studio.marks) of_camera.assign(6, Marks{});
  const CapturedMotion nothing = studio.Capture();
  ASSERT_EQ(nothing.frames.size(), 6u);
  for (const auto& frame : nothing.frames) EXPECT_FALSE(frame);
}

TEST(MarkedTake, NeedsNoMarksWhereMeasurementsAreKnown) {
  Studio studio;
  studio.stages.measure.min_plane_angle = Radians(1);  // exact marks need no margin, so all limbs are measured
  const std::vector<FrameMeasurement> measured = studio.Capture().measured;
  const BodyPose head_to_toe = studio.Capture().frames[3]->pose;
  for (std::vector<Marks>& of_camera : studio.marks) of_camera.assign(6, Marks{});
  for (const FrameMeasurement& frame : measured) studio.known.push_back({frame.ends, frame.directions});
  EXPECT_EQ(studio.Capture().frames[3]->pose.joints, head_to_toe.joints);
}

/// Inputs that do not fit together are a caller's bug, at which builds with assertions stop.
TEST(MarkedTakeDeathTest, StopsAtInputsThatDoNotFitTogether) {
  const auto capture = [](auto spoil) {
    Studio studio;
    spoil(studio);
    return studio.Capture().frames.size();
  };
  EXPECT_EQ(capture([](Studio&) {}), 6u);
#ifdef NDEBUG
  GTEST_SKIP() << "this build has no assertions";
#else
  EXPECT_DEATH(capture([](Studio& s) { s.cameras.resize(1); }), "cameras.size\\(\\) >= 2");
  EXPECT_DEATH(capture([](Studio& s) { s.marks.pop_back(); }), "marks.size\\(\\) == inputs.cameras.size\\(\\)");
  EXPECT_DEATH(capture([](Studio& s) { s.marks[1].pop_back(); }), "of_camera.size\\(\\) == count");
  EXPECT_DEATH(capture([](Studio& s) { s.known.resize(2); }), "known.size\\(\\) == count");
  EXPECT_DEATH(capture([](Studio& s) { s.marked.resize(7); }), "fits\\(inputs.marked.size\\(\\)\\)");
  EXPECT_DEATH(capture([](Studio& s) { s.body.lengths.neck = 0; }), "IsValid\\(body.lengths\\)");
  EXPECT_DEATH(capture([](Studio& s) { s.stages.recover.solver = nullptr; }), "solver != nullptr");
#endif
}

}  // namespace
}  // namespace etude
