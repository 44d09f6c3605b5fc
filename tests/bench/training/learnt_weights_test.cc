#include "bench/training/learnt_weights.h"

#include <gtest/gtest.h>

#include <numeric>

#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TrainingClips BuiltinClips() { return *GatherTrainingClips({}, {}, MakeBodyProportions(PoseOf(Controls{}), 0.9)); }

TEST(TrainingClips, AreEveryBuiltInMoveOnceAndWhatElseTheLibraryHas) {
  const BodyMotion clips[] = {LoadBuiltinMove("clap")->motion, LoadBuiltinMove("sway")->motion};
  const BodyProportions proportions = MakeBodyProportions(PoseOf(Controls{}), 0.9);
  ASSERT_OK(training, GatherTrainingClips(clips, {"builtin:clap", "mine.bvh"}, proportions));
  std::vector<std::string> expected;
  for (const std::string& name : BuiltinMoveNames()) expected.push_back("builtin:" + name);
  expected.push_back("mine.bvh");
  EXPECT_EQ(training->identities, expected);
  EXPECT_EQ(training->frames.size(), expected.size());
}

TEST(LearntWeights, NeverSawTheJudgedClips) {
  LearntWeights learnt(BuiltinClips());
  const int n = static_cast<int>(BuiltinMoveNames().size());
  for (WeightSource rule : {WeightSource::kAdaptive, WeightSource::kGenetic}) {
    const WeightFit& fit = learnt.FitOf(rule, "builtin:clap", "builtin:sway");
    EXPECT_EQ(fit.pairs, (n - 2) * (n - 3) / 2 * kFramesPerClip * kFramesPerClip);
    ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
    EXPECT_NEAR(std::accumulate(fit.weights.begin(), fit.weights.end(), 0.0), kWeightSum, 1e-12);
    EXPECT_NE(fit.weights, PaperWeights());
    EXPECT_EQ(&learnt.For(rule, "builtin:sway", "builtin:clap"), &fit.weights) << "learnt once, in either order";
    EXPECT_NE(learnt.For(rule, "builtin:bird", "builtin:robot"), fit.weights) << "others' weights are others'";
  }
  EXPECT_EQ(learnt.FitOf(WeightSource::kAdaptive, "mine.bvh", "builtin:sway").pairs,
            (n - 1) * (n - 2) / 2 * kFramesPerClip * kFramesPerClip);
}

TEST(LearntWeights, OfAJudgedClipDoNotMoveWhenItDoes) {
  TrainingClips moved = BuiltinClips();
  moved.frames[0] = moved.frames[5];  // another motion under the same name
  LearntWeights before(BuiltinClips()), after(moved);
  const std::string judged = moved.identities[0], other = moved.identities[1], third = moved.identities[2];
  EXPECT_EQ(before.For(WeightSource::kGenetic, judged, other), after.For(WeightSource::kGenetic, judged, other));
  EXPECT_NE(before.For(WeightSource::kGenetic, third, other), after.For(WeightSource::kGenetic, third, other))
      << "control";
}

TEST(LearntWeights, FixedOnesAreTheSystems) {
  FuzzySystem system{.weights = {8, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
  LearntWeights learnt(TrainingClips{}, system);
  EXPECT_EQ(learnt.For(WeightSource::kFixed, "a", "b"), system.weights);
  EXPECT_EQ(learnt.FitOf(WeightSource::kGenetic, "a", "b").status, WeightFitStatus::kOneClassOnly);
  EXPECT_EQ(learnt.For(WeightSource::kGenetic, "a", "b"), system.weights) << "nothing to learn from";
  EXPECT_EQ(learnt.For(WeightSource::kAdaptive, "a", "b"), system.weights);
}

TEST(WeightRules, AreFoundByTheirNames) {
  const std::vector<std::string> names = WeightSourceNames();
  EXPECT_EQ(names, (std::vector<std::string>{"fixed", "adaptive", "genetic"}));
  EXPECT_EQ(FindWeightSource("genetic"), WeightSource::kGenetic);
}

}  // namespace
}  // namespace etude
