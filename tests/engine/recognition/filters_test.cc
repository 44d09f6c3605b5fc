#include "engine/recognition/filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kExact = 1e-12;

SkeletonStream StreamOf(const std::vector<double>& heights) {
  SkeletonStream stream;
  for (double height : heights) {
    SensedFrame frame{.body_seen = true};
    for (SensedJoint& joint : frame.joints) joint = {{0, height, 0}, TrackingState::kTracked};
    stream.frames.push_back(frame);
  }
  return stream;
}

double HeightAt(const SkeletonStream& stream, std::size_t frame) {
  return stream.frames[frame][Role::kHead].position.y;
}

TEST(HoltFilter, FollowsTheSdksFormulasOnAVectorWorkedByHand) {
  // Defaults: smoothing, correction, prediction ½; radii 5 and 4 cm. Heights in metres.
  //   x0 = 0     s0 = 0,                          b0 = 0                       out = 0
  //   x1 = 0.2   s1 = (0.2 + 0)/2 = 0.1,          b1 = ½·0.1 = 0.05            predicted 0.125: 0.075 off, held at 0.16
  //   x2 = 0.12  |x2 − s1| = 0.02 ≤ 0.05: calmed = 0.4·0.12 + 0.6·0.1 = 0.108
  //              s2 = ½·0.108 + ½·(0.1 + 0.05) = 0.129,  b2 = ½·0.029 + ½·0.05 = 0.0395   out = 0.14875
  HoltFilter filter{HoltOptions{}};
  EXPECT_NEAR(filter.Update({0, 0, 0}).y, 0.0, kExact);
  EXPECT_NEAR(filter.Update({0, 0.2, 0}).y, 0.16, kExact);
  EXPECT_NEAR(filter.Update({0, 0.12, 0}).y, 0.14875, kExact);
}

TEST(HoltFilter, WidensBothRadiiForAnInferredJoint) {
  // As above, but inferred: predicted 0.125 lies within 8 cm of 0.2; then calmed = 0.2·0.12 + 0.8·0.1 = 0.104,
  // s2 = 0.127, b2 = 0.0385, out = 0.14625.
  HoltFilter filter{HoltOptions{}};
  filter.Update({0, 0, 0}, true);
  EXPECT_NEAR(filter.Update({0, 0.2, 0}, true).y, 0.125, kExact);
  EXPECT_NEAR(filter.Update({0, 0.12, 0}, true).y, 0.14625, kExact);
}

TEST(HoltFilter, IsPlainDoubleExponentialSmoothingWithoutItsRadii) {
  // On a ramp of 10 cm per frame, the textbook's recursion s = a·x + (1−a)(s + b), b = g·(s − s_previous) + (1−g)·b
  // settles without lag.
  HoltFilter filter{{.smoothing = 0.5,
                     .correction = 0.5,
                     .prediction_frames = 0,
                     .jitter_radius_m = 0,
                     .max_deviation_radius_m = 10}};
  double out = 0;
  for (int i = 0; i < 200; ++i) out = filter.Update({0, 0.1 * i, 0}).y;
  EXPECT_NEAR(out, 0.1 * 199, 1e-9);
}

TEST(HoltFilter, StaysWithinItsRadiusOfTheRawData) {
  HoltFilter filter{HoltOptions{}};
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 raw(std::sin(i * 0.9), std::cos(i * 1.7), i % 7);
    EXPECT_LE(glm::distance(filter.Update(raw), raw), HoltOptions{}.max_deviation_radius_m + kExact);
  }
}

TEST(OneEuroFilter, FollowsThePapersAlgorithmOnAVectorWorkedByHand) {
  // 30 Hz, minimum cut-off 1 Hz, beta 0: weight a = 1 / (1 + 30/2π); a step from 0 to 1 gives 1 − (1−a)^n.
  OneEuroFilter filter({.min_cutoff_hz = 1, .beta_per_m = 0, .derivative_cutoff_hz = 1}, 30);
  const double weight = 1.0 / (1.0 + 30.0 / (2 * kPi));
  filter.Update({0, 0, 0});
  for (int n = 1; n <= 10; ++n) {
    EXPECT_NEAR(filter.Update({1, 1, 1}).y, 1 - std::pow(1 - weight, n), kExact) << "step " << n;
  }
}

TEST(OneEuroFilter, RaisesItsCutOffWithTheSmoothedSpeed) {
  // A first step of height 1 with beta 1: slope 30 m/s, smoothed a·30, cut-off 1 + 30a.
  OneEuroFilter filter({.min_cutoff_hz = 1, .beta_per_m = 1, .derivative_cutoff_hz = 1}, 30);
  const double a = 1.0 / (1.0 + 30.0 / (2 * kPi));
  const double cutoff = 1 + 30 * a;
  filter.Update({0, 0, 0});
  EXPECT_NEAR(filter.Update({0, 1, 0}).y, 1.0 / (1.0 + 30.0 / (2 * kPi * cutoff)), kExact);
}

TEST(Smooth, LeavesAConstantAloneWhateverTheFilter) {
  for (const std::string& name : FilterNames()) {
    const SkeletonStream smoothed = Smooth(StreamOf(std::vector<double>(20, 1.3)), {.kind = FilterOf(name)});
    for (std::size_t t = 0; t < 20; ++t) EXPECT_NEAR(HeightAt(smoothed, t), 1.3, kExact) << name;
  }
}

TEST(Smooth, LooksAtThePastOnly) {
  std::vector<double> heights;
  for (int i = 0; i < 30; ++i) heights.push_back(std::sin(0.4 * i));
  for (const std::string& name : FilterNames()) {
    const FilterOptions options{.kind = FilterOf(name)};
    const SkeletonStream whole = Smooth(StreamOf(heights), options);
    const SkeletonStream part = Smooth(StreamOf({heights.begin(), heights.begin() + 12}), options);
    for (std::size_t t = 0; t < 12; ++t) EXPECT_EQ(HeightAt(whole, t), HeightAt(part, t)) << name << " frame " << t;
  }
}

TEST(Smooth, StartsAnewAfterAJointWasNotTracked) {
  for (const char* name : {"holt", "one-euro"}) {
    SkeletonStream stream = StreamOf({0, 0, 0, 0, 2, 2, 2});
    stream.frames[3][Role::kHead].state = TrackingState::kNotTracked;
    const SkeletonStream smoothed = Smooth(stream, {.kind = FilterOf(name)});
    EXPECT_EQ(HeightAt(smoothed, 3), 0.0) << name;                        // unfiltered
    EXPECT_NEAR(HeightAt(smoothed, 4), 2.0, kExact) << name;              // the filter starts anew at 2 m
    EXPECT_LT(smoothed.frames[4][Role::kSpine].position.y, 2.0) << name;  // the control: this joint was never lost
  }
}

}  // namespace
}  // namespace etude
