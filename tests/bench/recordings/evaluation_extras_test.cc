#include "bench/recordings/evaluation_extras.h"

#include <gmock/gmock.h>

#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

EvaluationExtras SampleOfPair() {
  EvaluationExtras extras;
  extras.truth.rate_hz = 59.94;
  extras.truth.joints = {"root", "tail é"};
  extras.truth.parents = {-1, 0};
  extras.truth.positions = {{0, 0.1 + 0.2, 0}, {0, 1, -1}, {0, 2, 0}, {1e-9, 2, 3}};
  extras.answer = extras.truth;
  extras.answer.positions[3] = NotSeen();
  return extras;
}

TEST(EvaluationExtras, SurviveWritingAndReadingWithTheirGaps) {
  const EvaluationExtras written = SampleOfPair();
  ASSERT_OK(read, ReadEvaluationExtras(WriteEvaluationExtras(written)));
  EXPECT_EQ(read->truth.rate_hz, 59.94);
  EXPECT_EQ(read->answer.joints, written.truth.joints);
  EXPECT_EQ(read->answer.parents, written.truth.parents);
  EXPECT_EQ(read->truth.positions, written.truth.positions);
  ASSERT_EQ(read->answer.positions.size(), 4u);
  EXPECT_EQ(read->answer.positions[0], written.answer.positions[0]);
  EXPECT_FALSE(IsSeen(read->answer.positions[3]));
}

// A joint with one missing number is unseen.
TEST(EvaluationExtras, OthersAreRefused) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/recordings/evaluation_complaints.txt", [](const std::string& edit) {
    return testing::Message(ReadEvaluationExtras(testing::Edited(WriteEvaluationExtras(SampleOfPair()), edit)));
  }));
  const std::string nameless = testing::Edited(WriteEvaluationExtras(SampleOfPair()), R"("answer" => "other")");
  EXPECT_THAT(testing::Message(ReadEvaluationExtras(nameless)), ::testing::HasSubstr("this recording of an evaluation "
                                                                                     "cannot be read"));
}

}  // namespace
}  // namespace etude
