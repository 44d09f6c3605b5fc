#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// The options by which key poses and tolerances are found.
struct TeachOptions {
  /// An angle makes key poses when it changes by so much in the course of the move, degrees (Posture: its scale), and
  /// by half as much as the one that changes most. Below it, sensors' noise would. With one angle of an arm all four of
  /// the arms are told, as A's poses do, because one arm that rises alone is another move than both; with one angle of
  /// a leg both of that leg.
  double least_range_deg = 25;
  /// The largest number of key poses: the pose farthest from the move's mean, then those farthest from the ones there
  /// are, as long as they are half as far apart as the first two.
  int most_poses = 3;
  /// A tolerance is so many deviations of the examples about their mean, within the limits below.
  double spread = 2.5;
  /// The limits of a tolerance, degrees. One example shows no spread: its tolerances are the least ones.
  double least_tolerance_deg = 20;
  double most_tolerance_deg = 40;
};

/// Teaches a move from performances of it, each a stream from its beginning to its end: key poses with tolerances for
/// recognisers that go by those, the examples for those that compare. Wrong performances are kept as counter-examples.
/// Refused: no right performance, one without half a second of a body, names that are no names, over a minute.
Result<TaughtMove> TeachMove(const std::string& name, std::vector<SkeletonStream> right,
                             std::vector<SkeletonStream> wrong = {}, const TeachOptions& options = {});

}  // namespace etude
