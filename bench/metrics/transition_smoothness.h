#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// This header measures the smoothness of a motion around given frames (docs/reference/metrics.md, Transitions).
/// Motions are judged at 30 Hz, in metres, for a body whose hips stand at 0.90 m.

/// The unevenness of a motion near its transition points.
struct TransitionSmoothness {
  double jump_cm = 0;             ///< largest second difference of any joint
  double mean_joint_jump_cm = 0;  ///< largest value, over the frames, of the joints' mean second difference
  double rotation_step_change_deg = 0;
  double jerk_peak_mps3 = 0;  ///< largest third difference of any joint × 30³
};

/// A window contains the frames within this distance of the transition point, eleven frames in all.
constexpr int kWindowReach = 5;

/// Returns the largest values over the windows around all transition points in `frames`, of which there must be at
/// least one. Frames outside the motion are ignored. A motion of fewer than four frames has no jerk, and a motion of
/// fewer than three frames has no jump.
TransitionSmoothness MeasureTransitions(const BodyMotion& motion, std::span<const int> frames);

/// Returns the largest second difference of any joint at each frame, centimetres; 0 at both ends.
std::vector<double> SecondDifferencesCm(const BodyMotion& motion);

/// Returns the natural jumps of an unbroken clip: jump_cm of every window of eleven frames, centimetres.
std::vector<double> NaturalJumpsCm(const BodyMotion& clip);

/// Returns the largest jump that still counts as natural: the 95th percentile of the natural jumps, interpolated
/// linearly. At least one natural jump is required.
double NaturalLimitCm(std::vector<double> natural_jumps);

/// Returns true if the transition counts for `natural_share`: its jump does not exceed NaturalLimitCm of the natural
/// jumps by more than rounding. At least one natural jump is required. A transition that found no path has no jump and
/// is not natural.
bool IsNatural(std::optional<double> jump_cm, std::vector<double> natural_jumps_cm);

/// Returns the foot slide in the second after frame `point`: the mean over both feet of v_xz · clamp(2 − 2^(h / 2.5
/// cm), 0, 1), cm/s. v_xz is the foot's horizontal speed and h its height above y = 0, the floor on which every clip of
/// a stage was placed. A frame after the transition point is required. (MeasureFootSlide in
/// engine/motion/statistics.h estimates the height of the floor from the motion, because there the floor is unknown.)
double FootSlideCmps(const BodyMotion& motion, int point);
/// Returns the foot slide over the steps from frame `first` to frame `last`, cm/s. Frames after the motion's end are
/// ignored.
double FootSlideCmps(std::span<const BodyPose> poses, int first, int last, double rate_hz);

/// Returns the largest joint distance between the frame that the transition leaves and the frame that it enters,
/// centimetres. Both poses must already be aligned on the floor.
double PoseGapCm(const BodyPose& leaving, const BodyPose& arriving);

/// Returns the largest difference of joint velocity, cm/s, between the step into the frame that the transition leaves
/// and the step out of the frame that it enters.
double VelocityGapCmps(const BodyPose& leaving_before, const BodyPose& leaving, const BodyPose& arriving,
                       const BodyPose& arriving_after, double rate_hz);

/// A matched pair of frames is falsely smooth if its pose gap exceeds this limit, centimetres.
constexpr double kFalseSmoothGapCm = 20;
constexpr bool IsFalselySmooth(double pose_gap_cm) { return pose_gap_cm > kFalseSmoothGapCm; }

/// The frames of one clip that played while the transition waited.
struct Stay {
  int from_frame = 0;
  int until_frame = 0;
};

/// Returns `wait_s`: the time from the request until the wanted clip plays, seconds. The time of clips that play in
/// between is included.
double WaitSeconds(std::span<const Stay> stays, double rate_hz);

}  // namespace etude
