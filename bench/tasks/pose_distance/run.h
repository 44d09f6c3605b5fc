#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/world.h"
#include "bench/training/learnt_weights.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// A way to tell how unlike two poses are.
enum class PoseDistance {
  kFuzzy,           ///< paper A's d, equation 1
  kPointCloud,      ///< Kovar's: root mean square over the joints after the best alignment on the floor, cm
  kJointPositions,  ///< mean over the joints after laying heading and hip centre onto each other, cm
};

/// "fuzzy", "point-cloud", "joint-positions".
std::vector<std::string> PoseDistanceNames();
/// `name` must be one of them.
PoseDistance FindPoseDistance(std::string_view name);

/// A method of task pose-distance.
struct PoseDistanceMethod {
  std::string name;
  PoseDistance distance = PoseDistance::kFuzzy;
  WeightSource weights = WeightSource::kFixed;  ///< of the fuzzy one
  double threshold = kPaperThreshold;           ///< two poses are called alike below it; of the others, centimetres
};

/// The verdicts of a method on a world's pairs, in their order.
struct PairVerdict {
  std::vector<double> distances;  ///< the larger, the more unlike; on any scale
  std::vector<bool> alike;
};

/// `weights` are S of the fuzzy distance; the others have none.
PairVerdict TellPairs(const PairWorld& world, const PoseDistanceMethod& method, const Memberships& memberships,
                      const FeatureWeights& weights);

/// The ids of all metrics, in the order in which they are measured.
std::vector<std::string> PoseDistanceMetrics();

/// Measures a verdict. `distance` is the built-in one that was asked, whose own number a pair has; null for a method
/// outside, whose scale nobody knows.
CellResult ScorePairs(const PairWorld& world, const PairVerdict& verdict, const PoseDistance* distance);

}  // namespace etude
