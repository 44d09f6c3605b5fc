#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// Faults that no motion of a real person has. Either the motion is wrong or its file was read wrongly.
enum class FaultKind {
  kFloats,     ///< the feet rest above the floor; size: height, metres
  kSinks,      ///< the body is below the floor; size: depth, metres
  kSkates,     ///< standing feet move along the floor; size: their common speed, metres per second
  kJumps,      ///< the whole body is displaced from one frame to the next; size: distance, metres
  kPops,       ///< one joint is displaced alone; size: distance, metres
  kFreezes,    ///< no joint moves although the body was in motion, or a pose is repeated exactly; size: seconds
  kStretches,  ///< a limb changes its length; size: share of its median length
  kBends,      ///< a knee bends backwards; size: degrees
  kTorn,       ///< a joint is at a wrong distance from its neighbours, or (without a joint) left and right are
               ///< exchanged; size: error of the position, metres
  kGaps,       ///< some frames lack joints that other frames show; size: seconds
  kPasses,     ///< a forearm or a hand passes through trunk or head; size: its distance from the spine's line, metres
  kRate,       ///< in flight the body falls with a wrong acceleration; size: that acceleration, metres per second²
  kSpeed,      ///< the fastest joint is too fast for a person; size: its median speed, metres per second
};

/// The name, unit and rule of a kind of fault. FaultRules lists them in the order of FaultKind.
struct FaultRule {
  std::string_view
      name;  ///< "floats", "sinks", "skates", "jumps", "pops", "freezes", "stretches", "bends", "passes", …
  std::string_view unit;  ///< unit of the fault's size: "m", "m/s", "s", "share", "deg" or "m/s2"
  std::string rule;       ///< the rule in words, with the thresholds (fault_limits.h)
};
const std::vector<FaultRule>& FaultRules();
std::string_view FaultName(FaultKind kind);
std::string_view FaultUnit(FaultKind kind);

/// One fault in a motion.
struct MotionFault {
  FaultKind kind = FaultKind::kFloats;
  double from_s = 0, to_s = 0;     ///< times of the fault's first and last frame
  std::optional<Role> joint = {};  ///< the joint at fault; a limb is named by its far end; absent: the whole body
  double size = 0;                 ///< meaning and unit: see the comment of `kind` in FaultKind
  double lasts_s = 0;              ///< the fault's duration, if it comes and goes between `from_s` and `to_s`; else 0
  std::string text = {};           ///< a sentence for users: "floats 6 cm from 1.20 to 3.20 s"
};

struct MotionFaults {
  double floor_m = 0;                    ///< the height of the floor that the motion is judged by
  bool is_floor_found = false;           ///< true if the floor was found from the motion, which is far from height 0
  std::vector<MotionFault> faults = {};  ///< sorted by kind, then by time
};

/// Options of FindMotionFaults.
struct FaultOptions {
  std::optional<double> floor_m = {};  ///< the height of the floor; absent: see FindMotionFaults
  bool is_floor_known = true;          ///< false: height 0 is not that of a floor, but of the camera or the hips
  double begin_s = 0;                  ///< time of the first frame by the file's clock, which faults' times use
  /// For each frame, the joints that it does not show, because the file lacks them and a reader guessed their
  /// positions; empty: all joints are shown. Limbs that end at such joints are not judged.
  std::vector<JointSet> unseen = {};
  /// Joints that no frame of the file shows, if the motion is only a part of the file; absent: joints that no frame of
  /// the motion shows. Only joints that other frames show can be lost in a gap.
  std::optional<JointSet> never = {};
  /// The durations of the frames before and after the motion that are not in it because joints are missing.
  double lost_before_s = 0, lost_after_s = 0;
  bool is_of_markers = false;  ///< true: joints were found from markers on the skin, so the lengths of limbs may change
};

/// Motions with fewer frames are not judged.
constexpr std::size_t kMinFramesForFaults = 8;

/// Finds the faults of a motion without a reference motion; the method is our own. FaultRules states the rules. The
/// motion is in metres, Y up, with finite positions, and at its own rate, because resampling hides displaced or
/// repeated frames. If `floor_m` is absent, the floor is at height 0; but if the floor is not known, or the 5th
/// percentile of the lowest joint's height is then more than 60 cm from 0, the floor is found from the height at which
/// the feet rest. In a motion of
/// fewer than kMinFramesForFaults frames, only gaps are found.
MotionFaults FindMotionFaults(const BodyMotion& motion, const FaultOptions& options = {});

/// Sorts faults by kind, then by time.
void SortFaults(std::vector<MotionFault>& faults);

/// Returns the sentences of the three largest faults of each kind. If faults are left out, one more sentence states
/// their number.
std::vector<std::string> FaultSentences(const std::vector<MotionFault>& faults);

}  // namespace etude
