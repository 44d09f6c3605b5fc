#pragma once

#include "engine/motion/body.h"

namespace etude {

/// Returns the stature of a pose in its own unit: the way along the limbs from the ankles over knees, hips, spine and
/// neck to the head (both legs' mean), divided by the 0.92 of a body that it covers.
double Stature(const BodyPose& pose);

/// Overall measures of a motion, in metres and seconds.
struct MotionStatistics {
  double stature_m = 0;         ///< median over the frames (Stature)
  double travelled_m = 0;       ///< way of the hip centre along the floor
  double speed_median_m_s = 0;  ///< of the fastest joint in each frame
  double speed_p95_m_s = 0;
  double speed_peak_m_s = 0;
  Role fastest = Role::kHead;  ///< the joint of the peak
  double foot_slide_m_s = 0;   ///< FootSlide
  double lowest_foot_m = 0;    ///< lowest ankle or toe of either foot over the clip; near 0 for a clip on the floor
};

/// Measures a motion of at least one frame; of one frame all speeds are 0. A speed is the way from one frame to the
/// next.
MotionStatistics ComputeStatistics(const BodyMotion& motion);

/// Returns the mean over frames and feet of the toes' horizontal speed, weighted by how much they stand: the weight is
/// clamp(2 − 2^(h / 2.5 cm), 0, 1) at height h above the floor (Zhang et al. 2018, "Mode-adaptive neural networks").
/// Heights are above each foot's own lowest point, so that it need not be known where the floor is. Metres per second;
/// 0 of a single frame.
double FootSlide(const BodyMotion& motion);

}  // namespace etude
