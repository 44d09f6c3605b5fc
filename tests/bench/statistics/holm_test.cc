#include "bench/statistics/holm.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

std::vector<std::optional<double>> Corrected(std::vector<std::optional<double>> p_values) {
  return HolmCorrected(p_values);
}

TEST(Holm, AgreesWithR) {
  // p.adjust(c(0.01, 0.02, 0.03, 0.04, 0.05), "holm") and p.adjust(c(0.04, 0.001, 0.03), "holm")
  const auto rising = Corrected({0.01, 0.02, 0.03, 0.04, 0.05});
  const double expected[] = {0.05, 0.08, 0.09, 0.09, 0.09};
  for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(*rising[i], expected[i]);
  const auto mixed = Corrected({0.04, 0.001, 0.03});
  EXPECT_DOUBLE_EQ(*mixed[0], 0.06);
  EXPECT_DOUBLE_EQ(*mixed[1], 0.003);
  EXPECT_DOUBLE_EQ(*mixed[2], 0.06);
}

TEST(Holm, NeverExceedsOneNorForgetsAQuestion) {
  const auto corrected = Corrected({0.9, std::nullopt, 0.02});
  EXPECT_EQ(*corrected[0], 1);
  EXPECT_FALSE(corrected[1]);
  EXPECT_DOUBLE_EQ(*corrected[2], 0.06);  // times three, not two
  EXPECT_TRUE(Corrected({}).empty());
}

}  // namespace
}  // namespace etude
