#include "bench/tasks/base/ik_targets.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"

namespace etude {
namespace {

const WorldKey kWorld{.suite_seed = 1, .scenario = "targets", .trial = 0};

std::vector<EffectorTarget> DisturbedBy(const TargetNoise& noise, std::size_t count) {
  std::vector<EffectorTarget> targets(count);
  RandomStream dice(kWorld, "noise");
  Disturb(targets, noise, dice);
  return targets;
}

TEST(Disturb, ScattersPlacesByItsStandardDeviationAlongEveryAxis) {
  constexpr std::size_t kCount = 5000;
  glm::dvec3 squares(0), sum(0);
  for (const EffectorTarget& target : DisturbedBy({.position_cm = 2}, kCount)) {
    squares += target.position * target.position;
    sum += target.position;
    EXPECT_EQ(target.axes, glm::dmat3(1));
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(squares[axis] / kCount), 0.02, 0.001);
    EXPECT_NEAR(sum[axis] / kCount, 0, 0.001);
  }
}

TEST(Disturb, TurnsAxesByItsStandardDeviationAboutEveryAxisAndKeepsThemARotation) {
  constexpr std::size_t kCount = 5000;
  double squares = 0;
  for (const EffectorTarget& target : DisturbedBy({.orientation_deg = 3}, kCount)) {
    EXPECT_EQ(target.position, glm::dvec3(0));
    EXPECT_NEAR(glm::determinant(target.axes), 1, 1e-12);
    const double cosine = (target.axes[0][0] + target.axes[1][1] + target.axes[2][2] - 1) / 2;
    squares += std::pow(Degrees(std::acos(std::min(cosine, 1.0))), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / (3 * kCount)), 3, 0.1);
}

TEST(Disturb, ScalesTheSameDice) {
  const auto weak = DisturbedBy({.position_cm = 1, .orientation_deg = 0}, 10);
  const auto strong = DisturbedBy({.position_cm = 4, .orientation_deg = 5}, 10);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(glm::distance(4.0 * weak[i].position, strong[i].position), 1e-12);
    EXPECT_NE(weak[i].axes, strong[i].axes);
  }
}

TEST(Disturb, LeavesTargetsAloneWhenThereIsNoNoise) {
  for (const EffectorTarget& target : DisturbedBy({}, 10)) {
    EXPECT_EQ(target.position, glm::dvec3(0));
    EXPECT_EQ(target.axes, glm::dmat3(1));
  }
}

}  // namespace
}  // namespace etude
