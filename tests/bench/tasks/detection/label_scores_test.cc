#include "bench/tasks/detection/label_scores.h"

#include <gtest/gtest.h>

#include "tests/io/streams/record_people.h"
#include "tests/support/results.h"

namespace etude {
namespace {

const std::vector<std::string> kMoves = {"boxing", "clap", "robot", "side_kick", "stretch"};

WatchOptions By(const char* recogniser) {
  WatchOptions options;
  options.recogniser.kind = FindRecogniser(recogniser);
  return options;
}
WatchOptions ByDtw() { return By("dtw"); }

TEST(LeaveOnePersonOut, RecognisesPeopleByWhatOthersTaught) {
  const Recorded recorded = Record(5, kMoves, 10);
  ASSERT_OK(out, LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", ByDtw()));
  EXPECT_EQ(out->people.size(), 5u);
  EXPECT_EQ(out->verdicts.size() + static_cast<std::size_t>(out->points.size()), recorded.parts.size());
  EXPECT_GT(*Accuracy(out->nearest), 0.8);
  EXPECT_GT(*Accuracy(out->verdicts), 0.7);
  // The recogniser whole-body is told where performances begin and end, like the yardstick (`nearest`).
  ASSERT_OK(whole, LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", By("whole-body")));
  EXPECT_GT(*Accuracy(whole->verdicts), 0.9);
}

TEST(LeaveOnePersonOut, LabelsThatMeanNothingAreGuessed) {
  Recorded recorded = Record(4, kMoves, 10);
  // Every person uses other names for the moves, so training on the other people is useless.
  for (LabelledPart& part : recorded.parts) {
    const auto at = static_cast<std::size_t>(std::ranges::find(kMoves, part.move) - kMoves.begin());
    part.move = kMoves[(at + part.stream) % kMoves.size()];
  }
  ASSERT_OK(out, LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", ByDtw()));
  EXPECT_LT(*Accuracy(out->nearest), 0.3);
  EXPECT_LT(*Accuracy(out->verdicts), 0.4);
}

TEST(LeaveOnePersonOut, RefusesOnePersonAndNobody) {
  Recorded recorded = Record(1, kMoves, 5);
  EXPECT_EQ(
      testing::Refusal(LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", {})),
      "l.csv: the labels contain 1 person; needed: at least two people, because each person is judged with the data of "
      "the other people");
  recorded.parts[2].person.clear();
  recorded.parts[2].line = 7;
  EXPECT_EQ(
      ToString(LeaveOnePersonOut(recorded.streams, recorded.parts, "l.csv", {}).error()).find("l.csv:7: the person in"),
      0u);
}

TEST(Accuracy, IsTheShareTakenForWhatTheyWere) {
  const std::vector<Classified> some = {{"a", "a", "p"}, {"a", "b", "p"}, {"b", "", "p"}, {"b", "b", "q"}};
  EXPECT_DOUBLE_EQ(*Accuracy(some), 0.5);
  EXPECT_FALSE(Accuracy({}));
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
