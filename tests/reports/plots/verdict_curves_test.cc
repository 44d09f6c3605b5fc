#include <gtest/gtest.h>

#include <vector>

#include "reports/plots/verdicts.h"

namespace etude {
namespace {

TEST(FoundBySeverity, CountsFaultsInFifths) {
  std::vector<JudgedPerformance> all;
  for (double severity : {0.1, 0.15, 0.5, 0.55, 0.9, 1.0})
    all.push_back({.is_called = severity < 0.53, .severity = severity});
  all.push_back({.is_called = true, .severity = 0});
  const auto curve = FoundBySeverity(all);
  const std::vector<std::pair<double, double>> expected = {{0.1, 0}, {0.5, 0.5}, {0.9, 1}};
  EXPECT_EQ(curve, expected);
  EXPECT_DOUBLE_EQ(*HalfFoundAt(curve), 0.5);
  EXPECT_FALSE(HalfFoundAt(std::vector<std::pair<double, double>>{{0.1, 0.6}, {0.9, 0.7}}));
}

}  // namespace
}  // namespace etude
