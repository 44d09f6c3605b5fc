#pragma once

#include <cstddef>
#include <span>

#include "engine/motion/body.h"

namespace etude {

/// Measurements of a motion under the assumption that one axis points up. Lengths are multiples of the stature.
struct AxisStance {
  double upright = 0;   ///< share of the frames with the trunk upright, the hips above the feet, and the head on top
  double balanced = 0;  ///< share of the frames with the centre of mass over the feet
  double straight = 0;  ///< share of the frames with trunk, head and legs straight along the axis, as in static trials
  double tall = 0;      ///< share of the frames with the hips above the ankles by nearly the length of the legs
  double propped = 0;   ///< share of the frames in which hands and legs on one plane carry the body (IsPropped)
  double lowest = 0;    ///< the lowest joint's height in the file's axes (5th percentile)
  double bottom = 0;    ///< like `lowest`, but the 1st percentile; people who jump also reach it
  double floor = 0;     ///< range of the lowest joint's height (5th to 95th percentile)
  double hover_s = 0;   ///< longest time, seconds, with the lowest joint more than half a stature above `lowest`
  double way = 0;       ///< largest extent of the hip centre's path, perpendicular to the axis
  double steps = 0;     ///< of the frames in which the hips travel, the share in which an ankle stands
  double on_hands = 0;  ///< share of the frames with a wrist beyond the head, as in a handstand
  double seated = 0;    ///< share of the frames in which the body sits upright (IsSeated)
  double on_side = 0;   ///< share of the frames with the line between the hips along the axis
  /// Ranges (5th to 95th percentile): of the heights of hip centre and shoulder centre; of the path of the stiller
  /// ankle; of the shoulder centre's path perpendicular to the axis.
  double hip_rise = 0, shoulder_rise = 0, ankle_way = 0, sway = 0;
};

/// The frames to measure: every n-th pose, each paired with the pose about a twentieth of a second later.
struct StanceFrames {
  std::span<const BodyPose> poses;
  std::size_t stride = 1, later = 1;
  double seconds = 1;  ///< time between a frame and its later pose
  double rate_hz = 1;
  double stature = 1;
};

/// Chooses at most 4,000 of the poses, which have no gaps. `poses` must outlive the result and must not be empty.
StanceFrames StanceFramesOf(std::span<const BodyPose> poses, double rate_hz);

/// Measures how the body stands, sits or lies if the unit vector `up` points up.
AxisStance MeasureStance(const StanceFrames& frames, const glm::dvec3& up);

}  // namespace etude
