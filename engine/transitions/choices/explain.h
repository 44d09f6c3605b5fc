#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A pair of frames as a choice thinks of it.
struct RankedPair {
  int from = 0, to = 0;
  bool matches = false;        ///< a transition point may be there
  double rank = 0;             ///< less is better, among those that match or among those that do not
  std::optional<double> cost;  ///< as the record shows it
};

/// The taken pair and the best of the others, kMostCandidates at most, by frames. `others` does not hold the taken one;
/// those of them that match have the outcome `passed_over`.
std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over);

/// "no match among 900 pairs of bridge frames: the nearest has d = 0.52, not below 0.4". `nearest` holds pairs that do
/// not match, ranked by d; none when no two frames were comparable. `frames` says what of: "bridge frames".
std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules);

/// "boxing frame 41 (0.37 s after the request) and clap frame 3".
std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to);

}  // namespace etude
