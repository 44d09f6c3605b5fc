#include <gmock/gmock.h>

#include <cmath>

#include "bench/metrics/evaluation.h"
#include "bench/tasks/evaluation/match.h"
#include "bench/tasks/evaluation/run.h"
#include "tests/bench/tasks/evaluation/motions.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Adds white noise, 10 mm on each axis, from a generator of its own.
void AddNoise(RawMotion& motion) {
  unsigned state = 11;
  const auto uniform = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 16777216.0 - 0.5;
  };
  for (glm::dvec3& p : motion.positions) {
    for (int k = 0; k < 3; ++k) p[k] += 0.02 * (uniform() + uniform() + uniform());  // deviation 20 mm · √(3/12)
  }
}

/// Returns the mean distance of an answer from the truth at the answer's own times, millimetres.
double MeanDistance(const RawMotion& answer, const RawMotion& truth_at_its_times) {
  double sum = 0;
  for (std::size_t i = 0; i < answer.positions.size(); ++i) {
    sum += glm::distance(answer.positions[i], truth_at_its_times.positions[i]);
  }
  return 1000 * sum / static_cast<double>(answer.positions.size());
}

TEST(Match, AnAnswerBetweenTheTruthsFramesIsNotSmoothed) {
  const RawMotion truth = Swaying(60, 301, 0);
  // At another rate, at half a frame's offset, and at a rate that is higher or lower by half.
  for (const auto& [rate_hz, late_s] : {std::pair(60000.0 / 1001, 0.0), {60.0, 0.5 / 60}, {90.0, 0.0}, {40.0, 0.0}}) {
    const auto frames = static_cast<std::size_t>(5 * rate_hz);
    // A start at −late_s shows the truth late_s earlier.
    RawMotion exact = Swaying(rate_hz, frames, -late_s), answer = exact;
    RawMotion clocked = truth;
    clocked.start_s = 0;
    answer.start_s = late_s;
    AddNoise(answer);
    const auto matched = Match(clocked, answer, "roles", Lag::kNone);
    ASSERT_TRUE(matched) << ToString(matched.error());
    const CellResult result = JudgeMotion(*matched);
    const double expected = MeanDistance(answer, exact);
    EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), expected, 0.02 * expected) << rate_hz;
    EXPECT_NEAR(ValueIn(result, "jitter@wham"), *Jitter({answer.joints.size(), answer.positions}, rate_hz),
                0.02 * ValueIn(result, "jitter@wham"))
        << rate_hz;
    EXPECT_EQ(ValueIn(result, "accel_error_mps2"), -1) << rate_hz;
    EXPECT_THAT(result.reason, HasSubstr("for which the truth was interpolated"));
  }
}

TEST(Match, AnExactAnswerAtAMultipleOfTheRateHasNoError) {
  for (const auto& [true_hz, answer_hz] : {std::pair(60.0, 30.0), {30.0, 60.0}, {30.0, 120.0}, {100.0, 25.0}}) {
    const RawMotion answer = Swaying(answer_hz, static_cast<std::size_t>(5 * answer_hz), 0);
    const auto matched = Match(Swaying(true_hz, static_cast<std::size_t>(5 * true_hz), 0), answer, "roles", Lag::kNone);
    ASSERT_TRUE(matched);
    EXPECT_FALSE(matched->is_interpolated);
    EXPECT_EQ(matched->pair.rate_hz, std::min(true_hz, answer_hz));
    const CellResult result = JudgeMotion(*matched);
    EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 0, 1e-6) << answer_hz;
    EXPECT_NEAR(ValueIn(result, "accel_error_mps2"), 0, 1e-6) << answer_hz;
    EXPECT_NEAR(ValueIn(result, "jitter@wham"), *Jitter({answer.joints.size(), answer.positions}, answer_hz), 0.05)
        << "the answer's own rate";
    EXPECT_EQ(result.judged.rate_hz, answer_hz);
    EXPECT_EQ(result.judged.compared_hz, answer_hz > true_hz ? true_hz : 0) << "0: the answer's rate";
  }
}

TEST(Match, TheJudgedSharesAreThoseOfEachMetric) {
  const auto pelvis = static_cast<std::size_t>(Index(Role::kHipCentre));
  const RawMotion truth = Swaying(30, 100, 0);
  RawMotion answer = truth;
  for (std::size_t f = 0; f < 100; ++f) {
    if (f % 10 < 4) answer.positions[f * answer.joints.size() + pelvis] = NotSeen();
  }
  const CellResult result = JudgeMotion(*Match(truth, answer, "roles", Lag::kNone));
  EXPECT_NEAR(ValueIn(result, "seen_share"), 1 - 0.4 / 20, 1e-12);
  EXPECT_NEAR(result.judged.ShareOf("mpjpe_unaligned_mm"), 1 - 0.4 / 20, 1e-12);
  EXPECT_NEAR(result.judged.ShareOf("mpjpe_root_mm"), 0.6, 1e-12) << "frames without a root";
  EXPECT_NEAR(result.judged.ShareOf("rte@wham"), 0.6, 1e-12);
  EXPECT_NEAR(result.judged.ShareOf("l2p@lafan1"), 0.6, 1e-12) << "frames that do not show every joint";
  EXPECT_EQ(result.judged.ShareOf("skating_ratio@gmd"), 1);
  EXPECT_EQ(result.judged.parts.size(), 21u);
  EXPECT_EQ(result.judged.parts.back(), "root hip_centre");
  EXPECT_TRUE(JudgeMotion(*Match(truth, truth, "roles", Lag::kNone)).judged.shares.empty()) << "all is judged";
}

TEST(Match, ASlowerAnswerHasTheMeanOfTheSameSpan) {
  // Each answer drifts by 40 mm/s for 5 s, so its mean error is 100 mm at every rate.
  for (const double rate_hz : {60.0, 30.0, 20.0, 4.0}) {
    RawMotion answer = Swaying(rate_hz, static_cast<std::size_t>(5 * rate_hz) + 1, 0);
    for (std::size_t i = 0; i < answer.positions.size(); ++i) {
      answer.positions[i].y += 0.04 * static_cast<double>(i / answer.joints.size()) / rate_hz;
    }
    const CellResult result = JudgeMotion(*Match(Swaying(60, 301, 0), answer, "roles", Lag::kNone));
    EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 100, 1e-6) << rate_hz;
    EXPECT_NEAR(ValueIn(result, "seen_share"), 1, 1e-12);
    EXPECT_THAT(result.judged.shares, ::testing::IsEmpty()) << rate_hz;
  }
}

TEST(Match, ASegmentThatTheTruthDoesNotShowIsNobodysLoss) {
  // In the first two frames of its second segment, the truth shows one joint: no answer can be fitted there.
  RawMotion truth = Swaying(30, 250, 0);
  const std::size_t joints = truth.joints.size();
  for (std::size_t i = 100 * joints; i < 102 * joints; ++i) {
    if (i % joints > 0) truth.positions[i] = NotSeen();
  }
  EXPECT_TRUE(JudgeMotion(*Match(truth, Swaying(30, 250, 0), "roles", Lag::kNone)).judged.shares.empty());
  RawMotion answer = Swaying(30, 250, 0);
  answer.positions[5 * joints + 3] = NotSeen();
  const CellResult result = JudgeMotion(*Match(truth, answer, "roles", Lag::kNone));
  EXPECT_NEAR(result.judged.ShareOf("w_mpjpe_mm@wham"), 1 - 1.0 / (150 * 20), 1e-12) << "of the other two segments";
  EXPECT_NEAR(result.judged.ShareOf("wa_mpjpe_mm@wham"), 1 - 1.0 / (248 * 20 + 2), 1e-12);
  EXPECT_NEAR(result.judged.ShareOf("mpjpe_each_frame_mm"), 1 - 1.0 / (248 * 20), 1e-12);
  // The control: an answer that does not show the beginning of the first segment loses this segment.
  for (std::size_t i = 0; i < 2 * joints; ++i) answer.positions[i] = NotSeen();
  EXPECT_NEAR(JudgeMotion(*Match(truth, answer, "roles", Lag::kNone)).judged.ShareOf("w_mpjpe_mm@wham"), 50.0 / 150,
              1e-12);
}

TEST(Match, TheShareOfNpssIsThatOfItsWindows) {
  const RawMotion truth = Swaying(30, 100, 0);
  RawMotion answer = truth;
  answer.positions[45 * answer.joints.size()] = NotSeen();  // in the second of three windows of 30 frames
  const CellResult result = JudgeMotion(*Match(truth, answer, "roles", Lag::kNone));
  EXPECT_NEAR(result.judged.ShareOf("npss"), 2.0 / 3, 1e-12);
  EXPECT_NEAR(result.judged.ShareOf("npss@lafan1"), 2.0 / 3, 1e-12);
  answer = truth;
  answer.positions[95 * answer.joints.size()] = NotSeen();  // after the last window
  EXPECT_EQ(JudgeMotion(*Match(truth, answer, "roles", Lag::kNone)).judged.ShareOf("npss"), 1);
}

TEST(Match, InterpolationLowersTheAccelerationOfNoise) {
  // This is why accelerations have no value where the truth is interpolated. Midway between frames, the cubic's weights
  // are (-1, 9, 9, -1) / 16. Their second differences are (-1, 11, -10, -10, 11, -1) / 16, instead of (1, -2, 1).
  RawMotion noise = Gliding(30, 4000);
  AddNoise(noise);
  std::vector<double> midway;
  for (int f = 1; f < 3998; ++f) midway.push_back(f + 0.5);
  const RawMotion between = AtFrames(noise, midway, 30, Inbetween::kCubic);
  const auto rms = [](const RawMotion& motion) {
    double sum = 0, count = 0;
    for (std::size_t f = 2; f < motion.FrameCount(); ++f, ++count) {
      const glm::dvec3 second = motion.At(f, 0) - 2.0 * motion.At(f - 1, 0) + motion.At(f - 2, 0);
      sum += glm::dot(second, second);
    }
    return std::sqrt(sum / count);
  };
  EXPECT_NEAR(rms(between) / rms(noise), std::sqrt((2 * 1 + 2 * 121 + 2 * 100) / 256.0 / 6), 0.01);
}

}  // namespace
}  // namespace etude
