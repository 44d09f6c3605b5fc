#include "engine/fuzzy/membership.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

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

struct Sample {
  Feature feature;
  const char* term;
  double input;
  double grade;
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
  const Sample samples[] = {
      {kRH, "down", 0, 1},
      {kRH, "down", 20, 1},
      {kRH, "down", 55, 0.5},  // equation 2
      {kRH, "down", 90, 0},
      {kRH, "down", 180, 0},  //
      {kRH, "mid", 0, 0},
      {kRH, "mid", 20, 0},
      {kRH, "mid", 55, 0.5},  // equation 3
      {kRH, "mid", 90, 1},
      {kRH, "mid", 135, 0.5},
      {kRH, "mid", 180, 0},  //
      {kRH, "up", 45, 0},
      {kRH, "up", 90, 0},
      {kRH, "up", 135, 0.5},  // equation 4
      {kRH, "up", 180, 1},    //
      {kRHE, "false", 0, 1},
      {kRHE, "false", 45, 0.5},
      {kRHE, "false", 90, 0},   // equation 5
      {kRHE, "false", 150, 0},  //
      {kRHE, "true", 0, 0},
      {kRHE, "true", 20, 0},
      {kRHE, "true", 55, 0.5},  // equation 6
      {kRHE, "true", 90, 1},
      {kRHE, "true", 150, 1},  //
      {kPosture, "lie", -5, 1},
      {kPosture, "lie", 0, 1},
      {kPosture, "lie", 10, 0.75},  // equation 7
      {kPosture, "lie", 40, 0},     //
      {kPosture, "sit", 0, 0},
      {kPosture, "sit", 10, 0.25},
      {kPosture, "sit", 40, 1},  // equation 8
      {kPosture, "sit", 70, 0.25},
      {kPosture, "sit", 80, 0},  //
      {kPosture, "stand", 40, 0},
      {kPosture, "stand", 50, 0.25},
      {kPosture, "stand", 80, 1},  // equation 9
      {kPosture, "stand", 110, 0.25},
      {kPosture, "stand", 120, 0},  //
      {kPosture, "jump", 80, 0},
      {kPosture, "jump", 90, 0.25},
      {kPosture, "jump", 120, 1},  // equation 10
      {kPosture, "jump", 200, 1},  //
      {kTrunk, "true", 90, 1},
      {kTrunk, "true", 110, 1},
      {kTrunk, "true", 145, 0.5},  // equation 11
      {kTrunk, "true", 180, 0},    //
      {kTrunk, "false", 110, 0},
      {kTrunk, "false", 125, 0},
      {kTrunk, "false", 152.5, 0.5},  // equation 12
      {kTrunk, "false", 180, 1},      //
      {kRF, "inward", 0, 1},
      {kRF, "inward", 30, 0.25},
      {kRF, "inward", 40, 0},  // equation 13
      {kRF, "inward", 90, 0},  //
      {kRF, "outward", 0, 0},
      {kRF, "outward", 30, 0.75},
      {kRF, "outward", 40, 1},  // equation 14
      {kRF, "outward", 90, 1},  //
      {kRFK, "true", 60, 1},
      {kRFK, "true", 90, 1},
      {kRFK, "true", 135, 0.5},  // equation 15
      {kRFK, "true", 180, 0},    //
      {kRFK, "false", 90, 0},
      {kRFK, "false", 100, 0},
      {kRFK, "false", 140, 0.5},  // equation 16
      {kRFK, "false", 180, 1},
  };
  std::set<std::string> covered;
  for (const Sample& sample : samples) {
    EXPECT_NEAR(GradeOf(sample.feature, sample.term, sample.input), sample.grade, 1e-12)
        << FeatureName(sample.feature) << " " << sample.term << " at " << sample.input;
    covered.insert(std::string(FeatureName(sample.feature)) + sample.term);
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
