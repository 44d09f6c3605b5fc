#pragma once

#include <array>
#include <optional>

#include "engine/motion/body.h"

namespace etude {

/// Returns the stature of a pose in the pose's unit: the length along the limbs from an ankle over knee, hip, spine and
/// neck to the head (mean of left and right), divided by 0.92. These limbs cover about 92 % of the stature.
double Stature(const BodyPose& pose);

/// Returns the height of a pose's lowest joint; this need not be a foot, because people also lie and sit. Finger tips
/// are left out, because rigs place them inaccurately.
double LowestHeight(const BodyPose& pose);

/// The horizontal speeds of feet in stance, metres per second; nullopt if no foot ever stands.
struct FootSlide {
  std::optional<double> mean;                    ///< mean over all frames and feet in stance
  std::array<std::optional<double>, 2> of_foot;  ///< one mean per foot, in the order of Side
  std::array<double, 2> stance_share{};          ///< share of the frames in which the foot stands
};

/// Measures foot sliding. A foot is in stance if FindBearing by kFootRules finds its toes or its ankle at rest. If no
/// joint of the body is at rest in a frame, the foot joints near the body's lowest joint (SupportRules::lowest) count
/// as in stance, unless the lowest joint is more than SupportRules::height above the floor. Glides and treadmills
/// therefore count as sliding, and jumps do not. The floor is the lower quartile of the height of the body's lowest
/// joint: neither a single low frame nor a jump changes the quartile. If toes and ankle are both in stance, the
/// foot's speed is the speed of the slower joint, so a rolling foot does not count as sliding. Velocities are
/// computed by JointVelocities.
FootSlide MeasureFootSlide(const BodyMotion& motion);

/// Summary measures of a motion, in metres and seconds.
struct MotionStatistics {
  double stature_m = 0;         ///< median over the frames (Stature)
  double travelled_m = 0;       ///< distance covered by the hip centre along the floor
  double speed_median_m_s = 0;  ///< speed of each frame's fastest joint, median over the frames
  double speed_p95_m_s = 0;
  double speed_peak_m_s = 0;
  Role fastest = Role::kHead;  ///< the joint with the highest speed
  FootSlide foot_slide;        ///< the result of MeasureFootSlide
  double lowest_foot_m = 0;    ///< lowest height of an ankle or toe over the clip; near 0 for a clip on the floor
};

/// Measures a motion of at least one frame; for one frame all speeds are 0. A speed is the distance from one frame to
/// the next, times the frame rate.
MotionStatistics ComputeStatistics(const BodyMotion& motion);

}  // namespace etude
