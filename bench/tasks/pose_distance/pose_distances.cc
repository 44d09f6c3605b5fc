#include "bench/tasks/pose_distance/pose_distances.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "bench/metrics/pose_distance.h"
#include "engine/transitions/base/alignment.h"
#include "engine/transitions/choices/point_cloud_rows.h"

namespace etude {
namespace {

constexpr std::array<std::pair<std::string_view, PoseDistance>, 3> kDistances = {
    {{"fuzzy", PoseDistance::kFuzzy},
     {"point-cloud", PoseDistance::kPointCloud},
     {"joint-positions", PoseDistance::kJointPositions}}};

/// A cloud of one frame's joints each.
double PointCloudCm(const BodyPose& a, const BodyPose& b) {
  const BodyMotion first{kJudgedRateHz, {a}}, second{kJudgedRateHz, {b}};
  std::array<double, 1> cost{};
  PointCloudRows(first, second, 0, 0).Compute(0, std::array{0}, cost);
  return cost[0];
}

}  // namespace

std::vector<std::string> PoseDistanceNames() {
  std::vector<std::string> names;
  for (const auto& [name, distance] : kDistances) names.emplace_back(name);
  return names;
}

PoseDistance FindPoseDistance(std::string_view name) {
  const auto found =
      std::find_if(kDistances.begin(), kDistances.end(), [&](const auto& entry) { return entry.first == name; });
  assert(found != kDistances.end());
  return found->second;
}

PairVerdict TellPairs(const PairWorld& world, const PoseDistanceMethod& method, const Memberships& memberships,
                      const FeatureWeights& weights) {
  const auto distance_of = [&](const SeenPair& pair) {
    switch (method.distance) {
      case PoseDistance::kFuzzy: {
        const Grades a = Fuzzify(pair.a.features, memberships), b = Fuzzify(pair.b.features, memberships);
        return ComputeDistance(a, b, weights).value;
      }
      case PoseDistance::kPointCloud:
        return PointCloudCm(pair.a.pose, pair.b.pose);
      case PoseDistance::kJointPositions:
        return MeanJointDistanceCm(pair.a.pose, AlignOnFloor(pair.b.pose, pair.a.pose).Apply(pair.b.pose));
    }
    assert(false);
    return 0.0;
  };
  PairVerdict verdict;
  for (const SeenPair& pair : world.pairs) {
    verdict.distances.push_back(distance_of(pair));
    verdict.alike.push_back(verdict.distances.back() < method.threshold);
  }
  return verdict;
}

}  // namespace etude
