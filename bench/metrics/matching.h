#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The outcome of testing a distance against a threshold on the pairs of frames that a transition could have used:
/// every bridge frame of the old clip that the wait allows with every bridge frame of the new one
/// (docs/reference/metrics.md, Matching).
struct MatchTally {
  std::int64_t pairs = 0;
  std::int64_t matching = 0;        ///< their distance is below the threshold
  std::int64_t falsely_smooth = 0;  ///< they match, and yet their pose gap is more than 20 cm (IsFalselySmooth)
};

/// Share of the pairs that match; empty where there is no pair.
std::optional<double> MatchingShare(const MatchTally& tally);

/// Share of the matching pairs that are falsely smooth; empty where nothing matches.
std::optional<double> FalseSmoothShare(const MatchTally& tally);

/// True if a direct transition could be made, which takes a pair.
constexpr bool HasDirectMatch(const MatchTally& tally) { return tally.matching > 0; }

/// Two poses whose worst joint is less than this apart, metres, are close: hard to tell apart.
constexpr double kCloseGap = 0.15;

/// Mean distance of the twenty joints, centimetres; both poses stand where they are.
double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b);

/// The frames that a search answered for one query, in the order in which they are asked for; empty: none.
using FoundFrames = std::vector<int>;

/// `search_agreement`: the share of the queries answered exactly as a loop over all frames answers them. One entry per
/// query in both; empty where there is no query.
std::optional<double> SearchAgreement(const std::vector<FoundFrames>& found, const std::vector<FoundFrames>& truth);

/// `matches_per_query`: how many frames are answered on average.
std::optional<double> MatchesPerQuery(const std::vector<FoundFrames>& found);

/// The mean of something counted per query (`distances_per_query`, `boxes_per_query`); empty where there is no query.
std::optional<double> MeanPerQuery(std::span<const std::int64_t> counts);

}  // namespace etude
