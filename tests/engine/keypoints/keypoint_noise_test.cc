#include "engine/keypoints/keypoint_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/cameras/triangulation.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

struct Planted {
  std::vector<ProjectionMatrix> cameras;
  MatchedPerson person;
};

/// Makes keypoints of a moving point cloud with deviation `noise_px`, twice that for wrists. A share `wrong` is 40 px
/// off, and a tenth is missing.
Planted Plant(int cameras, double noise_px, double wrong = 0) {
  Planted planted;
  constexpr std::size_t kFrames = 100;
  RandomStream dice({Seed{3}, "keypoint-noise", cameras}, "draws");
  for (int c = 0; c < cameras; ++c) {
    const double angle = -0.7 + 1.1 * c;
    const Intrinsics in{.width = 1280, .height = 960, .fx = 700, .fy = 700, .cx = 640, .cy = 480};
    planted.cameras.push_back(MatrixOf(LookAt(in, {4 * std::sin(angle), 1.5, 4 * std::cos(angle)}, {0, 1, 0})));
    planted.person.seen.emplace_back(kFrames);
  }
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const glm::dvec3 p_WQ = glm::dvec3(0, 1, 0) + 0.3 * dice.Normal3();
      const bool is_wrist = i == Index(Landmark::kLeftWrist) || i == Index(Landmark::kRightWrist);
      for (std::size_t c = 0; c < planted.cameras.size(); ++c) {
        glm::dvec2 pixel = *Project(planted.cameras[c], p_WQ) +
                           (is_wrist ? 2 : 1) * noise_px * glm::dvec2(dice.Normal(), dice.Normal());
        if (dice.Uniform() < wrong) pixel.x += 40;
        auto& seen = planted.person.seen[c][frame];
        if (!seen) seen.emplace();
        seen->keypoints[i] = {pixel, dice.Uniform() < 0.1 ? 0.0 : 0.8};
      }
    }
  }
  return planted;
}

TEST(KeypointNoise, IsThatWhichWasPlanted) {
  for (const int cameras : {2, 3, 5}) {
    for (const double noise_px : {0.5, 3.0}) {
      const Planted planted = Plant(cameras, noise_px);
      ASSERT_OK(noise, MeasureKeypointNoise(planted.cameras, planted.person, 0.1, 100));
      EXPECT_GT(noise->points, 2000u);
      EXPECT_NEAR(noise->Of(Role::kLeftKnee) / noise_px, 1, 0.3) << cameras;
      EXPECT_NEAR(noise->Of(Role::kLeftWrist) / noise_px, 2, 0.6) << cameras;
      EXPECT_NEAR(noise->all_px / noise_px, 1.05, 0.06) << cameras;
      EXPECT_EQ(noise->Of(Role::kSpine), noise->all_px) << "no landmark shows it";
    }
  }
}

TEST(KeypointNoise, IsNotThatOfOutliers) {
  const Planted planted = Plant(4, 1, 0.05);
  ASSERT_OK(noise, MeasureKeypointNoise(planted.cameras, planted.person, 0.1, 10));
  EXPECT_NEAR(noise->all_px, 1.05, 0.08);
}

TEST(KeypointNoise, IsNoneIfNoTwoCamerasSeeAPoint) {
  Planted planted = Plant(2, 1);
  for (auto& seen : planted.person.seen[1]) seen.reset();
  EXPECT_FALSE(MeasureKeypointNoise(planted.cameras, planted.person, 0.1, 100));
}

}  // namespace
}  // namespace etude
