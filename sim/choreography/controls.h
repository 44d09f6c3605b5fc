#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "engine/motion/body.h"

namespace etude {

/// The controls of trunk, hips and head. A positive bend is forward; a positive side or turn is to the person's own
/// left.
enum class MiddleControl {
  kHipsSide,   ///< metres to the left of the point midway between the feet's home spots
  kHipsAhead,  ///< metres forward of the point midway between the feet's home spots
  kHipsDrop,   ///< metres below the hips' height on straight legs
  kHipsTurn,
  kHipsTilt,  ///< positive raises the left hip
  kJump,      ///< metres by which hips and feet leave the floor; a negative value lowers the hips alone
  kTrunkBend,
  kTrunkSide,
  kTrunkTurn,
  kNeckBend,
  kNeckSide,
  kNeckTurn,
};
constexpr std::size_t kMiddleControlCount = 12;

/// The controls of one arm and one leg. On both sides, positive is forward or outward from the body. To mirror a pose,
/// exchange the sides; no sign changes.
enum class SideControl {
  kArmForward,  ///< raises the arm in the sagittal plane; 0 = hanging
  kArmSide,     ///< away from the sagittal plane, applied before kArmForward; 90° is a T pose for every kArmForward
  kArmTwist,    ///< outward about the upper arm: in a T pose with the elbow at 90°, +90° points the hand up
  kElbow,       ///< flexion of the elbow; 0 = straight
  kWrist,       ///< flexion of the wrist
  kLegFree,     ///< 0 = the foot stands on its spot; 1 = the leg follows its four angles (kLegForward to kKnee)
  kLegForward,
  kLegSide,
  kLegTwist,
  kKnee,
  kFootPoint,  ///< free leg: plantar flexion
  kFootSide,   ///< standing foot: metres outward from the foot's home spot
  kFootAhead,
  kFootLift,  ///< metres above the floor: a step lifts the foot, a slide does not
  kFootHeel,  ///< rotation that raises the heel about the toe tip
  kFootTurn,  ///< standing foot: outward turn of the toes beyond the home angle
};
constexpr std::size_t kSideControlCount = 16;
constexpr std::size_t kControlCount = kMiddleControlCount + 2 * kSideControlCount;

/// A body's configuration in a choreographer's terms. Key poses are written in these controls, and poses are
/// interpolated, scaled and mirrored in them. Angles are in radians, lengths in metres. `PoseOf` converts controls to
/// joints.
struct Controls {
  std::array<double, kControlCount> values{};

  double& operator[](MiddleControl control) { return values[static_cast<std::size_t>(control)]; }
  double operator[](MiddleControl control) const { return values[static_cast<std::size_t>(control)]; }
  double& Of(Side side, SideControl control) { return values[SideIndex(side, control)]; }
  double Of(Side side, SideControl control) const { return values[SideIndex(side, control)]; }

  static constexpr std::size_t SideIndex(Side side, SideControl control) {
    return kMiddleControlCount + static_cast<std::size_t>(side) * kSideControlCount + static_cast<std::size_t>(control);
  }
};

/// The name and the unit of a control in choreography files.
struct ControlName {
  std::string_view group;  ///< "hips", "arm", "elbow"; side controls are written "left_arm", "right_arm" or "arms"
  std::string_view key;    ///< key within the group's mapping; empty if the group itself is a number
  double per_unit;         ///< radians per degree, or metres per centimetre
};
/// Returns the names of all controls in the order of the enums. `kLegFree` has no name: a file that gives angles of a
/// leg makes the leg free.
std::span<const ControlName, kMiddleControlCount> MiddleControlNames();
std::span<const ControlName, kSideControlCount> SideControlNames();

/// Returns the controls with left and right exchanged.
Controls Mirrored(const Controls& controls);
/// Returns the sum of two sets of controls, control by control.
Controls Sum(const Controls& a, const Controls& b);
/// Returns (1 − share) · from + share · to, for every control.
Controls Mix(const Controls& from, const Controls& to, double share);
/// Returns `controls` with their distance from `centre` scaled by `factor`. kLegFree is not scaled: a smaller kick must
/// still leave the floor.
Controls Exaggerated(const Controls& controls, const Controls& centre, double factor);

}  // namespace etude
