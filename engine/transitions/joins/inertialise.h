#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// The difference of the old motion from the new one as a vector: metres, or the turn of a limb in radians.
struct Offset {
  glm::dvec3 value{0};
  glm::dvec3 velocity{0};  ///< per second
};

/// Returns what is left of an offset `seconds` after the transition point: all of it at 0.
using DecayLaw = std::function<glm::dvec3(const Offset& offset, double seconds)>;

/// The join one would use today (Bollo 2018): keep what the old motion was off from the new one, in pose and in
/// velocity, and let it die away while the new motion plays.
///
/// On twenty joint positions: the offset of a limb is the turn between its old and its new direction, the offset of the
/// body a shift of the hip centre. So all limbs keep the new motion's lengths.
class Inertialiser {
 public:
  Inertialiser(const JoinInput& input, DecayLaw law);

  /// The new motion's frame `seconds` after the transition point, still pulled towards the old one; at 0 it is the last
  /// frame shown.
  BodyPose Apply(const BodyPose& target, double seconds) const;

 private:
  DecayLaw law_;
  Offset hips_;
  std::array<Offset, kRoleCount> limbs_;  ///< by child joint
};

struct SpringOptions {
  /// Seconds until about half an offset is gone. Ours. Longer ones are smoother, and further from both clips' poses.
  double half_life_s = 0.1;
};

/// Computes a critically damped spring that halves an offset in about `half_life_s` (Holden 2020, "Spring-It-On"). An
/// offset that is still growing goes on to do so for a while: velocities are continuous.
glm::dvec3 SpringDecay(const Offset& offset, double seconds, const SpringOptions& options = {});
Blend InertialiseSpring(const JoinInput& input, const SpringOptions& options = {});

struct QuinticOptions {
  double blend_s = 0.33;  ///< seconds until the new motion is shown alone, at the latest. Ours
};
const SettingTable<QuinticOptions>& QuinticSettings();

/// Computes Bollo's quintic (GDC 2018): the offset keeps its axis and its length goes to rest at zero within `blend_s`,
/// sooner when it shrinks so fast that it would overshoot; a growing one is taken as resting, and what turns the axis
/// is lost.
glm::dvec3 QuinticDecay(const Offset& offset, double seconds, const QuinticOptions& options = {});
Blend InertialiseQuintic(const JoinInput& input, const QuinticOptions& options = {});

}  // namespace etude
