#include "engine/kinematics/start_angles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/kinematics/euler.h"

namespace etude {
namespace {

using enum Role;

constexpr double kStraight = Radians(3);  // limbs nearer to one line give no normal
constexpr double kSmallestLength = 1e-6;  // metres
const glm::dvec3 kAlong(0, 0, 1);         // every limb, in its own frame

// The way each limb of the tree runs on the canonical body, in the order of BodyTreeJoint.
struct LimbRow {
  Role from, to;
  // The next limb, when a hinge between the two gives this limb's twist, and which way that hinge bends about X.
  BodyTreeJoint hinge = kTreeLeftToe;
  int bends = 0;
};
constexpr std::array<LimbRow, kBodyTreeJointCount> kLimbs = {{
    {kLeftFoot, kLeftAnkle},
    {kLeftAnkle, kLeftKnee},
    {kLeftKnee, kLeftHip},
    {kLeftHip, kRightHip},
    {kHipCentre, kShoulderCentre},
    {kLeftShoulder, kLeftElbow, kTreeLeftElbow, +1},
    {kLeftElbow, kLeftWrist},
    {kLeftWrist, kLeftHand},
    {kRightShoulder, kRightElbow, kTreeRightElbow, +1},
    {kRightElbow, kRightWrist},
    {kRightWrist, kRightHand},
    {kShoulderCentre, kHead},
    {kRightHip, kRightKnee, kTreeRightKnee, -1},
    {kRightKnee, kRightAnkle},
    {kRightAnkle, kRightFoot},
}};

using Directions = std::array<glm::dvec3, kBodyTreeJointCount>;

std::optional<Directions> FindDirections(const BodyPose& joints) {
  Directions directions;
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    const glm::dvec3 limb = joints[kLimbs[i].to] - joints[kLimbs[i].from];
    const double length = glm::length(limb);
    if (!std::isfinite(length) || length < kSmallestLength) return std::nullopt;
    directions[i] = limb / length;
  }
  return directions;
}

// The left foot's frame, whose X axis is that of the hinges at ankle and knee.
std::optional<glm::dmat3> FindRootFrame(const Directions& directions) {
  // Both hinges turn about +X by positive angles from foot to thigh; a cross product weighs each normal by the sine of
  // its angle, which is how well it is known.
  glm::dvec3 normal = glm::cross(directions[kTreeLeftAnkle], directions[kTreeLeftToe] + directions[kTreeLeftKnee]);
  if (glm::length(normal) < std::sin(kStraight)) {
    // Toe, ankle, knee and hip in one line (a leap, a stand on the very toes): then the hips tell what is right.
    const glm::dvec3& along = directions[kTreeLeftKnee];
    normal = directions[kTreeLeftHip] - glm::dot(directions[kTreeLeftHip], along) * along;
  }
  if (glm::length(normal) < std::sin(kStraight)) return std::nullopt;
  const glm::dvec3 x = glm::normalize(normal);
  // A foot along X cannot be: it would be normal to the shank and to the plane of the leg at once.
  if (std::abs(glm::dot(directions[kTreeLeftToe], x)) > std::cos(kStraight)) return std::nullopt;
  const glm::dvec3 z = UnitNormalPart(directions[kTreeLeftToe], x);
  return glm::dmat3(x, glm::cross(z, x), z);
}

// Where the limb's X axis shall point, if anything tells.
std::optional<glm::dvec3> FindTwist(int limb, const Directions& directions, const BodyPose& joints) {
  glm::dvec3 x(0);
  if (limb == kTreeLeftHip) {
    x = glm::cross(directions[kTreeNavel], directions[kTreeLeftHip]);
  } else if (limb == kTreeNavel) {
    x = joints[kRightShoulder] - joints[kLeftShoulder];
  } else if (kLimbs[limb].bends != 0) {
    x = static_cast<double>(kLimbs[limb].bends) * glm::cross(directions[limb], directions[kLimbs[limb].hinge]);
  }
  const glm::dvec3 across = glm::cross(directions[limb], x);
  const bool is_known = glm::length(across) > (kLimbs[limb].bends != 0 ? std::sin(kStraight) : kSmallestLength);
  if (!is_known) return std::nullopt;
  return x;
}

// The angles of a joint that turn its limb from `base` into `direction`, its X axis near `x` if it has three.
glm::dvec3 AnglesTowards(const glm::dmat3& base, int dof_count, const glm::dvec3& direction,
                         const std::optional<glm::dvec3>& x) {
  const glm::dvec3 local = glm::transpose(base) * direction;
  if (dof_count == 1) return {std::atan2(-local.y, local.z), 0, 0};
  if (dof_count == 2) return {std::atan2(-local.y, local.z), std::asin(std::clamp(local.x, -1.0, 1.0)), 0};
  glm::dmat3 frame = SmallestRotation(kAlong, local);
  if (x) {
    frame[0] = UnitNormalPart(glm::transpose(base) * *x, local);
    frame = {frame[0], glm::cross(local, frame[0]), local};
  }
  return AnglesXyz(frame);
}

}  // namespace

std::optional<TreeState> FindStartState(const KinematicTree& body, const BodyPose& joints,
                                        std::span<const AngleRange> limits) {
  assert(body.joints.size() == kBodyTreeJointCount && limits.size() == body.limits.size());
  const std::optional<Directions> directions = FindDirections(joints);
  if (!directions) return std::nullopt;
  const std::optional<glm::dmat3> root = FindRootFrame(*directions);
  if (!root) return std::nullopt;

  TreeState state{joints[kLeftFoot], *root, std::vector<double>(limits.size(), 0.0)};
  std::array<glm::dmat3, kBodyTreeJointCount> frames;
  frames[kTreeLeftToe] = *root;
  for (int i = 1; i < kBodyTreeJointCount; ++i) {
    const TreeJoint& joint = body.joints[i];
    const glm::dmat3 base = frames[joint.parent] * joint.rest;
    glm::dvec3 angles = AnglesTowards(base, joint.dof_count, (*directions)[i], FindTwist(i, *directions, joints));
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      const AngleRange& range = limits[joint.first_dof + axis];
      angles[axis] = ClampAngle(angles[axis], range);
      state.angles[joint.first_dof + axis] = angles[axis];
    }
    frames[i] = base * RotationXyz(angles);
  }
  return state;
}

IkProblem MakeImageProblem(const KinematicTree& body, const LimbObservation& observation, const TreeState& start) {
  IkProblem problem{start, {}, body.limits};
  const TreeFrames frames = ComputeFrames(body, start);
  for (std::size_t e = 0; e < body.effectors.size(); ++e) {
    const Role role = body.effectors[e].role;
    const glm::dvec3 seen = glm::normalize(observation.directions[Index(role)]);
    const glm::dmat3& axes = frames.effectors[e].axes;
    EffectorTarget target;
    target.position = observation.ends[role];
    target.axes = SmallestRotation(axes[2], seen) * axes;
    target.axis_weights = {0, 0, 1};
    problem.targets.push_back(target);
  }
  return problem;
}

}  // namespace etude
