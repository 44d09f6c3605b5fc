#pragma once

#include <cstdint>
#include <optional>

#include "engine/motion/body.h"

namespace etude {

/// The number of pairs of bridge frames, and how many of them match: their distance is below a threshold. Each bridge
/// frame of the old clip within the allowed wait forms a pair with each bridge frame of the new clip
/// (docs/reference/metrics.md, Matching).
struct MatchTally {
  std::int64_t pairs = 0;
  std::int64_t matching = 0;        ///< number of pairs whose distance is below the threshold
  std::int64_t falsely_smooth = 0;  ///< number of matching pairs whose pose gap exceeds 20 cm (IsFalselySmooth)
};

/// Returns the share of the pairs that match; empty if there are no pairs.
std::optional<double> MatchingShare(const MatchTally& tally);

/// Returns the share of the matching pairs that are falsely smooth; empty if no pair matches.
std::optional<double> FalseSmoothShare(const MatchTally& tally);

/// Returns true if a direct transition is possible: at least one pair matches.
constexpr bool HasDirectMatch(const MatchTally& tally) { return tally.matching > 0; }

/// Two poses are close (hard to tell apart) if their largest joint distance is below this limit, metres.
constexpr double kCloseGap = 0.15;

/// Returns the mean distance of the twenty joints, centimetres, without aligning the poses.
double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b);

}  // namespace etude
