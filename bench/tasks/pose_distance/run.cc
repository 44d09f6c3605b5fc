#include "bench/tasks/pose_distance/run.h"

#include <array>
#include <cassert>

#include "bench/metrics/detection.h"
#include "bench/metrics/matching.h"
#include "bench/metrics/transition_smoothness.h"
#include "engine/base/digest.h"
#include "engine/base/named.h"
#include "engine/motion/body.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {
namespace {

constexpr Named<PoseDistance> kDistances[] = {{"fuzzy", PoseDistance::kFuzzy},
                                              {"point-cloud", PoseDistance::kPointCloud},
                                              {"joint-positions", PoseDistance::kJointPositions}};

/// Returns the point-cloud distance of two poses, centimetres. Each cloud consists of a single frame.
double PointCloudCm(const BodyPose& a, const BodyPose& b) {
  const BodyMotion first{kJudgedRateHz, {a}}, second{kJudgedRateHz, {b}};
  std::array<double, 1> cost{};
  PointCloudRows(first, second, 0, 0).Compute(0, std::array{0}, cost);
  return cost[0];
}

constexpr const char* kManyPairs = "the world has several pairs";
constexpr const char* kNotCalledAlike = "the method did not call the poses alike";

/// Measures the metrics of a single pair.
void MeasurePair(const SeenPair& pair, double value, bool alike, const PoseDistance* distance, CellResult& result) {
  const auto own = [&](const char* id, bool is_its, const char* why_not) {
    is_its ? result.Measure(id, value) : result.Missing(id, why_not);
  };
  const bool fuzzy = distance && *distance == PoseDistance::kFuzzy;
  own("fuzzy_distance", fuzzy, "the method measures no fuzzy distance");
  own("joint_distance_cm", distance && !fuzzy, "the method measures no distance of joints");
  const double gap_cm = 100 * pair.gap_m;
  result.Measure("pose_gap_cm", gap_cm);
  result.Measure("called_alike", alike);
  alike ? result.Measure("false_smooth", IsFalselySmooth(gap_cm)) : result.Missing("false_smooth", kNotCalledAlike);
}

MatchTally Tally(const PairWorld& world, const PairVerdict& verdict) {
  MatchTally tally;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    ++tally.pairs;
    tally.matching += verdict.alike[i];
    tally.falsely_smooth += verdict.alike[i] && IsFalselySmooth(100 * world.pairs[i].gap_m);
  }
  return tally;
}

std::vector<JudgedEvent> AsEvents(const PairWorld& world, const PairVerdict& verdict) {
  std::vector<JudgedEvent> events;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    events.push_back({world.pairs[i].gap_m < kCloseGap, verdict.alike[i], -verdict.distances[i]});
  }
  return events;
}

}  // namespace

std::vector<std::string> PoseDistanceNames() { return NamesOf(kDistances); }

PoseDistance FindPoseDistance(std::string_view name) { return ValueNamed(kDistances, name); }

PairVerdict ComputePairVerdict(const PairWorld& world, const PoseDistanceMethod& method, const Memberships& memberships,
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

std::vector<std::string> PoseDistanceMetrics() {
  return {"fuzzy_distance", "joint_distance_cm", "pose_gap_cm",    "called_alike",      "false_smooth",
          "close_auc",      "close_f1",          "matching_share", "false_smooth_share"};
}

CellResult ScorePairs(const PairWorld& world, const PairVerdict& verdict, const PoseDistance* distance) {
  CellResult result = CellResult::Ended(Status::kOk, "");
  Digest digest;
  for (double value : verdict.distances) digest.Add(value);
  for (bool alike : verdict.alike) digest.Add(std::int64_t{alike});
  result.digests.emplace_back("verdict", digest.Hex());

  if (world.pairs.size() == 1) {
    MeasurePair(world.pairs.front(), verdict.distances.front(), verdict.alike.front(), distance, result);
  } else {
    for (const char* id : {"fuzzy_distance", "joint_distance_cm", "pose_gap_cm", "called_alike", "false_smooth"}) {
      result.Missing(id, kManyPairs);
    }
  }
  const std::vector<JudgedEvent> events = AsEvents(world, verdict);
  const MatchTally tally = Tally(world, verdict);
  result.MeasureOr("close_auc", RocAuc(events), "the pairs are all close, or none is");
  result.MeasureOr("close_f1", F1(CountConfusion(events)), "no pair is close, and none was called alike");
  result.MeasureOr("matching_share", MatchingShare(tally), "there is no pair");
  result.MeasureOr("false_smooth_share", FalseSmoothShare(tally), "no pair was called alike");
  return result;
}

}  // namespace etude
