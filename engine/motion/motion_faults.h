#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// Ways in which a motion cannot be that of a person, or its file is read wrongly.
enum class FaultKind {
  kFloats,     ///< the feet rest above the floor; size: height, metres
  kSinks,      ///< the body is below the floor; size: depth, metres
  kSkates,     ///< standing feet move along the floor; size: their common speed, metres per second
  kJumps,      ///< the whole body is displaced from one frame to the next; size: distance, metres
  kPops,       ///< one joint is displaced alone; size: distance, metres
  kFreezes,    ///< no joint moves while the body was in motion; size: seconds
  kStretches,  ///< a limb changes its length; size: share of its median length
  kBends,      ///< a knee bends backwards; size: degrees
  kTorn,       ///< a joint is not where its neighbours have it, or (without a joint) left and right are exchanged;
               ///< size: how far off, metres
  kGaps,       ///< joints are not shown; size: seconds
  kPasses,     ///< a forearm or a hand passes through trunk or head; size: its distance from the spine's line, metres
  kRate,       ///< in flight the body falls by another gravity: a wrong rate or unit; size: metres per second²
  kSpeed,      ///< most frames show a joint faster than people are; size: metres per second
};

/// What is said of a kind of fault, in the order of FaultKind.
struct FaultRule {
  std::string_view
      name;  ///< "floats", "sinks", "skates", "jumps", "pops", "freezes", "stretches", "bends", "passes", …
  std::string_view unit;  ///< of its size: "m", "m/s", "s", "share", "deg" or "m/s2"
  std::string rule;       ///< when a motion shows it, with the thresholds (fault_limits.h)
};
const std::vector<FaultRule>& FaultRules();
std::string_view FaultName(FaultKind kind);
std::string_view FaultUnit(FaultKind kind);

/// A fault, the time that it takes, and what it looks like.
struct MotionFault {
  FaultKind kind = FaultKind::kFloats;
  double from_s = 0, to_s = 0;     ///< its first and its last frame
  std::optional<Role> joint = {};  ///< the joint at fault; a limb is named by its far end; absent: the whole body
  double size = 0;                 ///< unit: FaultKind
  std::string text = {};           ///< a sentence for people: "floats 6 cm from 1.20 to 3.20 s"
};

struct MotionFaults {
  double floor_m = 0;           ///< the height of the floor that the motion is judged by
  bool is_floor_found = false;  ///< the motion is far from height 0, so its floor is the height where its feet rest
  std::vector<MotionFault> faults = {};  ///< by kind, then by time
};

/// How the faults of a motion are sought.
struct FaultOptions {
  std::optional<double> floor_m = {};  ///< the height of the floor; absent: 0, or found
  double begin_s = 0;                  ///< the time of the first frame, from which faults are dated
  /// The joints that a frame does not show, because the file lacks them and a reader placed them; empty: none. Nothing
  /// is said of limbs that end there.
  std::vector<JointSet> unseen = {};
  double lost_before_s = 0, lost_after_s = 0;  ///< time of the file before and behind the motion, which joints lack
  bool is_of_markers = false;  ///< its joints were found from markers on the skin, so limbs need not keep their lengths
};

/// The fewest frames in which faults are sought.
constexpr std::size_t kMinFramesForFaults = 8;

/// Finds the faults of a motion without a truth, in metres, Y up, at its own rate (resampling hides frames that are
/// displaced or repeated). *(Ours.)* The floor is `floor_m`, else height 0; a motion whose lowest joint stays more than
/// 60 cm from 0 has no floor at 0, and the height at which its feet rest is used. FaultRules states the rules.
/// Fewer than kMinFramesForFaults frames show no fault. All positions must be finite.
MotionFaults FindMotionFaults(const BodyMotion& motion, const FaultOptions& options = {});

/// Returns the sentences of the faults, of each kind the three largest; a last one counts the others.
std::vector<std::string> FaultSentences(const std::vector<MotionFault>& faults);

}  // namespace etude
