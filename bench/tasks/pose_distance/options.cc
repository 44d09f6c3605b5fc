#include "bench/tasks/pose_distance/options.h"

#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

/// The default threshold on mean joint distances, centimetres. It accepts about as many pairs as paper A's threshold:
/// of all pairs of frames of two clips, 0.4 % have a smaller mean joint distance, and 0.5 % have a d of paper A below
/// 0.4.
constexpr double kThresholdCm = 6;

void SetThreshold(Fields& /*method*/, PoseDistanceMethod& options) {
  if (options.distance != PoseDistance::kFuzzy) options.threshold = kThresholdCm;
}

}  // namespace

const FieldTable<PairOptions>& PoseDistanceConditionFields() {
  using Key = Field<PairOptions>;
  static const FieldTable<PairOptions> table{
      {Key::Name("pairs", &PairOptions::source,
                 {{"blindspots", PairSource::kBlindSpots}, {"frames", PairSource::kFrames}},
                 "What is compared: the eight pairs of poses that paper A's distance confuses, one per trial, or any "
                 "frames of two different clips."),
       FuzzyField<PairOptions>(),
       Key::Number("pairs_per_world", &PairOptions::pairs_per_world, {1, 10000},
                   "Number of pairs of frames drawn in a trial.")
           .With("pairs", {"frames"})}};
  return table;
}

const FieldTable<PoseDistanceMethod>& PoseDistanceMethodFields() {
  using Method = PoseDistanceMethod;
  using Key = Field<Method>;
  static const FieldTable<Method> table{
      {Key::Name("distance", &Method::distance, PoseDistanceNames(), FindPoseDistance,
                 "The distance of two poses: paper A's d, Kovar's point clouds (of one frame), or the mean distance of "
                 "joints after heading and hips are aligned."),
       Key::Name("weights", &Method::weights, WeightSourceNames(), FindWeightSource,
                 "Weights of the fuzzy features: paper A's, or learnt on all clips but the two judged, by logistic "
                 "regression or a genetic algorithm.")
           .With("distance", {"fuzzy"}),
       // Grades are in [0, 1] and the weights S have sum 8, so no distance exceeds sqrt(8 · 4).
       Key::Number("threshold", &Method::threshold, {0, 6}, "Poses are called alike if d is below this threshold.")
           .With("distance", {"fuzzy"})},
      SetThreshold};
  return table;
}

}  // namespace etude
