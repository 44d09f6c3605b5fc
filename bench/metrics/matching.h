#pragma once

#include <cstdint>
#include <optional>

namespace etude {

/// What a distance below a threshold makes of the pairs of frames that a transition could have used: every bridge frame
/// of the old clip that the wait allows with every bridge frame of the new one (docs/metrics.md, Matching).
struct MatchTally {
  std::int64_t pairs = 0;
  std::int64_t matching = 0;        ///< their distance is below the threshold
  std::int64_t falsely_smooth = 0;  ///< they match, and yet their pose gap is more than 20 cm (IsFalselySmooth)
};

/// Share of the pairs that match; empty where there is no pair.
std::optional<double> MatchingShare(const MatchTally& tally);

/// Share of the matching pairs that are falsely smooth; empty where nothing matches.
std::optional<double> FalseSmoothShare(const MatchTally& tally);

/// Whether a direct transition could be made. Where there is no pair, none could.
constexpr bool HasDirectMatch(const MatchTally& tally) { return tally.matching > 0; }

}  // namespace etude
