#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// Something that was off at a seam, as a vector: metres, or the turn of a limb in radians.
struct Offset {
  glm::dvec3 value{0};
  glm::dvec3 velocity{0};  ///< per second
};

/// What is left of an offset `seconds` after the seam: all of it at 0.
using DecayLaw = glm::dvec3 (*)(const Offset& offset, double seconds, const JoinSettings& settings);

/// The join one would use today (Bollo 2018): at the switch, keep what the old motion was off from the new one, in pose
/// and in velocity, and let it die away while the new motion plays.
///
/// On twenty joint positions: the offset of a limb is the turn between its old and its new direction, the offset of the
/// body a shift of the hip centre. So all limbs keep the new motion's lengths.
class Inertialiser {
 public:
  Inertialiser(const SeamMotions& motions, DecayLaw law, const JoinSettings& settings);

  /// The new motion's frame `seconds` after the seam, still pulled towards the old one; at 0 it is the last frame
  /// shown.
  BodyPose Apply(const BodyPose& target, double seconds) const;

 private:
  DecayLaw law_;
  JoinSettings settings_;
  Offset hips_;
  std::array<Offset, kRoleCount> limbs_;  ///< by child joint
};

/// A critically damped spring that halves an offset in about `half_life_s` (Holden 2020, "Spring-It-On"). An offset
/// that is still growing goes on to do so for a while: velocities are continuous.
glm::dvec3 SpringDecay(const Offset& offset, double seconds, const JoinSettings& settings);

/// Bollo's quintic (GDC 2018): the offset keeps its axis and its length goes to rest at zero within `blend_s`, sooner
/// when it shrinks so fast that it would overshoot; a growing one is taken as resting, and what turns the axis is lost.
glm::dvec3 QuinticDecay(const Offset& offset, double seconds, const JoinSettings& settings);

/// The joins of those names.
Blend InertialiseSpring(const SeamMotions& motions, const JoinSettings& settings);
Blend InertialiseQuintic(const SeamMotions& motions, const JoinSettings& settings);

}  // namespace etude
