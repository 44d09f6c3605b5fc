#pragma once

#include "engine/fuzzy/distance.h"

namespace etude {

/// Which of several matching pairs of frames is taken.
enum class Pick {
  kFirst,     ///< paper A: the first one found
  kSmallest,  ///< A's other wording ("the smallest difference"): the smallest distance in the window
};

/// When two frames match, for everything that goes by the fuzzy distance (equation 1).
struct MatchRules {
  FeatureWeights weights = PaperWeights();
  /// Frames match when their distance is below it. Paper A's: 0.4. A larger one finds more direct transitions, and
  /// worse ones (docs/transitions.md).
  double threshold = kPaperThreshold;
  Pick pick = Pick::kFirst;
  bool within_class = false;  ///< ours: only frames with the same ten tags match
};

}  // namespace etude
