#include "engine/kinematics/solvers/hinge_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

struct Pair {
  double weight;
  glm::dvec3 current, desired;
};

// g from its meaning: what the weighted dot products are after really turning.
double GainAfter(const std::vector<Pair>& pairs, const glm::dvec3& axis, double phi) {
  double gain = 0;
  for (const Pair& p : pairs) gain += p.weight * glm::dot(p.desired, AxisRotation(axis, phi) * p.current);
  return gain;
}

struct Hinge {
  glm::dvec3 axis;
  std::vector<Pair> pairs;
  HingeGain gain;
};

Hinge RandomHinge(int trial) {
  RandomStream random({.suite_seed = 3, .scenario = "hinge-test", .trial = trial}, "pairs");
  Hinge hinge{glm::normalize(random.Normal3()), {}, {}};
  for (int i = 0; i < 5; ++i) hinge.pairs.push_back({random.Uniform(0.1, 2), random.Normal3(), random.Normal3()});
  for (const Pair& p : hinge.pairs) hinge.gain.Add(p.weight, p.current, p.desired, hinge.axis);
  return hinge;
}

constexpr int kScan = 2000;

TEST(HingeGain, IsWhatTurningReallyGives) {
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    for (double phi : {-3.0, -1.0, 0.0, 0.4, 2.2}) {
      EXPECT_NEAR(hinge.gain.At(phi), GainAfter(hinge.pairs, hinge.axis, phi), 1e-12);
    }
  }
}

TEST(HingeGain, OptimumBeatsEveryAngleOfAScan) {
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    const double best = GainAfter(hinge.pairs, hinge.axis, hinge.gain.Optimum());
    double scanned = -1e300;
    for (int i = 0; i <= kScan; ++i) {
      scanned = std::max(scanned, GainAfter(hinge.pairs, hinge.axis, -kPi + 2 * kPi * i / kScan));
    }
    EXPECT_GE(best, scanned - 1e-12);
    EXPECT_LT(best - scanned, 1e-4 * (1 + std::abs(best))) << "the scan must come near, or it checks nothing";
  }
}

TEST(HingeGain, OptimumWithinARangeBeatsEveryAngleOfIt) {
  const AngleRange ranges[] = {{-0.1, 0.3}, {-2, 0}, {0, 0}, {-0.5, 6.0}, {-7, 7}};
  for (int trial = 0; trial < 40; ++trial) {
    const Hinge hinge = RandomHinge(trial);
    for (const AngleRange& range : ranges) {
      const double phi = hinge.gain.OptimumWithin(range);
      EXPECT_GE(phi, range.lower);
      EXPECT_LE(phi, range.upper);
      for (int i = 0; i <= 200; ++i) {
        const double other = range.lower + (range.upper - range.lower) * i / 200;
        EXPECT_GE(hinge.gain.At(phi), hinge.gain.At(other) - 1e-12) << "trial " << trial;
      }
    }
  }
}

TEST(HingeGain, TheOptimumCountsModuloAFullTurn) {
  HingeGain gain;
  gain.Add(1, {1, 0, 0}, {0, -1, 0}, {0, 0, 1});  // a quarter turn back, or three quarters on
  EXPECT_NEAR(gain.Optimum(), -kPi / 2, 1e-15);
  EXPECT_NEAR(gain.OptimumWithin({0, 5}), 1.5 * kPi, 1e-15);
}

TEST(HingeGain, ATieBetweenBothEndsGoesToTheLowerOne) {
  HingeGain gain;
  gain.Add(1, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1});  // half a turn away: both ways are as good
  EXPECT_EQ(gain.OptimumWithin({-0.5, 0.5}), -0.5);
}

TEST(HingeGain, AFlatGainTurnsNothing) {
  HingeGain gain;
  gain.Add(1, {0, 0, 2}, {1, 1, 1}, {0, 0, 1});  // the effector lies on the axis
  EXPECT_EQ(gain.OptimumWithin({-1, 1}), 0);
}

}  // namespace
}  // namespace etude
