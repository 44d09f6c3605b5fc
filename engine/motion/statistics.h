#pragma once

#include <array>
#include <optional>

#include "engine/motion/body.h"

namespace etude {

/// Returns the stature of a pose in its own unit: the way along the limbs from the ankles over knees, hips, spine and
/// neck to the head (both legs' mean), divided by the 0.92 of a body that it covers.
double Stature(const BodyPose& pose);

/// The speeds of feet along the floor while they stand, metres per second. None: nothing ever stood.
struct FootSlide {
  std::optional<double> mean;                    ///< over all frames in which a foot stands, of both feet
  std::array<std::optional<double>, 2> of_foot;  ///< by side, in Side's order
  std::array<double, 2> stance_share{};          ///< the share of the frames in which the foot stands
};

/// Measures how feet slide. A foot stands with its toes or its ankle where FindBearing finds them at rest by
/// kFootRules. In a frame where nothing of the body is at rest, its lowest joints stand all the same, unless they are
/// higher above the floor than SupportRules::height: so glides and treadmills slide, and jumps do not. The floor is the
/// lower quartile of the heights of the body's lowest joint: one low frame moves it no more than a jump does. A foot
/// that rolls slides no faster than the slower of its standing joints; velocities are those of JointVelocities.
FootSlide MeasureFootSlide(const BodyMotion& motion);

/// Overall measures of a motion, in metres and seconds.
struct MotionStatistics {
  double stature_m = 0;         ///< median over the frames (Stature)
  double travelled_m = 0;       ///< way of the hip centre along the floor
  double speed_median_m_s = 0;  ///< of the fastest joint in each frame
  double speed_p95_m_s = 0;
  double speed_peak_m_s = 0;
  Role fastest = Role::kHead;  ///< the joint of the peak
  FootSlide foot_slide;        ///< MeasureFootSlide
  double lowest_foot_m = 0;    ///< lowest ankle or toe of either foot over the clip; near 0 for a clip on the floor
};

/// Measures a motion of at least one frame; of one frame all speeds are 0. A speed is the way from one frame to the
/// next.
MotionStatistics ComputeStatistics(const BodyMotion& motion);

}  // namespace etude
