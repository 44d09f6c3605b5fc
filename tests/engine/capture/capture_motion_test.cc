#include "engine/capture/capture_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/capture/calibrate_cameras.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/support/gtest_printers.h"

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

/// From calibration points and marks to a clip, as a program does it that links this folder alone.
TEST(CaptureMotion, MakesAClipOfMarkedPicturesOfTwoCamerasOrThree) {
  const std::vector<BodyPose> truth = Dance();
  for (std::size_t camera_count : {2u, 3u}) {
    std::vector<ProjectionMatrix> studio = ThreeCameras();
    studio.resize(camera_count);
    std::vector<std::vector<PointPair>> pairs(camera_count);
    for (std::size_t i = 0; i < camera_count; ++i) {
      for (Role role : AllRoles()) pairs[i].push_back({truth[0][role], *Project(studio[i], truth[0][role])});
    }
    const TakeMarks marks = ExactMarks(truth, studio);

    const auto cameras = CalibrateCameras(pairs);
    ASSERT_TRUE(cameras) << ToString(cameras.error());
    const CaptureInputs inputs{.pictures = {.cameras = *cameras, .marks = marks},
                               .body = PaperBody(MeasureLimbLengths(truth))};
    CaptureOptions options;
    options.measure.smallest_plane_angle = Radians(1);  // exact marks need no margin
    options.recover.solver = FindIkSolver("damped-least-squares");
    const auto motion = CaptureMotion(inputs, options);
    ASSERT_TRUE(motion) << ToString(motion.error());
    const Clip clip = ToClip(inputs.body, HoldFrames(motion->frames), kJudgedRateHz, "dance");

    ASSERT_EQ(clip.frames.size(), truth.size());
    const int head = clip.skeleton.Find("Head");
    ASSERT_GE(head, 0);
    std::vector<GlobalTransform> joints;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      ASSERT_TRUE(motion->frames[k]) << k;
      EXPECT_LT(MeanDistance(motion->frames[k]->pose, truth[k]), 0.001) << k;
      ComputeGlobals(clip.skeleton, clip.frames[k], joints);
      EXPECT_LT(glm::distance(joints[head].position, truth[k][Role::kHead]), 0.001) << k;
    }
  }
}

/// Two cameras, exact marks, and what else it takes.
struct Studio {
  std::vector<BodyPose> truth = Dance();
  std::vector<ProjectionMatrix> cameras = {ThreeCameras()[0], ThreeCameras()[1]};
  TakeMarks marks = ExactMarks(truth, cameras);
  std::vector<KnownMeasurement> known;
  std::vector<bool> marked;
  CaptureBody body = PaperBody({});
  CaptureOptions options;

  Studio() { options.recover.solver = FindIkSolver("ccd"); }
  Result<CapturedMotion> Capture() const {
    const MeasureInputs pictures{.cameras = cameras, .marks = marks, .known = known};
    return CaptureMotion({.pictures = pictures, .body = body, .marked = marked}, options);
  }
};

TEST(CaptureMotion, HasASkeletonAsLongAsThereAreMarks) {
  Studio studio;
  studio.options.bridge.longest_gap = 2;
  studio.marked.assign(6, true);
  for (std::size_t k = 1; k < 6; ++k) {
    studio.marks[0][k].effectors[0].reset();
    studio.marked[k] = false;
  }
  const auto motion = studio.Capture();
  ASSERT_TRUE(motion) << ToString(motion.error());
  for (std::size_t k = 0; k < 6; ++k) {
    ASSERT_TRUE(motion->frames[k]) << k;
    EXPECT_EQ(motion->seen[k]->lacks_end[Index(EffectorMarks()[0].role)], k > 2) << k;
    EXPECT_LT(MeanDistance(motion->frames[k]->pose, studio.truth[k]), 0.05) << k;
  }
  for (std::vector<Marks>& of_camera : studio.marks) of_camera.assign(6, Marks{});
  const auto nothing = studio.Capture();
  ASSERT_TRUE(nothing) << ToString(nothing.error());
  for (const auto& frame : nothing->frames) EXPECT_FALSE(frame);
}

TEST(CaptureMotion, NeedsNoMarksWhereMeasurementsAreKnown) {
  Studio studio;
  studio.options.measure.smallest_plane_angle = Radians(1);  // exact marks need no margin: all limbs are measured
  const std::vector<FrameMeasurement> measured = studio.Capture()->measured;
  const BodyPose head_to_toe = studio.Capture()->frames[3]->pose;
  for (std::vector<Marks>& of_camera : studio.marks) of_camera.assign(6, Marks{});
  for (const FrameMeasurement& frame : measured) studio.known.push_back({frame.ends, frame.directions});
  EXPECT_EQ(studio.Capture()->frames[3]->pose.joints, head_to_toe.joints);
}

TEST(CaptureMotion, RefusesInputsThatDoNotFitTogether) {
  const auto complaint = [](auto spoil) {
    Studio studio;
    spoil(studio);
    const auto motion = studio.Capture();
    return motion ? std::string("none") : motion.error().message;
  };
  EXPECT_EQ(complaint([](Studio&) {}), "none");
  EXPECT_EQ(complaint([](Studio& s) { s.cameras.resize(1); }), "1 cameras; at least 2 are needed");
  EXPECT_EQ(complaint([](Studio& s) { s.marks.pop_back(); }), "marks of 1 cameras, and matrices of 2");
  EXPECT_EQ(complaint([](Studio& s) { s.marks[1].pop_back(); }), "camera 2 has marks of 5 frames, camera 1 of 6");
  EXPECT_EQ(complaint([](Studio& s) { s.known.resize(2); }), "known measurements of 2 frames, and marks of 6");
  EXPECT_EQ(complaint([](Studio& s) { s.marked.resize(7); }), "'marked' tells of 7 frames, and there are marks of 6");
  EXPECT_EQ(complaint([](Studio& s) { s.body.lengths.neck = 0; }), "a limb length that is not positive");
  EXPECT_EQ(complaint([](Studio& s) { s.options.recover.solver = nullptr; }), "no solver is given");
}

}  // namespace
}  // namespace etude
