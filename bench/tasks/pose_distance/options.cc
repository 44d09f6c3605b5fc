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
                 "The pairs of poses that are compared. blindspots: eight pairs that paper A's distance confuses, one "
                 "pair in each trial; frames: random frames of two different clips."),
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
                 "The distance between two poses: d of paper A, Kovar's distance between point clouds (for one frame), "
                 "or the mean distance between joints after heading and hips are aligned."),
       Key::Name("weights", &Method::weights, WeightSourceNames(), FindWeightSource,
                 "Weights of the fuzzy features: the weights of paper A, or weights that are learnt on all clips "
                 "except the two judged clips, by logistic regression or by a genetic algorithm.")
           .With("distance", {"fuzzy"}),
       // Grades are in [0, 1] and the weights S have sum 8, so no distance exceeds sqrt(8 · 4).
       Key::Number("threshold", &Method::threshold, {0, 6},
                   "The method calls two poses alike if d is below this threshold.")
           .With("distance", {"fuzzy"})},
      SetThreshold};
  return table;
}

}  // namespace etude
