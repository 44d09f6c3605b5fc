#include "bench/dataset/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using testing::ElementsAre;

Scenario Swept(std::initializer_list<std::vector<SweptValue>> conditions) {
  Scenario scenario;
  for (const std::vector<SweptValue>& settings : conditions) scenario.conditions.push_back({settings, {}});
  return scenario;
}

TEST(Layout, NamesAConditionByItsValues) {
  EXPECT_THAT(ConditionFolders(Swept({{}})), ElementsAre("all"));
  EXPECT_THAT(ConditionFolders(Swept({{{"noise_deg", "5"}, {"noise", "uniform"}}, {{"noise_deg", "-0.5"}}})),
              ElementsAre("noise_deg=5,noise=uniform", "noise_deg=-0.5"));
}

TEST(Layout, GivesConditionsOneNameEachThatCannotLeaveTheirFolder) {
  EXPECT_THAT(ConditionFolders(Swept({{{"a", "../x y"}}, {{"a", "../x/y"}}, {{"a", "../x~y"}}})),
              ElementsAre("a=.._x_y", "a=.._x_y~2", "a=.._x_y~3"));
  const std::string longest(5000, 'v');
  for (const std::string& name : ConditionFolders(Swept({{{"a", longest}}, {{"b", longest}}}))) {
    EXPECT_LT(name.size(), 250u);
  }
}

TEST(Layout, NumbersTrialsInThreeDigitsOrMore) {
  EXPECT_EQ(TrialName(7), "007");
  EXPECT_EQ(TrialName(12345), "12345");
}

}  // namespace
}  // namespace etude
