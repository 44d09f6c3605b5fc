#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/transition/run.h"
#include "bench/tasks/transition/stage.h"
#include "engine/transitions/choices/choice.h"
#include "tests/bench/tasks/transition/transition_fixture.h"
#include "tests/engine/transitions/lying_clips.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class TransitionTaskTest : public TransitionFixture {};

TEST_F(TransitionTaskTest, MeasuresEveryMethodInTheSameWorld) {
  const ClipLibrary library = SmallLibrary();
  ASSERT_OK(task, Make(kMethods, library));
  int smoother = 0;
  for (int trial = 0; trial < 6; ++trial) {
    EXPECT_EQ((*task)->ClipsOf(Trial(trial)).front(), library.clips[trial % 3].name);
    const std::vector<CellResult> cells = CellsOf(**task, trial);
    ASSERT_EQ(cells.size(), 6u);
    EXPECT_EQ(cells[0].status, Status::kOk);
    EXPECT_EQ(ValueOf(cells[0], "wait_s"), 0);
    EXPECT_EQ(cells[4].status, Status::kOk);
    EXPECT_GT(ValueOf(cells[4], "wait_s"), 0);
    EXPECT_EQ(cells[0].digests[0], cells[4].digests[0]) << "same clips, same features";
    if (ValueOf(cells[1], "in_between") == 0) {
      EXPECT_LT(ValueOf(cells[1], "fuzzy_distance"), 0.4);
    }
    EXPECT_EQ(ValueOf(cells[1], "pose_gap_cm"), ValueOf(cells[3], "pose_gap_cm")) << "same choice, other join";
    smoother += ValueOf(cells[3], "jump_cm") < ValueOf(cells[1], "jump_cm");
  }
  EXPECT_GT(smoother, 0);
}

TEST_F(TransitionTaskTest, CountsAWorldWithoutAWayAndSaysWhy) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library);
  ASSERT_OK(cell, (*task)->MakeWorld(Trial(0), false)->Judge({{"unsolved", "nothing fits"}}));
  EXPECT_EQ(cell->status, Status::kUnsolved);
  EXPECT_EQ(cell->reason, "nothing fits");
  ASSERT_EQ(cell->metrics.size(), MakeTransitionTaskKind().metrics.size());
  for (const MetricValue& metric : cell->metrics) {
    EXPECT_EQ((*task)->ValueOfFailure(metric.id), metric.value) << metric.id;
    EXPECT_EQ(metric.value.has_value(), metric.null_reason.empty()) << metric.id;
  }
  EXPECT_EQ(ValueOf(*cell, "natural_share"), 0) << "a transition that never came was not natural";
}

TEST_F(TransitionTaskTest, GoesThroughAnInBetweenWhereNothingMatches) {
  const ClipLibrary library = SmallLibrary();
  const CellResult never = CellsOf(**Make(kMethods, library), 0, true)[5];
  EXPECT_EQ(never.status, Status::kOk);
  EXPECT_EQ(ValueOf(never, "in_between"), 1);
  EXPECT_EQ(ValueOf(never, "direct_match"), 0);
  EXPECT_EQ(ValueOf(never, "matching_share"), 0);
  const Json facts = Json::parse(never.recording->extras_json);
  EXPECT_EQ(facts["branch"], "forced");
  EXPECT_EQ(facts["transition_points"].size(), 2u);
  EXPECT_EQ(facts["transition_points"][0]["to"], "in-between");
}

TEST_F(TransitionTaskTest, RefusesKeysOfTheScenarioThatCannotHaveAnEffect) {
  const ClipLibrary library = SmallLibrary();
  const auto refusal = [&](const std::string& yaml) { return testing::Refusal(Make(yaml, library)); };
  const std::string fuzzy = "methods: [{name: a}]\n", now = "methods: [{name: a, choice: now}]\n",
                    own = "methods: [{name: a, threshold: 1}]\n";
  for (const std::string& methods : {now, own}) {
    EXPECT_THAT(refusal(methods + "threshold: 0.5"), HasSubstr("2:12: 'threshold' has no effect here"));
  }
  EXPECT_TRUE(Make(fuzzy + "threshold: 0.5", library));
}

TEST_F(TransitionTaskTest, CountsWhoGoesThroughAClipThatStandsUpAndWhoHasNone) {
  const LibraryClip lie{"lie", "lie", LyingClip(90), {}}, stand{"stand", "stand", StandingClip(90, 0), {}},
      rise{"rise", "rise", RisingClip(90), {}};
  const std::string played = "methods: [{name: played, choice: played, join: planted-feet}]";
  const auto none = Make(played, {{lie, stand}});
  for (int trial : {0, 1}) {  // each clip is left once
    const CellResult cell = RunWorld(**none, Trial(trial), 1, false)[0];
    EXPECT_EQ(cell.status, Status::kUnsolved);
    EXPECT_THAT(cell.reason, HasSubstr(trial == 0 ? "no join can raise a body" : "no join can lower a body"));
    EXPECT_EQ(ValueOf(cell, "clean_share"), 0);
  }
  const auto one = Make(played, {{lie, stand, rise}});
  int through = 0;
  for (int trial = 0; trial < 12; trial += 3) {  // the trials in which the lying clip is left
    const CellResult cell = RunWorld(**one, Trial(trial), 1, true)[0];
    ASSERT_EQ(cell.status, Status::kOk) << cell.reason;
    if (ValueOf(cell, "in_between") == 0) continue;
    ++through;
    EXPECT_GT(ValueOf(cell, "wait_s"), 0.5);
    EXPECT_EQ(Json::parse(cell.recording->extras_json)["transition_points"][0]["to"], "rise");
    ASSERT_EQ(cell.recording->tracks.size(), 4u);
    EXPECT_EQ(cell.recording->tracks[3].name, "through");
    EXPECT_EQ(ValueOf(cell, "supported_share"), 1);
  }
  EXPECT_GE(through, 1);
  EXPECT_LT(through, 4) << "into the clip that stands up itself the way is direct";
}

TEST_F(TransitionTaskTest, TalliesThePairsThatTheThresholdLetsThrough) {
  const ClipLibrary library = SmallLibrary();
  const Stage stage = SetStage(library);
  const Choice& choice = *FindChoice("fuzzy-bridge");
  int looser = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const TransitionRequest request = *DrawRequest(stage, Trial(trial));
    const TaggedClip &from = stage.library.tagged[request.from], &to = stage.library.tagged[request.to];
    std::int64_t pairs = 0;
    for (int leave : from.bridge_frames) {
      if (leave < request.request_frame || leave > request.request_frame + 30) continue;
      for (int enter : to.bridge_frames) pairs += enter < to.FrameCount() - 1 ? 1 : 0;
    }
    const auto tally = [&](double threshold) {
      TransitionWay way;
      way.choice = &choice;
      way.rules.threshold = threshold;
      return TallyMatches(stage, request, way);
    };
    EXPECT_EQ(tally(0).matching, 0);
    EXPECT_EQ(tally(6).matching, pairs) << "no distance is larger";
    EXPECT_EQ(tally(0.4).pairs, pairs);
    EXPECT_EQ(tally(0.4).matching > 0, choice.plan(stage.library, request, {}, {}).segments.size() == 2);
    looser += tally(0.8).matching > tally(0.4).matching ? 1 : 0;
  }
  EXPECT_GT(looser, 0);
}

TEST_F(TransitionTaskTest, ReportsTheMetricsThatItsKindNames) {
  const ClipLibrary library = SmallLibrary();
  for (const CellResult& cell : CellsOf(**Make(kMethods, library), 1)) {
    std::vector<std::string> ids;
    for (const MetricValue& metric : cell.metrics) ids.push_back(metric.id);
    EXPECT_EQ(ids, MakeTransitionTaskKind().metrics);
  }
}

TEST_F(TransitionTaskTest, AsksForActsWhileMovesPlay) {
  const ClipLibrary library{{Builtin("puzzled"), Builtin("sway"), Builtin("clap"), Builtin("head_shake")}};
  const Stage acts = SetStage(library, {.fuzzy = {}, .head = {}, .tween = {}, .asks_for_acts = true});
  const ClipLibrary none = SmallLibrary();
  const Stage any = SetStage(none, {.fuzzy = {}, .head = {}, .tween = {}, .asks_for_acts = true});
  std::vector<int> wanted(library.clips.size());
  for (int trial = 0; trial < 20; ++trial) {
    const TransitionRequest request = *DrawRequest(acts, Trial(trial));
    EXPECT_EQ(request.from, 1 + trial % 2);
    ++wanted[request.to];
    EXPECT_NE(DrawRequest(any, Trial(trial))->from, DrawRequest(any, Trial(trial))->to) << "no acts: any clip";
  }
  EXPECT_GT(wanted[0], 0);
  EXPECT_GT(wanted[3], 0);
  EXPECT_EQ(wanted[0] + wanted[3], 20);
}

TEST_F(TransitionTaskTest, IsAFunctionOfTheWorldAlone) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(kMethods, library), again = Make(kMethods, library);
  CellsOf(**again, 5);  // earlier worlds must not matter
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

TEST_F(TransitionTaskTest, KeepsEveryCellsExplanationWhenAsked) {
  const ClipLibrary library = SmallLibrary();
  const auto plain = CellsOf(**Make(kMethods, library), 0);
  const auto told = CellsOf(**Make("explain: true\n" + std::string(kMethods), library), 0);
  for (std::size_t m = 0; m < told.size(); ++m) {
    EXPECT_EQ(told[m].digests, plain[m].digests);
    ASSERT_EQ(plain[m].series.size(), 1u);
    if (told[m].status != Status::kOk) continue;
    ASSERT_EQ(told[m].series.size(), 8u);
    const Series &points = told[m].series[1], &distances = told[m].series[5], &partials = told[m].series[7];
    EXPECT_EQ(points.name, "point_partials");
    double worst = 0;
    for (auto ten = points.values.begin(); ten != points.values.end(); ten += kFeatureCount) {
      worst = std::max(worst, std::sqrt(std::accumulate(ten, ten + kFeatureCount, 0.0)));
    }
    EXPECT_NEAR(worst, ValueOf(told[m], "fuzzy_distance"), 1e-12);
    ASSERT_EQ(distances.name, "candidate_distance");
    EXPECT_EQ(partials.values.size(), distances.values.size() * kFeatureCount);
  }
}

TEST_F(TransitionTaskTest, RecordsTheTransitionWithWhatExplainsIt) {
  const ClipLibrary library = SmallLibrary();
  const auto cells = CellsOf(**Make(kMethods, library), 0, true);
  ASSERT_TRUE(cells[0].recording);
  const Recording& recording = *cells[0].recording;
  ASSERT_EQ(recording.tracks.size(), 3u);
  EXPECT_EQ(recording.tracks[0].name, "coach");
  EXPECT_EQ(recording.tracks[1].name, "left");
  EXPECT_EQ(recording.tracks[2].name, "wanted");
  EXPECT_GT(recording.tracks[0].motion.poses.size(), 30u);
  EXPECT_FALSE(CellsOf(**Make(kMethods, library), 0)[0].recording);

  const Json facts = Json::parse(recording.extras_json);
  EXPECT_EQ(facts["from"], "builtin:sway");
  EXPECT_EQ(facts["branch"], "now");
  EXPECT_FALSE(facts["why"].get<std::string>().empty());
  for (const CellResult& cell : cells) {
    const Json told = Json::parse(cell.recording->extras_json);
    for (const Json& change : told["transition_points"]) {
      double sum = 0;
      for (const auto& [feature, part] : change["partials"].items()) sum += part.get<double>();
      EXPECT_NEAR(std::sqrt(sum), change["distance"], 1e-12);
    }
    for (const Json& candidate : told["candidates"]) {
      EXPECT_EQ(candidate["partials"].size(), kFeatureCount);
      EXPECT_LT(candidate["point"], told["transition_points"].size());
      EXPECT_TRUE(candidate["cost"].is_number() == !told["cost_unit"].get<std::string>().empty());
    }
    double weights = 0;
    for (const auto& [feature, weight] : told["weights"].items()) weights += weight.get<double>();
    EXPECT_NEAR(weights, kWeightSum, 1e-12);
  }
}

TEST_F(TransitionTaskTest, MakesBridgeFramesAsTheConditionSays) {
  const auto digest = [&](const std::string& says, std::size_t stage) {
    const ClipLibrary library = SmallLibrary();
    return CellsOf(**Make(says + kMethods, library), 0)[0].digests[stage];
  };
  const auto features = digest("", 0), frames = digest("", 1), keys = digest("", 2);
  EXPECT_EQ(frames.first, "bridge_frames");
  EXPECT_EQ(keys.first, "in_between_keys");
  for (const char* says : {"min_clips: 1", "head_bend_deg: 5", "head_turn_dps: 10", "most_per_class: 2"}) {
    EXPECT_EQ(digest(says, 0), features) << says;
    EXPECT_NE(digest(says, 1), frames) << says;
  }
  EXPECT_NE(digest("fuzzy: builtin:gaussian", 0), features);
}

TEST_F(TransitionTaskTest, WeighsFeaturesAsLearntWhenAskedTo) {
  const ClipLibrary library = SmallLibrary();
  const auto task = Make(R"(
methods:
  - {name: fixed, choice: now}
  - {name: adaptive, choice: now, weights: adaptive}
  - {name: genetic, choice: now, weights: genetic}
)",
                         library);
  const auto cells = RunWorld(**task, Trial(0), 3);
  EXPECT_EQ(ValueOf(cells[0], "jump_cm"), ValueOf(cells[1], "jump_cm"));
  EXPECT_NE(ValueOf(cells[0], "fuzzy_distance"), ValueOf(cells[1], "fuzzy_distance"));
  EXPECT_NE(ValueOf(cells[1], "fuzzy_distance"), ValueOf(cells[2], "fuzzy_distance"));
}

}  // namespace
}  // namespace etude
