#include "engine/retargeting/proportions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"
#include "engine/base/smoothstep.h"
#include "engine/retargeting/limb_finder.h"
#include "engine/retargeting/rig.h"

namespace etude {
namespace {

constexpr double kStill = Radians(0.02);

bool IsTurned(const glm::dquat& a, const glm::dquat& b) {
  const double half =
      glm::length(glm::dvec3((glm::conjugate(a) * b).x, (glm::conjugate(a) * b).y, (glm::conjugate(a) * b).z));
  return half > std::sin(0.5 * kStill);
}

// The joints of a skeleton, as measured in a clip's frames.
struct Measured {
  LocalPose rest;           // each joint's mean translation and, if its rotation is constant, that rotation
  std::vector<bool> turns;  // true for the joints that rotate
};

// Measures the skeleton in the frames from `first` on.
Measured Measure(const Clip& clip, std::size_t first) {
  const std::size_t count = clip.skeleton.joints.size();
  Measured measured{RestPose(clip.skeleton), std::vector<bool>(count)};
  std::vector<glm::dvec3> sums(count, glm::dvec3(0));
  const LocalPose& begin = clip.frames[first];
  for (std::size_t k = first; k < clip.frames.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      sums[i] += clip.frames[k][i].translation;
      if (!measured.turns[i]) measured.turns[i] = IsTurned(begin[i].rotation, clip.frames[k][i].rotation);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    measured.rest[i].scale = begin[i].scale;
    if (clip.skeleton.joints[i].parent < 0) continue;
    measured.rest[i].translation = sums[i] / static_cast<double>(clip.frames.size() - first);
    if (!measured.turns[i]) measured.rest[i].rotation = begin[i].rotation;
  }
  return measured;
}

/// Returns true if every role's joint is the hip centre's joint or a descendant of that joint.
bool DescendsFromPelvis(const RestBody& rest) {
  const int pelvis = rest.roles[Index(Role::kHipCentre)].joint;
  return std::ranges::all_of(rest.roles, [&](const RestBody::RoleAnchor& role) {
    int joint = role.joint;
    while (joint >= 0 && joint != pelvis) joint = rest.joints[joint].parent;
    return joint == pelvis;
  });
}

using enum Role;

/// Returns the sum of the lengths of thigh and shank.
double LegLength(const BodyPose& pose, const Limb& leg) {
  const auto [hip, knee, ankle] = leg.roles;
  return glm::distance(pose[hip], pose[knee]) + glm::distance(pose[knee], pose[ankle]);
}

/// Returns the mean length of both legs.
double LegLength(const BodyPose& pose) {
  double sum = 0;
  for (const Limb& leg : kLegs) sum += LegLength(pose, leg);
  return sum / kLegs.size();
}

/// Returns the median length of the legs over the frames, because measured lengths vary.
double UsualLegLength(const BodyMotion& motion) {
  std::vector<double> lengths;
  for (const BodyPose& pose : motion.poses) lengths.push_back(LegLength(pose));
  return UpperMedian(std::move(lengths));
}

/// Returns the vector from `role`'s parent to `role`, with the target body's length and the performer's direction.
glm::dvec3 NewLimb(const BodyPose& performer, const BodyPose& body, Role role) {
  const Role parent = *ParentOf(role);
  const glm::dvec3 limb = performer[role] - performer[parent], own = body[role] - body[parent];
  const double length = glm::length(limb);
  return length > 0 ? limb * (glm::length(own) / length) : own;
}

/// Returns the performer's pose with the target body's limb lengths and with the hip centre at its scaled position.
BodyPose WithNewLimbs(const BodyPose& performer, const BodyPose& body, double scale) {
  BodyPose pose;
  pose[kHipCentre] = scale * performer[kHipCentre];
  for (const Role role : AllRoles()) {
    if (role != kHipCentre) pose[role] = pose[*ParentOf(role)] + NewLimb(performer, body, role);
  }
  return pose;
}

/// Returns how far the hips must be lowered for the leg to reach `ankle`, metres. The result decreases for toes 5 to 15
/// cm above the floor, and is 0 for higher toes.
double NeededDrop(const BodyPose& pose, const Limb& leg, const glm::dvec3& ankle, double toe_height) {
  constexpr double kStands = 0.05, kFlies = 0.15;  // height of the toes above the floor, metres
  const double stands = 1 - Smoothstep(kStands, kFlies, toe_height);
  const double reach = LegLength(pose, leg);
  const glm::dvec3 hip = pose[leg.roles[0]];
  const double aside = std::hypot(hip.x - ankle.x, hip.z - ankle.z);
  const double highest = ankle.y + std::sqrt(std::max(0.0, reach * reach - aside * aside));
  return stands * std::max(0.0, hip.y - highest);
}

/// Returns the side of the line from hip to ankle (`along`) on which the knee lies: a unit vector perpendicular to
/// `along`, found from the thigh's direction. For a straight leg, returns the direction in front of the hips.
glm::dvec3 KneeSide(const BodyPose& pose, const glm::dvec3& thigh, const glm::dvec3& along) {
  constexpr double kStraight = 0.02, kBent = 0.08;  // offset of the knee from the line, in thigh lengths
  const double length = glm::length(thigh);
  const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, along) * along; };
  const auto unit = [](const glm::dvec3& v) { return glm::length(v) > 0 ? glm::normalize(v) : glm::dvec3(0); };
  const glm::dvec3 seen = across(thigh);
  const glm::dvec3 front = across(glm::cross(along, pose[kLeftHip] - pose[kRightHip]));
  const double trust = Smoothstep(kStraight * length, kBent * length, glm::length(seen));
  return unit(glm::mix(unit(front), unit(seen), trust));
}

/// Solves two-bone inverse kinematics: brings the ankle to `wanted`, or as near as the leg reaches, and keeps the knee
/// on the same side of the leg. The foot keeps its slope.
void Reach(BodyPose& pose, const Limb& leg, const glm::dvec3& wanted) {
  constexpr double kThere = 1e-9;
  const auto [hip, knee, ankle] = leg.roles;
  if (glm::distance(pose[ankle], wanted) < kThere) return;
  const glm::dvec3 thigh = pose[knee] - pose[hip], foot = pose[leg.tip] - pose[ankle];
  const double upper = glm::length(thigh), lower = glm::distance(pose[knee], pose[ankle]);

  const glm::dvec3 way = wanted - pose[hip];
  const double distance = std::clamp(glm::length(way), std::abs(upper - lower), upper + lower);
  const glm::dvec3 down(0, -1, 0);
  const glm::dvec3 along = glm::length(way) > 0 ? glm::normalize(way) : upper > 0 ? glm::normalize(thigh) : down;
  const glm::dvec3 side = KneeSide(pose, ShortestTurn(pose[ankle] - pose[hip], way) * thigh, along);

  // The law of cosines gives the angle at the hip.
  const double cosine =
      upper * distance > 0 ? (upper * upper + distance * distance - lower * lower) / (2 * upper * distance) : 0;
  const double c = std::clamp(cosine, -1.0, 1.0);
  pose[knee] = pose[hip] + upper * (c * along + std::sqrt(1 - c * c) * side);
  pose[ankle] = pose[hip] + distance * along;
  pose[leg.tip] = pose[ankle] + foot;
}

void ShiftDown(BodyPose& pose, double drop) {
  for (glm::dvec3& joint : pose.joints) joint.y -= drop;
}

}  // namespace

RestBody MeasureBody(const Clip& clip, const JointMap& map, const BodyConversion& body) {
  const Measured measured = Measure(clip, std::min(body.dropped_frames, clip.frames.size() - 1));
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, measured.rest, globals);
  BodyPose pose = Upright(Evaluate(map, globals), body.up);
  const FloorMove ahead{.yaw = -Heading(pose)};
  const auto in_world = [&](const glm::dvec3& upright) { return body.metres_per_unit * ahead.Apply(upright); };

  // Keep the joints that rotate; others are merged into their parents.
  RestBody rest;
  std::vector<int> index(globals.size());  // for each joint of the skeleton: the body's joint with which it moves
  for (std::size_t i = 0; i < globals.size(); ++i) {
    const Joint& joint = clip.skeleton.joints[i];
    if (joint.parent >= 0 && !measured.turns[i]) {
      index[i] = index[joint.parent];
      continue;
    }
    index[i] = static_cast<int>(rest.joints.size());
    rest.joints.push_back({.name = joint.name,
                           .parent = joint.parent < 0 ? -1 : index[joint.parent],
                           .position = in_world(Upright(globals[i].position, body.up))});
  }
  for (const Role role : AllRoles()) rest.roles[Index(role)] = {index[map[role].joint], in_world(pose[role])};
  return DescendsFromPelvis(rest) ? rest : RestBodyOf(body.motion.poses);
}

BodyMotion Retarget(const BodyMotion& motion, const BodyPose& body) {
  BodyMotion retargeted{.rate_hz = motion.rate_hz, .poses = {}};
  if (motion.poses.empty()) return retargeted;
  const double usual = UsualLegLength(motion);
  const double scale = usual > 0 ? LegLength(body) / usual : 1;
  for (const BodyPose& performer : motion.poses) {
    BodyPose pose = WithNewLimbs(performer, body, scale);
    // Move the toes to their scaled positions, because toes touch the floor and must not slide. Feet keep their slope.
    std::array<glm::dvec3, kLegs.size()> ankles;
    double drop = 0;
    for (std::size_t i = 0; i < kLegs.size(); ++i) {
      const Limb& leg = kLegs[i];
      const glm::dvec3 toe = scale * performer[leg.tip];
      ankles[i] = toe - (pose[leg.tip] - pose[leg.roles[2]]);
      drop = std::max(drop, NeededDrop(pose, leg, ankles[i], toe.y));
    }
    ShiftDown(pose, drop);
    for (std::size_t i = 0; i < kLegs.size(); ++i) Reach(pose, kLegs[i], ankles[i]);
    retargeted.poses.push_back(pose);
  }
  return retargeted;
}

}  // namespace etude
