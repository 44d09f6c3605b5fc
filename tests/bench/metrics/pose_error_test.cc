#include "bench/metrics/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

BodyPose SomePose() {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const double t = static_cast<double>(i);
    pose.joints[i] = {std::sin(1.3 * t), 1 + std::cos(2.1 * t), std::sin(0.7 * t + 1)};
  }
  return pose;
}

BodyPose Moved(BodyPose pose, auto move) {
  for (glm::dvec3& joint : pose.joints) joint = move(joint);
  return pose;
}

TEST(AlignSimilarity, SurvivesPointsInOnePlaceOrOnALine) {
  const BodyPose truth = SomePose();
  BodyPose point;  // all joints at the origin
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(point, truth)));
  const BodyPose line = Moved(truth, [](glm::dvec3 p) { return glm::dvec3(p.x, 0, 0); });
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(line, truth)));
  EXPECT_TRUE(std::isfinite(FramePaMpjpeMm(truth, point)));
}

}  // namespace
}  // namespace etude
