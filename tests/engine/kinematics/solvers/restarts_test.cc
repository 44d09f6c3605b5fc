#include "engine/kinematics/solvers/restarts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

TEST(Restarts, BeginAtOtherPosesAroundTheStartWithinTheRanges) {
  const std::vector<AngleRange>& ranges = Body().limits;
  std::vector<std::vector<double>> poses;
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<double> start = RandomPose(Body(), trial, 1.0).angles;
    for (int number = 1; number <= kRestarts; ++number) {
      std::vector<double>& angles = poses.emplace_back();
      ScatterAround(start, ranges, number, angles);
      for (std::size_t d = 0; d < angles.size(); ++d) {
        EXPECT_TRUE(angles[d] >= ranges[d].lower && angles[d] <= ranges[d].upper);
        EXPECT_LE(std::abs(angles[d] - start[d]), 1.5);
      }
      std::vector<double> again;
      ScatterAround(start, ranges, number, again);
      EXPECT_EQ(again, angles) << "no dice";
    }
  }
  std::ranges::sort(poses);
  EXPECT_EQ(std::ranges::adjacent_find(poses), poses.end()) << "each is a try of its own";
}

// Where no range cuts it off, every tenth of the 3 rad gets about a tenth of many numbers.
TEST(Restarts, AreSpreadEvenly) {
  const std::vector<AngleRange> wide(6, {-100, 100});
  const std::vector<double> start = {0, 0.3, -0.7, 1.1, 2, -2};
  constexpr int kNumbers = 500;
  for (std::size_t d = 0; d < start.size(); ++d) {
    int counts[10] = {};
    for (int number = 1; number <= kNumbers; ++number) {
      std::vector<double> angles;
      ScatterAround(start, wide, number, angles);
      ++counts[std::min(9, static_cast<int>((angles[d] - start[d] + 1.5) / 0.3))];
    }
    for (const int count : counts) EXPECT_NEAR(count, kNumbers / 10, 8) << d;
  }
}

}  // namespace
}  // namespace etude
