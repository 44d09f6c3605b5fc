#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "engine/motion/body.h"

namespace etude {

/// The controls of the middle of the body. Angles turn the way a person would say it: bend = forward, side and turn =
/// to the person's own left.
enum class MiddleControl {
  kHipsSide,   ///< from above the middle of the home spots of the feet, metres to the left
  kHipsAhead,  ///< metres forward
  kHipsDrop,   ///< metres below the hips' height on straight legs
  kHipsTurn,
  kHipsTilt,  ///< left hip up
  kJump,      ///< metres by which hips and feet leave the floor; below 0 the hips alone sink
  kTrunkBend,
  kTrunkSide,
  kTrunkTurn,
  kNeckBend,
  kNeckSide,
  kNeckTurn,
};
constexpr std::size_t kMiddleControlCount = 12;

/// The controls of one arm and leg. Positive is forward, or outward from the body, on both sides, so the mirror image
/// of a pose exchanges the sides and no sign.
enum class SideControl {
  kArmForward,  ///< raises the arm in the sagittal plane; 0 = hanging
  kArmSide,     ///< away from the sagittal plane, applied first: (0, 90) is a T, (90, 90) too
  kArmTwist,    ///< outward about the upper arm: with the arm in T and the elbow at 90°, +90° = hand up
  kElbow,       ///< 0 = straight
  kWrist,       ///< flexion
  kLegFree,     ///< 0 = the foot stands on its spot, 1 = the leg follows the four angles below
  kLegForward,
  kLegSide,
  kLegTwist,
  kKnee,
  kFootPoint,  ///< of a free leg: plantar flexion
  kFootSide,   ///< of a standing foot: its spot, metres outward from home
  kFootAhead,
  kFootLift,  ///< metres above the floor: what makes a step out of a slide
  kFootHeel,  ///< the heel's rise about the toe tip
  kFootTurn,  ///< of a standing foot: toes outward, beyond the home angle
};
constexpr std::size_t kSideControlCount = 16;
constexpr std::size_t kControlCount = kMiddleControlCount + 2 * kSideControlCount;

/// A body's configuration as choreographers say it: the vocabulary of key poses, in which poses are
/// interpolated, scaled and mirrored. Radians and metres; `PoseOf` makes joints of it.
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

/// The name of a control in choreography files, and its unit.
struct ControlName {
  std::string_view group;  ///< "hips", "arm", "elbow"; side controls are "left_arm", "right_arm" or "arms" there
  std::string_view key;    ///< the key inside the group's mapping; empty: the group itself is a number
  double per_unit;         ///< radians per degree, or metres per centimetre
};
/// Returns the names of all controls, in the order of the enums. `kLegFree` has no name: files free a leg by giving its
/// angles.
std::span<const ControlName, kMiddleControlCount> MiddleControlNames();
std::span<const ControlName, kSideControlCount> SideControlNames();

/// Returns the controls with left and right exchanged.
Controls Mirrored(const Controls& controls);
/// Adds two sets of controls, control by control.
Controls Sum(const Controls& a, const Controls& b);
/// Returns (1 − share) · from + share · to.
Controls Mix(const Controls& from, const Controls& to, double share);
/// Scales every control's distance from `centre` by `factor`; kLegFree stays as it is, so that a smaller kick is still
/// a kick.
Controls Exaggerated(const Controls& controls, const Controls& centre, double factor);

}  // namespace etude
