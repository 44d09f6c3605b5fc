#include "engine/motion/pendulum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/engine/motion/standing_body.h"

namespace etude {
namespace {

constexpr double kRate = 30, kG = 9.81;

template <typename Place>
std::vector<glm::dvec3> Centres(int frames, Place place) {
  std::vector<glm::dvec3> centres;
  for (int f = 0; f < frames; ++f) centres.push_back(place(f / kRate));
  return centres;
}

TEST(AccelerationAt, IsExactForAParabolaUpToBothEnds) {
  const glm::dvec3 acceleration(1, -9.81, 2);
  const auto centres = Centres(20, [&](double t) { return glm::dvec3(1, 2, 3) * t + 0.5 * t * t * acceleration; });
  for (int f = 0; f < 20; ++f) EXPECT_NEAR(glm::distance(AccelerationAt(centres, f, kRate), acceleration), 0, 1e-10);
  EXPECT_EQ(AccelerationAt(std::span(centres).first(6), 3, kRate), glm::dvec3(0)) << "seven frames are needed";
}

TEST(ZeroMomentPoint, IsWhereAPendulumStands) {
  // x − p = x₀ cosh(ωt) with ω² = g/h solves the linear inverted pendulum about p.
  constexpr double kHeight = 0.9, kStart = 0.05;
  const glm::dvec2 pivot(0.3, -0.2);
  const double omega = std::sqrt(kG / kHeight);
  const auto centres = Centres(12, [&](double t) {
    const double away = kStart * std::cosh(omega * t);
    return glm::dvec3(pivot.x + away, 1 + kHeight, pivot.y - 2 * away);
  });
  // A second difference over a tenth of a second exceeds ω² by the factor 2 (cosh(ω/10) − 1)·100/ω².
  const double factor = 200 * (std::cosh(omega / 10) - 1) / (omega * omega);
  for (int f = 3; f < 9; ++f) {
    const glm::dvec2 away = glm::dvec2(centres[f].x, centres[f].z) - pivot;
    const glm::dvec2 point = ZeroMomentPoint(centres, f, kRate, 1);
    EXPECT_NEAR(glm::distance(point, pivot - (factor - 1) * away), 0, 1e-12) << f;
    EXPECT_LT(glm::distance(point, pivot), 0.01 * glm::length(away)) << f;
  }
}

TEST(ZeroMomentOffset, LiesAheadOfABodyThatBrakes) {
  // The centre of mass is 1 m above the supporting foot and brakes at 3 m/s², so the zero-moment point is 3/9.81 m in
  // front of the foot.
  const BodyPose pose = Standing();
  const glm::dvec3 foot = pose[Role::kLeftFoot];
  const auto centres = Centres(9, [&](double t) {
    const double since = t - 4 / kRate;
    return glm::dvec3(foot.x, foot.y + 1, foot.z + 2 * since - 1.5 * since * since);
  });
  JointSet bears;
  EXPECT_FALSE(ZeroMomentOffset(centres, 4, kRate, pose, bears)) << "nothing bears it";
  bears.set(Index(Role::kLeftFoot));
  EXPECT_NEAR(*ZeroMomentOffset(centres, 4, kRate, pose, bears), 3 / kG, 1e-12);
  const auto still = Centres(9, [&](double) { return foot + glm::dvec3(0, 1, 0); });
  EXPECT_NEAR(*ZeroMomentOffset(still, 4, kRate, pose, bears), 0, 1e-12);
}

}  // namespace
}  // namespace etude
