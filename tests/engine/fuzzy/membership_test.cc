#include "engine/fuzzy/membership.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace etude {
namespace {

TEST(Shape, TakesTheTextbookGradesOfEachKind) {
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 5), 0.5);
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 10), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 25), 0.25);
  EXPECT_DOUBLE_EQ(GradeOf(Trapezoidal{0, 10, 20, 40}, 15), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Trapezoidal{0, 10, 20, 40}, 35), 0.25);
  EXPECT_DOUBLE_EQ(GradeOf(Gaussian{90, 25}, 90), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Gaussian{90, 25}, 115), std::exp(-0.5));
  EXPECT_EQ(GradeOf(Singleton{90}, 90), 1);
  EXPECT_EQ(GradeOf(Singleton{90}, std::nextafter(90, 91)), 0);
}

TEST(Shape, HasUprightSidesWhereTwoBreakpointsAreEqual) {
  EXPECT_EQ(GradeOf(Triangular{0, 0, 10}, 0), 1);
  EXPECT_EQ(GradeOf(Triangular{0, 10, 10}, 10), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 5), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 10), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 10.001), 0);
}

TEST(Shape, HasTheGradeOfACutAtBothItsEnds) {
  const Shape shapes[] = {Triangular{0, 10, 30}, Trapezoidal{-5, 10, 20, 40}, Gaussian{90, 25}};
  for (const Shape& shape : shapes) {
    for (double grade : {0.1, 0.5, 0.9, 1.0}) {
      const Cut cut = CutOf(shape, grade);
      EXPECT_NEAR(GradeOf(shape, cut.low), grade, 1e-12) << shape.index();
      EXPECT_NEAR(GradeOf(shape, cut.high), grade, 1e-12) << shape.index();
      EXPECT_LE(cut.low, cut.high);
    }
  }
}

/// A term's membership function, by its grades at some inputs.
struct Equation {
  Feature feature;
  const char* term;
  std::vector<std::pair<double, double>> grades;
};

double GradeOf(Feature feature, std::string_view term, double input) {
  PoseFeatures pose;
  pose[feature] = input;
  const Grades grades = Fuzzify(pose);
  for (std::size_t t = 0; t < TermsOf(feature).size(); ++t) {
    if (TermsOf(feature)[t].name == term) return grades[FirstTermOf(feature) + t];
  }
  ADD_FAILURE() << "no term " << term << " of " << FeatureName(feature);
  return -1;
}

// The paper's equations by hand: both ends of every range, a point inside each branch, and a point beyond each end.
TEST(Membership, FollowsEquations2To16AtBreakpointsAndBetweenThem) {
  using enum Feature;
  const Equation equations[] = {
      {kRH, "down", {{0, 1}, {20, 1}, {55, 0.5}, {90, 0}, {180, 0}}},              // equation 2
      {kRH, "mid", {{0, 0}, {20, 0}, {55, 0.5}, {90, 1}, {135, 0.5}, {180, 0}}},   // equation 3
      {kRH, "up", {{45, 0}, {90, 0}, {135, 0.5}, {180, 1}}},                       // equation 4
      {kRHE, "false", {{0, 1}, {45, 0.5}, {90, 0}, {150, 0}}},                     // equation 5
      {kRHE, "true", {{0, 0}, {20, 0}, {55, 0.5}, {90, 1}, {150, 1}}},             // equation 6
      {kPosture, "lie", {{-5, 1}, {0, 1}, {10, 0.75}, {40, 0}}},                   // equation 7
      {kPosture, "sit", {{0, 0}, {10, 0.25}, {40, 1}, {70, 0.25}, {80, 0}}},       // equation 8
      {kPosture, "stand", {{40, 0}, {50, 0.25}, {80, 1}, {110, 0.25}, {120, 0}}},  // equation 9
      {kPosture, "jump", {{80, 0}, {90, 0.25}, {120, 1}, {200, 1}}},               // equation 10
      {kTrunk, "true", {{90, 1}, {110, 1}, {145, 0.5}, {180, 0}}},                 // equation 11
      {kTrunk, "false", {{110, 0}, {125, 0}, {152.5, 0.5}, {180, 1}}},             // equation 12
      {kRF, "inward", {{0, 1}, {30, 0.25}, {40, 0}, {90, 0}}},                     // equation 13
      {kRF, "outward", {{0, 0}, {30, 0.75}, {40, 1}, {90, 1}}},                    // equation 14
      {kRFK, "true", {{60, 1}, {90, 1}, {135, 0.5}, {180, 0}}},                    // equation 15
      {kRFK, "false", {{90, 0}, {100, 0}, {140, 0.5}, {180, 1}}},                  // equation 16
  };
  std::set<std::string> covered;
  for (const auto& [feature, term, grades] : equations) {
    for (const auto& [input, grade] : grades) {
      EXPECT_NEAR(GradeOf(feature, term, input), grade, 1e-12)
          << FeatureName(feature) << " " << term << " at " << input;
    }
    covered.insert(std::string(FeatureName(feature)) + term);
  }
  EXPECT_EQ(covered.size(), 15u) << "one function per equation";
}

TEST(Membership, TreatsLeftLimbsLikeRightOnes) {
  using enum Feature;
  const std::pair<Feature, Feature> sides[] = {{kRH, kLH}, {kRHE, kLHE}, {kRF, kLF}, {kRFK, kLFK}};
  for (const auto& [right, left] : sides) {
    ASSERT_EQ(TermsOf(right).size(), TermsOf(left).size());
    for (std::size_t t = 0; t < TermsOf(right).size(); ++t) {
      EXPECT_EQ(TermsOf(right)[t].name, TermsOf(left)[t].name);
      for (double input = -10; input <= 200; input += 7) {
        const auto& shapes = PaperMemberships().shapes;
        EXPECT_EQ(GradeOf(shapes[FirstTermOf(right) + t], input), GradeOf(shapes[FirstTermOf(left) + t], input));
      }
    }
  }
}

TEST(Membership, GroupsTheTermsByFeature) {
  std::size_t next = 0;
  for (Feature feature : AllFeatures()) {
    EXPECT_EQ(FirstTermOf(feature), next);
    for (const Term& term : TermsOf(feature)) EXPECT_EQ(term.feature, feature);
    next += TermsOf(feature).size();
  }
  EXPECT_EQ(next, kTermCount);
}

TEST(Tags, NameTheTermOfMaximumMembership) {
  using enum Feature;
  PoseFeatures pose;
  pose[kRH] = 100;
  pose[kLH] = 10;
  pose[kRHE] = 80;
  pose[kLHE] = 5;
  pose[kPosture] = 79;
  pose[kTrunk] = 178;
  pose[kRF] = 30;
  pose[kLF] = 3;
  pose[kRFK] = 110;
  pose[kLFK] = 175;
  const Tags tags = ChooseTags(Fuzzify(pose));
  const char* expected[] = {"mid", "down", "true", "false", "stand", "false", "outward", "inward", "true", "false"};
  for (std::size_t k = 0; k < kFeatureCount; ++k) EXPECT_EQ(TagName(tags, AllFeatures()[k]), expected[k]) << k;
}

TEST(Tags, PreferTheEarlierTermOnATie) {
  PoseFeatures pose;
  pose[Feature::kRH] = 55;  // down = mid = 0.5
  EXPECT_EQ(TagName(ChooseTags(Fuzzify(pose)), Feature::kRH), "down");
}

}  // namespace

}  // namespace etude
