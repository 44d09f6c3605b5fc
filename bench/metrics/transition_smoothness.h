#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The smoothness of a motion around given frames (docs/reference/metrics.md, Transitions). Motions are judged
/// at 30 Hz, in metres, of a body whose hips stand at 0.90 m.

/// The unevenness of a motion close to a transition point.
struct TransitionSmoothness {
  double jump_cm = 0;             ///< largest second difference of any joint
  double mean_joint_jump_cm = 0;  ///< largest over frames of the mean over joints
  double rotation_step_change_deg = 0;
  double jerk_peak_mps3 = 0;  ///< largest third difference of any joint × 30³
};

/// A window is the frames within this many of the transition point: eleven frames.
constexpr int kWindowReach = 5;

/// The worst over the windows around all `frames` of transition points; what lies beyond the motion's ends does not
/// count. Needs one at least; a motion shorter than four frames has no jerk, shorter than three no jump.
TransitionSmoothness MeasureTransitions(const BodyMotion& motion, std::span<const int> frames);

/// The largest second difference of any joint at each frame, centimetres; 0 at both ends.
std::vector<double> SecondDifferencesCm(const BodyMotion& motion);

/// Nature's own: jump_cm of every unbroken window of eleven frames of a clip.
std::vector<double> NaturalJumpsCm(const BodyMotion& clip);

/// The largest jump that still counts as natural: the 95th percentile (linear between neighbours) of natural jumps.
/// Needs a value.
double NaturalLimitCm(std::vector<double> natural_jumps);

/// `natural_share` of one transition: its jump does not exceed the limit of the natural jumps (by more than rounding),
/// of which it needs one. A transition that found no way has no jump, and is not natural.
bool IsNatural(std::optional<double> jump_cm, std::vector<double> natural_jumps_cm);

/// Mean over both feet and the second after frame `point` of v_xz · clamp(2 − 2^(h / 2.5 cm), 0, 1):
/// the horizontal speed of feet that should be standing. Needs a frame after the transition point. Heights are above y
/// = 0, where every clip of a stage was set down: `FootSlide` (engine/motion/statistics), of clips whose floor nobody
/// knows, takes each foot's lowest point instead, which a foot that a join pushes through the floor would move.
double FootSlideCmps(const BodyMotion& motion, int point);
/// Computes the foot slide over the steps from frame `first` to frame `last` (to the motion's end at most).
double FootSlideCmps(std::span<const BodyPose> poses, int first, int last, double rate_hz);

/// The worst joint between the frame left and the frame entered, already aligned on the floor.
double PoseGapCm(const BodyPose& leaving, const BodyPose& arriving);

/// The worst joint's difference of velocity: arriving at the frame left, against leaving the one entered.
double VelocityGapCmps(const BodyPose& leaving_before, const BodyPose& leaving, const BodyPose& arriving,
                       const BodyPose& arriving_after, double rate_hz);

/// A matched pair of frames is falsely smooth when its pose gap exceeds this.
constexpr double kFalseSmoothGapCm = 20;
constexpr bool IsFalselySmooth(double pose_gap_cm) { return pose_gap_cm > kFalseSmoothGapCm; }

/// A clip that played while the wanted one was waited for: its frames, from when on until when.
struct Stay {
  int from_frame = 0;
  int until_frame = 0;
};

/// `wait_s`: from the request until the wanted clip plays, through an in-between if there is one.
double WaitSeconds(std::span<const Stay> stays, double rate_hz);

}  // namespace etude
