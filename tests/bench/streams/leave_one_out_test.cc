#include "bench/streams/leave_one_out.h"

#include <gtest/gtest.h>

#include "sim/performer/session.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {
namespace {

/// People who differ, each in one recording, as a Kinect sees them, with labels of what they did.
struct Recorded {
  std::vector<NamedStream> streams;
  std::vector<LabelledPart> parts;
};

Recorded Record(int people, const std::vector<std::string>& names, int events) {
  std::vector<Move> moves;
  for (const std::string& name : names) moves.push_back(*LoadBuiltinMove(name));
  Recorded recorded;
  for (int i = 0; i < people; ++i) {
    const WorldKey key{.suite_seed = 5, .scenario = "left-out", .trial = i};
    RandomStream plan_dice(key, "session-plan"), dance_dice(key, "session-dance");
    const Person person = DrawPerson(key, People::kAdult);
    const SessionOptions options{.people = People::kAdult, .events = events, .fault_share = 0};
    const Performance session = Perform(dance_dice, moves, person, PlanSession(plan_dice, moves, person, options));
    const SkeletonSensorOptions errors = SensorV2();
    NamedStream& stream = recorded.streams.emplace_back();
    stream.name = "person-" + std::to_string(i);
    stream.stream = SenseSkeleton(session.motion, SkeletonSensorAt(SensorPlace{}, errors.view), {}, errors, key);
    for (const SessionEvent& event : session.events) {
      LabelledPart& part = recorded.parts.emplace_back();
      part.stream = static_cast<std::size_t>(i);
      part.move = event.move;
      part.person = stream.name;
      part.begin = static_cast<int>(event.start_s * 30);
      part.end = std::min(static_cast<int>(event.end_s * 30), static_cast<int>(stream.stream.frames.size()));
    }
  }
  return recorded;
}

const std::vector<std::string> kMoves = {"boxing", "clap", "robot", "side_kick", "stretch"};

WatchOptions ByDtw() {
  WatchOptions options;
  options.recogniser.kind = FindRecogniser("dtw");
  return options;
}

TEST(LeaveOnePersonOut, RecognisesPeopleByWhatOthersTaught) {
  const Recorded recorded = Record(5, kMoves, 10);
  const auto out = LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", ByDtw());
  ASSERT_TRUE(out) << ToString(out.error());
  EXPECT_EQ(out->people.size(), 5u);
  EXPECT_EQ(out->verdicts.size() + static_cast<std::size_t>(out->points.size()), recorded.parts.size());
  EXPECT_GT(*Accuracy(out->nearest), 0.8);
  EXPECT_GT(*Accuracy(out->verdicts), 0.7);
}

TEST(LeaveOnePersonOut, LabelsThatMeanNothingAreGuessed) {
  Recorded recorded = Record(4, kMoves, 10);
  // Every person calls the moves by other names: what the others taught is of no use.
  for (LabelledPart& part : recorded.parts) {
    const auto at = static_cast<std::size_t>(std::ranges::find(kMoves, part.move) - kMoves.begin());
    part.move = kMoves[(at + part.stream) % kMoves.size()];
  }
  const auto out = LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", ByDtw());
  ASSERT_TRUE(out) << ToString(out.error());
  EXPECT_LT(*Accuracy(out->nearest), 0.3);
  EXPECT_LT(*Accuracy(out->verdicts), 0.4);
}

TEST(LeaveOnePersonOut, RefusesOnePersonAndNobody) {
  Recorded recorded = Record(1, kMoves, 5);
  const auto alone = LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", {});
  ASSERT_FALSE(alone);
  EXPECT_EQ(ToString(alone.error()), "l.csv: 1 person; leaving one out needs two");
  recorded.parts[2].person.clear();
  recorded.parts[2].line = 7;
  EXPECT_EQ(ToString(LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", {}).error()).find("l.csv:7: nobody"),
            0u);
}

TEST(WarpedDistance, IsNothingToItselfHoweverFastAndSymmetric) {
  const Recorded recorded = Record(1, {"stretch"}, 1);
  const LabelledPart& part = recorded.parts[0];
  const SkeletonStream once = PartOf(recorded.streams[0].stream, part.begin, part.end);
  SkeletonStream slow = once;
  slow.frames.clear();
  for (const SensedFrame& frame : once.frames) slow.frames.insert(slow.frames.end(), {frame, frame});
  EXPECT_EQ(*WarpedDistanceCm(once, once), 0);
  EXPECT_LT(*WarpedDistanceCm(once, slow), 3);
  const Recorded other = Record(1, {"boxing"}, 1);
  const SkeletonStream boxing = PartOf(other.streams[0].stream, other.parts[0].begin, other.parts[0].end);
  EXPECT_GT(*WarpedDistanceCm(once, boxing), 8);
  EXPECT_NEAR(*WarpedDistanceCm(once, boxing), *WarpedDistanceCm(boxing, once), 1e-9);
  EXPECT_FALSE(WarpedDistanceCm(once, {}));
}

}  // namespace
}  // namespace etude
