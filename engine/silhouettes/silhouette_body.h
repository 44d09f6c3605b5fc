#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// A capsule of flesh around a limb: all points within the radius of the segment a–b. The radius changes linearly from
/// end a to end b. Metres.
struct FleshCapsule {
  TreePoint a, b;
  double radius_a = 0, radius_b = 0;
  int part = 0;  ///< index of the body part that determines the capsule's thickness; both arms are one part
};

/// A person's body model for comparison with silhouettes: the kinematic tree, the twenty joints as points of the tree,
/// and the flesh. Limits of the tree must keep the Y angles of joints with three degrees of freedom within ±90°.
struct SilhouetteBody {
  KinematicTree tree;
  std::array<TreePoint, kRoleCount> roles;
  std::vector<FleshCapsule> flesh;
  int part_count = 0;
  /// The prior of one degree of freedom: people's usual angle and standard deviation, radians. The prior determines
  /// angles that the pictures leave open.
  struct Habit {
    double angle = 0;
    double spread = 1;
  };
  std::vector<Habit> habits;
  /// The two joints of an arm or leg, from the trunk outwards, whose angles the search for a lost limb varies.
  struct Limb {
    int upper = 0;
    int lower = 0;
    bool is_arm = false;
  };
  std::vector<Limb> limbs;
};

/// Makes the body of a generic adult with these limb lengths; only the lengths are specific to the person in the
/// pictures. The root is the hip centre, which moves and rotates freely; the back bends at two joints; each shoulder
/// lies at the end of a collar bone. The capsules are those of an average clothed adult, scaled by the stature that the
/// lengths imply. Girths are *ours*: rounded values, not from a table, with a centimetre of clothes on the trunk.
SilhouetteBody MakeSilhouetteBody(const LimbLengths& lengths);

/// Returns the world position of a point of the tree.
glm::dvec3 PlaceOf(const TreePoint& point, const TreeFrames& frames);

BodyPose ToBodyPose(const SilhouetteBody& body, const TreeFrames& frames);
BodyPose ToBodyPose(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
