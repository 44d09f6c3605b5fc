#include "engine/kinematics/capture_body.h"

#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

using enum Role;

// Returns the point of the tree for every role. Every point except that of the spine is an end of a limb.
std::array<TreePoint, kRoleCount> PaperRoles(const KinematicTree& tree, const LimbLengths& lengths) {
  std::array<TreePoint, kRoleCount> roles;
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    roles[Index(BodyTreeLimbs()[i].from)] = {static_cast<int>(i), glm::dvec3(0)};
  }
  for (const Effector& effector : tree.effectors) {
    roles[Index(BodyTreeLimbs()[effector.joint].to)] = {effector.joint, effector.p_LE};
  }
  roles[Index(kSpine)] = {kTreeNavel, {0, 0, kSpineShare * lengths.trunk}};
  return roles;
}

glm::dvec3 PositionOf(const TreePoint& point, const TreeFrames& frames) {
  const LimbFrame& X_WL = frames.joints[point.joint];
  return X_WL.position + X_WL.axes * point.p_LQ;
}

}  // namespace

CaptureBody PaperBody(const LimbLengths& lengths) {
  CaptureBody body;
  body.is_paper = true;
  body.tree = MakeBodyTree(lengths);
  body.roles = PaperRoles(body.tree, lengths);
  for (const Effector& effector : body.tree.effectors) {
    body.ends.push_back({.role = BodyTreeLimbs()[effector.joint].to, .has_direction = true});
  }
  body.lengths = lengths;
  const BodyPose standing = ToBodyPose(body, StandingState(body.tree));
  body.is_rigid.fill(true);
  for (const Bone& bone : AllBones()) body.bones[Index(bone.child)] = BoneLength(standing, bone);
  return body;
}

BodyPose ToBodyPose(const CaptureBody& body, const TreeFrames& frames) {
  BodyPose pose;
  for (const Role role : AllRoles()) pose[role] = PositionOf(body.roles[Index(role)], frames);
  if (body.hips_turn) pose[kHipCentre] = 0.5 * (pose[kLeftHip] + pose[kRightHip]);
  return pose;
}

BodyPose ToBodyPose(const CaptureBody& body, const TreeState& state) {
  return ToBodyPose(body, ComputeFrames(body.tree, state));
}

IkProblem MakeImageProblem(const CaptureBody& body, const LimbObservation& observation, const TreeState& start) {
  IkProblem problem{start, {}, body.tree.limits};
  const TreeFrames frames = ComputeFrames(body.tree, start);
  for (std::size_t e = 0; e < body.ends.size(); ++e) {
    const std::size_t role = Index(body.ends[e].role);
    const glm::dvec3 seen = body.ends[e].sense * glm::normalize(observation.directions[role]);
    const glm::dmat3& R_WE = frames.effectors[e].axes;
    const bool counts = body.ends[e].has_direction && !observation.lacks_direction[role];
    EffectorTarget target;
    target.position = observation.ends[body.ends[e].role];
    target.axes = SmallestRotation(R_WE[2], seen) * R_WE;
    target.position_weight = body.ends[e].has_position && !observation.lacks_end[role] ? 1 : 0;
    target.axis_weights = {0, 0, counts ? 1.0 : 0.0};
    problem.targets.push_back(target);
  }
  return problem;
}

Clip ToClip(const CaptureBody& body, std::span<const TreeState> states, double rate_hz, const std::string& name) {
  if (body.is_paper) return ToClip(body.tree, states, rate_hz, name);
  Clip clip{.name = name, .skeleton = {}, .rate_hz = rate_hz, .frames = {}};
  for (const CaptureBody::ClipJoint& joint : body.skeleton) {
    clip.skeleton.joints.push_back({joint.name, joint.parent, {.translation = joint.offset}, joint.is_end});
  }
  TreeFrames frames;
  std::vector<glm::dquat> R_WC(body.skeleton.size());
  for (const TreeState& state : states) {
    ComputeFrames(body.tree, state, frames);
    LocalPose& pose = clip.frames.emplace_back();
    for (std::size_t i = 0; i < body.skeleton.size(); ++i) {
      const CaptureBody::ClipJoint& joint = body.skeleton[i];
      R_WC[i] = glm::normalize(glm::quat_cast(frames.joints[joint.limb].axes * joint.R_LC));
      if (joint.parent < 0) {
        pose.push_back({PositionOf(body.skeleton_root, frames), R_WC[i]});
      } else {
        pose.push_back({joint.offset, glm::conjugate(R_WC[joint.parent]) * R_WC[i]});
      }
    }
  }
  return clip;
}

}  // namespace etude
