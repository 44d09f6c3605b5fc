#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace etude {

/// The frames that a search answered for one query, in the order in which they are asked for; empty: none.
using FoundFrames = std::vector<int>;

/// `search_agreement`: the share of the queries answered exactly as a loop over all frames answers them. One entry per
/// query in both; empty where there is no query.
std::optional<double> SearchAgreement(const std::vector<FoundFrames>& found, const std::vector<FoundFrames>& truth);

/// `matches_per_query`: how many frames are answered on average.
std::optional<double> MatchesPerQuery(const std::vector<FoundFrames>& found);

/// Of something counted per query (`distances_per_query`, `boxes_per_query`); empty where there is no query.
std::optional<double> MeanPerQuery(std::span<const std::int64_t> counts);

}  // namespace etude
