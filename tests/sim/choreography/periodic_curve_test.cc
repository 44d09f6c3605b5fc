#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/choreography/move_curves.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr Ease kAllEases[] = {Ease::kSmooth, Ease::kLinger, Ease::kRush, Ease::kSnap, Ease::kStep};

std::vector<PeriodicCurve::Key> RandomKeys(RandomStream& random) {
  std::vector<PeriodicCurve::Key> keys;
  double at = random.Uniform(0, 0.3);
  while (at < 4) {
    keys.push_back({at, random.Normal(), kAllEases[random.IndexBelow(std::size(kAllEases))]});
    at += random.Uniform(0.3, 1.0);
  }
  return keys;
}

TEST(PeriodicCurve, GoesThroughItsKeysInEveryPeriod) {
  const PeriodicCurve curve({{0.5, 1}, {1, 3}, {2.5, -2}}, 4);
  for (double lap : {-8.0, -4.0, 0.0, 4.0}) {
    EXPECT_NEAR(curve.At(0.5 + lap), 1, 1e-12);
    EXPECT_NEAR(curve.At(1 + lap), 3, 1e-12);
    EXPECT_NEAR(curve.At(2.5 + lap), -2, 1e-12);
  }
}

TEST(PeriodicCurve, IsExactlyConstantBetweenEqualKeys) {
  const PeriodicCurve curve({{0, 0.1}, {1, 0.7}, {2, 0.7}, {3, 0.2}}, 4);
  for (double at = 1; at <= 2; at += 0.05) EXPECT_EQ(curve.At(at), 0.7);
  EXPECT_EQ(PeriodicCurve({{1, 0.3}}, 4).At(2.2), 0.3);
}

/// The one-sided first and second derivative at a point, by finite differences that are exact for cubics.
struct Derivatives {
  double slope, bend;
};
Derivatives OneSided(const PeriodicCurve& curve, double at, double step) {
  const double f0 = curve.At(at), f1 = curve.At(at + step), f2 = curve.At(at + 2 * step), f3 = curve.At(at + 3 * step);
  return {(-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / (6 * step), (2 * f0 - 5 * f1 + 4 * f2 - f3) / (step * step)};
}

TEST(PeriodicCurve, HasNoStepInItsFirstTwoDerivativesAtAnyKey) {
  RandomStream random({}, "curves");
  double largest_bend = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto keys = RandomKeys(random);
    const PeriodicCurve curve(keys, 4.3);
    for (const auto& key : keys) {
      const Derivatives left = OneSided(curve, key.at, -1e-4), right = OneSided(curve, key.at, 1e-4);
      ASSERT_NEAR(left.slope, right.slope, 1e-3);
      ASSERT_NEAR(left.bend, right.bend, 0.05);
      largest_bend = std::max(largest_bend, std::abs(right.bend));
    }
  }
  EXPECT_GT(largest_bend, 10) << "the curves must bend for the comparison to mean anything";
}

TEST(PeriodicCurve, HasNoStepInItsFirstTwoDerivativesWhereASnapOrAStepStartsAndEnds) {
  for (Ease ease : {Ease::kSnap, Ease::kStep}) {
    const PeriodicCurve curve({{0, 1}, {1, 3, ease}, {2.5, 2}}, 4);
    for (double share : {0.2, 0.5, 0.84}) {
      const Derivatives left = OneSided(curve, share, -1e-4), right = OneSided(curve, share, 1e-4);
      EXPECT_NEAR(left.slope, right.slope, 1e-3) << share;
      EXPECT_NEAR(left.bend, right.bend, 0.2) << share;
    }
  }
}

TEST(PeriodicCurve, AnEaseChangesWhenAndNotWhere) {
  const auto half_way = [](Ease ease) { return PeriodicCurve({{0, 0}, {1, 1, ease}, {2, 1}}, 4).At(0.5); };
  EXPECT_NEAR(half_way(Ease::kSmooth), 0.5, 0.05);
  EXPECT_GT(half_way(Ease::kLinger), 0.65) << "most of the way early";
  EXPECT_LT(half_way(Ease::kRush), 0.35) << "most of the way late";
  EXPECT_EQ(half_way(Ease::kSnap), 0) << "still waiting";
  const PeriodicCurve step({{0, 0}, {1, 1, Ease::kStep}, {2, 1}}, 4);
  EXPECT_EQ(step.At(0.19), 0);
  EXPECT_NEAR(step.At(0.85), 1, 1e-12);
}

TEST(PeriodicCurve, NeverTurnsBackOnItsWayWhateverTheEase) {
  for (Ease ease : kAllEases) {
    const PeriodicCurve curve({{0, 0}, {0.7, 1, ease}, {1.9, 2, ease}, {3, 5, ease}}, 4);
    for (double at = 0; at < 2.985; at += 0.01) ASSERT_GE(curve.At(at + 0.01), curve.At(at) - 1e-12) << at;
  }
}

TEST(PeriodicCurve, TakesPrescribedDerivatives) {
  constexpr double kFall = 2.5, kHalf = 0.4;
  const double top = 0.5 * kFall * kHalf * kHalf, speed = kFall * kHalf;
  const PeriodicCurve curve({{0, 0},
                             {1 - kHalf, 0, Ease::kSmooth, {{speed, -kFall}}},
                             {1, top, Ease::kSmooth, {{0, -kFall}}},
                             {1 + kHalf, 0, Ease::kSmooth, {{-speed, -kFall}}}},
                            3);
  for (double t = -kHalf; t <= kHalf; t += 0.05) EXPECT_NEAR(curve.At(1 + t), top - 0.5 * kFall * t * t, 1e-12);
}

TEST(PeriodicCurve, StaysWithinItsKeys) {
  RandomStream random({}, "overshoot");
  for (int trial = 0; trial < 200; ++trial) {
    const auto keys = RandomKeys(random);
    const auto [low, high] = std::ranges::minmax_element(keys, {}, &PeriodicCurve::Key::value);
    const double slack = 0.02 * (high->value - low->value);
    const PeriodicCurve curve(keys, 4.3);
    for (double at = 0; at < 4.3; at += 0.01) {
      ASSERT_GE(curve.At(at), low->value - slack);
      ASSERT_LE(curve.At(at), high->value + slack);
    }
  }
}

}  // namespace
}  // namespace etude
