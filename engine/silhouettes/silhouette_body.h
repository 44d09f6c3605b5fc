#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// Flesh around a limb: every point within the radius of the segment a–b, where the radius changes evenly from one end
/// to the other. Metres.
struct FleshCapsule {
  TreePoint a, b;
  double radius_a = 0, radius_b = 0;
  int part = 0;  ///< whose thickness it shares: both arms are as thick as each other
};

/// A person's body for comparison with silhouettes: what moves, where the twenty joints lie in it, and the flesh. Any
/// tree will do whose limits keep Y angles of joints with three degrees of freedom within ±90°.
struct SilhouetteBody {
  KinematicTree tree;
  std::array<TreePoint, kRoleCount> roles;
  std::vector<FleshCapsule> flesh;
  int part_count = 0;
  /// The usual angle of a degree of freedom and people's standard deviation from it, both in radians. They decide where
  /// pictures do not.
  struct Habit {
    double angle = 0;
    double spread = 1;
  };
  std::vector<Habit> habits;
  /// The joints of an arm or leg, from the body outwards, which a search for a lost limb turns.
  struct Limb {
    int upper = 0;
    int lower = 0;
    bool is_arm = false;
  };
  std::vector<Limb> limbs;
};

/// Makes a generic adult of these limb lengths: rooted at the hip centre, which is free to move and turn; the back
/// bends in two places, each shoulder is borne by a collar bone. The flesh is that of an average clothed adult (girths
/// *ours*: round figures for a grown person, no table's, and a centimetre of clothes on the trunk), scaled by what the
/// lengths say of the stature. Of the person in the pictures it knows nothing but `lengths`.
SilhouetteBody MakeSilhouetteBody(const LimbLengths& lengths);

glm::dvec3 PlaceOf(const TreePoint& point, const TreeFrames& frames);

BodyPose ToBodyPose(const SilhouetteBody& body, const TreeFrames& frames);
BodyPose ToBodyPose(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
