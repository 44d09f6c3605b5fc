#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reports/films/convergence_scene.h"

namespace etude {
namespace {

constexpr int kLengths[] = {0, 1, 2, 7, 60, 200, 1000, 100'000};

TEST(RaceClock, ShowsAnyNumberOfIterationsInSixToTenSeconds) {
  for (const int last : kLengths) {
    const RaceClock clock(last);
    EXPECT_GE(clock.Frames(), 6 * kFilmRate) << last;
    EXPECT_LE(clock.Frames(), 10 * kFilmRate) << last;
  }
}

TEST(RaceClock, NeverRunsBackAndHoldsTheStartAndTheLastIteration) {
  for (const int last : kLengths) {
    const RaceClock clock(last);
    for (int frame = 1; frame < clock.Frames(); ++frame) {
      EXPECT_GE(clock.IterationAt(frame), clock.IterationAt(frame - 1)) << last << " at frame " << frame;
    }
    for (int frame = 0; frame <= kFilmRate / 2; ++frame) EXPECT_EQ(clock.IterationAt(frame), 0) << last;
    for (int held = 1; held <= 3 * kFilmRate / 2; ++held) {
      EXPECT_EQ(clock.IterationAt(clock.Frames() - held), last) << last << ", the last frame but " << held - 1;
    }
  }
}

TEST(RaceClock, IsALogarithm) {
  const RaceClock clock(1000);
  const int moving = clock.Frames() - 2 * kFilmRate;
  for (int frame = 0; frame < moving; ++frame) {
    const double iteration = clock.IterationAt(kFilmRate / 2 + frame);
    EXPECT_NEAR(clock.ShareOf(iteration), static_cast<double>(frame) / moving, 1e-12);
    EXPECT_NEAR(1 + iteration, std::pow(1001.0, static_cast<double>(frame) / moving), 1e-9 * (1 + iteration));
  }
}

TEST(RaceClock, ShowsTheFirstIterationsOneByOne) {
  const RaceClock clock(1000);
  std::set<int> seen;
  for (int frame = 0; frame < clock.Frames(); ++frame) seen.insert(static_cast<int>(clock.IterationAt(frame)));
  for (int iteration = 0; iteration <= 20; ++iteration) EXPECT_TRUE(seen.contains(iteration)) << iteration;
}

TEST(RaceClock, StandsStillWhenNoMethodMoved) {
  const RaceClock clock(0);
  EXPECT_EQ(clock.IterationAt(clock.Frames() - 1), 0);
  EXPECT_EQ(clock.ShareOf(0), 0);
}

}  // namespace
}  // namespace etude
