// The golden value of the retargeting pipeline: people of any rig, from their joints' names to a body and back to a
// rig. The other tests of this folder check that results are right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ranges>

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
#include "tests/engine/retargeting/turned_bodies.h"
#include "tests/support/body_of_person.h"
#include "tests/support/fingerprint.h"
#include "tests/support/kept_lines.h"

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

/// Returns a person as rigs have them: any unit, up axis, names and proportions; some have fingers, some lack tips or
/// neck; some lack a knee, exchange left and right, or have impossible proportions.
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
    Joint& joint = person.joints[person.Find(loose)];  // moved by a control joint of its own
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

/// Returns a person who walks and swings every limb, and may begin in a T-pose, lie, or grow.
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

void AddBody(Fingerprint& print, const Clip& clip, const JointMap& map, const BodyConversion& body) {
  print.Add(body.metres_per_unit).Add(body.up).Add(body.floor).Add(body.dropped_frames).Add(body.motion.rate_hz);
  print.Add(body.motion.poses | std::views::transform(&BodyPose::joints));
  const RestBody measured = MeasureBody(clip, map, body);
  for (const RestBody::Joint& joint : measured.joints) print.Add(joint.parent).Add(joint.position);
  for (const RestBody::RoleAnchor& place : measured.roles) print.Add(place.joint).Add(place.position);
  for (const LocalPose& frame : RigClip(body.motion, measured.Pose(), "rig").frames) {
    for (const LocalTransform& local : frame) print.Add(local.translation).Add(local.rotation).Add(local.scale);
  }
}

TEST(RetargetingGolden, OfOddPeople) {
  testing::Dice dice(3);
  Fingerprint print;
  std::vector<std::string> told;
  int understood = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Clip> clips = {OddClip(dice)};
    clips.push_back(clips[0]);
    clips[1].frames.erase(clips[1].frames.begin(), clips[1].frames.end() - 1);
    const Skeleton& skeleton = clips[0].skeleton;
    const PartialRoles roles = FindPartialRoles(skeleton);
    print.Add(roles.found).Add(roles.proposed).Add(roles.confidence).Add(FindNewRoot(skeleton));
    const Result<JointMap> map = FindJointMap(skeleton, fmt::format("{}.bvh", i));
    if (!map) told.push_back(ToString(map.error()));
    if (!map) continue;
    ++understood;
    for (const RolePoint& point : map->points) print.Add(point.joint).Add(point.offset);
    print.Add(map->composed).Add(map->by_anatomy).Add(map->confidence);
    BodyOptions asked{.rate_hz = 50, .drop_t_pose = false};
    if (i % 3 == 0) asked.metres_per_unit = 0.0102;
    if (i % 4 == 0) asked.up = UpAxis::kZ;
    const std::optional<Ground> ground = FindGround(clips, *map, {.up = asked.up});
    print.Add(ground.has_value());
    if (ground) print.Add(ground->up).Add(ground->floor).Add(ground->stature);
    if (ground && i % 2 == 0) asked.floor = ground->floor, asked.stature = ground->stature;
    for (const auto& [clip, options] : {std::pair(&clips[0], BodyOptions()), {&clips[1], asked}}) {
      const Result<BodyConversion> body = ToBodyMotion(*clip, *map, fmt::format("{}.bvh", i), options);
      told.push_back(body ? fmt::format("{}.bvh: {}; {}", i, body->unit, body->Note()) : ToString(body.error()));
      if (body) AddBody(print, *clip, *map, *body);
    }
    print.Add(UndoScales(clips, *map));
  }
  EXPECT_GT(understood, 75);
  EXPECT_TRUE(print.Is(583465, 7661.26153742));
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/retargeting/odd_people.txt"));
}

/// Returns the markers of `set` that follow the joints of `motion`, with random offsets and gaps.
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

TEST(FindMarkerBodies, DropsGapsOfMoreThanASecond) {
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

}  // namespace
}  // namespace etude
