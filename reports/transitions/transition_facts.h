#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/model/recording.h"
#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"

namespace etude {

/// a transition point: two frames, at which a motion changed clips.
struct PointFacts {
  std::string from, to;  ///< clips in words; "in-between" for frames of the method's own
  std::optional<int> from_frame, to_frame;
  std::optional<double> distance;
  std::optional<PerFeature> partials;  ///< S_k Δ_k², which sum to distance²
};

/// A pair of frames that was looked at on the way.
struct CandidateFacts {
  int from_frame = 0, to_frame = 0;
  double distance = 0;
  std::optional<PerFeature> partials;
  std::optional<double> cost;  ///< what the choice ranks by, where that is not the distance
  std::string outcome;         ///< "taken", "too far", "later", "worse"
  std::optional<int> point;    ///< for which of the points it was looked at

  bool operator==(const CandidateFacts&) const = default;
};

/// What the recording of a transition tells of it. Whatever it leaves out is empty here: recordings of older
/// runs, and of methods outside, tell less.
struct TransitionFacts {
  std::string from, to;  ///< clips in words
  std::string branch;    ///< which way was taken: "front half", "in-between", …
  std::string why;       ///< one sentence
  std::string cost_unit;
  std::vector<int> transition_frames;  ///< of the recording: the last ones before a change, rising; may be empty
  std::vector<PointFacts> points;
  std::vector<CandidateFacts> candidates;
  std::optional<int> request_frame;  ///< of the recording; negative: before it begins
  std::optional<double> wait_s, threshold, natural_limit_cm;
  std::optional<PerFeature> weights;
  std::optional<long long> pairs_seen, pairs_matched;
};

/// Fails, naming `cell`, when the extras are no JSON object. Transition points outside of the coach's motion are left
/// out.
Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell);

/// A clip's name as people say it: "builtin:side_kick" is "side kick".
std::string ClipInWords(std::string name);

}  // namespace etude
