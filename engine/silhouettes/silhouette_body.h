#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// A capsule of flesh around a limb: all points within the radius of the segment a–b. The radius changes linearly from
/// one end to the other. Metres.
struct FleshCapsule {
  TreePoint a, b;
  double radius_a = 0, radius_b = 0;
  int part = 0;  ///< the part of the body whose thickness it shares; both arms are one part
};

/// A person's body model for comparison with silhouettes: the kinematic tree, the positions of the twenty joints in it,
/// and the flesh. Any tree may be used whose limits keep the Y angles of joints with three degrees of freedom within
/// ±90°.
struct SilhouetteBody {
  KinematicTree tree;
  std::array<TreePoint, kRoleCount> roles;
  std::vector<FleshCapsule> flesh;
  int part_count = 0;
  /// The prior of one degree of freedom: its usual angle and people's standard deviation from it, radians. It
  /// determines the angles that the pictures leave open.
  struct Habit {
    double angle = 0;
    double spread = 1;
  };
  std::vector<Habit> habits;
  /// The two joints of an arm or leg, from the trunk outwards, that the search for a lost limb varies.
  struct Limb {
    int upper = 0;
    int lower = 0;
    bool is_arm = false;
  };
  std::vector<Limb> limbs;
};

/// Makes the body of a generic adult with these limb lengths. Its root is the hip centre, which moves and turns freely;
/// the back bends at two joints; a collar bone carries each shoulder. The flesh is that of an average clothed adult
/// (girths *ours*: round figures for a grown person, not from a table, with a centimetre of clothes on the trunk),
/// scaled by the stature that the lengths imply. Only `lengths` are specific to the person in the pictures.
SilhouetteBody MakeSilhouetteBody(const LimbLengths& lengths);

/// Returns the position of a point of the tree in the world.
glm::dvec3 PlaceOf(const TreePoint& point, const TreeFrames& frames);

BodyPose ToBodyPose(const SilhouetteBody& body, const TreeFrames& frames);
BodyPose ToBodyPose(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
