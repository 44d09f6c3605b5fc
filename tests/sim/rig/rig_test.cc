#include "sim/rig/rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/scene.h"

namespace etude {
namespace {

using ::testing::Each;

WorldKey Trial(int trial) { return {.suite_seed = 5, .scenario = "rig-test", .trial = trial}; }

std::vector<BodyPose> Walk(const glm::dvec3& from, const glm::dvec3& to) {
  std::vector<BodyPose> motion;
  for (int i = 0; i <= 20; ++i) {
    motion.push_back(StandingPose());
    for (glm::dvec3& joint : motion.back().joints) joint += glm::mix(from, to, i / 20.0);
  }
  return motion;
}

double AngleOf(const Camera& camera, const glm::dvec3& middle) {
  const glm::dvec3 from = camera.p_WC - middle;
  return Degrees(std::atan2(from.x, from.z));
}

double DistanceOf(const Camera& camera, const glm::dvec3& middle) {
  const glm::dvec3 from = camera.p_WC - middle;
  return std::hypot(from.x, from.z);
}

TEST(SetUpCameras, PutsThemWhereTheRigSaysUpToAnUnsteadyHand) {
  const std::vector<BodyPose> still = Walk({0, 0, 0}, {0, 0, 0});
  const glm::dvec3 middle = MiddleOnFloor(still);
  double sum = 0, squares = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<Camera> cameras = SetUpCameras({}, still, Trial(trial));
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_NEAR(AngleOf(cameras[0], middle), -40, 9);
    EXPECT_NEAR(DistanceOf(cameras[1], middle), 3.8, 0.25);
    EXPECT_NEAR(cameras[0].p_WC.y, 1.0, 0.15);
    EXPECT_NEAR(cameras[1].p_WC.y, 2.2, 0.15);
    const double error = AngleOf(cameras[1], middle) - 40;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kTrials, 0, 4 * 2 / std::sqrt(kTrials)) << "two degrees a camera";
  EXPECT_NEAR(std::sqrt(squares / kTrials), 2, 0.3);
}

TEST(SetUpCameras, KnowsAPairARingAndFourCorners) {
  const std::vector<BodyPose> still = Walk({0, 0, 0}, {0, 0, 0});
  const glm::dvec3 middle = MiddleOnFloor(still);
  const auto pair = SetUpCameras({.shape = RigShape::kStereo, .baseline_m = 0.6}, still, Trial(0));
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_NEAR(glm::distance(pair[0].p_WC, pair[1].p_WC), 0.6, 0.45);
  EXPECT_LT(Degrees(std::acos(glm::dot(glm::row(pair[0].R_CW, 2), glm::row(pair[1].R_CW, 2)))), 8) << "nearly parallel";

  const auto ring = SetUpCameras({.shape = RigShape::kRing, .distance_m = 2, .cameras = 8}, still, Trial(0));
  ASSERT_EQ(ring.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    const double off = AngleOf(ring[static_cast<std::size_t>(i)], middle) - 45 * i;
    EXPECT_NEAR(std::remainder(off, 360), 0, 9) << i;
  }
  const auto corners = SetUpCameras({.shape = RigShape::kCorners}, still, Trial(0));
  ASSERT_EQ(corners.size(), 4u);
  for (const Camera& camera : corners) EXPECT_NEAR(std::remainder(AngleOf(camera, middle) - 45, 90), 0, 9);
}

TEST(SetUpCameras, NeverPutsOneInTheWall) {
  for (int trial = 0; trial < 50; ++trial) {
    for (const double z : {-2.0, 0.0, 2.0}) {
      const auto motion = Walk({0, 0, z}, {0.5, 0, z});
      for (const Camera& camera : SetUpCameras({.shape = RigShape::kRing, .cameras = 8}, motion, Trial(trial))) {
        EXPECT_GT(camera.p_WC.z, kWallZ);
      }
    }
  }
}

/// Returns true if every joint of every frame projects into the picture.
bool HoldsAll(const Camera& camera, const std::vector<BodyPose>& motion) {
  return std::ranges::all_of(motion, [&](const BodyPose& pose) { return IsInPicture(camera, pose); });
}

TEST(SetUpCameras, FollowsWhoWalksAway) {
  const auto walk = Walk({1.5, 0, 2}, {4.5, 0, 3});
  int lost_without = 0;
  for (int trial = 0; trial < 20; ++trial) {
    for (const Camera& camera : SetUpCameras({}, walk, Trial(trial))) {
      EXPECT_TRUE(HoldsAll(camera, walk));
      EXPECT_LT(camera.intrinsics.fx, Intrinsics{}.fx);
      EXPECT_GE(camera.intrinsics.fx, Intrinsics{}.fx / 2);
    }
    // The control: cameras set up for a person who stays lose this performer.
    for (const Camera& camera : SetUpCameras({}, Walk({0, 0, 0}, {0, 0, 0}), Trial(trial))) {
      EXPECT_EQ(camera.intrinsics.fx, Intrinsics{}.fx) << "nothing asks for a wider lens";
      lost_without += !HoldsAll(camera, walk);
    }
  }
  EXPECT_EQ(lost_without, 40);
}

TEST(FramesInView, NeedsTheWholeBodyInTwoPictures) {
  const auto long_walk = Walk({-9, 0, 0}, {9, 0, 0});
  const std::vector<Camera> cameras = SetUpCameras({}, long_walk, Trial(0));
  const std::vector<bool> in_view = FramesInView(cameras, long_walk);
  EXPECT_FALSE(in_view.front());
  EXPECT_FALSE(in_view.back());
  EXPECT_TRUE(in_view[in_view.size() / 2]);
  EXPECT_THAT(FramesInView(std::vector<Camera>(1, cameras[0]), long_walk), Each(false)) << "one is not enough";
  BodyPose reaching = long_walk[10];
  ASSERT_TRUE(IsInPicture(cameras[0], reaching));
  reaching[Role::kLeftHand].y += 5;
  EXPECT_FALSE(IsInPicture(cameras[0], reaching)) << "one hand above the picture";
}

TEST(SetUpCameras, MovesAnOwnRigAlongTheFloorAsAWholeAndLeavesItAsItIs) {
  // Three cameras whose axes meet at (7, 1.1, −3).
  const glm::dvec3 middle(7, 1.1, -3);
  RigOptions options{.shape = RigShape::kFile};
  for (const glm::dvec3& from : {glm::dvec3(3, 1, 0), glm::dvec3(-2, 2, 2.5), glm::dvec3(0, 0.5, 4)}) {
    options.own.push_back(LookAt({.width = 320, .height = 200, .fx = 300, .fy = 310}, middle + from, middle));
  }
  options.own[1].distortion.k1 = -0.1;
  const std::vector<BodyPose> motion = Walk({-1, 0, 2}, {1, 0, 2});
  const glm::dvec3 wanted = MiddleOnFloor(motion);
  const std::vector<Camera> cameras = SetUpCameras(options, motion, Trial(0));
  ASSERT_EQ(cameras.size(), 3u);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const glm::dvec3 way = cameras[i].p_WC - options.own[i].p_WC;
    EXPECT_NEAR(way.x, wanted.x - middle.x, 0.01);
    EXPECT_EQ(way.y, 0) << "the floor stays where it is";
    EXPECT_NEAR(way.z, wanted.z - middle.z, 0.01);
    EXPECT_EQ(cameras[i].R_CW, options.own[i].R_CW);
    EXPECT_EQ(cameras[i].intrinsics.fy, 310);
    EXPECT_EQ(cameras[i].distortion, options.own[i].distortion);
    EXPECT_NEAR(glm::distance(cameras[i].p_WC, cameras[0].p_WC),
                glm::distance(options.own[i].p_WC, options.own[0].p_WC), 1e-12);
  }
}

TEST(SetUpCameras, FindsAPlaceBeforeAnOwnRigWhoseAxesNeverMeet) {
  const Camera left = LookAt({}, {-0.3, 1, 10}, {-0.3, 1, 0}), right = LookAt({}, {0.3, 1, 10}, {0.3, 1, 0});
  const std::vector<BodyPose> still = Walk({0, 0, 0}, {0, 0, 0});
  for (const Camera& camera : SetUpCameras({.shape = RigShape::kFile, .own = {left, right}}, still, Trial(0))) {
    EXPECT_NEAR(DistanceOf(camera, MiddleOnFloor(still)), std::hypot(3, 0.3), 0.02);
    EXPECT_TRUE(std::ranges::all_of(FramesInView(std::vector{camera, camera}, still), [](bool seen) { return seen; }));
  }
}

}  // namespace
}  // namespace etude
