#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/world.h"
#include "bench/training/learnt_weights.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// A definition of the distance of two poses.
enum class PoseDistance {
  kFuzzy,           ///< paper A's d, equation 1
  kPointCloud,      ///< Kovar's distance: RMS joint distance after the best alignment on the floor, cm
  kJointPositions,  ///< mean joint distance after aligning heading and hip centre, cm
};

/// Returns the names "fuzzy", "point-cloud", "joint-positions".
std::vector<std::string> PoseDistanceNames();
/// Returns the distance with this name. `name` must be one of PoseDistanceNames.
PoseDistance FindPoseDistance(std::string_view name);

struct PoseDistanceMethod {
  std::string name;
  PoseDistance distance = PoseDistance::kFuzzy;
  WeightSource weights = WeightSource::kFixed;  ///< the source of the fuzzy distance's weights
  /// Poses are called alike if their distance is below this threshold. It has no unit for the fuzzy distance, and is in
  /// centimetres for the other distances.
  double threshold = kPaperThreshold;
};

/// A method's verdicts on the pairs of a world, in the order of the pairs.
struct PairVerdict {
  std::vector<double> distances;  ///< distances on any scale; larger = less alike
  std::vector<bool> alike;
};

/// Computes a method's verdicts. `weights` are the feature weights S of the fuzzy distance; other distances ignore
/// them.
PairVerdict ComputePairVerdict(const PairWorld& world, const PoseDistanceMethod& method, const Memberships& memberships,
                      const FeatureWeights& weights);

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> PoseDistanceMetrics();

/// Scores a verdict. `distance` is the built-in distance that the method used, or null for an outside method, whose
/// scale is unknown. If the world has a single pair, the value of this distance is one of the metrics.
CellResult ScorePairs(const PairWorld& world, const PairVerdict& verdict, const PoseDistance* distance);

}  // namespace etude
