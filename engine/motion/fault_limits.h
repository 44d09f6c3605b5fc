#pragma once

#include <algorithm>

/// The thresholds of FindMotionFaults, in metres, seconds and degrees. FaultRules states the rules in words.
namespace etude::fault_limits {

inline constexpr double kAgreeingShare = 0.7;  ///< share of joints that move alike in a whole-body displacement

/// Below this rate, the third differences of fast real motion reach the limits of pops: at 10 Hz those of the hand in a
/// recorded tennis serve are 1 m. If accelerations stay below a, third differences (halved) stay below a / rate², so
/// the limits grow with 1 / rate². In 95 clips of people and animated characters, resampled to 5, 8, 10, 12, 15, 20, 25
/// and 30 Hz, third differences stay below these limits, except in one punch of an animated robot.
inline constexpr double kSlow_hz = 20;
/// Below this rate the same is true of the limits of whole-body displacements.
inline constexpr double kSlowJump_hz = 12;
/// Returns by how much a limit of third differences grows at this rate if it holds from `slow_hz` on.
constexpr double TimesAt(double rate_hz, double slow_hz) {
  return std::max(1.0, slow_hz * slow_hz / (rate_hz * rate_hz));
}

// Floats and sinks.
inline constexpr double kFloatInAll_m = 0.10, kSink_m = 0.06, kSink_s = 0.15;
inline constexpr double kLevel_m = 0.04;  ///< minimum vertical displacement of the whole body
inline constexpr double kStand_m = 0.15;  ///< feet that rest higher than this are taken to stand on an object

/// A body floats if its lowest joint stays above `height_m` for more than `longest_s`.
struct Hovering {
  double height_m, longest_s;
  bool is_upright;  ///< true if only frames in which the body is upright count
};
inline constexpr Hovering kHoverings[] = {{0.5, 1, false}, {0.25, 1, true}, {0.09, 2, true}};

// Skates. The first line limits sudden changes of the whole body's velocity and the time between two changes. The
// second limits a velocity shared by feet in stance, the third the velocity of one foot.
inline constexpr double kStep_m_s = 0.12, kMinCarried_s = 0.25, kMaxCarried_s = 20;
inline constexpr double kGlide_m_s = 0.14, kGlide_s = 0.5;
inline constexpr double kFootSkate_m_s = 0.14, kFootSkate_s = 0.4,
                        kEvenFootSkate_s = 0.25;  ///< minimum duration for one foot whose velocity is constant

// Jumps and pops.
inline constexpr double kMinCommon_m = 0.03;  ///< smaller displacements of the whole body are not considered
inline constexpr double kJumpAlongFloor_m = 0.10, kJump_m = 0.25;
inline constexpr double kPop_m = 0.25, kSurePop_m = 0.45, kPopTimesUsual = 6, kUsualPop = 0.95;
/// The second rule for pops. A third difference is also a pop if it exceeds both `kShortPop_m` and `kPopTimesUsual`
/// times the (1 − kPopFrames / n) quantile of the joint's n third differences, so up to `kPopFrames` large
/// differences do not raise the limit. This rule has an effect only in clips of `kShortClipFrames` to
/// kPopFrames / (1 − kUsualPop) frames.
inline constexpr double kShortPop_m = 0.36, kShortClipFrames = 45, kPopFrames = 9;

// Freezes.
inline constexpr double kStill_m_s = 0.002, kFreeze_s = 0.9, kAbrupt_m_s = 0.03;
/// Authored clips hold a pose exactly for up to 2 s. In 5000 recorded clips no pose is repeated for half a second.
inline constexpr double kRepeat_s = 3;

// Limbs.
inline constexpr double kStretch = 0.03, kStretchTimesUsual = 15, kStretch_s = 0.05;
inline constexpr double kBend_deg = 25, kBend_s = 0.1;
inline constexpr double kTorn_s = 0.1, kGap_s = 0.5;
inline constexpr double kPass_m = 0.035, kPass_s = 0.05;

// Gravity and speed.
inline constexpr double kGravity = 9.81, kGravityFactor = 2.2;
inline constexpr double kFast_m_s = 10;

}  // namespace etude::fault_limits
