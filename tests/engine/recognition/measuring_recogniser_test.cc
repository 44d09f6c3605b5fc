#include "engine/recognition/measuring_recogniser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/recognition/sight.h"
#include "tests/engine/recognition/waving_body.h"

namespace etude {
namespace {

std::vector<TaughtMove> ArmsUpAndLeftUp() {
  return {{.name = "up", .span_s = 4, .examples = {StreamOf(Swing(2, 2, 2))}},
          {.name = "left", .span_s = 4, .examples = {StreamOf(Swing(2, 0, 1))}}};
}

/// Plays each performance while its move is requested. Returns, for each request, the measures with the smallest
/// distance among all that the recogniser computed during the request.
std::vector<PerformanceMeasures> NearestMeasures(const std::vector<std::pair<std::size_t, BodyMotion>>& performances) {
  std::vector<PerformanceMeasures> nearest;
  const auto recogniser = MakeMeasuringRecogniser(
      ArmsUpAndLeftUp(), {}, [&](PerformanceOrigin occasion, std::size_t, const PerformanceMeasures& measures) {
        if (occasion == PerformanceOrigin::kAsked && measures[kDistanceMeasure] < nearest.back()[kDistanceMeasure]) {
          nearest.back() = measures;
        }
        return 0.0;
      });
  const auto follower = recogniser->Follow(30);
  LiveSight sight({}, 30);
  for (const auto& [move, motion] : performances) {
    nearest.emplace_back()[kDistanceMeasure] = 1e9;
    follower->Ask(move);
    for (const SensedFrame& frame : Then({motion, Rest(0.5)}).frames) follower->Update(sight.Update(frame));
    follower->Ask(std::nullopt);
  }
  return nearest;
}

/// Returns a motion that stands still for `seconds` and continues with `motion`.
BodyMotion Lagging(BodyMotion motion, double seconds) {
  const BodyMotion rest = Rest(seconds);
  motion.poses.insert(motion.poses.begin(), rest.poses.begin(), rest.poses.end());
  return motion;
}

TEST(MeasuringRecogniser, LaysAPerformanceOnTheExampleAtItsPaceAndLag) {
  // Three performances: 15 % longer and 0.4 s late; in time, but with one arm down; exactly as taught.
  const auto measured =
      NearestMeasures({{0, Lagging(Swing(2, 2, 2.3), 0.4)}, {0, Swing(2, 0, 2)}, {0, Swing(2, 2, 2)}});
  const auto rigid = [&](std::size_t i, std::size_t which) { return measured[i][kRigidSlice.first + which]; };
  enum : std::size_t { kUpperArmMore = 4, kUpperArmLess = 5, kLag = 36, kPace = 37, kDistance = 38 };
  EXPECT_NEAR(rigid(0, kLag), 0.4, 0.15);
  EXPECT_NEAR(rigid(0, kPace), std::log(1.15), 1e-9);
  EXPECT_LT(rigid(0, kDistance), 0.1);
  EXPECT_GT(rigid(1, kUpperArmMore), 0.5);
  EXPECT_LT(rigid(1, kUpperArmLess), 0.1);
  EXPECT_NEAR(rigid(2, kLag), 0, 0.07);
  EXPECT_EQ(rigid(2, kPace), 0);
  EXPECT_LT(rigid(2, kDistance), 0.05);
  EXPECT_NEAR(rigid(2, kUpperArmMore + kRigidMeasures), rigid(2, kUpperArmMore) - rigid(1, kUpperArmMore), 1e-9)
      << "beyond the usual: the larger of two";
}

}  // namespace
}  // namespace etude
