#include "sim/annotator/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace etude {
namespace {

WorldKey DiceKey(int trial) { return {.suite_seed = 5, .scenario = "annotator", .trial = trial}; }

TEST(RelativeDeviations, AreOneInTheMeanAndInTheRatiosThatCocoPublishes) {
  const auto& relative = RelativeDeviations();
  double sum = 0;
  int marked = 0;
  for (Role role : AllRoles()) {
    sum += relative[Index(role)];
    marked += relative[Index(role)] > 0;
    EXPECT_EQ(relative[Index(role)], relative[Index(Mirrored(role))]) << RoleName(role);
  }
  EXPECT_EQ(marked, 18);
  EXPECT_NEAR(sum / marked, 1, 1e-12);
  EXPECT_NEAR(relative[Index(Role::kLeftHip)] / relative[Index(Role::kLeftWrist)], 0.107 / 0.062, 1e-12);
  EXPECT_NEAR(relative[Index(Role::kLeftKnee)] / relative[Index(Role::kLeftFoot)], 0.087 / 0.068, 1e-12);
}

TEST(PersonErrors, SharesOfVarianceAreWhole) { EXPECT_DOUBLE_EQ(kBiasShare + kLastingShare + kIndependentShare, 1); }

TEST(Unclearness, IsOneWithoutContrastAndHalfAtTwentyCounts) {
  EXPECT_EQ(Unclearness(0), 1);
  EXPECT_EQ(Unclearness(20), 0.5);
  EXPECT_LT(Unclearness(200), 0.01);
}

TEST(MissProbability, GrowsAsALimbIsHiddenAndAsItFadesIntoWhatIsBehind) {
  const LimbEvidence clear{.line = {}, .seen_share = 1, .contrast = 200};
  LimbEvidence hidden = clear, pale = clear;
  hidden.seen_share = 0.3;
  pale.contrast = 5;
  EXPECT_LT(MissProbability(clear), 0.003);
  EXPECT_NEAR(MissProbability(hidden) - MissProbability(clear), 0.1 * 0.49, 1e-12);
  EXPECT_GT(MissProbability(pale), 0.02);
}

// The lasting part is an autoregressive process: correlation exp(−k / kLastingFrames) after k frames, unit variance.
TEST(AnnotatorDice, HaveUnitVarianceAndTheCorrelationOfAnOrnsteinUhlenbeckProcess) {
  constexpr int kTrials = 60, kFrames = 120;
  for (const int step : {1, 7}) {
    double squares = 0, products = 0, fresh_squares = 0, fresh_products = 0;
    int count = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      AnnotatorDice dice(DiceKey(trial), 0, 0);
      PictureDice last = dice.Throw(0);
      for (int frame = step; frame < kFrames; frame += step) {
        const PictureDice now = dice.Throw(frame);
        for (std::size_t i = 0; i < kRoleCount; ++i) {
          squares += glm::dot(now.lasting[i], now.lasting[i]) / 2;
          products += glm::dot(now.lasting[i], last.lasting[i]) / 2;
          fresh_squares += glm::dot(now.independent[i], now.independent[i]) / 2;
          fresh_products += glm::dot(now.independent[i], last.independent[i]) / 2;
          ++count;
        }
        last = now;
      }
    }
    EXPECT_NEAR(squares / count, 1, 0.05) << step;
    EXPECT_NEAR(products / count, std::exp(-step / kLastingFrames), 0.05) << step;
    EXPECT_NEAR(fresh_squares / count, 1, 0.03) << step;
    EXPECT_NEAR(fresh_products / count, 0, 0.03) << step;
  }
}

TEST(AnnotatorDice, BiasIsOfUnitVarianceThePersonsOwnAndTheSameForAllCameras) {
  double squares = 0;
  int count = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const AnnotatorDice first(DiceKey(trial), 0, 0), elsewhere(DiceKey(trial), 0, 1), other(DiceKey(trial), 1, 0);
    EXPECT_EQ(first.bias(), elsewhere.bias());
    EXPECT_NE(first.bias(), other.bias());
    for (const glm::dvec2& joint : first.bias()) {
      squares += glm::dot(joint, joint) / 2;
      ++count;
    }
  }
  EXPECT_NEAR(squares / count, 1, 0.06);
}

TEST(AnnotatorDice, DifferBetweenCamerasAndBetweenPeople) {
  AnnotatorDice first(DiceKey(0), 0, 0), elsewhere(DiceKey(0), 0, 1), other(DiceKey(0), 1, 0), again(DiceKey(0), 0, 0);
  const PictureDice dice = first.Throw(0);
  EXPECT_EQ(dice.lasting, again.Throw(0).lasting);
  EXPECT_NE(dice.lasting, elsewhere.Throw(0).lasting);
  EXPECT_NE(dice.lasting, other.Throw(0).lasting);
}

}  // namespace
}  // namespace etude
