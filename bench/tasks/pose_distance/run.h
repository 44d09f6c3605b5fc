#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/world.h"
#include "bench/training/learnt_weights.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// A distance of two poses.
enum class PoseDistance {
  kFuzzy,           ///< paper A's d, equation 1
  kPointCloud,      ///< Kovar's: root mean square over the joints after the best alignment on the floor, cm
  kJointPositions,  ///< mean over the joints after aligning heading and hip centre, cm
};

/// "fuzzy", "point-cloud", "joint-positions".
std::vector<std::string> PoseDistanceNames();
/// `name` must be one of them.
PoseDistance FindPoseDistance(std::string_view name);

/// A method of task pose-distance.
struct PoseDistanceMethod {
  std::string name;
  PoseDistance distance = PoseDistance::kFuzzy;
  WeightSource weights = WeightSource::kFixed;  ///< of the fuzzy distance
  /// Poses with a smaller distance are called alike; in centimetres for the other distances.
  double threshold = kPaperThreshold;
};

/// The verdicts of a method on a world's pairs, in their order.
struct PairVerdict {
  std::vector<double> distances;  ///< larger = less alike; on any scale
  std::vector<bool> alike;
};

/// Computes a method's verdict. `weights` are S of the fuzzy distance; the others do not use them.
PairVerdict ComputePairVerdict(const PairWorld& world, const PoseDistanceMethod& method, const Memberships& memberships,
                      const FeatureWeights& weights);

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> PoseDistanceMetrics();

/// Measures a verdict. `distance` is the built-in distance used, whose value a single pair reports; null for an outside
/// method, whose scale is unknown.
CellResult ScorePairs(const PairWorld& world, const PairVerdict& verdict, const PoseDistance* distance);

}  // namespace etude
