#include "engine/motion/clip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_clip.h"

namespace etude {
namespace {

TEST(SampleFrame, GivesWholeFramesAsTheyAreAndNothingBeyondTheEnds) {
  const Clip clip = testing::RandomClip(1, {.moving_offsets = true, .scales = true});
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    EXPECT_EQ(SampleFrame(clip, static_cast<double>(f)), clip.frames[f]);
  }
  EXPECT_EQ(SampleFrame(clip, -3), clip.frames.front());
  EXPECT_EQ(SampleFrame(clip, 99), clip.frames.back());
  EXPECT_NE(SampleFrame(clip, 0.5), clip.frames.front());
}

TEST(SampleFrame, TurnsAtConstantSpeedAndShiftsAndScalesStraight) {
  Clip clip = testing::RandomClip(2);
  clip.frames.resize(2);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -1));
  clip.frames[0][3] = {{1, 2, 3}, glm::angleAxis(0.2, axis), {1, 1, 1}};
  clip.frames[1][3] = {{2, 0, 3}, -glm::angleAxis(1.2, axis), {3, 1, 0.5}};  // the other sign of the same rotation
  const LocalTransform between = SampleFrame(clip, 0.25)[3];
  EXPECT_LT(glm::distance(between.translation, {1.25, 1.5, 3}), 1e-15);
  EXPECT_LT(glm::distance(between.scale, {1.5, 1, 0.875}), 1e-15);
  EXPECT_NEAR(std::abs(glm::dot(between.rotation, glm::angleAxis(0.45, axis))), 1, 1e-15);
}

}  // namespace
}  // namespace etude
