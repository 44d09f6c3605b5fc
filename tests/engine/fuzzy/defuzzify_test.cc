#include "engine/fuzzy/defuzzify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace etude {
namespace {

using enum Defuzzification;
constexpr Universe kDegrees = {0, 180};

double Value(const std::vector<ActivatedTerm>& terms, Defuzzification method, const Universe& universe = kDegrees) {
  const auto value = Defuzzify(terms, universe, method);
  EXPECT_TRUE(value) << DefuzzificationName(method);
  return value.value_or(NAN);
}

TEST(Defuzzify, GivesThePeakOfASymmetricTriangleByEveryMethod) {
  for (Defuzzification method : AllDefuzzifications()) {
    for (double grade : {0.2, 1.0}) {
      EXPECT_NEAR(Value({{Triangular{40, 90, 140}, grade}}, method), 90, 1e-6) << DefuzzificationName(method);
      EXPECT_NEAR(Value({{Gaussian{90, 10}, grade}}, method), 90, 1e-6) << DefuzzificationName(method);
    }
  }
}

// The triangle (0, 0, 90) has its centre of gravity at 30. Clipped at ½, it is a rectangle 0…45 of height ½ (area 22.5,
// centre 22.5) and a triangle 45…90 (area 11.25, centre 60): (506.25 + 675) / 33.75 = 35.
TEST(Defuzzify, FindsTheCentreOfGravityOfOneClippedTriangle) {
  for (Defuzzification method : {kCentroid, kArea}) {
    EXPECT_NEAR(Value({{Triangular{0, 0, 90}, 1}}, method), 30, 1e-6);
    EXPECT_NEAR(Value({{Triangular{0, 0, 90}, 0.5}}, method), 35, 1e-6);
  }
  EXPECT_NEAR(Value({{Triangular{0, 0, 90}, 0.5}}, kMaximum), 22.5, 1e-9) << "the middle of 0…45";
  EXPECT_NEAR(Value({{Triangular{0, 0, 90}, 0.5}}, kHeight), 0, 1e-9) << "the peak";
}

// A = (0, 2, 4) to 0.5 and B = (2, 4, 6) to 1. A clipped has area 1.5, centre 2; B has area 2, centre 4. On 2…4, min(A,
// B) is min(½, (x − 2)/2, (4 − x)/2), a triangle of height ½ at x = 3 with area ½, centre 3. Hence area = (1.5·2 + 2·4)
// / 3.5 = 22/7; centroid = (1.5·2 + 2·4 − ½·3) / (3.5 − ½) = 19/6; height = (½·2 + 4) / 1.5 = 10/3.
TEST(Defuzzify, TellsTheFourMethodsApartOnTwoTriangles) {
  const std::vector<ActivatedTerm> terms = {{Triangular{0, 2, 4}, 0.5}, {Triangular{2, 4, 6}, 1}};
  EXPECT_NEAR(Value(terms, kMaximum, {0, 6}), 4, 1e-9);
  EXPECT_NEAR(Value(terms, kCentroid, {0, 6}), 19.0 / 6, 1e-6);
  EXPECT_NEAR(Value(terms, kHeight, {0, 6}), 10.0 / 3, 1e-9);
  EXPECT_NEAR(Value(terms, kArea, {0, 6}), 22.0 / 7, 1e-6);
}

TEST(Defuzzify, MeansSeveralMaximaByTheirLength) {
  // The maxima are 0…10 and 30…50: (10·5 + 20·40) / 30.
  const std::vector<ActivatedTerm> apart = {{Trapezoidal{0, 0, 10, 12}, 1}, {Trapezoidal{29, 30, 50, 51}, 1}};
  EXPECT_NEAR(Value(apart, kMaximum), 850.0 / 30, 1e-9);
  const std::vector<ActivatedTerm> points = {{Triangular{0, 10, 20}, 1}, {Triangular{20, 50, 80}, 1}};
  EXPECT_NEAR(Value(points, kMaximum), 30, 1e-9);
  const std::vector<ActivatedTerm> overlapping = {{Trapezoidal{0, 0, 10, 12}, 1}, {Trapezoidal{4, 5, 15, 16}, 1}};
  EXPECT_NEAR(Value(overlapping, kMaximum), 7.5, 1e-9) << "what both cover counts once";
}

// Half a Gaussian from its mean on: its centre of gravity is at sigma · sqrt(2/π).
TEST(Defuzzify, SumsUnderAGaussianFinelyEnough) {
  EXPECT_NEAR(Value({{Gaussian{0, 20}, 1}}, kCentroid), 20 * std::sqrt(2 / 3.14159265358979), 180 * 1e-4);
}

TEST(Defuzzify, CountsSingletonsByTheirGrades) {
  const std::vector<ActivatedTerm> terms = {{Singleton{30}, 0.25}, {Singleton{90}, 0.75}};
  for (Defuzzification method : {kCentroid, kHeight, kArea}) EXPECT_NEAR(Value(terms, method), 75, 1e-12);
  EXPECT_NEAR(Value(terms, kMaximum), 90, 1e-12);
}

TEST(Defuzzify, HasNoValueWhereNothingIsActivated) {
  for (Defuzzification method : AllDefuzzifications()) {
    EXPECT_FALSE(Defuzzify({}, kDegrees, method));
    EXPECT_FALSE(Defuzzify(std::vector<ActivatedTerm>{{Triangular{0, 20, 40}, 0}}, kDegrees, method));
    EXPECT_FALSE(Defuzzify(std::vector<ActivatedTerm>{{Triangular{200, 220, 240}, 1}}, kDegrees, method));
  }
}

TEST(Defuzzify, StaysInTheUniverseForEveryInputOfPaperA) {
  int checked = 0;
  for (Feature feature : AllFeatures()) {
    const Universe& universe = PaperMemberships().universes[static_cast<std::size_t>(feature)];
    for (double input = universe.low; input <= universe.high; input += 7) {
      PoseFeatures pose;
      pose[feature] = input;
      for (Defuzzification method : AllDefuzzifications()) {
        const auto back = DefuzzifyFeature(Fuzzify(pose), feature, PaperMemberships(), method);
        if (!back) continue;  // no grade, so no value
        EXPECT_GE(*back, universe.low);
        EXPECT_LE(*back, universe.high);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 900);
}

// Posture's triangles are adjacent and sum to 1, so the height method returns the input.
TEST(Defuzzify, GivesTheHeightBackExactlyWhereGradesSumToOne) {
  for (double input : {0.0, 10.0, 40.0, 79.0, 103.5}) {
    PoseFeatures pose;
    pose[Feature::kPosture] = input;
    EXPECT_NEAR(*DefuzzifyFeature(Fuzzify(pose), Feature::kPosture, PaperMemberships(), kHeight), input, 1e-9);
  }
}

}  // namespace
}  // namespace etude
