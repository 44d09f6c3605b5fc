#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/switching/joins/join.h"

namespace etude {

/// The join one would use today (Bollo 2018; Holden's critically damped spring): at the switch, keep
/// what the old motion was off from the new one, in pose and in velocity, and let it die away while
/// the new motion plays.
///
/// On twenty joint positions: the offset of a limb is the rotation between its old and its new
/// direction, the offset of the body a shift of the hip centre. So all limbs keep their lengths.
class Inertialiser {
 public:
  /// `shown`: the last two frames shown. `target`: the frames of the new motion, already aligned on
  /// the floor, that would stand in their place. `half_life`: seconds until half an offset is gone.
  Inertialiser(const PosePair& shown, const PosePair& target, double rate_hz, double half_life);

  /// The new motion's frame `seconds` after the switch, still pulled towards the old one; at 0 it is
  /// the last frame shown.
  BodyPose Apply(const BodyPose& target, double seconds) const;

 private:
  /// A critically damped spring on its way to rest at zero.
  struct Decay {
    glm::dvec3 offset{0};
    glm::dvec3 velocity{0};  ///< per second
    glm::dvec3 At(double seconds, double half_life) const;
  };

  double half_life_;
  Decay hips_;
  std::array<Decay, kRoleCount> limbs_;  ///< rotation vectors, by child joint
};

/// The join of that name.
Blend InertialiseSpring(const Meeting& meeting, const JoinSettings& settings);

}  // namespace etude
