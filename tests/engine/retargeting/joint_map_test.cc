#include "engine/retargeting/joint_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/retargeting/map_file.h"
#include "tests/support/body_of_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using testing::BodyAtRest;
using ::testing::ElementsAre;
using testing::ExpectNear;
using ::testing::HasSubstr;

Skeleton Without(Skeleton skeleton, const std::string& name) {
  const int gone = skeleton.Find(name);
  skeleton.joints.erase(skeleton.joints.begin() + gone);
  for (Joint& joint : skeleton.joints) {
    if (joint.parent > gone) --joint.parent;
  }
  return skeleton;
}

/// Inserts a joint above `child`, at the place of the child's parent.
void InsertAbove(Skeleton& skeleton, const std::string& child, const std::string& name) {
  const int at = skeleton.Find(child);
  const int parent = skeleton.joints[at].parent;
  skeleton.joints.insert(skeleton.joints.begin() + at, Joint{name, parent, {}, false});
  for (std::size_t i = at + 1; i < skeleton.joints.size(); ++i) {
    if (skeleton.joints[i].parent >= at) ++skeleton.joints[i].parent;
  }
  skeleton.joints[at + 1].parent = at;
}

BodyPose BodyInMotion(const Clip& clip, const JointMap& map) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames.front(), globals);
  return Evaluate(map, globals);
}

TEST(JointMap, TakesCmusShoulderForTheCollarBoneAndItsSecondNeckForTheNeck) {
  Skeleton cmu = testing::PersonSkeleton();
  cmu.joints[cmu.Find("Neck")].name = "Neck1";
  InsertAbove(cmu, "Neck1", "Neck");  // between collars and chest
  InsertAbove(cmu, "LeftUpLeg", "LHipJoint");
  InsertAbove(cmu, "RightUpLeg", "RHipJoint");
  testing::ExpectThePerson(cmu);
}

TEST(JointMap, TakesTheFirstOfTwoNecksThatStandAboveTheChest) {
  Skeleton person = testing::PersonSkeleton();
  InsertAbove(person, "Head", "Neck1");
  person.joints[person.Find("Neck1")].rest.translation = {0, 4, 0};
  person.joints[person.Find("Head")].rest.translation = {0, 6, 0};
  testing::ExpectThePerson(person);
}

TEST(JointMap, RefusesAClipWithTheListOfMissingRolesAndOfItsJoints) {
  Skeleton horse = testing::PersonSkeleton();
  horse.joints[horse.Find("LeftForeArm")].rest.translation *= 2;  // also, its proportions are not a person's
  horse.joints[horse.Find("LeftForeArm")].name = "LeftForeHoof";
  for (const char* name : {"RightUpLeg", "RightLeg", "RightFoot"}) horse.joints[horse.Find(name)].name = "Wheel";
  const auto map = FindJointMap(horse, "horse.bvh");
  EXPECT_THAT(testing::Refusal(map),
              HasSubstr("horse.bvh: no joint found for left_elbow (a 'forearm'), right_hip, right_knee, right_ankle; "
                        "joints in the file: 'Hips', 'Spine', 'Neck', 'Head', 'LeftShoulder'"));
  EXPECT_THAT(testing::Message(map), HasSubstr("'LeftForeHoof'"));
}

TEST(JointMap, TakesTheHeadThatIsThereWhateverItIsCalled) {
  Skeleton rigify = testing::PersonSkeleton();
  rigify.joints[rigify.Find("Neck")].name = "spine.004";
  rigify.joints[rigify.Find("Head")].name = "spine.006";
  ASSERT_OK(map, FindJointMap(rigify, "rigify.glb"));
  EXPECT_EQ((*map)[kHead].joint, rigify.Find("Head_End"));
  ExpectNear(BodyAtRest(rigify, *map)[kHead], {0, 165, 0});
}

TEST(JointMap, GivesTheRolesThatAreThereWhereOthersAreMissing) {
  Skeleton odd = testing::PersonSkeleton();
  for (const char* name : {"LeftLeg", "RightLeg"}) {
    odd.joints[odd.Find(name)].rest.translation *= 0.4;
    odd.joints[odd.Find(name)].name = name[0] == 'L' ? "Q1" : "Q2";
  }
  ASSERT_FALSE(FindJointMap(odd, "odd.bvh"));
  const PartialRoles roles = FindPartialRoles(odd);
  for (const auto& [role, name] : {std::pair(kLeftHip, "LeftUpLeg"), std::pair(kRightAnkle, "RightFoot"),
                                   std::pair(kLeftElbow, "LeftForeArm"), std::pair(kHead, "Head")}) {
    EXPECT_EQ(roles.found[Index(role)], odd.Find(name)) << name;
  }
  EXPECT_EQ(roles.found[Index(kLeftKnee)], -1);
  EXPECT_LT(roles.confidence, 0.9);
}

TEST(JointMap, RefusesTwoHalvesWithoutACommonJoint) {
  Skeleton halves = testing::PersonSkeleton();
  halves.joints[halves.Find("RightUpLeg")].parent = -1;
  EXPECT_EQ(testing::Message(FindJointMap(halves, "halves.bvh")),
            "the hips, 'LeftUpLeg' and 'RightUpLeg', have no common ancestor");
}

TEST(JointMap, RefusesAKneeThatDoesNotHangFromItsHip) {
  Skeleton crossed = testing::PersonSkeleton();
  crossed.joints[crossed.Find("RightLeg")].parent = crossed.Find("LeftUpLeg");
  EXPECT_EQ(
      testing::Message(FindJointMap(crossed, "crossed.bvh")),
      "the role right_knee has the joint 'RightLeg', which does not descend from 'RightUpLeg', the joint of the role "
      "right_hip");
}

TEST(JointMap, RefusesTwoHipsOnOneSide) {
  Skeleton lopsided = testing::PersonSkeleton();
  lopsided.joints[lopsided.Find("RightUpLeg")].rest.translation.x = 3;
  EXPECT_THAT(testing::Message(FindJointMap(lopsided, "lopsided.bvh")), HasSubstr("are on the same side of 'Hips'"));
}

TEST(JointMap, ComposesTipsThatTheFileHasAtUnbelievableDistances) {
  Skeleton mass = testing::PersonSkeleton();
  mass.joints[mass.Find("LeftHand_End")].rest.translation = {0.3, 0.1, 0.9};
  mass.joints[mass.Find("RightHand_End")].rest.translation = {161, 0.1, 0.9};
  mass.joints[mass.Find("Head")].rest.translation = {0, 8, 3.5};
  mass.joints[mass.Find("Head_End")].rest.translation = {0, 0, 0};
  ASSERT_OK(map, FindJointMap(mass, "mass.bvh"));
  EXPECT_THAT(map->composed, ElementsAre(kLeftHand, kRightHand, kHead));
  // In the person's proportions, the composed points are at the former end sites.
  const BodyPose body = BodyAtRest(mass, *map);
  ExpectNear(body[kLeftHand], {90, 137, 0});
  ExpectNear(body[kRightHand], {-90, 137, 0});
  ExpectNear(body[kHead], {0, 165, 0});
}

/// Replaces the ends of both hands by chains of one joint and an end site. `fingers` are names without the side, and
/// end positions from the left wrist.
Skeleton WithFingers(const std::vector<std::pair<std::string, glm::dvec3>>& fingers) {
  Skeleton person = Without(Without(testing::PersonSkeleton(), "LeftHand_End"), "RightHand_End");
  for (const auto& [side, sign] : {std::pair("Left", 1.0), std::pair("Right", -1.0)}) {
    for (const auto& [finger, place] : fingers) {
      const glm::dvec3 half = 0.5 * glm::dvec3(sign * place.x, place.y, place.z);
      const std::string name = side + finger;
      person.joints.push_back({name, person.Find(side + std::string("Hand")), {.translation = half}, false});
      person.joints.push_back({name + "_End", person.Find(name), {.translation = half}, true});
    }
  }
  return person;
}

/// Returns the joints that play the hands, without the side; "" for a composed point.
std::pair<std::string, std::string> TipsOf(const Skeleton& skeleton) {
  const auto map = FindJointMap(skeleton, "person.bvh");
  EXPECT_TRUE(map) << ToString(map.error());
  const auto name_of = [&](Role hand, std::size_t side) {
    const bool is_composed = std::ranges::find(map->composed, hand) != map->composed.end();
    return is_composed ? "" : skeleton.joints[(*map)[hand].joint].name.substr(side);
  };
  return {name_of(kLeftHand, 4), name_of(kRightHand, 5)};
}

TEST(JointMap, TakesNoThumbForTheTipOfAHand) {
  using Both = std::pair<std::string, std::string>;
  for (const char* thumb : {"Thumb", "HandThumb1", "_thumb_01"}) {
    EXPECT_EQ(TipsOf(WithFingers({{thumb, {20, 0, 2}}, {"Pinky", {12, 0, 0}}})), Both("Pinky_End", "Pinky_End"));
    EXPECT_EQ(TipsOf(WithFingers({{thumb, {18, 0, 0}}})), Both("", "")) << "composed rather than a thumb";
  }
  EXPECT_EQ(TipsOf(WithFingers({{"Digit", {20, 0, 2}}, {"Pinky", {12, 0, 0}}})), Both("Digit_End", "Digit_End"))
      << "the control: by another name it is the tip";
}

TEST(JointMap, ChoosesAmongEquallyFarTipsAlikeOnBothSides) {
  using Both = std::pair<std::string, std::string>;
  const glm::dvec3 straight(18, 0, 0), aside(18 * 0.6, 0, 18 * 0.8);
  // Adds an error, such as the rounding to six decimals of a metre, with opposite signs on both sides.
  const auto choose = [&](const std::string& a, const std::string& b, double rounding) {
    Skeleton person = WithFingers({{a, straight}, {b, aside}});
    person.joints[person.Find("Left" + a)].rest.translation.x += rounding;
    person.joints[person.Find("Right" + b)].rest.translation.x -= rounding;
    return TipsOf(person);
  };
  for (const double rounding : {0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-4, -1e-4}) {
    SCOPED_TRACE(rounding);
    EXPECT_EQ(choose("Index1", "Middle1", rounding), Both("Middle1_End", "Middle1_End"));
    EXPECT_EQ(choose("Middle1", "Index1", rounding), Both("Middle1_End", "Middle1_End"));
    EXPECT_EQ(choose("Ring1", "Index1", rounding), Both("Index1_End", "Index1_End"));
    EXPECT_EQ(choose("Pinky1", "Ring1", rounding), Both("Ring1_End", "Ring1_End"));
    EXPECT_EQ(choose("FingerA", "FingerB", rounding), Both("FingerA_End", "FingerA_End")) << "the first";
    EXPECT_EQ(choose("FingerB", "FingerA", rounding), Both("FingerB_End", "FingerB_End")) << "the first";
    EXPECT_EQ(choose("Thumb1", "FingerA", rounding), Both("FingerA_End", "FingerA_End"));
  }
  EXPECT_EQ(choose("Index1", "Middle1", 0.1), Both("Index1_End", "Middle1_End")) << "the control: really farther";
}

TEST(JointMap, TakesNoEyeForTheCrownOfTheHead) {
  Skeleton daz = testing::PersonSkeleton();
  const int head = daz.Find("Head"), crown = daz.Find("Head_End");
  daz.joints[crown].name = "leftEye";
  daz.joints[crown].rest.translation = {3, 7, 8};
  ASSERT_OK(map, FindJointMap(daz, "daz.bvh"));
  EXPECT_EQ((*map)[Role::kHead].joint, head);
  EXPECT_THAT(map->composed, ::testing::Contains(Role::kHead));
  // The control: in line with the trunk the joint is the crown.
  daz.joints[crown].rest.translation = {0, 15, 0};
  EXPECT_EQ((*FindJointMap(daz, "daz.bvh"))[Role::kHead].joint, crown);
}

/// Returns a person whose head and left foot are turned away at rest, and turned back in every frame.
Clip TurnedAtRest(const glm::dquat& head, const glm::dquat& foot) {
  Clip clip = testing::AtRest(testing::PersonSkeleton(), 4);
  for (const auto& [joint, tip, turn] : {std::tuple("Head", "Head_End", head), {"LeftToeBase", "LeftToeBase_End", foot}}) {
    LocalTransform& rest = clip.skeleton.joints[clip.skeleton.Find(tip)].rest;
    rest.translation = turn * rest.translation;
    for (std::size_t f = 0; f < clip.frames.size(); ++f) {
      testing::At(clip, f, tip).translation = rest.translation;
      testing::At(clip, f, joint).rotation = glm::conjugate(turn);
    }
  }
  return clip;
}

TEST(JointMap, JudgesTipsInMotionWhereTheRestPoseIsNone) {
  const glm::dquat back = testing::Turn(-1.6, {1, 0, 0}), up = testing::Turn(-2.2, {1, 0, 0});
  const Clip clip = TurnedAtRest(back, up);
  ASSERT_OK(map, FindJointMap(clip.skeleton, "turned.bvh", nullptr, clip.frames));
  EXPECT_THAT(map->composed, ElementsAre());
  testing::ExpectThePersonsPlaces(BodyInMotion(clip, *map), 1, 1e-9);
  // The control: from the rest pose alone the head is composed, and is wrong in motion.
  ASSERT_OK(at_rest, FindJointMap(clip.skeleton, "turned.bvh"));
  EXPECT_GT(glm::distance(BodyInMotion(clip, *at_rest)[kHead], {0, 165, 0}), 20);
}

TEST(JointMap, ComposesInMotionWhatTheRestPosePointsElsewhere) {
  Clip clip = TurnedAtRest(testing::Turn(-1.6, {1, 0, 0}), glm::dquat(1, 0, 0, 0));
  const int crown = clip.skeleton.Find("Head_End");
  clip.skeleton = Without(clip.skeleton, "Head_End");
  for (LocalPose& frame : clip.frames) frame.erase(frame.begin() + crown);
  ASSERT_OK(map, FindJointMap(clip.skeleton, "turned.bvh", nullptr, clip.frames));
  EXPECT_THAT(map->composed, ElementsAre(kHead));
  ExpectNear(BodyInMotion(clip, *map)[kHead], {0, 165, 0}, 1e-9);
}

TEST(JointMap, IsOneForASkeletonWhoseTipsAreEndSitesOrNodes) {
  // CMU's converters put the neck at the chest, and call no joint a head.
  Skeleton sites = testing::PersonSkeleton();
  sites.joints[sites.Find("Head_End")].name = "Neck1_End";
  sites.joints[sites.Find("Head")].name = "Neck1";
  sites.joints[sites.Find("Neck")].rest.translation = {0, 0, 0};
  sites.joints[sites.Find("Neck1")].rest.translation = {0, 12, 2};
  for (const char* collar : {"LeftShoulder", "RightShoulder"}) sites.joints[sites.Find(collar)].rest.translation.y = 0;
  Skeleton nodes = sites;
  for (Joint& joint : nodes.joints) joint.is_end_site = false;
  ASSERT_OK(of_sites, FindJointMap(sites, "a.bvh"));
  ASSERT_OK(of_nodes, FindJointMap(nodes, "a.glb"));
  EXPECT_EQ(of_sites->composed, of_nodes->composed);
  for (const Role role : AllRoles()) {
    EXPECT_EQ((*of_sites)[role].joint, (*of_nodes)[role].joint) << RoleName(role);
    EXPECT_EQ((*of_sites)[role].offset, (*of_nodes)[role].offset) << RoleName(role);
  }
}

TEST(JointMap, TakesAStandingFrameForARestPoseThatIsNone) {
  // At rest all limbs are folded beside the trunk; every frame unfolds them.
  Clip clip = testing::AtRest(testing::PersonSkeleton(), 3);
  for (const char* name : {"LeftUpLeg", "RightUpLeg"}) {
    for (const char* below : {"Leg"}) {
      const std::string leg = std::string(name).substr(0, name[0] == 'L' ? 4 : 5) + below;
      Joint& joint = clip.skeleton.joints[clip.skeleton.Find(leg)];
      joint.rest.translation = {0, 43, 0};
      for (std::size_t f = 0; f < 3; ++f) {
        testing::At(clip, f, leg).translation = {0, 43, 0};
        testing::At(clip, f, name).rotation = testing::Turn(3.141592653589793, {1, 0, 0});
        testing::At(clip, f, leg).rotation = testing::Turn(3.141592653589793, {1, 0, 0});
      }
    }
  }
  ASSERT_OK(map, FindJointMap(clip.skeleton, "folded.bvh", nullptr, clip.frames));
  testing::ExpectThePersonsPlaces(BodyInMotion(clip, *map), 1, 1e-6);
}

TEST(JointMap, ComposesFeetForwardAndASpineHalfWayWhenThereAreNone) {
  Skeleton bare = testing::PersonSkeleton();
  for (const char* name : {"LeftToeBase_End", "LeftToeBase", "RightToeBase_End", "RightToeBase"})
    bare = Without(bare, name);
  // Without the chest, neck and collars hang from the hips.
  const int spine = bare.Find("Spine");
  for (Joint& joint : bare.joints) {
    if (joint.parent == spine) joint = {joint.name, 0, {.translation = joint.rest.translation + glm::dvec3(0, 20, 0)}};
  }
  bare = Without(bare, "Spine");
  ASSERT_OK(map, FindJointMap(bare, "bare.bvh"));
  EXPECT_THAT(map->composed, ElementsAre(kSpine, kLeftFoot, kRightFoot));
  const BodyPose body = BodyAtRest(bare, *map);
  ExpectNear(body[kLeftFoot], {9, 5, 18});
  ExpectNear(body[kSpine], {0, 117.5, 0});
}

TEST(JointMap, ComposedPointsTurnWithTheirJoint) {
  Skeleton mass = testing::PersonSkeleton();
  mass = Without(mass, "LeftHand_End");
  ASSERT_OK(map, FindJointMap(mass, "mass.bvh"));
  Clip clip = testing::AtRest(mass);
  testing::At(clip, 0, "LeftHand").rotation = testing::Turn(std::numbers::pi / 2, {0, 0, 1});
  ExpectNear(BodyInMotion(clip, *map)[kLeftHand], {72, 155, 0});
}

glm::dquat FromX(const glm::dvec3& direction) {
  const glm::dvec3 to = glm::normalize(direction);
  if (to.x < -0.999) return testing::Turn(std::numbers::pi, {0, 0, 1});
  return glm::normalize(glm::dquat(1 + to.x, glm::cross(glm::dvec3(1, 0, 0), to)));
}

/// Returns the person. Each joint's X axis points along the bone to its first child, so at zero rotations the limbs
/// coincide, as in LAFAN1's files.
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
  ASSERT_OK(map, FindJointMap(folded.skeleton, "folded.bvh"));
  const BodyPose body = BodyInMotion(folded, *map);
  ExpectNear(body[kSpine], {0, 115, 0});
  ExpectNear(body[kHead], {0, 165, 0});
  ExpectNear(body[kRightHand], {-90, 137, 0});
  ExpectNear(body[kLeftAnkle], {9, 5, 0});
  ExpectNear(body[kLeftFoot], {9, 0, 18});
  // The control: the rest pose is folded, with the ankle far above the floor.
  EXPECT_GT(BodyAtRest(folded.skeleton, *map)[kLeftAnkle].y, 40);
}

TEST(JointMap, KeepsTheHipCentreMidwayWhenTheHipsThemselvesMove) {
  const Skeleton person = testing::PersonSkeleton();
  ASSERT_OK(map, FindJointMap(person, "person.bvh"));
  Clip clip = testing::AtRest(person);
  testing::At(clip, 0, "LeftUpLeg").translation = {11, -5, 4};
  ExpectNear(BodyInMotion(clip, *map)[kHipCentre], {1, 90, 2});
}

/// Returns the skeleton in the same rest pose as glTF exporters write it: arbitrary joint frames, a scale in a node
/// above, meshes as nodes that may have a joint's name, and a second root.
Skeleton AsGltfNodes(const Skeleton& person, double scale) {
  Skeleton nodes;
  nodes.joints.push_back({.name = "Camera", .parent = -1, .rest = {}});
  nodes.joints.push_back({.name = "Armature",
                          .parent = -1,
                          .rest = {.translation = {0, 0, 0},
                                   .rotation = testing::Turn(-std::numbers::pi / 2, {1, 0, 0}),
                                   .scale = glm::dvec3(scale)}});
  nodes.joints.push_back({.name = "LeftArm", .parent = 1, .rest = {}});  // a mesh node
  nodes.joints.push_back({.name = "Head", .parent = 0, .rest = {}});
  const int first = static_cast<int>(nodes.joints.size());
  const glm::dquat armature = nodes.joints[1].rest.rotation;
  std::vector<glm::dquat> axes;  // every joint's axes in the world
  for (std::size_t i = 0; i < person.joints.size(); ++i) {
    const Joint& joint = person.joints[i];
    const glm::dquat above = joint.parent < 0 ? armature : axes[joint.parent];
    const double angle = 0.7 * static_cast<double>(i);
    axes.push_back(glm::angleAxis(angle, glm::normalize(glm::dvec3(1, std::sin(3 * angle), -0.5))));
    nodes.joints.push_back({.name = joint.name,
                            .parent = joint.parent < 0 ? 1 : joint.parent + first,
                            .rest = {.translation = glm::conjugate(above) * joint.rest.translation,
                                     .rotation = glm::conjugate(above) * axes.back()}});
  }
  return nodes;
}

TEST(JointMap, FindsThePersonAmongTheNodesOfAGltf) {
  const Skeleton nodes = AsGltfNodes(testing::PersonSkeleton(), 0.01);
  ASSERT_OK(map, FindJointMap(nodes, "person.glb"));
  testing::ExpectThePersonsPlaces(BodyAtRest(nodes, *map), 0.01);
  EXPECT_NE((*map)[kLeftShoulder].joint, nodes.Find("LeftArm")) << "that is the mesh";
}

TEST(JointMap, ComposesPointsInTheFrameOfTurnedAndScaledJoints) {
  Skeleton bare = testing::PersonSkeleton();
  for (const char* name : {"LeftToeBase_End", "LeftToeBase", "RightToeBase_End", "RightToeBase", "LeftHand_End",
                           "RightHand_End", "Head_End", "Head", "Neck"}) {
    bare = Without(bare, name);
  }
  const Skeleton nodes = AsGltfNodes(bare, 0.01);
  ASSERT_OK(map, FindJointMap(nodes, "bare.glb"));
  EXPECT_THAT(map->composed, ElementsAre(kShoulderCentre, kLeftHand, kRightHand, kLeftFoot, kRightFoot, kHead));
  const BodyPose body = BodyAtRest(nodes, *map);
  ExpectNear(body[kLeftHand], {0.90, 1.37, 0});
  ExpectNear(body[kRightFoot], {-0.09, 0.05, 0.18});
  ExpectNear(body[kShoulderCentre], {0, 1.37, 0});
  ExpectNear(body[kHead], {0, 1.37 + 0.235, 0});  // half a trunk's length above
  ExpectNear(body[kSpine], {0, 1.15, 0});
}

TEST(JointMap, ComposesPointsOfJointsWithoutSizeOnTheJointItself) {
  Skeleton person = Without(testing::PersonSkeleton(), "LeftHand_End");
  person.joints[person.Find("LeftHand")].rest.scale = {0, 0, 0};
  ASSERT_OK(map, FindJointMap(person, "person.glb"));
  ExpectNear(BodyAtRest(person, *map)[kLeftHand], {72, 137, 0});
}

TEST(JointMap, TakesFeetThatHangFromControlsInsteadOfTheLegs) {
  Skeleton rig = testing::PersonSkeleton();
  for (const char* side : {"Left", "Right"}) {
    Joint& foot = rig.joints[rig.Find(side + std::string("Foot"))];
    foot.parent = 0;
    foot.rest.translation = {side == std::string("Left") ? 9 : -9, -90, 0};
    rig.joints[rig.Find(side + std::string("ToeBase_End"))].rest.translation = {0, 0, -20};
  }
  ASSERT_OK(map, FindJointMap(rig, "rig.glb"));
  EXPECT_THAT(map->composed, ElementsAre(kLeftFoot, kRightFoot)) << "what hangs from a control is no foot";
  ExpectNear(BodyAtRest(rig, *map)[kLeftAnkle], {9, 5, 0});
  ExpectNear(BodyAtRest(rig, *map)[kLeftFoot], {9, 5, 18});
  // The control: an exchanged leg is not accepted.
  Skeleton crossed = testing::PersonSkeleton();
  crossed.joints[crossed.Find("RightFoot")].parent = crossed.Find("LeftLeg");
  EXPECT_EQ(testing::Message(FindJointMap(crossed, "crossed.glb")),
            "the role right_ankle has the joint 'RightFoot', which does not descend from 'RightLeg', the joint of the "
            "role right_knee");
}

TEST(JointMap, TakesTaughtJointsBeforeAnyName) {
  Skeleton horse = testing::PersonSkeleton();
  horse.joints[horse.Find("LeftForeArm")].name = "Hoof";
  horse.joints[horse.Find("RightFoot")].name = "Wheel";
  EXPECT_THAT(FindJointMap(horse, "horse.bvh")->by_anatomy, ElementsAre(kLeftElbow, kRightAnkle));
  const JointMapOverrides taught{{{kLeftElbow, {"Hoof", {}}}, {kRightAnkle, {"Wheel", {}}}, {kLeftHand, {"LeftHand", {}}}}};
  EXPECT_EQ(
      testing::Message(FindJointMap(horse, "horse.bvh", &taught)),
      "the role left_hand has the joint 'LeftHand', which does not descend from 'LeftHand', the joint of the role "
      "left_wrist")
      << "taught joints are checked as well";

  const JointMapOverrides better{{{kLeftElbow, {"Hoof", {}}}, {kRightAnkle, {"Wheel", {}}}, {kHead, {"Head", {}}}}};
  ASSERT_OK(map, FindJointMap(horse, "horse.bvh", &better));
  ExpectNear(BodyAtRest(horse, *map)[kLeftElbow], {47, 137, 0});
  ExpectNear(BodyAtRest(horse, *map)[kHead], {0, 150, 0});
}

TEST(JointMap, RefusesATaughtHeadOrSpineThatIsPartOfALimb) {
  Skeleton person = testing::PersonSkeleton();
  person.joints[person.Find("Neck")].name = "Giraffe";  // the head needs a neck to hang from
  for (const auto& [role, joint] : {std::pair(kHead, "RightLeg"), std::pair(kSpine, "LeftUpLeg")}) {
    const JointMapOverrides taught{{{role, {joint, {}}}}};
    EXPECT_EQ(testing::Message(FindJointMap(person, "person.bvh", &taught)),
              std::string("the role ") + std::string(RoleName(role)) + " has the joint '" + joint +
                  "', which is part of a limb; allowed: a joint of the trunk, the neck or the head");
  }
}

}  // namespace
}  // namespace etude
