#include "bench/recordings/task_extras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/files/files.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

DetectionExtras Session() {
  DetectionExtras extras{.moves = {{"clap", {{{"RH", 90, 20.5}}, {{"LH", 10, 5}, {"Trunk", 0, 5}}}}}};
  extras.events = {{.move = "clap",
                    .truth = "right",
                    .fault = "none",
                    .danced = "clap",
                    .begin_frame = 3,
                    .end_frame = 9,
                    .called_right = true,
                    .score = 0.25,
                    .called_frame = 7}};
  extras.events.push_back(extras.events.front());
  extras.events[1].called_right = false;
  extras.events[1].called_frame.reset();
  extras.alarms = {{"sway", 4}};
  extras.joint_states = {"tin"};
  return extras;
}

TEST(DetectionExtras, AreWrittenInTheOrderOfTheirKeys) {
  DetectionExtras extras = Session();
  extras.events.pop_back();
  EXPECT_EQ(WriteExtras(extras),
            R"({"format":"etude-detection","version":1,"moves":[{"name":"clap","key_poses":[[{"feature":"RH",)"
            R"("degrees":90.0,"tolerance_deg":20.5}],[{"feature":"LH","degrees":10.0,"tolerance_deg":5.0},)"
            R"({"feature":"Trunk","degrees":0.0,"tolerance_deg":5.0}]]}],"events":[{"move":"clap","truth":"right",)"
            R"("fault":"none","danced":"clap","begin_frame":3,"end_frame":9,"called_right":true,"score":0.25,)"
            R"("called_frame":7}],"alarms":[{"move":"sway","frame":4}],"joint_states":["tin"]})");
}

TEST(DetectionExtras, SurviveWritingAndReading) {
  DetectionExtras extras = Session();
  extras.threshold = 0.4;
  const std::string text = WriteExtras(extras);
  ASSERT_OK(read, ReadExtras<DetectionExtras>(text));
  EXPECT_EQ(read->threshold, 0.4);
  EXPECT_EQ(read->moves[0].key_poses[1][1].feature, "Trunk");
  EXPECT_EQ(read->events[0].called_frame, 7);
  EXPECT_FALSE(read->events[1].called_frame.has_value());
  EXPECT_EQ(WriteExtras(*read), text);
}

TEST(DetectionExtras, AreRefusedNamingThePlaceWhatWasFoundAndWhatItMeans) {
  EXPECT_TRUE(testing::AnswersAreKept(
      "tests/bench/recordings/complaints.txt", [good = WriteExtras(Session())](const std::string& edit) {
        return testing::Refusal(ReadExtras<DetectionExtras>(testing::Edited(good, edit)));
      }));
}

TEST(CoachExtras, SurviveWritingAndReading) {
  CoachExtras extras{.song = "groove", .modes = {{"dance", 0}}};
  extras.performances = {{.move = "clap", .truth = "grey", .called = "unjudged", .end_frame = 8, .faults = "none"}};
  extras.words = {{.begin_frame = 2, .say = "Watch!", .hint = "up", .picture = BodyPose{}}, {.begin_frame = 5}};
  extras.words[0].picture->joints[19] = {1, 2, 3.5};
  extras.decisions = {{8, "wrong", "not reached"}};
  extras.corrections = {8};
  extras.transitions = {9, 12};
  extras.beats_s = {0.5};
  const std::string text = WriteExtras(extras);
  EXPECT_THAT(text, HasSubstr(R"(1.0,2.0,3.5]},{"begin_frame":5,"say":"","hint":""}],"decisions")"));
  EXPECT_THAT(text, HasSubstr(R"([{"move":"clap","begin_frame":0,"end_frame":8,"truth":"grey","faults":"none",)"));
  ASSERT_OK(read, ReadExtras<CoachExtras>(text));
  EXPECT_EQ(read->words[0].picture->joints, extras.words[0].picture->joints);
  EXPECT_FALSE(read->words[1].picture.has_value());
  EXPECT_THAT(read->transitions, ElementsAre(9, 12));
  EXPECT_EQ(WriteExtras(*read), text);
}

TEST(IkExtras, TellNullWhereNoPositionIsAskedFor) {
  IkExtras extras{.iterations = {0, 1}, .axis_error_max_deg = {3, 0.5}};
  extras.targets_m = {glm::dvec3(0, 1, 2), std::nullopt};
  const std::string text = WriteExtras(extras);
  EXPECT_EQ(text, R"({"iterations":[0,1],"position_error_max_cm":[],"orientation_error_max_deg":[],)"
                  R"("axis_error_max_deg":[3.0,0.5],"targets_m":[[0.0,1.0,2.0],null]})");
  EXPECT_EQ(WriteExtras(*ReadExtras<IkExtras>(text)), text);
}

TEST(IkExtras, LeaveEmptyWhateverIsNotWhatItShouldBe) {
  ASSERT_OK(read,
            ReadExtras<IkExtras>(R"({"iterations": [0, "1"], "axis_error_max_deg": [1, 2], "targets_m": [[1, 2]]})"));
  EXPECT_TRUE(read->iterations.empty() && read->targets_m.empty());
  EXPECT_THAT(read->axis_error_max_deg, ElementsAre(1, 2));
  EXPECT_THAT(testing::Refusal(ReadExtras<IkExtras>("3")), HasSubstr("not a JSON object"));
}

TEST(TransitionExtras, SurviveWritingAndReading) {
  TransitionExtras extras{.transition_frames = {4, 9}};
  extras.points = {
      {.from = "clap", .to = "in-between", .from_frame = 4, .to_frame = 0, .distance = 0.25, .partials = {}}};
  extras.points[0].partials.emplace()[9] = 0.0625;
  extras.candidates = {
      {.point = 0, .from_frame = 4, .to_frame = 2, .distance = 0.5, .partials = {}, .cost = {}, .outcome = "taken"}};
  extras.pairs_seen = 900;
  const std::string text = WriteExtras(extras);
  EXPECT_THAT(text, HasSubstr(R"("distance":0.25,"partials":{"RH":0.0,"LH":0.0,)"));
  EXPECT_THAT(text, HasSubstr(R"("pairs_seen":900,"pairs_matched":null)"));
  EXPECT_THAT(text, HasSubstr(R"("partials":null,"cost":null,"outcome":"taken"}]})"));
  ASSERT_OK(read, ReadExtras<TransitionExtras>(text));
  EXPECT_EQ((*read->points[0].partials)[9], 0.0625);
  EXPECT_EQ(read->candidates, extras.candidates);
  EXPECT_EQ(WriteExtras(*read), text);
}

TEST(TaskExtras, AreTheOnesThatThePageTellsOf) {
  ASSERT_OK(page, ReadWholeFile("docs/reference/recordings.md"));
  EXPECT_EQ(*page, RecordingsAsMarkdown()) << "write it anew: etude list recordings > docs/reference/recordings.md";
  EXPECT_THAT(*page, HasSubstr("- `moves`: the moves that may be requested\n  - `name`: name of a taught move\n"));
  EXPECT_THAT(*page, HasSubstr("- `version`: always 1\n"));
}

}  // namespace
}  // namespace etude
