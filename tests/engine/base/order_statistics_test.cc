#include "engine/base/order_statistics.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(Median, IsTheMidpointOfAnEvenNumber) {
  EXPECT_EQ(Median({7}), 7);
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(Median({5, 5, 1, 9}), 5);
}

TEST(Quantile, IsNumpysDefault) {
  // numpy.quantile([3, 1, 4, 1, 5, 9, 2, 6], q)
  const std::vector<double> values = {3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_DOUBLE_EQ(Quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(Quantile(values, 0.95), 7.95);
  EXPECT_DOUBLE_EQ(Quantile(values, 1), 9);
  EXPECT_DOUBLE_EQ(Quantile(std::vector<double>{7}, 0.5), 7);
}

TEST(UpperMedian, IsTheMiddleOfAnOddNumberAndTheUpperMiddleOfAnEvenOne) {
  EXPECT_EQ(UpperMedian(std::vector<double>{7}), 7);
  EXPECT_EQ(UpperMedian(std::vector<double>{3, 1, 2}), 2);
  EXPECT_EQ(UpperMedian(std::vector<double>{4, 1, 3, 2}), 3);
  EXPECT_EQ(UpperMedian(std::vector<float>{0.5F, 0.25F}), 0.5F);
}

TEST(LowerPercentile, IsTheValueAtTheRankBelow) {
  const std::vector<double> values = {40, 10, 30, 20, 50};
  EXPECT_EQ(LowerPercentile(values, 0), 10);
  EXPECT_EQ(LowerPercentile(values, 0.24), 10);
  EXPECT_EQ(LowerPercentile(values, 0.25), 20);
  EXPECT_EQ(LowerPercentile(values, 0.9), 40);
  EXPECT_EQ(LowerPercentile(values, 1), 50);
}

TEST(LowerPercentile, AtOneHalfDiffersFromTheUpperMedianOfAnEvenNumber) {
  const std::vector<double> values = {4, 1, 3, 2};
  EXPECT_EQ(LowerPercentile(values, 0.5), 2);
  EXPECT_EQ(UpperMedian(values), 3);
}

}  // namespace
}  // namespace etude
