#pragma once

#include <glm/glm.hpp>

#include "engine/motion/body.h"
#include "sim/choreography/controls.h"

namespace etude {

/// The proportions of the body that performs the built-in moves, metres. The body is an adult of 1.70 m with the
/// segment lengths of Drillis and Contini (1966).
struct CanonicalBody {
  static constexpr double kHipHalfWidth = 0.09;
  static constexpr double kThigh = 0.4165;
  static constexpr double kShank = 0.418;
  static constexpr double kAnkleHeight = 0.066;
  static constexpr double kToeHeight = 0.025;  ///< height of the toe tip of a flat foot
  static constexpr double kFootReach = 0.17;   ///< ankle to toe tip, along the floor
  static constexpr double kSpine = 0.21;       ///< distance from hip centre to spine
  static constexpr double kChest = 0.31;       ///< distance from spine to shoulder centre
  static constexpr double kShoulderHalfWidth = 0.18;
  static constexpr double kShoulderFall = 0.03;  ///< vertical distance from the base of the neck down to the shoulders
  static constexpr double kHeadRise = 0.165;     ///< base of the neck to the middle of the head
  static constexpr double kUpperArm = 0.30;
  static constexpr double kForearm = 0.25;
  static constexpr double kHand = 0.18;
  /// The height of the hip centre above the floor, with straight legs.
  static constexpr double kHipHeight = kThigh + kShank + kAnkleHeight;
  /// The home spots are the places of the feet in the ready stance. These constants are half the distance between the
  /// two spots, metres, and the outward angle of the toes, radians.
  static constexpr double kHomeHalfWidth = 0.12;
  static constexpr double kHomeToeOut = 0.2;
};

/// The sizes of a body, metres, equal on both sides. The defaults belong to the canonical body.
struct BodyDimensions {
  double hip_half_width = CanonicalBody::kHipHalfWidth;
  double thigh = CanonicalBody::kThigh;
  double shank = CanonicalBody::kShank;
  double ankle_height = CanonicalBody::kAnkleHeight;
  double toe_height = CanonicalBody::kToeHeight;
  double foot_reach = CanonicalBody::kFootReach;
  double spine = CanonicalBody::kSpine;
  double chest = CanonicalBody::kChest;
  double shoulder_half_width = CanonicalBody::kShoulderHalfWidth;
  double shoulder_fall = CanonicalBody::kShoulderFall;
  double head_rise = CanonicalBody::kHeadRise;
  double upper_arm = CanonicalBody::kUpperArm;
  double forearm = CanonicalBody::kForearm;
  double hand = CanonicalBody::kHand;
  double home_half_width = CanonicalBody::kHomeHalfWidth;

  /// Returns the height of the hip centre above the floor, with straight legs, metres.
  double HipHeight() const { return thigh + shank + ankle_height; }
};

/// Computes the twenty joints of a body that faces +Z on a floor at y = 0. The home spots of the feet are left and
/// right of the origin. Legs that are not free reach for their spots by two-bone inverse kinematics, so a standing foot
/// cannot slide; the hips sink until the standing legs reach their spots. In every pose, the limbs have the lengths in
/// `body`. Angles in `controls` are used unchanged. Controls in metres (of hips, feet and jumps) are scaled with the
/// hip height, so a small body takes small steps.
BodyPose PoseOf(const Controls& controls, const BodyDimensions& body = {});

/// Returns the ready stance, in or near which every move starts and ends: feet on their home spots, knees soft, arms
/// hanging loosely. Controls that a choreography file does not name have the values of this stance.
Controls ReadyStance();

/// Returns the canonical body at rest with straight legs and hanging arms. Bodies are calibrated, fitted and compared
/// in this pose.
BodyPose StandingPose();

/// The hip height of the body that performs a scenario's clips, metres. `StandingPose` is scaled to this height.
inline constexpr double kScenarioHipHeight = 0.90;

}  // namespace etude
