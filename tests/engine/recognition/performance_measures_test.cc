#include "engine/recognition/performance_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr int kSteps = 40;

/// Returns one limb that turns steadily, so that all moments differ.
PoseVector Turned(double step) {
  PoseVector pose;
  pose.weights.fill(1);
  pose.parts[3] = {std::cos(0.07 * step), std::sin(0.07 * step), 0};
  return pose;
}

std::vector<PoseVector> TurningPattern() {
  std::vector<PoseVector> pattern;
  for (int step = 0; step < kSteps; ++step) pattern.push_back(Turned(step));
  return pattern;
}

/// Returns the measures of a performance that shows `step_at(k)` of the example in step k.
template <typename StepAt>
ClockMeasures Measured(const StepAt& step_at, double usual_s = 0) {
  const std::vector<PoseVector> pattern = TurningPattern();
  ClockComparison comparison(pattern);
  for (int k = 0; k < kSteps; ++k) comparison.Update(Turned(std::clamp<double>(step_at(k), 0, kSteps - 1)));
  return comparison.Measure(usual_s);
}

TEST(ClockComparison, FindsByHowMuchAPerformanceIsLate) {
  for (const int late : {-6, 0, 3}) {
    const ClockMeasures measures = Measured([&](int k) { return k - late; });
    EXPECT_NEAR(measures.shift, late / kStepsPerSecond, 1.01 / kStepsPerSecond) << late;
    EXPECT_EQ(measures.off > 0.01, late != 0) << late;
    EXPECT_EQ(measures.gain > 0.01, late != 0) << late;
  }
}

TEST(ClockComparison, PrefersWhatIsUsualButKnowsTheLaterFromTheLate) {
  const auto shift_of = [](int late) { return Measured([&](int k) { return k - late; }).shift; };
  EXPECT_LT(shift_of(3), shift_of(6));
  EXPECT_LT(shift_of(6), shift_of(9));
}

TEST(ClockComparison, CountsFromWhatIsUsualOfThePerson) {
  const auto late = [](int k) { return k - 6; };
  const ClockMeasures unknown = Measured(late), known = Measured(late, 6 / kStepsPerSecond);
  EXPECT_NEAR(known.off, 0.0, 0.02);
  EXPECT_NEAR(known.gain, 0.0, 0.02);
  EXPECT_GT(unknown.off, 0.05);
}

TEST(ClockComparison, TellsWhoHurriesFromWhoIsLate) {
  // In time at the beginning, six steps early at the end.
  const ClockMeasures hurried = Measured([](int k) { return k * (1 + 6.0 / kSteps); });
  const ClockMeasures late = Measured([](int k) { return k - 6; });
  EXPECT_LT(hurried.drift, -1 / kStepsPerSecond);
  EXPECT_NEAR(late.drift, 0, 1.01 / kStepsPerSecond);
}

TEST(ClockComparison, SaysNothingOfWhatWasHardlySeen) {
  const std::vector<PoseVector> pattern = TurningPattern();
  ClockComparison comparison(pattern);
  comparison.Update(Turned(30));
  const ClockMeasures measures = comparison.Measure(-0.1);
  EXPECT_EQ(measures.off, 0);
  EXPECT_NEAR(measures.shift, -0.1, 1e-12);
}

TEST(PersonBaseline, KnowsWhenAPersonKeepsTheClock) {
  PersonBaseline usual;
  const double unknown = usual.Shift();
  PerformanceMeasures measures{};
  measures[kClockSlice.first] = 0.2;
  usual.Add(measures);
  EXPECT_NE(unknown, 0.2);
  EXPECT_EQ(usual.Shift(), 0.2);
  measures[kClockSlice.first] = 0.5;
  usual.Relate(measures);
  EXPECT_NEAR(measures[kClockSlice.Beyond().first], 0.3, 1e-12);
}

}  // namespace
}  // namespace etude
