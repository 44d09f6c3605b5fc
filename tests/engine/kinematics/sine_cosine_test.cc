#include "engine/kinematics/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/angles.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

TEST(SineCosine, IsTheLibrarysToTheLastBitsForAnglesOfAllSizes) {
  RandomStream random({.suite_seed = 7, .scenario = "sine-cosine-test"}, "angles");
  for (const double largest : {1e-8, 1.0, kPi, 100.0, 1e6}) {
    for (int i = 0; i < 20000; ++i) {
      const double angle = random.Uniform(-largest, largest);
      const auto [sine, cosine] = ComputeSineCosine(angle);
      ASSERT_NEAR(sine, std::sin(angle), 2 * kEpsilon * std::abs(std::sin(angle))) << angle;
      ASSERT_NEAR(cosine, std::cos(angle), 2 * kEpsilon * std::abs(std::cos(angle))) << angle;
    }
  }
}

TEST(SineCosine, KeepsItsDigitsNextToItsZeros) {
  for (int quarters = -600000; quarters <= 600000; quarters += 7) {
    const double angle = 0.5 * kPi * quarters;  // rounding moves the angle off the exact zero
    const auto [sine, cosine] = ComputeSineCosine(angle);
    ASSERT_NEAR(sine, std::sin(angle), 2 * kEpsilon * std::abs(std::sin(angle))) << quarters;
    ASSERT_NEAR(cosine, std::cos(angle), 2 * kEpsilon * std::abs(std::cos(angle))) << quarters;
  }
}

TEST(SineCosine, IsExactWhereItCanBe) {
  EXPECT_EQ(ComputeSineCosine(0).sine, 0);
  EXPECT_EQ(ComputeSineCosine(0).cosine, 1);
  EXPECT_EQ(ComputeSineCosine(-0.3).sine, -ComputeSineCosine(0.3).sine);
  EXPECT_EQ(ComputeSineCosine(-0.3).cosine, ComputeSineCosine(0.3).cosine);
}

TEST(SineCosine, HandsOnWhatIsNoNumber) {
  EXPECT_TRUE(std::isnan(ComputeSineCosine(std::numeric_limits<double>::quiet_NaN()).sine));
  EXPECT_TRUE(std::isnan(ComputeSineCosine(std::numeric_limits<double>::infinity()).cosine));
}

}  // namespace
}  // namespace etude
