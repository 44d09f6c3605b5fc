#include "engine/retargeting/anatomy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/retargeting/joint_map.h"
#include "tests/support/body_of_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

Skeleton Nameless(Skeleton skeleton = testing::PersonSkeleton()) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) skeleton.joints[i].name = "Q" + std::to_string(i);
  return skeleton;
}

AnatomyProposal ProposalFor(const Skeleton& skeleton) {
  const SkeletonTree tree(skeleton);
  return ProposeByAnatomy(tree);
}

TEST(Anatomy, FindsThePersonWithoutAnyName) {
  ASSERT_OK(map, FindJointMap(Nameless(), "nameless.bvh"));
  EXPECT_EQ(map->by_anatomy.size(), 12u);
  EXPECT_GE(map->confidence, 0.9);
  BodyPose body = testing::BodyAtRest(Nameless(), *map);
  EXPECT_THAT(map->composed, ::testing::ElementsAre(kShoulderCentre));
  body[kShoulderCentre] = {0, 140, 0};  // composed: midway between the shoulders
  testing::ExpectThePersonsPlaces(body);
}

TEST(Anatomy, TellsLeftFromRightByTheToesInWhateverAxes) {
  const Skeleton person = Nameless();
  const AnatomyProposal upright = ProposalFor(person);
  for (const glm::dquat& turn : {testing::Turn(Radians(90), {1, 0, 0}), testing::Turn(Radians(180), {0, 1, 0}),
                                 testing::Turn(1, glm::normalize(glm::dvec3(1, 2, 3)))}) {
    Skeleton turned = person;
    turned.joints[0].rest.rotation = turn;
    const AnatomyProposal found = ProposalFor(turned);
    EXPECT_EQ(found.joints, upright.joints);
    EXPECT_NEAR(found.confidence, upright.confidence, 1e-9);
  }
  Skeleton mirrored = person;
  for (Joint& joint : mirrored.joints) joint.rest.translation.z *= -1;
  const AnatomyProposal other = ProposalFor(mirrored);
  for (const Role role : AllRoles()) EXPECT_EQ(other.joints[Index(role)], upright.joints[Index(Mirrored(role))]);
}

TEST(Anatomy, IsNotSureOfWhatIsNoPersonOrDoesNotTellItsSides) {
  Skeleton toeless = Nameless();
  for (Joint& joint : toeless.joints) {
    if (joint.rest.translation.z != 0) joint.rest.translation = {0, 0, 0};
  }
  EXPECT_LT(ProposalFor(toeless).confidence, kMinAnatomyConfidence);
  EXPECT_GT(ProposalFor(toeless).confidence, 0.3) << "but it is one";

  Skeleton dog = Nameless();  // on all fours: arms and legs hang from a level trunk
  for (Joint& joint : dog.joints) {
    const glm::dvec3 at = joint.rest.translation;
    const bool is_trunk = at.x == 0 && at.z == 0 && at.y > 0;
    if (is_trunk) joint.rest.translation = {0, 0, at.y};
    if (std::abs(at.x) == 4) joint.rest.translation.y = 0;  // collar bones
    if (std::abs(at.x) > 15) joint.rest.translation = {0, -std::abs(at.x), 0};
  }
  EXPECT_LT(ProposalFor(dog).confidence, 0.1);

  Skeleton giraffe = Nameless();
  for (Joint& joint : giraffe.joints) {
    if (joint.rest.translation.y < -40) joint.rest.translation *= 3;
  }
  EXPECT_LT(ProposalFor(giraffe).confidence, 0.3);

  Skeleton snake;
  for (int i = 0; i < 20; ++i)
    snake.joints.push_back({.name = "", .parent = i - 1, .rest = {.translation = {0, 5, 0}}});
  EXPECT_EQ(ProposalFor(snake).confidence, 0);
  EXPECT_EQ(ProposalFor(Skeleton{}).confidence, 0);
}

TEST(Anatomy, DoesNotOverruleNames) {
  Skeleton crossed = testing::PersonSkeleton();  // a left arm called right, and an elbow with a meaningless name
  for (Joint& joint : crossed.joints) {
    if (joint.name == "LeftForeArm") joint.name = "Q";
    if (joint.name == "LeftArm")
      joint.name = "RightArm";
    else if (joint.name == "RightArm")
      joint.name = "LeftArm";
  }
  EXPECT_FALSE(FindJointMap(crossed, "crossed.bvh"));
}

}  // namespace
}  // namespace etude
