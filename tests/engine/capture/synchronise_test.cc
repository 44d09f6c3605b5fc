#include "engine/capture/synchronise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/capture/marked_body.h"

namespace etude {
namespace {

BodyPose PoseAtTime(double frame) { return ModelPose(0.15 * frame); }

/// Returns the marks of cameras that are late by `offsets` frames.
TakeMarks LateMarks(const std::vector<ProjectionMatrix>& cameras, const std::vector<double>& offsets, int frames = 40) {
  TakeMarks marks;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::vector<Marks>& of_camera = marks.emplace_back();
    for (int k = 0; k < frames; ++k) of_camera.push_back(ExactMarks(PoseAtTime(k + offsets[i]), cameras[i]));
  }
  return marks;
}

// With exact marks the error is up to 0.04 of a frame, because the misfit is not a parabola. A search between frames
// would be better here, but would be off by half a frame with noisy marks.
TEST(Synchronise, FindsHowLateEveryCameraIs) {
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  for (const std::vector<double>& offsets :
       {std::vector<double>{0, 3.4, -7.25}, {0, 0.5, 12.75}, {0, -0.2, 0.1}, {0, 0, 0}}) {
    const std::vector<double> found = EstimateOffsets(cameras, LateMarks(cameras, offsets));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], offsets[i], 0.04) << i;
  }
}

TEST(Synchronise, FindsItWithMarksThatErrAndAreMissing) {
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  TakeMarks marks = LateMarks(cameras, {0, 2.5, -1.3}, 60);
  int mark = 0;
  for (auto& of_camera : marks) {
    for (Marks& frame : of_camera) {
      for (auto& disc : frame.effectors) {
        ++mark;
        if (disc) *disc += 3.0 * glm::dvec2(std::sin(37.0 * mark), std::cos(91.0 * mark * mark));
        if (mark % 11 == 0) disc.reset();
        if (mark % 23 == 0 && disc) *disc += glm::dvec2(80, -50);  // a mistaken mark on another limb
      }
    }
  }
  const std::vector<double> found = EstimateOffsets(cameras, marks);
  EXPECT_NEAR(found[1], 2.5, 0.15);
  EXPECT_NEAR(found[2], -1.3, 0.15);
}

TEST(Synchronise, LeavesClocksAloneThatNothingTellsOf) {
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  TakeMarks still;
  for (const ProjectionMatrix& camera : cameras) still.emplace_back(30, ExactMarks(PoseAtTime(0), camera));
  EXPECT_EQ(EstimateOffsets(cameras, still), (std::vector<double>{0, 0, 0}));
  const TakeMarks nothing(3, std::vector<Marks>(30));
  EXPECT_EQ(EstimateOffsets(cameras, nothing), (std::vector<double>{0, 0, 0}));
}

TEST(Synchronise, MarksAreThenThoseOfTheFirstCamerasTime) {
  const std::vector<ProjectionMatrix> cameras = ThreeCameras();
  const std::vector<double> offsets = {0, 3.4, -7.25};
  const TakeMarks shifted = Synchronised(LateMarks(cameras, offsets), offsets);
  for (std::size_t i = 0; i < 3; ++i) {
    const Marks truth = ExactMarks(PoseAtTime(20), cameras[i]);
    for (std::size_t e = 0; e < kEffectorCount; ++e) {
      ASSERT_TRUE(shifted[i][20].effectors[e]);
      EXPECT_LT(glm::distance(*shifted[i][20].effectors[e], *truth.effectors[e]), 0.1);
    }
  }
  EXPECT_FALSE(shifted[1][0].effectors[0]) << "3.4 frames before its first";
  EXPECT_FALSE(shifted[2][39].effectors[0]);
}

TEST(MarksAt, IsTheFrameItselfAtWholeFramesAndNothingNextToAGap) {
  std::vector<Marks> track = LateMarks({ThreeCameras()[0]}, {0}, 5)[0];
  EXPECT_EQ(MarksAt(track, 2).effectors[1], track[2].effectors[1]);
  EXPECT_TRUE(MarksAt(track, 1.5).effectors[1]);
  track[2].effectors[1].reset();
  EXPECT_FALSE(MarksAt(track, 1.5).effectors[1]);
  EXPECT_TRUE(MarksAt(track, 3.5).effectors[1]) << "straight, without its outer neighbour";
}

}  // namespace
}  // namespace etude
