#include "engine/retargeting/joint_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/support/person.h"

namespace etude {
namespace {

using enum Role;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Skeleton Renamed(Skeleton skeleton, const std::map<std::string, std::string>& parts) {
  for (Joint& joint : skeleton.joints) {
    for (const char* side : {"Left", "Right", ""}) {
      const std::string_view prefix = side;
      if (!joint.name.starts_with(prefix)) continue;
      const auto part = parts.find(joint.name.substr(prefix.size()));
      if (part == parts.end()) continue;
      joint.name = std::string(prefix) + part->second;
      break;
    }
  }
  return skeleton;
}

Skeleton Without(Skeleton skeleton, const std::string& name) {
  const int gone = skeleton.Find(name);
  skeleton.joints.erase(skeleton.joints.begin() + gone);
  for (Joint& joint : skeleton.joints) {
    if (joint.parent > gone) --joint.parent;
  }
  return skeleton;
}

BodyPose RestBody(const Skeleton& skeleton, const JointMap& map) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(skeleton, testing::AtRest(skeleton).frames[0], globals);
  return Evaluate(map, globals);
}

void ExpectNear(const glm::dvec3& actual, const glm::dvec3& expected) {
  EXPECT_LT(glm::distance(actual, expected), 1e-12) << "(" << actual.x << ", " << actual.y << ", " << actual.z << ")";
}

void ExpectThePerson(const Skeleton& skeleton) {
  const auto map = FindJointMap(skeleton, "person.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  EXPECT_THAT(map->composed, IsEmpty());
  const BodyPose body = RestBody(skeleton, *map);
  ExpectNear(body[kHipCentre], {0, 90, 0});
  ExpectNear(body[kSpine], {0, 115, 0});
  ExpectNear(body[kShoulderCentre], {0, 140, 0});
  ExpectNear(body[kHead], {0, 165, 0});
  ExpectNear(body[kLeftShoulder], {18, 137, 0});
  ExpectNear(body[kLeftElbow], {47, 137, 0});
  ExpectNear(body[kLeftWrist], {72, 137, 0});
  ExpectNear(body[kLeftHand], {90, 137, 0});
  ExpectNear(body[kLeftHip], {9, 90, 0});
  ExpectNear(body[kLeftKnee], {9, 47, 0});
  ExpectNear(body[kLeftAnkle], {9, 5, 0});
  ExpectNear(body[kLeftFoot], {9, 0, 18});
  for (Role role : AllRoles()) {
    const glm::dvec3& other = body[Mirrored(role)];
    ExpectNear(body[role], {-other.x, other.y, other.z});
  }
}

TEST(JointMap, FindsTheTwentyRolesUnderEveryNamingScheme) {
  const Skeleton person = testing::PersonSkeleton();
  {
    SCOPED_TRACE("MotionBuilder");
    ExpectThePerson(person);
  }
  {
    SCOPED_TRACE("Biovision");
    ExpectThePerson(Renamed(person, {{"Shoulder", "Collar"},
                                     {"Arm", "Shoulder"},
                                     {"ForeArm", "Elbow"},
                                     {"Hand", "Wrist"},
                                     {"UpLeg", "Hip"},
                                     {"Leg", "Knee"},
                                     {"Foot", "Ankle"},
                                     {"ToeBase", "Toes"},
                                     {"Spine", "Chest"}}));
  }
  {
    SCOPED_TRACE("Biovision's samples");
    ExpectThePerson(Renamed(person, {{"Shoulder", "Collar"},
                                     {"Arm", "UpArm"},
                                     {"ForeArm", "LowArm"},
                                     {"Leg", "LowLeg"},
                                     {"ToeBase", "Toe"},
                                     {"Spine", "Chest"}}));
  }
  Skeleton prefixed = person;
  Skeleton lettered =
      Renamed(person, {{"Arm", "UpperArm"}, {"ForeArm", "LowerArm"}, {"UpLeg", "UpperLeg"}, {"Leg", "LowerLeg"}});
  for (std::size_t i = 0; i < person.joints.size(); ++i) {
    prefixed.joints[i].name = "mixamorig:" + prefixed.joints[i].name;
    std::string& name = lettered.joints[i].name;
    if (name.starts_with("Left")) name = name.substr(4) + "_L";
    if (name.starts_with("Right")) name = name.substr(5) + "_R";
  }
  {
    SCOPED_TRACE("Mixamo's prefix");
    ExpectThePerson(prefixed);
  }
  {
    SCOPED_TRACE("side as a letter at the end");
    ExpectThePerson(lettered);
  }
  for (Joint& joint : prefixed.joints) joint.name = "Character1_" + joint.name.substr(10);
  {
    SCOPED_TRACE("MASS's prefix");
    ExpectThePerson(prefixed);
  }
}

TEST(JointMap, TakesCmusShoulderForTheCollarBoneAndItsSecondNeckForTheNeck) {
  Skeleton cmu = Renamed(testing::PersonSkeleton(), {{"Neck", "Neck1"}});
  // CMU's "Neck" lies at the chest, between chest and "Neck1".
  Joint& neck1 = cmu.joints[cmu.Find("Neck1")];
  const int spine = neck1.parent;
  cmu.joints.insert(cmu.joints.begin() + cmu.Find("Neck1"), Joint{"Neck", spine, {}, false});
  const int neck = cmu.Find("Neck");
  for (std::size_t i = neck + 1; i < cmu.joints.size(); ++i) {
    if (cmu.joints[i].parent >= neck) ++cmu.joints[i].parent;
  }
  cmu.joints[neck + 1].parent = neck;
  ExpectThePerson(cmu);
}

TEST(JointMap, RefusesAClipWithTheListOfMissingRolesAndOfItsJoints) {
  Skeleton horse = testing::PersonSkeleton();
  horse.joints[horse.Find("LeftForeArm")].name = "LeftForeHoof";
  horse.joints[horse.Find("Head")].name = "Muzzle";
  const auto map = FindJointMap(horse, "horse.bvh");
  ASSERT_FALSE(map);
  EXPECT_THAT(
      ToString(map.error()),
      HasSubstr("horse.bvh: no joint found for head, left_shoulder, left_elbow, left_wrist; joints in the file: "
                "'Hips', 'Spine', 'Neck', 'Muzzle', 'LeftShoulder'"));
  EXPECT_THAT(map.error().message, HasSubstr("'LeftForeHoof'"));
}

TEST(JointMap, RefusesAKneeThatDoesNotHangFromItsHip) {
  Skeleton crossed = testing::PersonSkeleton();
  crossed.joints[crossed.Find("RightLeg")].parent = crossed.Find("LeftUpLeg");
  const auto map = FindJointMap(crossed, "crossed.bvh");
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().message,
            "right_knee is played by 'RightLeg', which does not descend from 'RightUpLeg', the right_hip");
}

TEST(JointMap, RefusesTwoHipsOnOneSide) {
  Skeleton lopsided = testing::PersonSkeleton();
  lopsided.joints[lopsided.Find("RightUpLeg")].rest.translation.x = 3;
  const auto map = FindJointMap(lopsided, "lopsided.bvh");
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, HasSubstr("lie on the same side of 'Hips'"));
}

TEST(JointMap, ComposesTipsThatTheFileHasAtUnbelievableDistances) {
  Skeleton mass = testing::PersonSkeleton();
  mass.joints[mass.Find("LeftHand_End")].rest.translation = {0.3, 0.1, 0.9};
  mass.joints[mass.Find("RightHand_End")].rest.translation = {161, 0.1, 0.9};
  mass.joints[mass.Find("Head")].rest.translation = {0, 8, 3.5};
  mass.joints[mass.Find("Head_End")].rest.translation = {0, 0, 0};
  const auto map = FindJointMap(mass, "mass.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  EXPECT_THAT(map->composed, ElementsAre(kLeftHand, kRightHand, kHead));
  // In the person's own proportions they come to where the end sites were.
  const BodyPose body = RestBody(mass, *map);
  ExpectNear(body[kLeftHand], {90, 137, 0});
  ExpectNear(body[kRightHand], {-90, 137, 0});
  ExpectNear(body[kHead], {0, 165, 0});
}

TEST(JointMap, ComposesFeetForwardAndASpineHalfWayWhenThereAreNone) {
  Skeleton bare = testing::PersonSkeleton();
  for (const char* name : {"LeftToeBase_End", "LeftToeBase", "RightToeBase_End", "RightToeBase"})
    bare = Without(bare, name);
  // The chest goes: neck and collars hang from the hips.
  const int spine = bare.Find("Spine");
  for (Joint& joint : bare.joints) {
    if (joint.parent == spine) joint = {joint.name, 0, {.translation = joint.rest.translation + glm::dvec3(0, 20, 0)}};
  }
  bare = Without(bare, "Spine");
  const auto map = FindJointMap(bare, "bare.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  EXPECT_THAT(map->composed, ElementsAre(kSpine, kLeftFoot, kRightFoot));
  const BodyPose body = RestBody(bare, *map);
  ExpectNear(body[kLeftFoot], {9, 5, 18});
  ExpectNear(body[kSpine], {0, 117.5, 0});
}

TEST(JointMap, ComposedPointsTurnWithTheirJoint) {
  Skeleton mass = testing::PersonSkeleton();
  mass = Without(mass, "LeftHand_End");
  const auto map = FindJointMap(mass, "mass.bvh");
  ASSERT_TRUE(map);
  Clip clip = testing::AtRest(mass);
  testing::At(clip, 0, "LeftHand").rotation = testing::Turn(std::numbers::pi / 2, {0, 0, 1});
  std::vector<GlobalTransform> globals;
  ComputeGlobals(mass, clip.frames[0], globals);
  ExpectNear(Evaluate(*map, globals)[kLeftHand], {72, 155, 0});
}

/// The shortest turn that takes +X to `direction`.
glm::dquat FromX(const glm::dvec3& direction) {
  const glm::dvec3 to = glm::normalize(direction);
  if (to.x < -0.999) return testing::Turn(std::numbers::pi, {0, 0, 1});
  return glm::normalize(glm::dquat(1 + to.x, glm::cross(glm::dvec3(1, 0, 0), to)));
}

/// The person in the same pose, but every joint's frame has its X along the bone to its first child:
/// with all rotations zero, limbs lie on top of each other (LAFAN1's files are like that).
Clip FoldedAtRest() {
  Clip clip = testing::AtRest(testing::PersonSkeleton());
  std::vector<Joint>& joints = clip.skeleton.joints;
  std::vector<glm::dquat> frames(joints.size(), glm::dquat(1, 0, 0, 0));
  for (std::size_t i = joints.size() - 1; i > 0; --i) frames[joints[i].parent] = FromX(joints[i].rest.translation);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const glm::dquat above = i == 0 ? glm::dquat(1, 0, 0, 0) : glm::conjugate(frames[joints[i].parent]);
    joints[i].rest.translation = above * joints[i].rest.translation;
    clip.frames[0][i] = {joints[i].rest.translation, above * frames[i]};
  }
  return clip;
}

TEST(JointMap, FindsThePersonWhoseRestPoseIsFoldedUp) {
  const Clip folded = FoldedAtRest();
  const auto map = FindJointMap(folded.skeleton, "folded.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(folded.skeleton, folded.frames[0], globals);
  const BodyPose body = Evaluate(*map, globals);
  ExpectNear(body[kSpine], {0, 115, 0});
  ExpectNear(body[kHead], {0, 165, 0});
  ExpectNear(body[kRightHand], {-90, 137, 0});
  ExpectNear(body[kLeftAnkle], {9, 5, 0});
  ExpectNear(body[kLeftFoot], {9, 0, 18});
  // The control: at rest it really is folded, the ankle is nowhere near the floor.
  EXPECT_GT(RestBody(folded.skeleton, *map)[kLeftAnkle].y, 40);
}

TEST(JointMap, KeepsTheHipCentreMidwayWhenTheHipsThemselvesMove) {
  const Skeleton person = testing::PersonSkeleton();
  const auto map = FindJointMap(person, "person.bvh");
  ASSERT_TRUE(map);
  Clip clip = testing::AtRest(person);
  testing::At(clip, 0, "LeftUpLeg").translation = {11, -5, 4};
  std::vector<GlobalTransform> globals;
  ComputeGlobals(person, clip.frames[0], globals);
  ExpectNear(Evaluate(*map, globals)[kHipCentre], {1, 90, 2});
}

}  // namespace
}  // namespace etude
