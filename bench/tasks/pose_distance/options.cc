#include "bench/tasks/pose_distance/options.h"

#include "bench/tasks/base/fuzzy_key.h"
#include "bench/tasks/base/misplaced_keys.h"
#include "engine/base/names.h"

namespace etude {
namespace {

const std::vector<std::string> kSources = {"blindspots", "frames"};
/// Ours: of any frames of two clips the joints' mean lets through about as many pairs below it (0.4 %) as paper A's d
/// does below 0.4 (0.5 %).
constexpr double kDefaultThresholdCm = 6;

Result<PoseDistanceMethod> ReadMethod(const Node& node) {
  Fields fields(node, "a method of task pose-distance");
  PoseDistanceMethod method;
  method.name = fields.RequiredText("name");
  method.distance = FindPoseDistance(fields.Choice("distance", PoseDistanceNames(), PoseDistanceNames().front()));
  if (method.distance == PoseDistance::kFuzzy) {
    method.weights = FindWeightSource(fields.Choice("weights", WeightSourceNames(), WeightSourceNames().front()));
    // Grades lie in [0, 1] and S sums to 8, so no distance exceeds sqrt(8 · 4).
    method.threshold = fields.Number("threshold", kPaperThreshold, {0, 6});
  } else {
    method.threshold = fields.Number("threshold_cm", kDefaultThresholdCm, {0, 1000});
  }
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

PairOptions ReadPairOptions(Fields& condition) {
  PairOptions options;
  const bool frames = condition.Choice("pairs", kSources, kSources.front()) == "frames";
  options.source = frames ? PairSource::kFrames : PairSource::kBlindSpots;
  options.pairs_per_world = condition.Integer("pairs_per_world", options.pairs_per_world, {1, 10000});
  const std::vector<KeyInfo> keys = PoseDistanceConditionKeys();
  RefuseMisplacedKeys(condition, keys, "pairs", frames ? "frames" : "blindspots");
  return options;
}

std::vector<KeyInfo> PoseDistanceConditionKeys() {
  return {
      {"pairs", Join(kSources), kSources.front(),
       "What is compared: the eight pairs of poses that paper A's distance takes for alike, one a trial, or any "
       "frames of two different clips."},
      FuzzyKey(),
      {"pairs_per_world", "1…10000", "500", "How many pairs of frames are drawn in a trial.", {"pairs", {"frames"}}}};
}

Result<std::vector<PoseDistanceMethod>> ReadPoseDistanceMethods(std::span<const Node> methods) {
  std::vector<PoseDistanceMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> PoseDistanceMethodKeys() {
  return {{"distance", Join(PoseDistanceNames()), PoseDistanceNames().front(),
           "How unlike two poses are: paper A's d, Kovar's point clouds (of one frame), or the joints' mean distance "
           "once heading and hips agree."},
          {"weights",
           Join(WeightSourceNames()),
           WeightSourceNames().front(),
           "How much each fuzzy feature counts: as paper A says, or as learnt on all clips but the two judged, by a "
           "logistic regression or a genetic algorithm.",
           {"distance", {"fuzzy"}}},
          {"threshold", "0…6", "0.4", "Poses are called alike when d is below it.", {"distance", {"fuzzy"}}},
          {"threshold_cm",
           "0…1000 (cm)",
           "6",
           "Poses are called alike when their distance is below it.",
           {"distance", {"point-cloud", "joint-positions"}}}};
}

}  // namespace etude
