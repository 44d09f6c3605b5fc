#include "engine/streams/labels.h"

#include <gtest/gtest.h>

#include "tests/support/results.h"

namespace etude {
namespace {

TEST(Labels, CsvTellsPerformancesActionPointsAndWholeRecordings) {
  const std::string text =
      "clip,from_s,to_s,move,truth,person\n"
      "seq-1,0.5,3.1,arms-open,right,anna\n"
      "seq-1,4,,arms-open,right,anna\n"
      "seq-2,,,arms-open,half,bo\n";
  ASSERT_OK(labels, ReadLabels(text, "l.csv"));
  ASSERT_EQ(labels->size(), 3u);
  EXPECT_EQ((*labels)[0].from_s, 0.5);
  EXPECT_EQ((*labels)[0].to_s, 3.1);
  EXPECT_TRUE((*labels)[0].IsRight());
  EXPECT_TRUE((*labels)[1].IsActionPoint());
  EXPECT_EQ((*labels)[2].fault, "half");
  EXPECT_FALSE((*labels)[2].from_s);
  EXPECT_EQ((*labels)[2].person, "bo");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*labels)[i].clip, i < 2 ? "seq-1" : "seq-2");
    EXPECT_EQ((*labels)[i].move, "arms-open");
    EXPECT_EQ((*labels)[i].IsRight(), i < 2);
  }
  EXPECT_EQ((*labels)[0].person, "anna");
  EXPECT_EQ((*labels)[1].person, "anna");
  EXPECT_EQ((*labels)[1].from_s, 4);
  EXPECT_FALSE((*labels)[1].to_s);
  EXPECT_FALSE((*labels)[2].to_s);
}

TEST(Labels, ColumnsMayStandInAnyOrderWithoutPersonAmongRemarks) {
  ASSERT_OK(labels, ReadLabels("# by hand\nmove, truth, clip, from_s, to_s\r\n\r\nwave, right, a, 1, 2\r\n", "l.csv"));
  EXPECT_EQ((*labels)[0].clip, "a");
  EXPECT_EQ((*labels)[0].person, "");
}

TEST(Labels, RefusesAHeadingThatIsGivenTwice) {
  EXPECT_EQ(testing::Refusal(ReadLabels("clip,from_s,to_s,move,truth,truth\na,1,2,m,right,half\n", "l")),
            "l:1:29: the heading 'truth' is given twice; allowed: each heading once");
}

TEST(Labels, StringsMayBeInQuotesAsRWritesThem) {
  const std::string text =
      "\"\",\"clip\",\"from_s\",\"to_s\",\"move\",\"truth\",\"person\"\n"
      "\"1\",\"seq 1\",0.5,3.1,\"wave\",\"right\",\"anna\"\n\"2\",\"b\",NA,NA,\"wave\",\"half\",\"\"\n";
  ASSERT_OK(labels, ReadLabels(text, "l"));
  ASSERT_EQ(labels->size(), 2u);
  EXPECT_EQ((*labels)[0].clip, "seq 1");
  EXPECT_EQ((*labels)[0].to_s, 3.1);
  EXPECT_EQ((*labels)[0].person, "anna");
  EXPECT_TRUE((*labels)[0].IsRight());
  EXPECT_FALSE((*labels)[1].from_s);
  EXPECT_EQ((*labels)[1].fault, "half");
  EXPECT_EQ((*labels)[1].person, "");
  EXPECT_FALSE(ReadLabels("\"clip\",from_s,to_s,move,truth\n\"a,b\",1,2,m,right\n", "l")) << "a comma in a name";
}

TEST(Labels, TicksOfATagStreamAreMicrosecondsOfTheRecording) {
  // From the data set's own load_tagstream: usec = (tick · 1000 + 49875/2) / 49875, which rounds.
  ASSERT_OK(labels, ReadLabels("XQPCTick;Tag\n2202252000;G1 lift outstretched arms\n", "p.tagstream", "p"));
  EXPECT_NEAR(*(*labels)[0].from_s, 44.15542857, 1e-8);
  EXPECT_TRUE((*labels)[0].IsActionPoint());
  EXPECT_TRUE((*labels)[0].by_own_clock);
  EXPECT_EQ((*labels)[0].clip, "p");
  EXPECT_EQ((*labels)[0].move, "G1 lift outstretched arms");
}

TEST(Labels, ActionLabelsOfUTKinectNameTakesAndFrames) {
  const auto labels =
      ReadLabels("s01_e01 \nwalk: 252 390\nsitDown: 572 686 \ns10_e02\ncarry: NaN NaN\npush: 30 60\n", "a");
  ASSERT_TRUE(labels) << ToString(labels.error());
  ASSERT_EQ(labels->size(), 3u);
  EXPECT_DOUBLE_EQ(*(*labels)[0].from_s, 8.4);
  EXPECT_DOUBLE_EQ(*(*labels)[0].to_s, 13);
  EXPECT_EQ((*labels)[2].person, "s10");
  EXPECT_TRUE(IsLabelOf((*labels)[0], "joints_s01_e01"));
  EXPECT_FALSE(IsLabelOf((*labels)[0], "joints_s01_e02"));
}

}  // namespace
}  // namespace etude
