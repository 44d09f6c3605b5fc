#include "sim/annotator/annotator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

using enum Role;

WorldKey KeyOf(int trial) { return {.suite_seed = 5, .scenario = "annotator", .trial = trial}; }

const Shown& FrontView() {
  static const Shown kShown(LabelsOf(BodyCapsules(StandingBody()), FrontCamera()));
  return kShown;
}

Marks MarkOnce(const AnnotatedPicture& picture, double error_px, int trial, int annotator = 0) {
  Annotator person({.error_px = error_px}, {}, KeyOf(trial), annotator, 0);
  return person.Mark(0, picture);
}

TEST(Annotator, WithASteadyHandDrawsTheEvidenceAndNothingElse) {
  const PictureEvidence seen = SeePicture(FrontView().picture());
  for (int trial = 0; trial < 20; ++trial) {
    const Marks marks = MarkOnce(FrontView().picture(), 0, trial);
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      ASSERT_TRUE(marks.strokes[i] && seen.limbs[i]) << i;
      EXPECT_EQ(marks.strokes[i]->a, seen.limbs[i]->line.a);
      EXPECT_EQ(marks.strokes[i]->b, seen.limbs[i]->line.b);
    }
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      EXPECT_EQ(marks.effectors[i], seen.joints[Index(EffectorMarks()[i].role)]);
    }
  }
}

// The variances of the three parts of a mark's error add up to (error_px times the joint's relative deviation)².
TEST(Annotator, ErrsByItsDeviation) {
  constexpr int kTrials = 300;
  const PictureEvidence seen = SeePicture(FrontView().picture());
  std::array<double, kEffectorCount> squares{};
  std::array<int, kEffectorCount> count{};
  for (int trial = 0; trial < kTrials; ++trial) {
    const Marks marks = MarkOnce(FrontView().picture(), 1, trial);
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      if (!marks.effectors[i]) continue;
      const glm::dvec2 off = *marks.effectors[i] - *seen.joints[Index(EffectorMarks()[i].role)];
      if (glm::length(off) > 20) continue;  // left and right are exchanged here
      squares[i] += glm::dot(off, off) / 2;
      ++count[i];
    }
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const double deviation = RelativeDeviations()[Index(EffectorMarks()[i].role)];
    EXPECT_GT(count[i], kTrials - 20);
    EXPECT_NEAR(std::sqrt(squares[i] / count[i]), deviation, 0.09 * deviation) << i;
  }
}

TEST(Annotator, HasABiasThatStaysFromFrameToFrame) {
  constexpr int kTrials = 50, kFrames = 100, kApart = 25;  // kApart is 2.5 time constants
  double products = 0;
  int count = 0;
  const PictureEvidence seen = SeePicture(FrontView().picture());
  const glm::dvec2 hand = *seen.joints[Index(kLeftHand)];
  for (int trial = 0; trial < kTrials; ++trial) {
    Annotator person({.error_px = 1}, {}, KeyOf(trial), 0, 0);
    std::optional<glm::dvec2> last;
    for (int k = 0; k < kFrames; k += kApart) {
      const Marks marks = person.Mark(k, FrontView().picture());
      const auto& disc = marks.effectors[2];
      if (!disc || glm::distance(*disc, hand) > 20) continue;
      if (last) {
        products += glm::dot(*disc - hand, *last) / 2;
        ++count;
      }
      last = *disc - hand;
    }
  }
  const double deviation = RelativeDeviations()[Index(kLeftHand)];
  EXPECT_NEAR(products / count / (deviation * deviation), kBiasShare + kLastingShare * std::exp(-2.5), 0.13);
}

TEST(Annotator, ThrowsAJointOnce) {
  for (int trial = 0; trial < 30; ++trial) {
    Marks marks = MarkOnce(FrontView().picture(), 3, trial);
    for (std::size_t i = 0; i + 1 < kStrokeCount; ++i) {
      if (StrokeMarks()[i].to != StrokeMarks()[i + 1].from) continue;
      if (!marks.strokes[i] || !marks.strokes[i + 1]) continue;
      // Each stroke is shortened along its own line, so both lines still meet at the joint that was drawn.
      const PixelSegment &above = *marks.strokes[i], &below = *marks.strokes[i + 1];
      const glm::dvec2 u = above.b - above.a, v = below.b - below.a;
      const double cross = u.x * v.y - u.y * v.x;
      if (std::abs(cross) < 0.2 * glm::length(u) * glm::length(v)) continue;  // the limb is too straight
      const glm::dvec2 between = below.a - above.a;
      const glm::dvec2 meet = above.a + (between.x * v.y - between.y * v.x) / cross * u;
      EXPECT_LT(glm::distance(meet, above.b), 0.4 * glm::length(u));
      EXPECT_LT(glm::distance(meet, below.a), 0.4 * glm::length(v));
    }
  }
}

TEST(Annotator, ThrowsTheSameDiceHoweverStrongAndWhateverIsSeen) {
  const PictureEvidence seen = SeePicture(FrontView().picture());
  const glm::dvec2 hand = *seen.joints[Index(kLeftHand)];
  const Marks weak = MarkOnce(FrontView().picture(), 0.5, 3), strong = MarkOnce(FrontView().picture(), 2, 3);
  ASSERT_TRUE(weak.effectors[2] && strong.effectors[2]);
  const glm::dvec2 ratio = (*strong.effectors[2] - hand) / (*weak.effectors[2] - hand);
  EXPECT_NEAR(ratio.x, 4, 1e-9);
  EXPECT_NEAR(ratio.y, 4, 1e-9);
  // A mask that hides the right arm changes no other mark.
  Shown half = FrontView();
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 100; ++x) half.person.At(x, y) = 0;
  }
  const Marks some = MarkOnce(half.picture(), 2, 3);
  EXPECT_FALSE(some.effectors[3]);
  EXPECT_EQ(some.effectors[2], strong.effectors[2]);
}

TEST(Annotator, ErrsMoreWhereALimbFadesIntoWhatIsBehind) {
  Shown pale = FrontView();
  for (auto& pixel : pale.colours.pixels) pixel = {90, 90, 90};
  const PictureEvidence seen = SeePicture(FrontView().picture());
  const glm::dvec2 hand = *seen.joints[Index(kLeftHand)];
  double clear_squares = 0, pale_squares = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Marks a = MarkOnce(FrontView().picture(), 1, trial), b = MarkOnce(pale.picture(), 1, trial);
    if (!a.effectors[2] || !b.effectors[2] || glm::distance(*a.effectors[2], hand) > 20) continue;
    clear_squares += glm::dot(*a.effectors[2] - hand, *a.effectors[2] - hand);
    pale_squares += glm::dot(*b.effectors[2] - hand, *b.effectors[2] - hand);
  }
  // The error is twice as large, except for its bias.
  EXPECT_NEAR(pale_squares / clear_squares, kBiasShare + 4 * (1 - kBiasShare), 0.35);
}

TEST(Annotator, OverlooksLimbsAsOftenAsItIsSaid) {
  const PictureEvidence seen = SeePicture(FrontView().picture());
  double expected = 0;
  for (const auto& limb : seen.limbs) expected += 5 * MissProbability(*limb);
  int missed = 0;
  constexpr int kTrials = 600;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (const auto& stroke : MarkOnce(FrontView().picture(), 10, trial).strokes) missed += !stroke;
  }
  EXPECT_NEAR(missed, kTrials * expected, 5 * std::sqrt(kTrials * expected));
  EXPECT_GT(missed, 100);
}

TEST(Annotator, DrawsStrokesTooShortOnTheirLine) {
  const PictureEvidence seen = SeePicture(FrontView().picture());
  const std::size_t thigh = StrokeTo(kLeftKnee);
  double left_out = 0;
  int count = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Marks marks = MarkOnce(FrontView().picture(), 2, trial);
    const auto &stroke = marks.strokes[thigh], &next = marks.strokes[StrokeTo(kLeftAnkle)];
    if (!stroke || !next) continue;
    // Each end of a stroke leaves out the share kShortShare · |N| of the limb, with N standard normal; E|N| = √(2/π).
    left_out +=
        1 - glm::distance(stroke->a, stroke->b) / glm::distance(seen.limbs[thigh]->line.a, seen.limbs[thigh]->line.b);
    ++count;
  }
  EXPECT_NEAR(left_out / count, 2 * kShortShare * std::sqrt(2 / kPi), 0.008);
}

// From the person's left, the far limbs are behind the near ones. An exchange moves all marks of both arms or both
// legs, and no others; it lasts kSwapFrames frames on average.
TEST(Annotator, ExchangesLeftAndRightMoreOftenFromAsideAndForSomeFrames) {
  const Shown side(LabelsOf(BodyCapsules(StandingBody()), SideCamera()));
  const auto count_swaps = [](const Shown& shown) {
    const PictureEvidence seen = SeePicture(shown.picture());
    const glm::dvec2 foot = *seen.joints[Index(kLeftFoot)];
    std::pair<int, int> runs_and_frames{0, 0};
    for (int trial = 0; trial < 12; ++trial) {
      Annotator person({.error_px = 8}, {}, KeyOf(trial), 0, 0);
      bool was = false;
      for (int k = 0; k < 150; ++k) {
        const Marks marks = person.Mark(k, shown.picture());
        const auto &left = marks.effectors[0], &right = marks.effectors[1];
        bool is = was;
        if (left && seen.joints[Index(kRightFoot)]) {
          is = glm::distance(*left, *seen.joints[Index(kRightFoot)]) < glm::distance(*left, foot);
        } else if (left || right) {
          is = !left;  // only one foot is visible, and it was marked as the other
        }
        runs_and_frames.first += is && !was;
        runs_and_frames.second += is;
        was = is;
      }
    }
    return runs_and_frames;
  };
  const auto [front_runs, front_frames] = count_swaps(FrontView());
  const auto [side_runs, side_frames] = count_swaps(side);
  EXPECT_GT(side_runs, front_runs);
  EXPECT_GT(side_runs, 3);
  EXPECT_GT(side_frames, 2 * side_runs) << "they last";
}

TEST(Annotator, MarksNothingThatIsNotThere) {
  const Shown nothing(LabelImage(1, 1));
  for (const auto& stroke : MarkOnce(nothing.picture(), 4, 0).strokes) EXPECT_FALSE(stroke);
  for (const auto& disc : MarkOnce(nothing.picture(), 4, 0).effectors) EXPECT_FALSE(disc);
}

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

// The slow part is an autoregressive process: correlation exp(−k / kLastingFrames) after k frames, unit variance.
TEST(AnnotatorDice, HaveUnitVarianceAndTheCorrelationOfAnOrnsteinUhlenbeckProcess) {
  constexpr int kTrials = 60, kFrames = 120;
  for (const int step : {1, 7}) {
    double squares = 0, products = 0, fresh_squares = 0, fresh_products = 0;
    int count = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      AnnotatorDice dice(DiceKey(trial), 0, 0);
      PictureDice last = dice.DrawNumbers(0);
      for (int frame = step; frame < kFrames; frame += step) {
        const PictureDice now = dice.DrawNumbers(frame);
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
  const PictureDice dice = first.DrawNumbers(0);
  EXPECT_EQ(dice.lasting, again.DrawNumbers(0).lasting);
  EXPECT_NE(dice.lasting, elsewhere.DrawNumbers(0).lasting);
  EXPECT_NE(dice.lasting, other.DrawNumbers(0).lasting);
}

}  // namespace

}  // namespace etude
