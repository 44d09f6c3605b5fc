#pragma once

#include <string>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// One angle of a key pose (paper A, "key pose on a few angles").
struct PoseTarget {
  Feature feature = Feature::kRH;
  double degrees = 0;
  double tolerance_deg = 0;  ///< > 0
};

/// A pose that must be reached for the move to count.
struct TaughtPose {
  std::vector<PoseTarget> targets;  ///< at least one
};

constexpr double kLongestSpan = 60;  ///< seconds

/// A move as recognisers are taught it. Each takes what it needs and refuses a move that lacks it.
struct TaughtMove {
  std::string name;
  std::vector<TaughtPose> poses = {};  ///< to be reached in this order
  /// The longest that one performance lasts, seconds, above 0 and at most kLongestSpan: the move's length at its
  /// slowest. It bounds what is taken for one performance where nobody says when the move is due.
  double span_s = 10;
  std::vector<SkeletonStream> examples = {};          ///< right performances, from the first beat to the last
  std::vector<SkeletonStream> counter_examples = {};  ///< wrong ones, which look alike
};

}  // namespace etude
