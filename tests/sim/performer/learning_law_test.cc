#include "sim/performer/learning_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

constexpr int kTrials = 40;

TEST(LearningLaw, ExponentialFallsByTheSameShareEveryTrial) {
  Skill skill(LearningLaw::kExponential, 0.6, 0.1, {.rate = 0.2});
  for (int n = 0; n < kTrials; ++n) {
    EXPECT_NEAR(skill.Error(), 0.1 + 0.5 * std::exp(-0.2 * n), 1e-12);
    n % 2 ? skill.Practise(1) : skill.Learn(1);
  }
}

TEST(LearningLaw, PowerIsALineInLogarithmsOfExperience) {
  const LearningRates rates{.rate = 0.15, .exponent = 0.5};
  Skill skill(LearningLaw::kPower, 0.8, 0.05, rates);
  const double experience = rates.exponent / rates.rate;  // earlier practice, in trials
  for (int n = 0; n < kTrials; ++n) {
    EXPECT_NEAR(skill.Error(), 0.05 + 0.75 * std::pow((n + experience) / experience, -0.5), 1e-12);
    skill.Practise(1);
  }
}

TEST(LearningLaw, ThePowerLawBeginsAsSteeplyAsTheExponentialOneAndEndsSlower) {
  const auto after = [](LearningLaw law, double units) {
    Skill skill(law, 1);
    skill.Learn(units);
    return skill.Error();
  };
  EXPECT_NEAR(after(LearningLaw::kPower, 0.01), after(LearningLaw::kExponential, 0.01), 1e-5);
  EXPECT_GT(after(LearningLaw::kPower, 30), after(LearningLaw::kExponential, 30) + 0.1);
}

/// Smith et al.'s model in closed form: with e = 1 − x, the two states follow a linear recurrence; the result is its
/// fixed point plus the decay along the matrix's eigenvectors.
double TwoRateError(int n, const LearningRates& r) {
  const double a = r.fast_kept - r.fast_learnt, b = -r.fast_learnt, c = -r.slow_learnt, d = r.slow_kept - r.slow_learnt;
  // (I − M) x* = (fast_learnt, slow_learnt)
  const double det = (1 - a) * (1 - d) - b * c;
  const double fast = ((1 - d) * r.fast_learnt + b * r.slow_learnt) / det;
  const double slow = (c * r.fast_learnt + (1 - a) * r.slow_learnt) / det;
  const double mean = 0.5 * (a + d), root = std::sqrt(0.25 * (a - d) * (a - d) + b * c);
  const double first = mean + root, second = mean - root;
  // M^n = first^n P + second^n (I − P), P = (M − second I) / (first − second)
  const double p = std::pow(first, n), q = std::pow(second, n), gap = first - second;
  const auto power = [&](double m, double identity) {
    return (p * (m - second * identity) - q * (m - first * identity)) / gap;
  };
  const double f = fast - (power(a, 1) * fast + power(b, 0) * slow),
               s = slow - (power(c, 0) * fast + power(d, 1) * slow);
  return 1 - f - s;
}

TEST(LearningLaw, TwoRatesFollowTheirClosedForm) {
  const LearningRates rates;
  Skill skill(LearningLaw::kTwoRate, 1);
  for (int n = 0; n < kTrials; ++n) {
    EXPECT_NEAR(skill.Error(), TwoRateError(n, rates), 1e-12) << n;
    skill.Practise(1);
  }
  EXPECT_NEAR(TwoRateError(1, rates), 1 - 0.23, 1e-12) << "the first trial, by hand";
}

TEST(LearningLaw, WhatIsLearntFastIsForgottenFast) {
  Skill skill(LearningLaw::kTwoRate, 1);
  for (int n = 0; n < 5; ++n) skill.Practise(1);
  const double learnt = 1 - skill.Error();
  Skill rested = skill;
  rested.Rest(20);
  const double kept = 1 - rested.Error();
  EXPECT_GT(learnt, 0.35);
  EXPECT_LT(kept, 0.25 * learnt);
  EXPECT_GT(kept, 0.05);
  for (LearningLaw law : {LearningLaw::kExponential, LearningLaw::kPower}) {
    Skill other(law, 1);
    other.Learn(5);
    const double before = other.Error();
    other.Rest(20);
    EXPECT_EQ(other.Error(), before) << "laws of practice know no forgetting";
  }
}

TEST(LearningLaw, MoreTeachingIsNeverWorseAndErrorsStayWithinTheirRange) {
  for (const std::string& name : LearningLawNames()) {
    const LearningLaw law = FindLearningLaw(name);
    double before = 1;
    for (double units = 0; units <= 50; units += 0.5) {
      Skill skill(law, 0.7, 0.02);
      skill.Learn(units);
      EXPECT_LE(skill.Error(), before) << name << " " << units;
      EXPECT_GE(skill.Error(), 0.02) << name;
      EXPECT_LE(skill.Error(), 0.7) << name;
      before = skill.Error();
    }
  }
}

TEST(LearningLaw, UnlearningNeverGoesBehindTheBeginning) {
  for (const std::string& name : LearningLawNames()) {
    Skill skill(FindLearningLaw(name), 0.7, 0.02);
    skill.Learn(3);
    const double learnt = skill.Error();
    skill.Unlearn(1);
    EXPECT_GT(skill.Error(), learnt) << name;
    skill.Unlearn(100);
    EXPECT_LE(skill.Error(), 0.7 + 1e-12) << name;
    EXPECT_NEAR(skill.Error(), 0.7, 1e-3) << name;
  }
}

TEST(LearningLaw, WhoErrsNeverDoesNot) {
  for (const std::string& name : LearningLawNames()) {
    Skill skill(FindLearningLaw(name), 0);
    skill.Practise(1);
    skill.Unlearn(2);
    EXPECT_EQ(skill.Error(), 0) << name;
  }
}

}  // namespace
}  // namespace etude
