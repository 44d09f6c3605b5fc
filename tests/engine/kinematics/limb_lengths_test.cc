#include "engine/kinematics/limb_lengths.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/base/directions.h"
#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/observed_tree.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

void ExpectLengths(const BodyPose& pose, const LimbLengths& lengths) {
  const LimbLengths found = MeasureLimbLengths(std::span(&pose, 1));
  EXPECT_NEAR(found.foot, lengths.foot, 1e-12);
  EXPECT_NEAR(found.shank, lengths.shank, 1e-12);
  EXPECT_NEAR(found.thigh, lengths.thigh, 1e-12);
  EXPECT_NEAR(found.hip_width, lengths.hip_width, 1e-12);
  EXPECT_NEAR(found.trunk, lengths.trunk, 1e-12);
  EXPECT_NEAR(found.neck, lengths.neck, 1e-12);
  EXPECT_NEAR(found.shoulder_width, lengths.shoulder_width, 1e-12);
  EXPECT_NEAR(found.upper_arm, lengths.upper_arm, 1e-12);
  EXPECT_NEAR(found.forearm, lengths.forearm, 1e-12);
  EXPECT_NEAR(found.hand, lengths.hand, 1e-12);
}

constexpr LimbLengths kChild{0.12, 0.30, 0.31, 0.14, 0.38, 0.20, 0.28, 0.20, 0.17, 0.12};

TEST(LimbLengths, OfATreeComeBackByMeasuring) {
  ExpectLengths(ToBodyPose(MakeBodyTree(kChild), RandomPose(MakeBodyTree(kChild), 0, 1.0)), kChild);
}

TEST(LimbLengths, FixingFindsEveryJointOfAConsistentObservation) {
  const KinematicTree tree = MakeBodyTree(kChild);
  for (int trial = 0; trial < 20; ++trial) {
    const BodyPose truth = ToBodyPose(tree, RandomPose(tree, trial, 1.0));
    ASSERT_OK(fixed, FixLimbLengths(Observe(truth), kChild));
    EXPECT_LT(WorstJointDistance(*fixed, truth), 1e-12);
  }
}

TEST(LimbLengths, StrokesMayHaveAnyLength) {
  const BodyPose truth = ToBodyPose(MakeBodyTree({}), RandomPose(MakeBodyTree({}), 0, 1.0));
  LimbObservation observation = Observe(truth);
  for (glm::dvec3& direction : observation.directions) direction *= 37.0;
  EXPECT_LT(WorstJointDistance(*FixLimbLengths(observation, {}), truth), 1e-12);
}

TEST(LimbLengths, AreRightAfterFixingADisturbedObservation) {
  for (int trial = 0; trial < 20; ++trial) {
    const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), trial, 0.8));
    const LimbObservation observation = Disturb(Observe(truth), trial, 0.02, 5);
    ASSERT_OK(fixed, FixLimbLengths(observation, {}));
    ExpectLengths(*fixed, {});
    EXPECT_EQ((*fixed)[kLeftFoot], observation.ends[kLeftFoot]) << "the root stays where it was seen";
    EXPECT_GT(glm::distance((*fixed)[kHead], observation.ends[kHead]), 1e-4) << "other ends move";
    const glm::dvec3 trunk = (*fixed)[kShoulderCentre] - (*fixed)[kHipCentre];
    EXPECT_NEAR(glm::dot(trunk, (*fixed)[kRightShoulder] - (*fixed)[kLeftShoulder]), 0, 1e-12) << "trunk ⟂ shoulders";
  }
}

TEST(LimbLengths, FixingKeepsTheSeenDirectionsOfArmsAndLegs) {
  const LimbObservation seen = Disturb(Observe(ToBodyPose(Body(), RandomPose(Body(), 1, 0.8))), 1, 0.02, 5);
  const BodyPose fixed = *FixLimbLengths(seen, {});
  for (Role limb : ObservedLimbs()) {
    const glm::dvec3 direction = fixed[limb] - fixed[*ParentOf(limb)];
    EXPECT_LT(AngleBetween(direction, seen.directions[Index(limb)]), 1e-7) << RoleName(limb);
  }
}

TEST(LimbLengths, UnusableObservationsGiveNothing) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const LimbObservation sound = Observe(ToBodyPose(Body(), RandomPose(Body(), 0, 0.5)));
  ASSERT_TRUE(FixLimbLengths(sound, {}));
  LimbObservation lost_hand = sound;
  lost_hand.ends[kLeftHand].x = kNaN;
  EXPECT_FALSE(FixLimbLengths(lost_hand, {}));
  LimbObservation no_stroke = sound;
  no_stroke.directions[Index(kRightKnee)] = glm::dvec3(0);
  EXPECT_FALSE(FixLimbLengths(no_stroke, {}));
  EXPECT_FALSE(FixLimbLengths(sound, LimbLengths{.thigh = 0}));
}

LimbObservation Without(LimbObservation seen, const std::vector<Role>& ends, const std::vector<Role>& limbs = {}) {
  for (Role end : ends) {
    seen.ends[end] = glm::dvec3(1e3);
    seen.lacks_end[Index(end)] = true;
  }
  for (Role limb : limbs) {
    seen.directions[Index(limb)] = glm::dvec3(0);
    seen.lacks_direction[Index(limb)] = true;
  }
  return seen;
}

const std::vector<std::vector<Role>> kEndsLost = {{kLeftFoot},
                                                  {kRightFoot},
                                                  {kLeftHand},
                                                  {kHead},
                                                  {kLeftFoot, kRightFoot},
                                                  {kLeftHand, kRightHand},
                                                  {kLeftHand, kRightHand, kHead},
                                                  {kLeftFoot, kRightFoot, kRightHand},
                                                  {kLeftFoot, kRightFoot, kLeftHand, kRightHand},
                                                  {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead}};

// The missing ends are completed from the very pose that was observed, so nothing is lost.
TEST(CompleteObservation, GivesThePoseBackThatItIsLike) {
  for (int trial = 0; trial < 10; ++trial) {
    const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), trial, 0.8));
    for (const auto& lost : kEndsLost) {
      ASSERT_OK(whole, CompleteObservation(Without(Observe(truth), lost), {}, truth, true));
      ASSERT_OK(fixed, FixLimbLengths(*whole, {}));
      EXPECT_LT(WorstJointDistance(*fixed, truth), 1e-9) << "without " << lost.size() << " ends";
      for (Role end : lost) EXPECT_TRUE(whole->lacks_end[Index(end)]) << "still no target";
    }
  }
}

// The body moved as a whole: unseen ends move with the seen ones.
TEST(CompleteObservation, MovesWhatWasNotSeenWithWhatWas) {
  const BodyPose like = ToBodyPose(Body(), RandomPose(Body(), 1, 0.8));
  BodyPose moved = like;
  for (glm::dvec3& joint : moved.joints) joint += glm::dvec3(0.5, 0.1, -0.3);
  for (const auto& lost : kEndsLost) {
    if (lost.size() == 5) continue;  // nothing shows the move
    const auto whole = CompleteObservation(Without(Observe(moved), lost), {}, like, true);
    EXPECT_LT(WorstJointDistance(*FixLimbLengths(*whole, {}), moved), 1e-9) << "without " << lost.size() << " ends";
  }
}

TEST(CompleteObservation, TurnsALimbWithTheOneItHangsFrom) {
  const BodyPose like = ToBodyPose(Body(), RandomPose(Body(), 2, 0.8));
  const LimbObservation before = Observe(like);
  LimbObservation seen = before;
  // The upper arm swings by 40° about an axis normal to it.
  const glm::dvec3 upper = before.directions[Index(kLeftElbow)];
  const glm::dvec3 axis = glm::normalize(glm::cross(upper, glm::dvec3(0.3, 0.5, 0.2)));
  const glm::dmat3 turn = AxisRotation(axis, Radians(40));
  seen.directions[Index(kLeftElbow)] = turn * upper;
  ASSERT_OK(whole, CompleteObservation(Without(seen, {}, {kLeftWrist, kLeftHand, kHead}), {}, like, true));
  for (Role limb : {kLeftWrist, kLeftHand}) {
    EXPECT_LT(AngleBetween(whole->directions[Index(limb)], turn * before.directions[Index(limb)]), 1e-7)
        << RoleName(limb);
  }
  EXPECT_LT(AngleBetween(whole->directions[Index(kHead)], before.directions[Index(kHead)]), 1e-7);
}

TEST(CompleteObservation, LeavesACompleteOneAsItIs) {
  const LimbObservation seen = Disturb(Observe(ToBodyPose(Body(), RandomPose(Body(), 3, 0.8))), 3, 0.02, 5);
  ASSERT_OK(whole, CompleteObservation(seen, {}, {}, false));
  EXPECT_EQ(whole->ends.joints, seen.ends.joints);
  EXPECT_EQ(whole->directions, seen.directions);
}

TEST(CompleteObservation, PlacesNoBodyOfWhichNoEndWasEverSeen) {
  const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), 0, 0.8));
  const LimbObservation seen = Without(Observe(truth), {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead});
  EXPECT_FALSE(CompleteObservation(seen, {}, truth, false));
  EXPECT_TRUE(CompleteObservation(seen, {}, truth, true));
}

}  // namespace
}  // namespace etude
