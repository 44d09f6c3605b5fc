
#include "reports/transitions/recorded_requests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/model/recording.h"
#include "tests/reports/support/example_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Recording With(const std::string& extras) {
  Recording recording{{{"coach", {}}}, extras};
  recording.tracks[0].motion.poses.resize(100);
  return recording;
}

TEST(TransitionFacts, AreReadAsTheRecordingTellsThem) {
  RunData run = ExampleRun();
  AddTransitions(run);
  ASSERT_OK(facts, ReadTransitionFacts(run.recordings[1].recording, "a cell"));
  EXPECT_EQ(facts->from, "clap");
  EXPECT_EQ(facts->to, "side kick");
  EXPECT_THAT(facts->transition_frames, ElementsAre(70, 85));
  ASSERT_THAT(facts->points, SizeIs(2));
  EXPECT_EQ(facts->points[0].to, "in-between");
  EXPECT_EQ(facts->points[1].from_frame, 14);
  EXPECT_EQ((*facts->points[1].partials)[1], 0.049);
  EXPECT_EQ(facts->threshold, 0.4);
  EXPECT_EQ(facts->pairs_matched, 0);
  EXPECT_EQ((*facts->weights)[9], 0.5);
}

TEST(TransitionFacts, OfARecordingThatListsNoPointsAreThoseOfItsOnePoint) {
  ASSERT_OK(facts, ReadTransitionFacts(With(R"({"transition_frame": 40, "from": "clap", "to": "b", "distance": 0.31,
    "partials": {"RH":0.1,"LH":0,"RHE":0,"LHE":0,"Posture":0,"Trunk":0,"RF":0,"LF":0,"RFK":0,"LFK":0}})"),
                                       "a cell"));
  EXPECT_THAT(facts->transition_frames, ElementsAre(40));
  EXPECT_EQ((*facts->points[0].partials)[0], 0.1);
  EXPECT_THAT(facts->candidates, IsEmpty());
  EXPECT_FALSE(facts->threshold.has_value());
}

TEST(TransitionFacts, LeaveOutWhateverIsNotWhatItShouldBe) {
  ASSERT_OK(
      facts,
      ReadTransitionFacts(
          With(
              R"({"transition_frames": [95, 1e300, "x", -1, 5000, 12], "from": 5, "threshold": "low", "weights": {"RH": 1},
               "request_frame": 99999999999999, "transition_points": [7, {"from_frame": 1.5, "partials": []}],
               "candidates": [{"from_frame": 1}, null, {"from_frame": 1, "to_frame": 2, "distance": 0.2}]})"),
          "a cell"));
  EXPECT_THAT(facts->transition_frames, ElementsAre(12, 95));
  EXPECT_EQ(facts->from, "");
  EXPECT_FALSE(facts->threshold || facts->weights || facts->request_frame);
  ASSERT_THAT(facts->points, SizeIs(1));
  EXPECT_FALSE(facts->points[0].from_frame.has_value());
  EXPECT_THAT(facts->candidates, SizeIs(1));
}

TEST(TransitionFacts, NameTheCellWhoseExtrasAreNoObject) {
  EXPECT_THAT(testing::Refusal(ReadTransitionFacts(With("[1, 2"), "transition/-/3/now")),
              HasSubstr("transition/-/3/now"));
}

TEST(RecordedRequests, PutTheMethodsOfOneRequestTogether) {
  RunData run = ExampleRun();
  AddRecordings(run);
  AddTransitions(run);
  const auto worlds = RecordedRequestsOf(run, run.scenarios.front());
  ASSERT_THAT(worlds, SizeIs(2));
  EXPECT_EQ(worlds[0].Name(), "trial 7");
  EXPECT_EQ(worlds[0].Request(), "clap → side kick");
  std::vector<std::string> methods;
  for (const RecordedTransition& recorded : worlds[0].transitions) methods.push_back(recorded.row->method);
  EXPECT_THAT(methods, ElementsAre("now", "fuzzy-bridge", "gate-inertialised"));
  EXPECT_EQ(worlds[1].Name(), "trial 5");
  // Recordings of other tasks contain no transition.
  EXPECT_THAT(RecordedRequestsOf(run, run.scenarios.back()), IsEmpty());
}

}  // namespace
}  // namespace etude
