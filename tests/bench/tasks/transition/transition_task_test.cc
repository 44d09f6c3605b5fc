#include "bench/tasks/transition/transition_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bench/tasks/transition/adaptive_weights.h"
#include "engine/document/node.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

LibraryClip Builtin(const std::string& name) {
  auto move = LoadBuiltinMove(name);
  EXPECT_TRUE(move) << ToString(move.error());
  return {"builtin:" + name, "builtin:" + name, move->motion, *move, ""};
}

ClipLibrary SmallLibrary() { return {{Builtin("sway"), Builtin("clap"), Builtin("boxing")}}; }

constexpr const char* kMethods = R"(
methods:
  - {name: now, choice: now}
  - {name: fuzzy}
  - {name: smallest, pick: smallest}
  - {name: smooth, join: inertialised}
  - {name: end, choice: wait-for-end}
  - {name: never, threshold: 0}
)";

class TransitionTaskTest : public ::testing::Test {
 protected:
  Result<std::unique_ptr<Task>> Make(const std::string& yaml, const ClipLibrary& library, bool recordings = false) {
    auto node = ParseYaml(yaml, "scenario.yaml");
    EXPECT_TRUE(node);
    Fields condition(*node, "a scenario");
    TaskInput input{condition, node->Find("methods")->items, library, recordings};
    return MakeTransitionTaskKind().make(input);
  }

  static WorldKey Trial(int trial) { return {.suite_seed = 1, .scenario = "test", .trial = trial}; }

  static double ValueOf(const CellResult& cell, std::string_view id) {
    for (const MetricValue& metric : cell.metrics) {
      if (metric.id == id && metric.value) return *metric.value;
    }
    ADD_FAILURE() << "no value of " << id;
    return NAN;
  }
};

TEST_F(TransitionTaskTest, MeasuresEveryMethodInTheSameWorld) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library);
  ASSERT_TRUE(task) << ToString(task.error());
  int smoother = 0;
  for (int trial = 0; trial < 6; ++trial) {
    EXPECT_EQ((*task)->ClipOf(Trial(trial)), library.clips[trial % 3].name);
    const std::vector<CellResult> cells = (*task)->RunWorld(Trial(trial));
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
  const CellResult never = (*Make(kMethods, library))->RunWorld(Trial(0))[5];
  EXPECT_EQ(never.status, Status::kUnsolved);
  EXPECT_THAT(never.reason, HasSubstr("matches one of"));
  ASSERT_FALSE(never.metrics.empty());
  for (const MetricValue& metric : never.metrics) {
    EXPECT_FALSE(metric.value) << metric.id;
    EXPECT_FALSE(metric.null_reason.empty()) << metric.id;
  }
}

TEST_F(TransitionTaskTest, IsAFunctionOfTheWorldAlone) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library), again = Make(kMethods, library);
  (*again)->RunWorld(Trial(5));  // what was run before must not matter
  const auto first = (*task)->RunWorld(Trial(2)), second = (*again)->RunWorld(Trial(2));
  for (std::size_t m = 0; m < first.size(); ++m) EXPECT_EQ(first[m].digests, second[m].digests);
  const auto other = (*task)->RunWorld(Trial(3));
  EXPECT_NE(first[0].digests, other[0].digests) << "the control: another world";
}

TEST_F(TransitionTaskTest, SkipsALibraryThatHoldsNothingToSwitchTo) {
  const ClipLibrary single{{Builtin("clap")}};
  const CellResult cell = (*Make(kMethods, single))->RunWorld(Trial(0))[0];
  EXPECT_EQ(cell.status, Status::kSkipped);
  EXPECT_THAT(cell.reason, HasSubstr("two clips"));

  ClipLibrary with_short{{Builtin("clap"), Builtin("sway")}};
  with_short.clips[1].motion.poses.resize(5);
  const auto task = Make(kMethods, with_short);
  EXPECT_THAT((*task)->RunWorld(Trial(0))[0].reason, HasSubstr("no other clip"));
  EXPECT_THAT((*task)->RunWorld(Trial(1))[0].reason, HasSubstr("has 5 frames"));
}

TEST_F(TransitionTaskTest, RecordsTheSwitchWithItsFacts) {
  const ClipLibrary library = SmallLibrary();
  const auto cells = (*Make(kMethods, library, true))->RunWorld(Trial(0));
  ASSERT_TRUE(cells[0].recording);
  const Recording& recording = *cells[0].recording;
  ASSERT_EQ(recording.tracks.size(), 1u);
  EXPECT_EQ(recording.tracks[0].name, "coach");
  EXPECT_GT(recording.tracks[0].motion.poses.size(), 30u);
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("seam_frame":)"));
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("from":"builtin:sway")"));
  EXPECT_THAT(recording.extras_json, HasSubstr(R"("branch":"now")"));
  EXPECT_FALSE((*Make(kMethods, library))->RunWorld(Trial(0))[0].recording);
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
  const auto cells = (*task)->RunWorld(Trial(0));
  EXPECT_EQ(ValueOf(cells[0], "jump_cm"), ValueOf(cells[1], "jump_cm"));
  EXPECT_NE(ValueOf(cells[0], "fuzzy_distance"), ValueOf(cells[1], "fuzzy_distance"));
}

TEST(AdaptiveWeights, AreLearntWithoutTheJudgedClips) {
  const Stage stage = SetStage(SmallLibrary());
  const auto training = SetTrainingStage(stage);
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
