#pragma once

#include <glm/glm.hpp>

#include "engine/motion/body.h"
#include "sim/choreography/controls.h"

namespace etude {

/// The proportions of the body that performs the built-in moves, metres: an adult of 1.70 m, after
/// Drillis and Contini's segment lengths (1966).
struct CanonicalBody {
  static constexpr double kHipHalfWidth = 0.09;
  static constexpr double kThigh = 0.4165;
  static constexpr double kShank = 0.418;
  static constexpr double kAnkleHeight = 0.066;
  static constexpr double kToeHeight = 0.025;  ///< the toe tip of a flat foot
  static constexpr double kFootReach = 0.17;   ///< ankle to toe tip, along the floor
  static constexpr double kSpine = 0.21;       ///< hip centre to spine
  static constexpr double kChest = 0.31;       ///< spine to shoulder centre
  static constexpr double kShoulderHalfWidth = 0.18;
  static constexpr double kShoulderFall = 0.03;  ///< shoulders below the base of the neck
  static constexpr double kHeadRise = 0.165;     ///< base of the neck to the middle of the head
  static constexpr double kUpperArm = 0.30;
  static constexpr double kForearm = 0.25;
  static constexpr double kHand = 0.18;
  /// The hip centre's height above the floor on straight legs.
  static constexpr double kHipHeight = kThigh + kShank + kAnkleHeight;
  /// Home spots of the feet: half their distance, and how far the toes point outward (radians).
  static constexpr double kHomeHalfWidth = 0.12;
  static constexpr double kHomeToeOut = 0.2;
};

/// Where the twenty joints are, on a floor at y = 0, facing +Z, the feet's home spots left and right
/// of the origin. Legs that are not free reach for their spot by two-bone inverse kinematics, so a
/// standing foot cannot slide; the hips sink as far as standing legs need to reach. Limb lengths are
/// the canonical body's in every pose.
BodyPose PoseOf(const Controls& controls);

}  // namespace etude
