#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// The options for finding key poses and tolerances.
struct TeachOptions {
  /// The range in degrees that an angle must cover in the move to be used in key poses (the feature Posture is not an
  /// angle; the same number applies to its values). The angle must also cover half the range of the angle that changes
  /// most. With a smaller value than the default, sensor noise would count. If one angle of an arm is used, all four
  /// angles of both arms are used, as in paper A's poses, because raising one arm is a different move from raising
  /// both. If one angle of a leg is used, both angles of that leg are used.
  double least_range_deg = 25;
  /// The maximum number of key poses. The first is the pose farthest from the move's mean. Each further key pose is the
  /// pose farthest from the poses chosen so far; its distance must be at least half of the distance between the first
  /// two key poses.
  int most_poses = 3;
  /// An angle's tolerance is this multiple of the angle's standard deviation over the examples, within the two limits
  /// below.
  double spread = 2.5;
  /// The limits of a tolerance, in degrees. With one example there is no standard deviation, so all tolerances are the
  /// minimum.
  double least_tolerance_deg = 20;
  double most_tolerance_deg = 40;
};

/// Teaches a move from performances; each is a stream from the performance's beginning to its end. Key poses with
/// tolerances are found for recognisers that need them, and the examples are kept for recognisers that compare with
/// examples. Wrong performances are kept as counter-examples and are not checked. Returns an error if there is no right
/// performance, or if a right performance shows a body for less than half a second or lasts more than a minute.
Result<TaughtMove> TeachMove(const std::string& name, std::vector<SkeletonStream> right,
                             std::vector<SkeletonStream> wrong = {}, const TeachOptions& options = {});

}  // namespace etude
