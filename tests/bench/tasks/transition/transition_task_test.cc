#include "bench/tasks/transition/transition_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "bench/tasks/transition/stage.h"
#include "bench/training/adaptive_weights.h"
#include "tests/bench/tasks/transition/transition_fixture.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class TransitionTaskTest : public TransitionFixture {};
class LearntWeights : public TransitionFixture {};

TEST_F(TransitionTaskTest, MeasuresEveryMethodInTheSameWorld) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library);
  ASSERT_TRUE(task) << ToString(task.error());
  int smoother = 0;
  for (int trial = 0; trial < 6; ++trial) {
    EXPECT_EQ((*task)->ClipOf(Trial(trial)), library.clips[trial % 3].name);
    const std::vector<CellResult> cells = CellsOf(**task, trial);
    ASSERT_EQ(cells.size(), 6u);
    EXPECT_EQ(cells[0].status, Status::kOk);
    EXPECT_EQ(ValueOf(cells[0], "wait_s"), 0);
    EXPECT_EQ(cells[4].status, Status::kOk);
    EXPECT_GT(ValueOf(cells[4], "wait_s"), 0);
    EXPECT_EQ(cells[0].digests[0], cells[4].digests[0]) << "same clips, same features";
    if (cells[1].status != Status::kOk) continue;
    EXPECT_LT(ValueOf(cells[1], "fuzzy_distance"), 0.4);
    EXPECT_EQ(ValueOf(cells[1], "pose_gap_cm"), ValueOf(cells[3], "pose_gap_cm")) << "same choice, other join";
    smoother += ValueOf(cells[3], "jump_cm") < ValueOf(cells[1], "jump_cm");
  }
  EXPECT_GT(smoother, 0);
}

TEST_F(TransitionTaskTest, SaysWhyNoWayWasFound) {
  const ClipLibrary library = SmallLibrary();
  const CellResult never = CellsOf(**Make(kMethods, library), 0)[5];
  EXPECT_EQ(never.status, Status::kUnsolved);
  EXPECT_THAT(never.reason, HasSubstr("matches one of"));
  ASSERT_EQ(never.metrics.size(), MakeTransitionTaskKind().metrics.size());
  for (const MetricValue& metric : never.metrics) {
    if (metric.id == "natural_share") continue;
    EXPECT_FALSE(metric.value) << metric.id;
    EXPECT_FALSE(metric.null_reason.empty()) << metric.id;
  }
  EXPECT_EQ(ValueOf(never, "natural_share"), 0) << "a switch that never came was not natural";
}

TEST_F(TransitionTaskTest, CreditsAMethodWithoutAnswerLikeOneThatFoundNoWay) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library);
  const CellResult never = CellsOf(**task, 0)[5];
  for (const MetricValue& metric : never.metrics) {
    EXPECT_EQ((*task)->ValueOfFailure(metric.id), metric.value) << metric.id;
  }
}

TEST_F(TransitionTaskTest, ReportsTheMetricsThatItsKindNames) {
  const ClipLibrary library = SmallLibrary();
  for (const CellResult& cell : CellsOf(**Make(kMethods, library), 1)) {
    std::vector<std::string> ids;
    for (const MetricValue& metric : cell.metrics) ids.push_back(metric.id);
    EXPECT_EQ(ids, MakeTransitionTaskKind().metrics);
  }
}

TEST_F(TransitionTaskTest, IsAFunctionOfTheWorldAlone) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library), again = Make(kMethods, library);
  CellsOf(**again, 5);  // what was run before must not matter
  const auto first = CellsOf(**task, 2), second = CellsOf(**again, 2);
  for (std::size_t m = 0; m < first.size(); ++m) EXPECT_EQ(first[m].digests, second[m].digests);
  const auto other = CellsOf(**task, 3);
  EXPECT_NE(first[0].digests, other[0].digests) << "the control: another world";
}

TEST_F(TransitionTaskTest, SkipsALibraryThatHoldsNothingToSwitchTo) {
  const ClipLibrary single{{Builtin("clap")}};
  const CellResult cell = CellsOf(**Make(kMethods, single), 0)[0];
  EXPECT_EQ(cell.status, Status::kSkipped);
  EXPECT_THAT(cell.reason, HasSubstr("two clips"));

  ClipLibrary with_short{{Builtin("clap"), Builtin("sway")}};
  with_short.clips[1].motion.poses.resize(5);
  const auto task = Make(kMethods, with_short);
  EXPECT_THAT(CellsOf(**task, 0)[0].reason, HasSubstr("no other clip"));
  EXPECT_THAT(CellsOf(**task, 1)[0].reason, HasSubstr("has 5 frames"));
}

TEST_F(TransitionTaskTest, RecordsTheSwitchWithItsFacts) {
  const ClipLibrary library = SmallLibrary();
  const auto cells = CellsOf(**Make(kMethods, library), 0, true);
  ASSERT_TRUE(cells[0].recording);
  const Recording& recording = *cells[0].recording;
  ASSERT_EQ(recording.tracks.size(), 1u);
  EXPECT_EQ(recording.tracks[0].name, "coach");
  EXPECT_GT(recording.tracks[0].motion.poses.size(), 30u);
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("seam_frame":)"));
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("from":"builtin:sway")"));
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("branch":"now")"));
  EXPECT_FALSE(CellsOf(**Make(kMethods, library), 0)[0].recording);
}

TEST_F(TransitionTaskTest, ComplainsAboutUnknownNames) {
  const auto wrong = Make("methods: [{name: x, choice: fuzy-bridge}]", SmallLibrary());
  ASSERT_FALSE(wrong);
  EXPECT_THAT(ToString(wrong.error()), HasSubstr("fuzzy-bridge"));
  EXPECT_THAT(ToString(wrong.error()), HasSubstr("scenario.yaml:1:"));
  EXPECT_FALSE(Make("methods: [{name: x, join: glue}]", SmallLibrary()));
  EXPECT_FALSE(Make("methods: [{name: x, treshold: 1}]", SmallLibrary()));
  EXPECT_FALSE(Make("methods: [{name: x, threshold: -1}]", SmallLibrary()));
}

TEST_F(TransitionTaskTest, WeighsFeaturesAsLearntWhenAskedTo) {
  const ClipLibrary library = SmallLibrary();
  const auto task =
      Make("methods: [{name: fixed, choice: now}, {name: adaptive, choice: now, weights: adaptive}]", library);
  const auto cells = RunWorld(**task, Trial(0), 2);
  EXPECT_EQ(ValueOf(cells[0], "jump_cm"), ValueOf(cells[1], "jump_cm"));
  EXPECT_NE(ValueOf(cells[0], "fuzzy_distance"), ValueOf(cells[1], "fuzzy_distance"));
}

TEST_F(LearntWeights, NeverSawTheJudgedClips) {
  const Stage stage = SetStage(SmallLibrary());
  const auto training = GatherTrainingClips(stage.library, stage.identities);
  ASSERT_TRUE(training);
  EXPECT_EQ(training->identities, [] {
    std::vector<std::string> names = BuiltinMoveNames();
    for (std::string& name : names) name = "builtin:" + name;
    return names;
  }()) << "every built-in move once, though the library names three of them again";

  AdaptiveWeights adaptive(*training);
  const WeightFit& fit = adaptive.Without("builtin:clap", "builtin:sway");
  const auto n = static_cast<int>(BuiltinMoveNames().size());
  EXPECT_EQ(fit.pairs, (n - 2) * (n - 3) / 2 * 16 * 16);
  EXPECT_EQ(adaptive.Without("mine.bvh", "builtin:sway").pairs, (n - 1) * (n - 2) / 2 * 16 * 16);
  ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
  EXPECT_NEAR(std::accumulate(fit.weights.begin(), fit.weights.end(), 0.0), 8, 1e-12);
  EXPECT_NE(fit.weights, PaperWeights());
  EXPECT_EQ(&fit, &adaptive.Without("builtin:sway", "builtin:clap")) << "learnt once";
}

}  // namespace
}  // namespace etude
