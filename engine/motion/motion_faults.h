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

/// Returns "floats", "sinks", "skates", "jumps", "pops", "freezes", "stretches", "bends", "torn", "gaps",
/// "passes", "rate" or "speed".
std::string_view FaultName(FaultKind kind);
/// Returns the unit of its size: "m", "m/s", "s", "share", "deg" or "m/s2".
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
/// 60 cm from 0 has no floor at 0, and the height at which its feet rest is used. Rules:
/// - Jumps, floats, sinks: third differences of positions in which 70 % of the joints agree, an ankle among them, are
///   displacements of the whole body. Those along the floor (10 cm) or longer than 25 cm are jumps; vertical ones (4
///   cm) start or end times in which the body floats or sinks. Without such an edge, a body floats that rests 10 cm
///   high in the whole clip or stays high without rest, and sinks where it is 6 cm below the floor.
/// - Skates: the velocity of 70 % of the joints changes by 12 cm/s or more from one frame to the next, and back later,
///   while low feet move with it; or the most frequent velocity of the low joints of the feet within 0.6 s is not near
///   0. One foot skates if its ankle and toes rest, and move alike along the floor for 0.4 s (0.25 s at one velocity).
/// - Rate: in flights, the mass centre falls with less than 4.5 or more than 21.6 m/s² (2.2 times less or more).
/// - Speed: the fastest joint moves at more than 10 m/s in the median frame, and no flight shows the gravity.
/// - Pops: third differences above 25 cm and six times the joint's usual (95th percentile); 45 cm at any noise.
/// - Stretches: upper arms, forearms, thighs and shanks, by 3 %; between markers by fifteen times the
///   usual (median). Bends: 25° for 0.1 s, by the direction of the toes,
///   or, without toes, about the line of the hips.
/// - Torn: the distance of two neighbours (of trunk, head, shoulders, hips; ankle and toes, wrist and hand) changes for
///   0.1 s by 8 to 12 % of leg and trunk; in the median frame it is 1.7 to 3.3 times the usual, or differs so much from
///   that of the other side. The head points down the trunk, toes point backwards, shoulders or hips are exchanged.
/// - Gaps: a joint that other frames show is not shown for 0.5 s.
/// - Passes: a forearm or a hand within 3.5 cm of the spine's line, or a forearm within that of neck and head.
/// Fewer than kMinFramesForFaults frames show no fault. All positions must be finite.
MotionFaults FindMotionFaults(const BodyMotion& motion, const FaultOptions& options = {});

/// Returns the sentences of the faults, of each kind the three largest; a last one counts the others.
std::vector<std::string> FaultSentences(const std::vector<MotionFault>& faults);

}  // namespace etude
