#include "engine/retargeting/measure_body.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kStill = Radians(0.02);

bool IsTurned(const glm::dquat& a, const glm::dquat& b) {
  const double half =
      glm::length(glm::dvec3((glm::conjugate(a) * b).x, (glm::conjugate(a) * b).y, (glm::conjugate(a) * b).z));
  return half > std::sin(0.5 * kStill);
}

// A skeleton as the clip has it: what it never moves is where it always is.
struct Measured {
  LocalPose rest;
  std::vector<bool> turns;
};

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

/// True if every role's joint is the hip centre's or below it.
bool HangsOnPelvis(const RestBody& rest) {
  const int pelvis = rest.roles[Index(Role::kHipCentre)].joint;
  return std::ranges::all_of(rest.roles, [&](const RestBody::RolePlace& role) {
    int joint = role.joint;
    while (joint >= 0 && joint != pelvis) joint = rest.joints[joint].parent;
    return joint == pelvis;
  });
}

}  // namespace

RestBody MeasureBody(const Clip& clip, const JointMap& map, const BodyConversion& body) {
  const Measured measured = Measure(clip, std::min(body.dropped_frames, clip.frames.size() - 1));
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, measured.rest, globals);
  BodyPose pose = Upright(Evaluate(map, globals), body.up);
  const FloorMove ahead{.yaw = -Heading(pose)};
  const auto in_world = [&](const glm::dvec3& upright) { return body.metres_per_unit * ahead.Apply(upright); };

  RestBody rest;
  std::vector<int> index(globals.size());  // of the body's joint that carries each of the skeleton's
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
  return HangsOnPelvis(rest) ? rest : RestBodyOf(body.motion.poses);
}

}  // namespace etude
