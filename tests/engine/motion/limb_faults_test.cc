#include "engine/motion/limb_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"
#include "engine/motion/motion_faults.h"
#include "tests/engine/motion/moving_body.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(LimbFaults, OfAKneeThatBendsBackwardsHaveItsAngle) {
  // Ramps of half a second, so that no joint pops.
  const auto bent = [](double degrees) {
    return WithChange(Swaying(60), 1, 4, [degrees](BodyPose& pose, double t) {
      const double part = std::clamp(std::min(t, 3 - t) / 0.5, 0.0, 1.0);
      const glm::dvec3 thigh = glm::normalize(pose[kLeftKnee] - pose[kLeftHip]);
      const glm::dvec3 shank = pose[kLeftAnkle] - pose[kLeftKnee], toes = pose[kLeftFoot] - pose[kLeftAnkle];
      const double flexion = std::acos(std::clamp(glm::dot(thigh, glm::normalize(shank)), -1.0, 1.0));
      const glm::dquat turn = glm::angleAxis(-part * (flexion + Radians(degrees)), glm::dvec3(1, 0, 0));
      pose[kLeftAnkle] = pose[kLeftKnee] + turn * shank;
      pose[kLeftFoot] = pose[kLeftAnkle] + turn * toes;
    });
  };
  const MotionFault bends = OneFault(bent(30), FaultKind::kBends);
  EXPECT_EQ(bends.joint, kLeftKnee);
  EXPECT_NEAR(bends.size, 30, 1);
  ExpectTime(bends, 1.5, 3.5, 0.15);
  EXPECT_THAT(FaultSentences(FindMotionFaults(bent(15)).faults), IsEmpty()) << "some knees overextend";
  // Without toes, the hinge is parallel to the line of the hips.
  for (const double degrees : {15, 30}) {
    const BodyMotion motion = bent(degrees);
    FaultOptions options{.unseen = std::vector<JointSet>(motion.poses.size())};
    for (JointSet& joints : options.unseen) joints.set(Index(kLeftFoot)).set(Index(kRightFoot));
    EXPECT_EQ(FindMotionFaults(motion, options).faults.size(), degrees == 30 ? 1u : 0u) << degrees;
  }
}

/// Returns a person who lifts the left leg and bends its knee by an angle, turned outwards by another; the toes are at
/// an angle in front of the line of the shank.
BodyMotion WithLiftedLeg(double knee_deg, double outwards_deg, double toes_deg) {
  constexpr double kLift_deg = 60, kUsualToes_deg = 56;
  return WithChange(Swaying(60), 1, 5, [=](BodyPose& pose, double t) {
    const double part = std::clamp(std::min(t, 4 - t), 0.0, 1.0);
    const auto turned = [part](const glm::dvec3& v, double degrees, const glm::dvec3& axis) {
      return glm::angleAxis(part * Radians(degrees), axis) * v;
    };
    const glm::dvec3 left(1, 0, 0), thigh = turned({0, -1, 0}, -kLift_deg, left);
    const glm::dvec3 hinge = turned(left, outwards_deg, thigh), shank = turned(thigh, knee_deg, hinge);
    const double toes = kUsualToes_deg + std::pow(part, 4) * (toes_deg - kUsualToes_deg);
    pose[kLeftKnee] = pose[kLeftHip] + 0.4 * thigh;
    pose[kLeftAnkle] = pose[kLeftKnee] + 0.4 * shank;
    pose[kLeftFoot] = pose[kLeftAnkle] + 0.18 * (glm::angleAxis(-Radians(toes), hinge) * shank);
  });
}

TEST(LimbFaults, AreNoneOfABentKneeAboveAPointedFoot) {
  // A passé: the foot is pointed so far that the toes lie behind the line of the shank.
  for (const double toes : {56.0, 25.0, 0.0, -20.0, -30.0}) {
    for (const double outwards : {0.0, 45.0, 80.0}) {
      EXPECT_THAT(FaultSentences(FindMotionFaults(WithLiftedLeg(135, outwards, toes)).faults), IsEmpty())
          << toes << " " << outwards;
    }
    // The control: a knee that bends as far to the wrong side is found, whatever the foot shows.
    const auto faults = FindMotionFaults(WithLiftedLeg(-135, 0, toes)).faults;
    const auto bends = std::ranges::find(faults, FaultKind::kBends, &MotionFault::kind);
    ASSERT_NE(bends, faults.end()) << toes;
    EXPECT_NEAR(bends->size, 135, 1) << toes;
  }
}

TEST(LimbFaults, OfAFootThatPointsBackwardsNowAndThenHaveItsDistanceAndItsTime) {
  // The foot turns about the shank by 180°.
  BodyMotion motion = Swaying(30);
  double moved = 0;
  for (const double from : {1.0, 5.0}) {
    motion = WithChange(std::move(motion), from, from + 0.2, [&moved](BodyPose& pose, double) {
      const glm::dvec3 foot = pose[kLeftFoot], shank = glm::normalize(pose[kLeftAnkle] - pose[kLeftKnee]);
      pose[kLeftFoot] = pose[kLeftAnkle] + glm::angleAxis(kPi, shank) * (foot - pose[kLeftAnkle]);
      moved = std::max(moved, glm::distance(foot, pose[kLeftFoot]));
    });
  }
  const auto faults = FindMotionFaults(motion).faults;
  const auto torn = std::ranges::find(faults, FaultKind::kTorn, &MotionFault::kind);
  ASSERT_NE(torn, faults.end());
  EXPECT_EQ(torn->joint, kLeftFoot);
  EXPECT_NEAR(torn->size, moved, 1e-9);
  ExpectTime(*torn, 1, 5.2);
  EXPECT_THAT(torn->text, HasSubstr("left_foot is torn off for 0.40 s between 1.00 and 5.17 s"));
}

}  // namespace
}  // namespace etude
