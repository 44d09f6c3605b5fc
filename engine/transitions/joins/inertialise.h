#pragma once

#include <array>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// The offset of the old motion from the new one: a translation in metres, or a limb's rotation vector in radians.
struct Offset {
  glm::dvec3 value{0};
  glm::dvec3 velocity{0};  ///< per second
};

/// Returns what remains of an offset `seconds` after the transition point; at 0 the whole offset remains.
using DecayLaw = std::function<glm::dvec3(const Offset& offset, double seconds)>;

/// Joins by inertialisation, the usual method today (Bollo 2018): the offset of the old motion from the new one, in
/// pose and velocity, is measured at the transition point and decays while the new motion plays.
///
/// Bodies are twenty joint positions. A limb's offset is the rotation from the limb's new direction to its old
/// direction; the body's offset is a translation of the hip centre. All limbs therefore keep the new motion's lengths.
class Inertialiser {
 public:
  Inertialiser(const JoinInput& input, DecayLaw law);

  /// Returns the new motion's frame `seconds` after the transition point plus the remaining offset. At 0 the result
  /// equals the last shown frame.
  BodyPose Apply(const BodyPose& target, double seconds) const;

 private:
  DecayLaw law_;
  Offset hips_;
  std::array<Offset, kRoleCount> limbs_;  ///< indexed by child joint
};

struct SpringOptions {
  /// The time after which about half of an offset is gone, in seconds (the default is ours). A longer time gives a
  /// smoother motion, but its poses differ from both clips for longer.
  double half_life_s = 0.1;
};

/// Returns an offset that decays like a critically damped spring, which halves it in about `half_life_s` (Holden 2020,
/// "Spring-It-On"). The velocity is continuous, so a growing offset first continues to grow.
glm::dvec3 SpringDecay(const Offset& offset, double seconds, const SpringOptions& options = {});
Blend InertialiseSpring(const JoinInput& input, const SpringOptions& options = {});

struct QuinticOptions {
  double blend_s = 0.33;  ///< maximum time until only the new motion is shown, seconds (the default is ours)
};
const SettingTable<QuinticOptions>& QuinticSettings();

/// Returns an offset that decays along Bollo's quintic (GDC 2018). The offset keeps its axis, and its length decays to
/// zero within `blend_s`, or earlier if it shrinks so fast that it would overshoot. If the offset grows, its velocity
/// is replaced by zero; a velocity perpendicular to the axis is ignored.
glm::dvec3 QuinticDecay(const Offset& offset, double seconds, const QuinticOptions& options = {});
Blend InertialiseQuintic(const JoinInput& input, const QuinticOptions& options = {});

/// Returns the displacement in `seconds` of a velocity that halves every `half_life_s`.
glm::dvec3 DecayingWay(const glm::dvec3& velocity, double seconds, double half_life_s);

struct DeadOptions {
  /// The time until only the new motion is shown, in seconds (the default is ours). A longer time shows more of the
  /// continuation, which is in neither clip.
  double blend_s = 0.33;
  /// The time in which the old motion's velocity halves, in seconds (the default is ours). A longer time keeps more
  /// momentum, but carries limbs farther away.
  double half_life_s = 0.2;
};
const SettingTable<DeadOptions>& DeadSettings();

/// Joins by dead blending (Holden 2023, "Dead Blending"). The old motion continues from the last shown frame: each limb
/// and the hip centre keep a velocity that decays. The new motion is faded in with the weight 3t² − 2t³. Unlike a
/// decaying offset, the continuation does not depend on the new motion's velocity.
Blend DeadBlending(const JoinInput& input, const DeadOptions& options = {});

}  // namespace etude
