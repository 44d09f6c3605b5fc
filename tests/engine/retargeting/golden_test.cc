#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/angles.h"
#include "engine/retargeting/anatomy.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/markers.h"
#include "engine/retargeting/orientation.h"
#include "engine/retargeting/proportions.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/move.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/engine/retargeting/prints.h"
#include "tests/engine/retargeting/turned_bodies.h"
#include "tests/support/body_of_person.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void RemoveJoint(Skeleton& skeleton, const std::string& name) {
  const int gone = skeleton.Find(name);
  const int parent = skeleton.joints[gone].parent;
  for (Joint& joint : skeleton.joints) {
    if (joint.parent != gone) continue;
    joint.parent = parent;
    joint.rest.translation += skeleton.joints[gone].rest.translation;
  }
  skeleton.joints.erase(skeleton.joints.begin() + gone);
  for (Joint& joint : skeleton.joints) joint.parent -= joint.parent > gone;
}

/// A person as rigs have them: of any unit, up, names and build, some with fingers, some without tips or neck, some
/// with a knee that is not there, their left for their right, or built like nobody.
Skeleton OddPerson(testing::Dice& dice) {
  Skeleton person = testing::PersonSkeleton();
  const auto one_of = [&](int count) { return dice.Below(static_cast<std::size_t>(count)) == 0; };
  const double unit = std::array{1.0, 0.01, 10.0, 1 / 2.54, 0.45 / 2.54, 1 / 30.48, 7.0, 1.05}[dice.Below(8)];
  const double uneven = one_of(4) ? 0.1 : 0.03;
  for (Joint& joint : person.joints) joint.rest.translation *= unit * (1 + uneven * dice.Signed());
  const auto hang = [&](const std::string& name, const std::string& parent, const glm::dvec3& offset, bool is_end) {
    person.joints.push_back({name, person.Find(parent), {.translation = unit * offset}, is_end});
  };
  if (one_of(4)) {
    for (const double sign : {1.0, -1.0}) {
      const std::string side = sign > 0 ? "Left" : "Right";
      RemoveJoint(person, side + "Hand_End");
      hang(side + "HandThumb1", side + "Hand", {sign * 5, 0, 19}, true);
      hang(side + "HandRing1", side + "Hand", {sign * 10, 0, -3}, false);
      hang(side + "HandMiddle1", side + "Hand", {sign * 10, 0, 0}, false);
      hang("", side + "HandRing1", {sign * 8, 0, 0.05}, true);
      hang("", side + "HandMiddle1", {sign * 8, 0, 0}, true);
    }
  }
  if (one_of(6)) RemoveJoint(person, "Neck");
  if (one_of(6)) RemoveJoint(person, "Head_End");
  if (one_of(8)) RemoveJoint(person, "LeftToeBase_End"), RemoveJoint(person, "LeftToeBase");
  if (one_of(10)) RemoveJoint(person, "RightLeg");
  if (one_of(10)) RemoveJoint(person, "Spine");
  if (one_of(6)) hang("LeftTwist", "LeftArm", {9, 0, 0}, false);
  for (const char* loose : {"RightForeArm", "RightFoot", "LeftLeg", "LeftHand"}) {
    if (!one_of(15)) continue;
    Joint& joint = person.joints[person.Find(loose)];  // moved by a control of its own
    joint.rest.translation += unit * glm::dvec3(joint.name[0] == 'L' ? 20 : -20, 50, 0);
    joint.parent = 0;
  }
  if (one_of(6)) person.joints[person.Find("LeftLeg")].rest.translation *= 1.3 + dice.Signed();
  if (one_of(6)) {
    for (Joint& joint : person.joints) joint.rest.translation.x *= -1;
  }
  person.joints[0].rest.rotation = std::array{glm::dquat(1, 0, 0, 0),
                                              glm::dquat(1, 0, 0, 0),
                                              glm::dquat(1, 0, 0, 0),
                                              testing::Turn(kPi / 2, {1, 0, 0}),
                                              testing::Turn(kPi / 2, {0, 0, 1}),
                                              testing::Turn(kPi / 4, {1, 0, 0}),
                                              testing::Turn(2, {0, 1, 0}),
                                              dice.Rotation()}[dice.Below(8)];
  const std::uint32_t names = dice.Below(8);
  for (std::size_t i = 0; i < person.joints.size(); ++i) {
    std::string& name = person.joints[i].name;
    if (names == 1) name = "mixamorig:" + name;
    if (names == 2 || (names == 3 && dice.Below(12) == 0)) name = "Q" + std::to_string(i);
    if (names == 4) name += "_JNT";
    if (names == 6) name = (name.find("Arm") != std::string::npos || name == "Neck" ? "a:" : "b:") + name;
    if (names == 5 && name.ends_with("Leg")) name = name.starts_with("Left") ? "Leg.l" : "Leg.r";
  }
  return person;
}

/// Somebody who walks about and swings every limb; who may begin in a T-pose, lie, or grow.
Clip OddClip(testing::Dice& dice) {
  const Skeleton skeleton = OddPerson(dice);
  constexpr std::array kRates = {30.0, 24.0, 120.0, 59.94};
  Clip clip = testing::AtRest(skeleton, 1 + static_cast<int>(dice.Below(40)), kRates[dice.Below(4)]);
  const double stature = glm::length(skeleton.joints[0].rest.translation), wild = 0.35 * (1 + dice.Signed());
  const std::size_t still = dice.Below(3) == 0 ? dice.Below(4) : 0, grown = dice.Below(8);
  const glm::dvec3 way = 0.1 * stature * dice.Vector();
  std::vector<glm::dvec3> axes, phases;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    axes.push_back(dice.Vector());
    phases.push_back(dice.Vector());
  }
  for (std::size_t f = still; f < clip.frames.size(); ++f) {
    const double seconds = static_cast<double>(f) / clip.rate_hz;
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
      const double angle = wild * std::sin(5 * seconds + 3 * phases[i].x) + (still > 0 ? 0.5 : 0);
      LocalTransform& local = clip.frames[f][i];
      if (!skeleton.joints[i].is_end_site) local.rotation *= glm::angleAxis(angle, glm::normalize(axes[i]));
    }
    clip.frames[f][0].translation += seconds * way;
    if (grown == 0) clip.frames[f][0].scale = glm::dvec3(1.4);
    if (grown == 1) clip.frames[f][0].scale = glm::dvec3(1 + seconds);
    if (grown == 2) clip.frames[f][1].translation *= 1.1;
  }
  return clip;
}

void AddTo(Fingerprint& print, const JointMap& map) {
  for (const RolePoint& point : map.points) print.Add(point.joint).Add(point.offset);
  print.Add(map.composed).Add(map.by_anatomy).Add(map.confidence);
}

void AddTo(Fingerprint& print, const Clip& clip) {
  print.Add(clip.rate_hz);
  for (const Joint& joint : clip.skeleton.joints) print.Add(joint.parent).Add(joint.rest.translation);
  for (const LocalPose& frame : clip.frames) {
    for (const LocalTransform& local : frame) print.Add(local.translation).Add(local.rotation).Add(local.scale);
  }
}

struct OddPrints {
  Fingerprint maps, bodies, measures, rigs, words;  // words apart: as numbers they are large
};

void AddBody(OddPrints& prints, const Clip& clip, const JointMap& map, const BodyOptions& options) {
  const Result<BodyConversion> body = ToBodyMotion(clip, map, "odd.bvh", options);
  if (AddedError(prints.words, body)) return;
  prints.words.Add(body->unit).Add(body->note);
  prints.bodies.Add(body->metres_per_unit).Add(body->up).Add(body->floor).Add(body->dropped_frames);
  prints.bodies.Add(body->motion.rate_hz).Add(JointsOfAll(body->motion.poses));
  const RestBody measured = MeasureBody(clip, map, *body);
  for (const RestBody::Joint& joint : measured.joints) {
    prints.words.Add(joint.name);
    prints.measures.Add(joint.parent).Add(joint.position);
  }
  for (const RestBody::RolePlace& place : measured.roles) prints.measures.Add(place.joint).Add(place.position);
  prints.measures.Add(measured.Pose().joints);
  AddTo(prints.rigs, RigClip(body->motion, measured.Pose(), "rig"));
}

TEST(RetargetingGolden, OfOddPeople) {
  testing::Dice dice(3);
  OddPrints prints;
  int understood = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<Clip> clips = {OddClip(dice)};
    clips.push_back(clips[0]);
    clips[1].frames.erase(clips[1].frames.begin(), clips[1].frames.end() - 1);
    const Skeleton& skeleton = clips[0].skeleton;
    const PartialRoles roles = FindRolesInPart(skeleton);
    prints.maps.Add(roles.found).Add(roles.proposed).Add(roles.confidence).Add(FindNewRoot(skeleton));
    const Result<JointMap> map = FindJointMap(skeleton, "odd.bvh");
    if (AddedError(prints.words, map)) continue;
    ++understood;
    AddTo(prints.maps, *map);
    prints.maps.Add(testing::BodyAtRest(skeleton, *map).joints);
    prints.words.Add(WriteJointMapFile(skeleton, *map));
    AddBody(prints, clips[0], *map, {});
    BodyOptions told{.rate_hz = 50, .drop_t_pose = false};
    if (i % 3 == 0) told.metres_per_unit = 0.0102;
    if (i % 4 == 0) told.up = UpAxis::kZ;
    const std::optional<Ground> ground = FindGround(clips, *map, {.up = told.up});
    prints.bodies.Add(ground.has_value());
    if (ground) prints.bodies.Add(ground->up).Add(ground->floor).Add(ground->stature);
    if (ground && i % 2 == 0) told.floor = ground->floor, told.stature = ground->stature;
    AddBody(prints, clips[1], *map, told);
    prints.bodies.Add(UndoScales(clips, *map));
    AddTo(prints.measures, clips[0]);
  }
  EXPECT_GT(understood, 150);
  EXPECT_TRUE(prints.maps.Is(50577, -11987.4734453));
  EXPECT_TRUE(prints.bodies.Is(197833, -2036.66694152));
  EXPECT_TRUE(prints.measures.Is(1990788, -21154.7822066));
  EXPECT_TRUE(prints.words.Is(361250, -12508.6197197));
  EXPECT_TRUE(prints.rigs.Is(984945, -465.675182876));
}

/// A move that has gaps, as markers of a set.
MarkerMotion MarkersOfSet(const MarkerSet& set, const BodyMotion& motion, testing::Dice& dice, double unit) {
  MarkerMotion take{
      .rate_hz = 20, .names = {}, .frames = std::vector<std::vector<std::optional<glm::dvec3>>>(motion.poses.size())};
  const auto add = [&](const std::string& marker, Role role) {
    if (std::ranges::find(take.names, marker) != take.names.end()) return;
    take.names.push_back(marker);
    const glm::dvec3 off = 0.04 * dice.Vector();
    for (std::size_t f = 0; f < motion.poses.size(); ++f) {
      const glm::dvec3 place = unit * (motion.poses[f][role] + off);
      take.frames[f].push_back(f % 41 == dice.Below(41) ? std::nullopt : std::optional(place));
    }
  };
  for (const MarkerRule& rule : set.rules) {
    for (const std::string& marker : rule.markers) add(marker, rule.role);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (!set.pelvis[i].empty()) add(set.pelvis[i], i % 2 == 0 ? Role::kLeftHip : Role::kRightHip);
  }
  return take;
}

void AddTo(Fingerprint& print, const Result<std::vector<MarkerBody>>& bodies) {
  if (AddedError(print, bodies)) return;
  for (const MarkerBody& body : *bodies) {
    print.Add(body.name).Add(body.note).Add(body.motion.rate_hz).Add(JointsOfAll(body.motion.poses));
  }
}

TEST(RetargetingGolden, OfMarkersOfEverySet) {
  testing::Dice dice(4);
  const BodyMotion move = LoadBuiltinMove("side_kick").value().motion;
  Fingerprint print;
  for (const MarkerSet& set : MarkerSets()) {
    print.Add(set.name).Add(set.pelvis).Add(set.is_gait);
    for (const MarkerRule& rule : set.rules) print.Add(rule.role).Add(rule.markers);
    for (const double unit : {1.0, 10.0, 0.001, 5.0}) {
      MarkerMotion take = MarkersOfSet(set, move, dice, unit);
      AddTo(print, FindMarkerBodies(take, "a.trc"));
      for (std::string& name : take.names) name = "Ann:" + name;
      for (std::size_t f = 20; f < 42; ++f) take.frames[f][5 + f % 2].reset();  // over a second
      for (std::size_t f = 3; f < 6; ++f) take.frames[f][7] = glm::dvec3(0);
      take.remark = "as told";
      for (auto& frame : take.frames) {
        for (auto& place : frame) {
          if (place) *place = {place->x, -place->z, place->y};
        }
      }
      AddTo(print, FindMarkerBodies(take, "a.trc"));
      AddTo(print, FindMarkerBodies(take, "a.trc", 'Z'));
      AddTo(print, FindMarkerBodies(take, "a.trc", 'Y'));
      take.names[9] = "someone's";
      AddTo(print, FindMarkerBodies(take, "a.trc"));
      for (auto& frame : take.frames) frame[2].reset();
      AddTo(print, FindMarkerBodies(take, "a.trc"));
    }
  }
  EXPECT_TRUE(print.Is(485250, 13207.8414772));
}

TEST(RetargetingGolden, OfGapsOfASecondAndLonger) {
  const MarkerSet& own = MarkerSets().front();
  const BodyMotion move = LoadBuiltinMove("stretch").value().motion;
  for (const auto& [lost, kept] : {std::pair{20, 171u}, {21, 120u}}) {
    testing::Dice dice(5);
    MarkerMotion take = MarkersOfSet(own, move, dice, 1);
    for (auto& frame : take.frames) {
      for (auto& place : frame) place = place.value_or(glm::dvec3(1, 1, 1));
    }
    for (int f = 30; f < 30 + lost; ++f) take.frames[f][Index(Role::kLeftKnee)].reset();
    EXPECT_EQ(FindMarkerBodies(take, "a.trc")->front().motion.poses.size(), kept) << lost << " of 20 frames a second";
  }
}

TEST(RetargetingGolden, OfOtherBodiesLimbs) {
  Fingerprint print;
  testing::Dice dice(6);
  for (const char* name : {"jump", "side_kick", "robot"}) {
    BodyMotion motion = LoadBuiltinMove(name).value().motion;
    for (std::size_t f = 0; f < motion.poses.size(); f += 3) {
      for (glm::dvec3& joint : motion.poses[f].joints) joint += 0.03 * dice.Vector();
    }
    for (const double size : {1.3, 0.8, 0.0}) {
      BodyPose body = AtAttention();
      for (glm::dvec3& joint : body.joints) joint *= size;
      body[Role::kLeftKnee] += 0.1 * size * dice.Vector();
      body[Role::kRightAnkle] += 0.2 * size * dice.Vector();
      print.Add(JointsOfAll(Retarget(motion, body).poses));
    }
  }
  print.Add(Retarget({}, StandingPose()).poses.size());
  print.Add(JointsOfAll(Retarget({.rate_hz = 30, .poses = {BodyPose()}}, StandingPose()).poses));
  EXPECT_TRUE(print.Is(56253, -248.059639104));
}

TEST(RetargetingGolden, OfTurnsAndRigs) {
  testing::Dice dice(7);
  std::vector<glm::dvec3> vectors = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -1, 0}, {0, 0, -3}, {1e-9, 0, 0}};
  for (int i = 0; i < 5; ++i) vectors.push_back(dice.Vector());
  Fingerprint turns, rigs;
  for (const glm::dvec3& a : vectors) {
    for (const glm::dvec3& b : vectors) turns.Add(ShortestTurn(a, b)).Add(Orientation(a, b));
  }
  for (const char* name : {"jump", "aerobic", "boxing"}) {
    const BodyMotion motion = LoadBuiltinMove(name).value().motion;
    AddTo(rigs, RigClip(motion, AtAttention(), name));
    BodyPose pose = motion.poses[9];
    for (const Role role : {Role::kLeftKnee, Role::kRightElbow, Role::kHead, Role::kLeftFoot}) {
      pose[role] = pose[*ParentOf(role)];
      for (const LocalTransform& local : PoseRig(pose, StandingPose())) rigs.Add(local.translation).Add(local.rotation);
    }
  }
  EXPECT_TRUE(turns.Is(2592, 19.4124286101));
  EXPECT_TRUE(rigs.Is(63123, 69.8660108776));
}

TEST(RetargetingGolden, OfSidesThatAreTurnedAndSwapped) {
  Fingerprint print;
  const BodyMotion move = LoadBuiltinMove("boxing").value().motion;
  JointMap feetless;
  feetless.composed = {Role::kLeftFoot, Role::kRightFoot};
  for (double degrees = -60; degrees <= 60; degrees += 7.5) {
    for (const Role from : {Role::kLeftKnee, Role::kLeftElbow, Role::kLeftAnkle, Role::kLeftShoulder, Role::kSpine}) {
      std::vector<BodyPose> poses = move.poses;
      for (BodyPose& pose : poses) {
        const glm::dquat turn = glm::angleAxis(2 * Radians(degrees), glm::normalize(glm::dvec3(1, 0.2, 0)));
        pose = Turned(Turned(pose, from, turn), Mirrored(from), from == Role::kSpine ? glm::dquat(1, 0, 0, 0) : turn);
      }
      std::vector<BodyPose> mirrored = poses;
      for (BodyPose& pose : mirrored) {
        for (glm::dvec3& joint : pose.joints) joint.x *= -1;
      }
      for (const JointMap& map : {JointMap(), feetless}) {
        for (const auto& some : {poses, mirrored}) {
          const Result<double> overstretch = CheckSides(some, map, "b.bvh");
          if (!AddedError(print, overstretch)) print.Add(*overstretch);
        }
      }
    }
  }
  EXPECT_TRUE(print.Is(15857, 3385.62695679));
}

TEST(RetargetingGolden, OfTheAxisThatPointsUp) {
  Fingerprint print;
  testing::Dice dice(8);
  for (int i = 0; i < 120; ++i) {
    const glm::dquat at_rest = i % 3 == 0 ? glm::dquat(1, 0, 0, 0) : dice.Rotation(), moving = dice.Rotation();
    const double unit = std::array{1.0, 0.1, 100.0}[i % 3];
    const auto turned = [&](BodyPose pose, const glm::dquat& turn, const glm::dvec3& shift) {
      for (glm::dvec3& joint : pose.joints) joint = unit * (turn * joint + shift);
      return pose;
    };
    std::vector<BodyPose> poses;
    const glm::dvec3 way = dice.Vector();
    for (int f = 0; f < 6; ++f) poses.push_back(turned(StandingPose(), moving, 0.5 * f * way));
    const BodyPose rest = turned(StandingPose(), at_rest, {});
    print.Add(FindUpAxis(rest, poses)).Add(MeanBodyAxis(poses)).Add(BodyAxis(rest));
    print.Add(Upright(rest, UpAxis::kZ).joints).Add(Upright(way, UpAxis::kY));
  }
  print.Add(BodyAxis({})).Add(FindUpAxis({}, {}));
  EXPECT_TRUE(print.Is(8524, 2367.04166803));
}

TEST(RetargetingGolden, OfNamesAndMapFiles) {
  Fingerprint print;
  Skeleton named;
  for (const std::string& name : testing::Parts(
           "mixamorig:LeftArm^Character1_LeftArm^l_arm_JNT^LeftArm_09^LeftForeArm^ArmLeft^Arm.L^lArm^"
           "Bip01 L UpperArm^Épaule_G^E\xcc\x81paule_D^E\xcd\xafpaule_D^E\xcd\xb0paule_D^\xcc^Genou_D\xcc\x82^左腕^"
           "右ひじ^R_Knee_joint_2^rThigh^ns|a:RightLeg^Neck1^neck_01^Head^HeadTop_End^J_Bip_C_Neck^ARML^L^^Left^"
           "left arm bone^thumb_01_l^lthumb^hips^LeftARm^LeftArM^aLArm^LARm^E\xcc^armLX^leftArmB2")) {
    named.joints.push_back({.name = name, .parent = static_cast<int>(named.joints.size()) - 1, .rest = {}});
    print.Add(FingerOf(name)).Add(QuotedInYaml(name));
  }
  for (const char* name : {"LeftHandRing2", "Finger0", "Pinky", "index.r", "LittleFinger", "Middle1", "RHandThumb"}) {
    print.Add(FingerOf(name));
  }
  const JointNames names(named);
  const auto add = [&](const std::vector<NamedJoint>& found) {
    for (const NamedJoint& joint : found) print.Add(joint.joint).Add(joint.prefix).Add(joint.suffixes);
    print.Add(found.size());
  };
  for (const std::span<const LimbNames> schemes : {ArmSchemes(), LegSchemes()}) {
    for (const LimbNames& scheme : schemes) {
      for (const std::string_view joint : scheme.joints) {
        print.Add(joint).Add(scheme.language);
        for (const Side side : {Side::kLeft, Side::kRight}) add(names.Find(joint, side, scheme.language));
      }
    }
  }
  for (const std::string_view name : NeckNames()) add(names.Find(name));
  for (const std::string_view name : HeadNames()) add(names.Find(name));
  const std::string roles = "roles:\n  left_shoulder: LShldr\n  head: \"Head_End\"\n";
  for (const std::string& part : testing::Parts(
           "+^+unit: cm\nup: z\nrate: 120\n^+unit: cmu\nup: y\n^+unit: 0.3\n^+unit: 0\n^+unit: miles\n^+up: x\n^"
           "+rate: 0\n^+rate: 1e6\n^+unit: ft\n^+unit: in\n^+unit: mm\n^+unit: m\n^+unit: -1\n^"
           "roles:\n  left_sholder: a\n^roles:\n  head: [a]\n^up: z\n^roles: 3\n^^rols:\n  head: a\n^+rate: fast\n^"
           "roles:\n  head: ''\n")) {
    const std::string text = part.starts_with('+') ? roles + part.substr(1) : part;
    const auto taught = ReadJointMapFile(text, "map.yaml");
    if (AddedError(print, taught)) continue;
    for (const auto& [role, joint] : taught->joints) {
      print.Add(role).Add(joint.name).Add(joint.place.line).Add(joint.place.column);
    }
    print.Add(taught->metres_per_unit).Add(taught->up).Add(taught->rate_hz);
    const auto map = FindJointMap(testing::PersonSkeleton(), "person.bvh", &*taught);
    if (!AddedError(print, map)) AddTo(print, *map);
  }
  EXPECT_TRUE(print.Is(7573, 643.142127771));
}

}  // namespace
}  // namespace etude
