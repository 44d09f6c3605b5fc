#include "engine/kinematics/start_angles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

using enum Role;

constexpr double kStraight = Radians(3);  // if two limbs are this close to one line, they define no normal
constexpr double kMinLengthM = 1e-6;
const glm::dvec3 kAlong(0, 0, 1);  // every limb points along this direction in its own frame

// A limb whose rotation about its own Z axis is determined by the axis of the hinge at its far end.
struct TwistHinge {
  BodyTreeJoint limb, hinge;
  double bends;  // sign of the rotation about X by which the hinge bends
};
constexpr std::array<TwistHinge, 3> kTwistHinges = {{{kTreeLeftShoulder, kTreeLeftElbow, +1},
                                                     {kTreeRightShoulder, kTreeRightElbow, +1},
                                                     {kTreeRightHip, kTreeRightKnee, -1}}};

using Directions = std::array<glm::dvec3, kBodyTreeJointCount>;  // unit vectors along the limbs, in the world

std::optional<Directions> FindDirections(const BodyPose& joints) {
  Directions directions;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const BodyTreeLimb& ends = BodyTreeLimbs()[i];
    const glm::dvec3 limb = joints[ends.to] - joints[ends.from];
    const double length = glm::length(limb);
    if (!std::isfinite(length) || length < kMinLengthM) return std::nullopt;
    directions[i] = limb / length;
  }
  return directions;
}

// Returns R_WL of the left foot's limb, whose X axis is the common axis of the hinges at ankle and knee.
std::optional<glm::dmat3> FindRootFrame(const Directions& directions) {
  // Both hinges have positive angles about +X when the leg bends. Each cross product is proportional to the sine of a
  // hinge's angle, which weights the normals by their accuracy.
  glm::dvec3 normal = glm::cross(directions[kTreeLeftAnkle], directions[kTreeLeftToe] + directions[kTreeLeftKnee]);
  if (glm::length(normal) < std::sin(kStraight)) {
    // If toe, ankle, knee and hip lie on one line (in a leap, or on the toes), use the hip line instead.
    const glm::dvec3& along = directions[kTreeLeftKnee];
    normal = directions[kTreeLeftHip] - glm::dot(directions[kTreeLeftHip], along) * along;
  }
  if (glm::length(normal) < std::sin(kStraight)) return std::nullopt;
  const glm::dvec3 x = glm::normalize(normal);
  // Give up if the foot points along X, the hinges' axis: no hinge angle brings it there.
  if (std::abs(glm::dot(directions[kTreeLeftToe], x)) > std::cos(kStraight)) return std::nullopt;
  const glm::dvec3 z = UnitNormalPart(directions[kTreeLeftToe], x);
  return glm::dmat3(x, glm::cross(z, x), z);
}

// Returns the desired X axis of a limb in the world, or nullopt if no neighbouring limb defines it.
std::optional<glm::dvec3> FindTwist(int limb, const Directions& directions, const BodyPose& joints) {
  const auto next = std::ranges::find(kTwistHinges, limb, &TwistHinge::limb);
  glm::dvec3 x(0);
  if (limb == kTreeLeftHip) {
    x = glm::cross(directions[kTreeNavel], directions[kTreeLeftHip]);
  } else if (limb == kTreeNavel) {
    x = joints[kRightShoulder] - joints[kLeftShoulder];
  } else if (next != kTwistHinges.end()) {
    x = next->bends * glm::cross(directions[limb], directions[next->hinge]);
  }
  const glm::dvec3 across = glm::cross(directions[limb], x);
  const bool is_known = glm::length(across) > (next != kTwistHinges.end() ? std::sin(kStraight) : kMinLengthM);
  if (!is_known) return std::nullopt;
  return x;
}

// Returns the angles that point the limb along `direction_W`. If the joint has three angles, they also turn the limb's
// X axis as near as possible to `x_W`.
glm::dvec3 AnglesTowards(const glm::dmat3& R_WJ, int dof_count, const glm::dvec3& direction_W,
                         const std::optional<glm::dvec3>& x_W) {
  const glm::dvec3 z_J = glm::transpose(R_WJ) * direction_W;
  if (dof_count == 1) return {std::atan2(-z_J.y, z_J.z), 0, 0};
  if (dof_count == 2) return {std::atan2(-z_J.y, z_J.z), std::asin(std::clamp(z_J.x, -1.0, 1.0)), 0};
  glm::dmat3 R_JL = SmallestRotation(kAlong, z_J);
  if (x_W) {
    R_JL[0] = UnitNormalPart(glm::transpose(R_WJ) * *x_W, z_J);
    R_JL = {R_JL[0], glm::cross(z_J, R_JL[0]), z_J};
  }
  return AnglesXyz(R_JL);
}

}  // namespace

std::optional<TreeState> FindStartState(const KinematicTree& body, const BodyPose& joints,
                                        std::span<const AngleRange> limits) {
  assert(body.joints.size() == kBodyTreeJointCount && limits.size() == body.limits.size());
  const std::optional<Directions> directions = FindDirections(joints);
  if (!directions) return std::nullopt;
  const std::optional<glm::dmat3> root = FindRootFrame(*directions);
  if (!root) return std::nullopt;

  // From the root outwards, compute the angles of each joint from the actual axes of its parent.
  TreeState state{joints[kLeftFoot], *root, std::vector<double>(limits.size(), 0.0)};
  std::array<glm::dmat3, kBodyTreeJointCount> R_WL;
  R_WL[kTreeLeftToe] = *root;
  for (int i = 1; i < kBodyTreeJointCount; ++i) {
    const TreeJoint& joint = body.joints[i];
    const glm::dmat3 R_WJ = R_WL[joint.parent] * joint.R_PJ;
    glm::dvec3 angles = AnglesTowards(R_WJ, joint.dof_count, (*directions)[i], FindTwist(i, *directions, joints));
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      const AngleRange& range = limits[joint.first_dof + axis];
      angles[axis] = ClampAngle(angles[axis], range);
      state.angles[joint.first_dof + axis] = angles[axis];
    }
    R_WL[i] = R_WJ * RotationXyz(angles);
  }
  return state;
}

}  // namespace etude
