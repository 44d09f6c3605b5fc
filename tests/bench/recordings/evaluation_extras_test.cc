#include "bench/recordings/evaluation_extras.h"

#include <gmock/gmock.h>

#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

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

TEST(EvaluationExtras, OthersAreRefused) {
  const std::string good = WriteEvaluationExtras(SampleOfPair());
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return testing::Message(ReadEvaluationExtras(text.replace(at, from.size(), to)));
  };
  EXPECT_EQ(complaint("59.94", "30"), "accepted");
  EXPECT_THAT(complaint("59.94", "0"), HasSubstr("0 Hz"));
  EXPECT_THAT(complaint("[-1,0]", "[-1,2]"), HasSubstr("parent 2 of 2 joints"));
  EXPECT_THAT(complaint("[-1,0]", "[-1]"), HasSubstr("2 joints, 1 parents"));
  EXPECT_THAT(complaint(",null,null,null", ""), HasSubstr("a frame of 3 numbers and 2 joints"));
  EXPECT_THAT(complaint("null,null,null", "null,1,2"), "accepted")
      << "a joint of which one number is missing is not seen";
  EXPECT_THAT(complaint("\"answer\"", "\"other\""), HasSubstr("not a readable recording"));
}

}  // namespace
}  // namespace etude
