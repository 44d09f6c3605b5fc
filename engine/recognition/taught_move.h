#pragma once

#include <string>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/recognition/skeleton_stream.h"

namespace [[gnu::visibility("default")]] etude {

/// One angle of a key pose (paper A, "key pose on a few angles").
struct PoseTarget {
  Feature feature = Feature::kRH;
  double degrees = 0;
  double tolerance_deg = 0;  ///< allowed deviation, > 0
};

/// A pose that must be reached for the move to be recognised.
struct TaughtPose {
  std::vector<PoseTarget> targets;  ///< the angles of the pose; at least one
};

constexpr double kMaxSpan = 60;  ///< maximum of TaughtMove::span_s, seconds

/// A move as it is taught to recognisers. Each recogniser uses the fields it needs and rejects a move that lacks them.
struct TaughtMove {
  std::string name;
  std::vector<TaughtPose> poses = {};  ///< key poses, which must be reached in this order
  /// The longest duration of one performance: the move's length at its slowest tempo. Seconds, above 0 and at most
  /// kMaxSpan. If the move was not asked for, its performance may begin at most this long before the present frame.
  double span_s = 10;
  std::vector<SkeletonStream> examples = {};          ///< right performances from the first beat to the last
  std::vector<SkeletonStream> counter_examples = {};  ///< wrong performances that look similar
};

}  // namespace etude
