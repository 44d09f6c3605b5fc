#include "engine/fuzzy/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/random/stream.h"
#include "tests/engine/fuzzy/posed_body.h"
#include "tests/support/gaps.h"

namespace etude {
namespace {

Grades GradesOf(const PosedBody& body) { return Fuzzify(ComputeFeatures(body.Pose(), PosedBody::kStandingHipHeight)); }

double DistanceOf(const PosedBody& a, const PosedBody& b) {
  return ComputeDistance(GradesOf(a), GradesOf(b), PaperWeights()).value;
}

double WorstJointCm(const PosedBody& a, const PosedBody& b) { return 100 * WorstJointDistance(a.Pose(), b.Pose()); }

/// Returns a body with its right arm, or right leg, in these directions.
PosedBody WithArm(const glm::dvec3& upper, const glm::dvec3& lower) {
  PosedBody body{.right_arm = {upper, lower}};
  return body;
}
PosedBody WithLeg(const glm::dvec3& upper, const glm::dvec3& lower) {
  PosedBody body{.right_leg = {upper, lower}};
  return body;
}
PosedBody WithStraightLeg(double degrees, const glm::dvec3& towards) {
  return WithLeg(PosedBody::Raised(degrees, towards), PosedBody::Raised(degrees, towards));
}
PosedBody WithBothArms(const glm::dvec3& left, const glm::dvec3& right) {
  PosedBody body{.left_arm = {left, left}, .right_arm = {right, right}};
  return body;
}

struct BlindSpot {
  const char* name;
  PosedBody a, b;
  double stated_distance;
  double stated_gap_cm;
};

// Eight pairs of very different poses whose fuzzy distance d is nearly zero. The figures come from a body with other
// limb lengths, hence the tolerances (with its narrower shoulders, the twist by 60° moved joints by only 11 cm).
TEST(FuzzyDistance, IsBlindToTheEightMeasuredPairs) {
  PosedBody twisted{.twist = Radians(60)};
  const BlindSpot pairs[] = {
      {"arm forward, sideways", WithArm(kForward, kForward), WithArm(-kLeftwards, -kLeftwards), 0.02, 67},
      {"both arms forward, T", WithBothArms(kForward, kForward), WithBothArms(kLeftwards, -kLeftwards), 0.02, 69},
      {"elbow 90, hand up, down", WithArm(kForward, kUp), WithArm(kForward, kDown), 0.00, 46},
      {"leg 40, front, side", WithStraightLeg(40, kForward), WithStraightLeg(40, -kLeftwards), 0.03, 75},
      {"leg 40, 90", WithStraightLeg(40, kForward), WithStraightLeg(90, kForward), 0.03, 70},
      {"knee 90, 60", WithLeg(kDown, PosedBody::Raised(-90, kForward)),
       WithLeg(kDown, PosedBody::Raised(-120, kForward)), 0.00, 22},
      {"arm 0, 20", WithArm(kDown, kDown), WithArm(PosedBody::Raised(20, kForward), PosedBody::Raised(20, kForward)),
       0.02, 17},
      {"trunk twisted by 60", PosedBody(), twisted, 0.06, 18},
  };
  for (const BlindSpot& pair : pairs) {
    EXPECT_NEAR(DistanceOf(pair.a, pair.b), pair.stated_distance, 0.065) << pair.name;
    EXPECT_LT(DistanceOf(pair.a, pair.b), kPaperThreshold) << pair.name << " would be a transition point";
    EXPECT_NEAR(WorstJointCm(pair.a, pair.b), pair.stated_gap_cm, 3.5) << pair.name;
  }
}

TEST(FuzzyDistance, SeesAnArmRaisedFromHangingToSideways) {
  const double d = DistanceOf(WithArm(kDown, kDown), WithArm(-kLeftwards, -kLeftwards));
  EXPECT_NEAR(d, std::sqrt(2.0), 1e-9) << "down and mid both change by 1, S = 1";
}

TEST(FuzzyDistance, CountsAFootHalfAsMuchAsAHand) {
  const FuzzyDistance d =
      ComputeDistance(GradesOf(PosedBody()), GradesOf(WithStraightLeg(40, kForward)), PaperWeights());
  EXPECT_NEAR(d.value, 1.0, 1e-9) << "inward and outward both change by 1, S = 0.5";
  EXPECT_NEAR(d.partials[static_cast<std::size_t>(Feature::kRF)], 1.0, 1e-9);
}

TEST(FuzzyDistance, PartialsSumToItsSquare) {
  const Grades a = GradesOf(WithStraightLeg(33, kForward)), b = GradesOf(WithArm(kForward, kUp));
  const FuzzyDistance d = ComputeDistance(a, b, PaperWeights());
  EXPECT_GT(d.value, 0.5);
  EXPECT_NEAR(std::accumulate(d.partials.begin(), d.partials.end(), 0.0), d.value * d.value, 1e-12);
  EXPECT_EQ(d.value, ComputeDistance(b, a, PaperWeights()).value);
}

TEST(FuzzyDistance, EarlyAnswerAgreesWithTheFullDistance) {
  const Grades rest = GradesOf(PosedBody());
  int closer = 0;
  for (int degrees = 0; degrees <= 180; degrees += 3) {
    const Grades other = GradesOf(WithArm(PosedBody::Raised(degrees, kForward), PosedBody::Raised(degrees, kForward)));
    const bool expected = ComputeDistance(rest, other, PaperWeights()).value < kPaperThreshold;
    EXPECT_EQ(IsCloser(rest, other, PaperWeights(), kPaperThreshold), expected) << degrees;
    closer += expected;
  }
  EXPECT_GT(closer, 0);
  EXPECT_LT(closer, 60) << "both answers must occur";
}

TEST(FuzzyDistance, EarlyAnswerAgreesToTheLastBit) {
  RandomStream dice({.suite_seed = 6, .scenario = "distance", .trial = 0}, "grades");
  int squares_mislead = 0;
  for (int i = 0; i < 2000; ++i) {
    Grades a, b;
    for (std::size_t t = 0; t < kTermCount; ++t) a[t] = dice.Uniform(), b[t] = dice.Uniform();
    const double d = ComputeDistance(a, b, PaperWeights()).value;
    const double above = std::nextafter(d, 10);
    EXPECT_FALSE(IsCloser(a, b, PaperWeights(), d)) << "equal is not below";
    EXPECT_TRUE(IsCloser(a, b, PaperWeights(), above));
    EXPECT_FALSE(IsCloser(a, b, PaperWeights(), std::nextafter(d, 0)));
    const FuzzyDistance parts = ComputeDistance(a, b, PaperWeights());
    const double sum = std::accumulate(parts.partials.begin(), parts.partials.end(), 0.0);
    squares_mislead += (sum < d * d) || !(sum < above * above);
  }
  EXPECT_GT(squares_mislead, 0) << "squares alone would not do";
}

TEST(PaperWeights, SumToEight) {
  const FeatureWeights weights = PaperWeights();
  EXPECT_DOUBLE_EQ(std::accumulate(weights.begin(), weights.end(), 0.0), kWeightSum);
}

}  // namespace
}  // namespace etude
