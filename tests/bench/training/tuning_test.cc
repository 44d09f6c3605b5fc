#include "bench/training/tuning.h"

#include <gtest/gtest.h>

#include "bench/training/genetic_search.h"
#include "bench/training/training_pairs.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TrainingClips SomeClips() {
  std::vector<BodyMotion> motions;
  std::vector<std::string> names = {"clap", "sway", "boxing", "stretch", "bird"};
  for (const std::string& name : names) motions.push_back(LoadBuiltinMove(name)->motion);
  return SampleClips(names, motions, MakeBodyProportions(PoseOf(Controls{}), 0.9));
}

TEST(MembershipGenes, OfOneHalfChangeNothing) {
  const Memberships& paper = PaperMemberships();
  const Memberships same = MembershipsOfGenes(paper, Genome(CountMembershipGenes(paper), 0.5));
  for (Feature feature : AllFeatures()) {
    PoseFeatures features;
    for (double& value : features.values) value = 57;
    EXPECT_EQ(Fuzzify(features, same), Fuzzify(features, paper)) << FeatureName(feature);
  }
}

TEST(MembershipGenes, KeepBreakpointsInOrderAndSidesAlike) {
  const Memberships& paper = PaperMemberships();
  const std::size_t count = CountMembershipGenes(paper);
  EXPECT_EQ(count, 20u);
  Genome genes(count);
  for (std::size_t i = 0; i < count; ++i) genes[i] = i % 2 == 0 ? 1.0 : 0.0;  // neighbours get opposite values
  const Memberships tuned = MembershipsOfGenes(paper, genes);
  int checked = 0;
  for (const Shape& shape : tuned.shapes) {
    if (const auto* triangle = std::get_if<Triangular>(&shape)) {
      EXPECT_LE(triangle->left, triangle->peak);
      EXPECT_LE(triangle->peak, triangle->right);
      ++checked;
    }
    if (const auto* top = std::get_if<Trapezoidal>(&shape)) {
      EXPECT_LE(top->left, top->left_top);
      EXPECT_LE(top->left_top, top->right_top);
      EXPECT_LE(top->right_top, top->right);
      ++checked;
    }
  }
  EXPECT_EQ(checked, static_cast<int>(kTermCount));
  for (double degrees = 0; degrees <= 180; degrees += 7) {
    for (std::size_t term = 0; term < 3; ++term) {
      EXPECT_EQ(GradeOf(tuned.shapes[FirstTermOf(Feature::kRH) + term], degrees),
                GradeOf(tuned.shapes[FirstTermOf(Feature::kLH) + term], degrees));
    }
  }
}

TEST(Tuning, DoesNoWorseThanThePaperOnWhatItSaw) {
  const TrainingClips clips = SomeClips();
  const auto pairs = LabelPairsAcross(clips.frames);
  const double before = PairTable(pairs).SoftF1(PaperWeights(), 0.4, 0.5);
  for (Tuning tuning : {Tuning::kGenetic, Tuning::kGeneticMemberships}) {
    const TunedSystem tuned = TuneSystem(clips.frames, tuning, {.population = 12, .generations = 8});
    ASSERT_EQ(tuned.status, WeightFitStatus::kFitted);
    EXPECT_EQ(tuned.generations, 8);
    const auto regraded = LabelPairsAcross(clips.frames, tuned.system.memberships);
    EXPECT_GE(PairTable(regraded).SoftF1(tuned.system.weights, 0.4, 0.5), before);
    const auto text = WriteFuzzySystem(tuned.system);
    ASSERT_OK(back, ReadFuzzySystem(text, "tuned.yaml"));
  }
}

TEST(Tuning, GradingAnewIsLabellingAnew) {
  const TrainingClips clips = SomeClips();
  Genome genes(CountMembershipGenes(PaperMemberships()), 0.7);
  const Memberships moved = MembershipsOfGenes(PaperMemberships(), genes);
  auto pairs = LabelPairsAcross(clips.frames);
  UpdateGrades(clips.frames, moved, pairs);
  const auto expected = LabelPairsAcross(clips.frames, moved);
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].squared_gaps, expected[i].squared_gaps);
    EXPECT_EQ(pairs[i].close, expected[i].close);
  }
}

TEST(Tuning, LearnsNothingFromOneClip) {
  const TrainingClips clips = SomeClips();
  const TunedSystem tuned = TuneSystem({clips.frames.data(), 1}, Tuning::kGenetic);
  EXPECT_EQ(tuned.status, WeightFitStatus::kOneClassOnly);
  EXPECT_EQ(tuned.system.weights, PaperWeights());
}

}  // namespace
}  // namespace etude
