#include "bench/tasks/pose_distance/run.h"

#include <array>
#include <cassert>

#include "bench/metrics/matching.h"
#include "engine/base/named.h"
#include "engine/transitions/alignment.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {
namespace {

constexpr Named<PoseDistance> kDistances[] = {{"fuzzy", PoseDistance::kFuzzy},
                                              {"point-cloud", PoseDistance::kPointCloud},
                                              {"joint-positions", PoseDistance::kJointPositions}};

/// A cloud of one frame's joints each.
double PointCloudCm(const BodyPose& a, const BodyPose& b) {
  const BodyMotion first{kJudgedRateHz, {a}}, second{kJudgedRateHz, {b}};
  std::array<double, 1> cost{};
  PointCloudRows(first, second, 0, 0).Compute(0, std::array{0}, cost);
  return cost[0];
}

}  // namespace

std::vector<std::string> PoseDistanceNames() { return NamesOf(kDistances); }

PoseDistance FindPoseDistance(std::string_view name) { return ValueNamed(kDistances, name); }

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
