#include <gtest/gtest.h>

#include "reports/plots/verdicts.h"

namespace etude {
namespace {

JudgedPerformance Faulty(const char* fault, double severity, bool is_called) {
  JudgedPerformance one{.fault = fault};
  one.severity = severity;
  one.is_called = is_called;
  return one;
}

TEST(FoundByFault, CountsSlightAndBadOnesApart) {
  const std::vector<JudgedPerformance> all = {Faulty("late", 0.2, true), Faulty("late", 0.5, false),
                                              Faulty("late", 0.51, true), Faulty("", 0, true),
                                              Faulty("skipped", 0, false)};
  const auto found = FoundByFault(all);
  ASSERT_EQ(found.size(), 1u) << "of severity 0 is none";
  const auto& [slight, bad] = found.at("late");
  EXPECT_EQ(slight.all, 2);
  EXPECT_EQ(slight.found, 1);
  EXPECT_EQ(bad.all, 1);
  EXPECT_EQ(bad.found, 0);
}

TEST(ConfusionOf, LeavesOutWhereNothingWasDancedOrNoMoveIsNamed) {
  std::vector<JudgedPerformance> all(5);
  all[0].danced = all[1].danced = all[2].danced = "clap";
  all[0].named = "clap";
  all[1].named = "sway";
  all[2].named = "";
  all[3].named = "clap";  // a move was named, but none danced
  all[4].danced = "clap";
  const MoveConfusion confusion = ConfusionOf(all);
  EXPECT_EQ(confusion.moves, (std::vector<std::string>{"clap", "sway"}));
  EXPECT_EQ(confusion.Danced("clap"), 3);
  EXPECT_EQ(confusion.Danced("sway"), 0);
  EXPECT_EQ(confusion.counts.at({"clap", "sway"}), 1);
  EXPECT_EQ(confusion.counts.at({"clap", ""}), 1);
}

TEST(WorstSessions, AreThoseWithTheLargestShareOfMistakes) {
  std::vector<JudgedPerformance> all;
  const auto add = [&](int person, double truth, bool is_called) {
    JudgedPerformance& one = all.emplace_back();
    one.person = person;
    one.truth = truth;
    one.is_called = is_called;
  };
  add(0, 1, true);
  add(0, 0, false);  // without a mistake
  add(1, 1, false);
  add(1, 1, true);
  add(1, 0, false);
  add(1, 0.5, true);  // neither right nor wrong, so no answer is a mistake
  add(2, 0, true);
  add(2, 1, true);
  const auto worst = WorstSessions(all);
  ASSERT_EQ(worst.size(), 2u);
  EXPECT_EQ(worst[0].person, 2);
  EXPECT_DOUBLE_EQ(worst[0].Share(), 0.5);
  EXPECT_EQ(worst[0].praised, 1);
  EXPECT_EQ(worst[1].missed, 1);
  EXPECT_EQ(worst[1].right, 2);
}

}  // namespace
}  // namespace etude
