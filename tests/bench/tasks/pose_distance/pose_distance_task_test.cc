#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/pose_distance/exchange.h"
#include "bench/tasks/pose_distance/options.h"
#include "bench/tasks/pose_distance/run.h"
#include "engine/document/node.h"
#include "sim/choreography/move.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class PoseDistanceTask : public ::testing::Test {
 protected:
  static ClipLibrary Clips(const std::vector<std::string>& names) {
    ClipLibrary library;
    for (const std::string& name : names) {
      Move move = *LoadBuiltinMove(name);
      library.clips.push_back({"builtin:" + name, "builtin:" + name, move.motion, move});
    }
    return library;
  }

  Result<std::unique_ptr<Task>> Make(const std::string& condition, const std::string& method,
                                     const ClipLibrary& clips) {
    condition_ = *ParseYaml(condition, "s.yaml");
    method_ = *ParseYaml(method, "s.yaml");
    fields_.emplace(condition_, "a condition");
    TaskInput input{*fields_, {&method_, 1}, clips};
    return MakePoseDistanceTaskKind().make(input);
  }

  static double ValueOf(const CellResult& cell, const std::string& id) {
    for (const MetricValue& metric : cell.metrics) {
      if (metric.id == id) return metric.value.value_or(-1);
    }
    ADD_FAILURE() << id << " was not measured";
    return -1;
  }

 private:
  Node condition_, method_;
  std::optional<Fields> fields_;
};

// The gaps are those of the canonical body, cm. Its straight arm ends 0.73 m from the shoulder, so an arm to the front
// and an arm to the side end 0.73 √2 = 1.03 m apart.
TEST_F(PoseDistanceTask, EveryBlindSpotIsCalledAlikeByPaperAsDistance) {
  ASSERT_OK(task, Make("{pairs: blindspots}", "{name: fuzzy}", {}));
  const double gaps[] = {103, 103, 86, 77, 75, 25, 25, 16};
  for (int trial = 0; trial < 16; ++trial) {
    const CellResult cell = RunWorld(**task, {.scenario = "s", .trial = trial}, 1).front();
    EXPECT_LT(ValueOf(cell, "fuzzy_distance"), 0.07) << (*task)->ClipsOf({.scenario = "s", .trial = trial}).front();
    EXPECT_EQ(ValueOf(cell, "called_alike"), 1);
    EXPECT_NEAR(ValueOf(cell, "pose_gap_cm"), gaps[trial % 8], 0.6);
    EXPECT_EQ(ValueOf(cell, "false_smooth"), gaps[trial % 8] > 20);
  }
}

TEST_F(PoseDistanceTask, PointCloudsAreNotFooled) {
  ASSERT_OK(task, Make("{pairs: blindspots}", "{name: cloud, distance: point-cloud}", {}));
  for (int trial = 0; trial < 8; ++trial) {
    const CellResult cell = RunWorld(**task, {.scenario = "s", .trial = trial}, 1).front();
    EXPECT_EQ(ValueOf(cell, "called_alike"), 0) << trial;
    EXPECT_LE(ValueOf(cell, "joint_distance_cm"), ValueOf(cell, "pose_gap_cm")) << "a mean is no more than the worst";
  }
}

TEST_F(PoseDistanceTask, AWorldOfFramesDependsOnItsKeyAlone) {
  const ClipLibrary clips = Clips({"clap", "sway", "boxing"});
  const auto draw = [&](int trial) { return DrawFramePairs(DanceClips(clips), 50, {.scenario = "s", .trial = trial}); };
  const PairWorld world = draw(1);
  EXPECT_EQ(world.clip_a, "builtin:sway");
  EXPECT_NE(world.clip_b, world.clip_a);
  ASSERT_EQ(world.pairs.size(), 50u);
  EXPECT_EQ(world.pairs[7].a.pose.joints, draw(1).pairs[7].a.pose.joints);
  EXPECT_NE(world.pairs[7].a.pose.joints, draw(4).pairs[7].a.pose.joints) << "control";
}

TEST_F(PoseDistanceTask, ThePoseGapItselfWouldBePerfect) {
  PairWorld world = DrawFramePairs(DanceClips(Clips({"clap", "sway"})), 400, {.scenario = "s"});
  for (int frame = 0; frame < 3; ++frame) {  // the two dances have no pose in common
    SeenPair same = world.pairs[static_cast<std::size_t>(frame)];
    same.b = same.a;
    same.gap_m = 0;
    world.pairs.push_back(same);
  }
  PairVerdict perfect, wrong;
  for (const SeenPair& pair : world.pairs) {
    perfect.distances.push_back(pair.gap_m);
    perfect.alike.push_back(pair.gap_m < 0.15);
    wrong.distances.push_back(-pair.gap_m);
    wrong.alike.push_back(pair.gap_m >= 0.15);
  }
  const CellResult best = ScorePairs(world, perfect, nullptr), worst = ScorePairs(world, wrong, nullptr);
  EXPECT_EQ(ValueOf(best, "close_auc"), 1);
  EXPECT_EQ(ValueOf(best, "close_f1"), 1);
  EXPECT_EQ(ValueOf(best, "false_smooth_share"), 0);
  EXPECT_EQ(ValueOf(worst, "close_auc"), 0);
  EXPECT_EQ(ValueOf(worst, "close_f1"), 0);
}

TEST_F(PoseDistanceTask, ABuiltInVerdictGivenFromOutsideScoresTheSame) {
  const PairWorld world = DrawFramePairs(DanceClips(Clips({"clap", "sway"})), 400, {.scenario = "s"});
  const PairVerdict own = ComputePairVerdict(world, {.name = "fuzzy"}, PaperMemberships(), PaperWeights());
  const Json answer = {{"distances", own.distances}, {"alike", own.alike}};
  ASSERT_OK(read, ReadPairAnswer(answer, world));
  const CellResult inside = ScorePairs(world, own, nullptr), outside = ScorePairs(world, *read, nullptr);
  for (const char* id : {"close_auc", "close_f1", "matching_share"})
    EXPECT_EQ(ValueOf(inside, id), ValueOf(outside, id));
  EXPECT_EQ(inside.digests, outside.digests);
}

TEST_F(PoseDistanceTask, AnswersThatDoNotFitAreRefusedByName) {
  const PairWorld world = ShowBlindSpot(0);
  const auto complaint = [&](const Json& answer) {
    const auto read = ReadPairAnswer(answer, world);
    return read ? std::string() : ToString(read.error());
  };
  EXPECT_EQ(complaint({{"distances", {0.3}}, {"alike", {true}}}), "");
  EXPECT_THAT(complaint({{"distances", {0.3, 0.4}}, {"alike", {true}}}), HasSubstr("distances"));
  EXPECT_THAT(complaint({{"distances", {-1}}, {"alike", {true}}}), HasSubstr("distances[0]"));
  EXPECT_THAT(complaint({{"distances", {0.3}}, {"alike", {1}}}), HasSubstr("alike[0]: 1 is neither true nor false"));
  EXPECT_THAT(complaint({{"distances", {0.3}}}), HasSubstr("alike"));
  EXPECT_THAT(complaint({{"distances", {0.3}}, {"alike", {true}}, {"mood", 1}}), HasSubstr("mood"));
}

}  // namespace
}  // namespace etude
