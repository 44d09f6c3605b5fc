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

}  // namespace
}  // namespace etude
