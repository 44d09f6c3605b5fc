#include "engine/base/directions.h"
#include "engine/kinematics/partial_observation.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/observed_tree.h"

namespace etude {
namespace {

using enum Role;

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

// What is lacking comes from the very pose that was observed: then nothing is lost.
TEST(CompleteObservation, GivesThePoseBackThatItIsLike) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 10; ++trial) {
    const BodyPose truth = ToBodyPose(tree, RandomPose(tree, trial, 0.8));
    for (const auto& lost : kEndsLost) {
      const auto whole = CompleteObservation(Without(Observe(truth), lost), {}, truth, true);
      ASSERT_TRUE(whole);
      const auto fixed = FixLimbLengths(*whole, {});
      ASSERT_TRUE(fixed);
      EXPECT_LT(LargestGap(*fixed, truth), 1e-9) << "without " << lost.size() << " ends";
      for (Role end : lost) EXPECT_TRUE(whole->lacks_end[Index(end)]) << "still no target";
    }
  }
}

// The body has moved and turned no limb but its whole: what is seen carries what is not.
TEST(CompleteObservation, MovesWhatWasNotSeenWithWhatWas) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose like = ToBodyPose(tree, RandomPose(tree, 1, 0.8));
  BodyPose moved = like;
  for (glm::dvec3& joint : moved.joints) joint += glm::dvec3(0.5, 0.1, -0.3);
  for (const auto& lost : kEndsLost) {
    if (lost.size() == 5) continue;  // then nothing tells of the move
    const auto whole = CompleteObservation(Without(Observe(moved), lost), {}, like, true);
    EXPECT_LT(LargestGap(*FixLimbLengths(*whole, {}), moved), 1e-9) << "without " << lost.size() << " ends";
  }
}

TEST(CompleteObservation, TurnsALimbWithTheOneItHangsFrom) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose like = ToBodyPose(tree, RandomPose(tree, 2, 0.8));
  const LimbObservation before = Observe(like);
  LimbObservation seen = before;
  // The upper arm swings by 40° about an axis normal to it.
  const glm::dvec3 upper = before.directions[Index(kLeftElbow)];
  const glm::dvec3 axis = glm::normalize(glm::cross(upper, glm::dvec3(0.3, 0.5, 0.2)));
  const glm::dmat3 turn = AxisRotation(axis, Radians(40));
  seen.directions[Index(kLeftElbow)] = turn * upper;
  const auto whole = CompleteObservation(Without(seen, {}, {kLeftWrist, kLeftHand, kHead}), {}, like, true);
  ASSERT_TRUE(whole);
  for (Role limb : {kLeftWrist, kLeftHand}) {
    EXPECT_LT(AngleBetween(whole->directions[Index(limb)], turn * before.directions[Index(limb)]), 1e-7)
        << RoleName(limb);
  }
  EXPECT_LT(AngleBetween(whole->directions[Index(kHead)], before.directions[Index(kHead)]), 1e-7);
}

TEST(CompleteObservation, LeavesACompleteOneAsItIs) {
  const KinematicTree tree = MakeBodyTree({});
  const LimbObservation seen = Disturb(Observe(ToBodyPose(tree, RandomPose(tree, 3, 0.8))), 3, 0.02, 5);
  const auto whole = CompleteObservation(seen, {}, {}, false);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->ends.joints, seen.ends.joints);
  EXPECT_EQ(whole->directions, seen.directions);
}

TEST(CompleteObservation, PlacesNoBodyOfWhichNoEndWasEverSeen) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose truth = ToBodyPose(tree, RandomPose(tree, 0, 0.8));
  const LimbObservation seen = Without(Observe(truth), {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead});
  EXPECT_FALSE(CompleteObservation(seen, {}, truth, false));
  EXPECT_TRUE(CompleteObservation(seen, {}, truth, true));
}

}  // namespace
}  // namespace etude
