#include "engine/recognition/key_pose.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

/// "Right arm up, then down", each within 20°.
TaughtMove UpAndDown(int span_frames = 1000) {
  return {
      .name = "up-down", .poses = {{{{Feature::kRH, 180, 20}}}, {{{Feature::kRH, 0, 20}}}}, .span_frames = span_frames};
}

FeatureFrame ArmAt(double degrees, TrackingState state = TrackingState::kTracked) {
  FeatureFrame frame;
  frame.body_seen = true;
  frame.features[Feature::kRH] = degrees;
  frame.states[static_cast<std::size_t>(Feature::kRH)] = state;
  return frame;
}

std::vector<FeatureFrame> Arm(const std::vector<double>& degrees) {
  std::vector<FeatureFrame> frames;
  for (double angle : degrees) frames.push_back(ArmAt(angle));
  return frames;
}

TEST(KeyPoseRecogniser, AnswersInTheFrameThatHoldsTheLastPoseLongEnough) {
  const auto frames = Arm({90, 170, 170, 170, 90, 10, 10, 10, 10});
  EXPECT_EQ(JudgeWindow(frames, UpAndDown(), {.hold_frames = 3}).recognised_at, 7);
  EXPECT_EQ(JudgeWindow(frames, UpAndDown(), {.hold_frames = 1}).recognised_at, 5);
  EXPECT_FALSE(JudgeWindow(frames, UpAndDown(), {.hold_frames = 4}).recognised_at);
}

TEST(KeyPoseRecogniser, DemandsTheTaughtOrder) {
  EXPECT_FALSE(JudgeWindow(Arm({10, 10, 10, 90, 170, 170, 170}), UpAndDown(), {.hold_frames = 3}).recognised_at);
}

TEST(KeyPoseRecogniser, SkipsFramesWithoutABodyAndBreaksOnFramesWithAWrongPose) {
  auto lost = Arm({170, 170, 170, 170, 10, 10, 10, 10});
  lost[1].body_seen = false;
  EXPECT_EQ(JudgeWindow(lost, UpAndDown(), {.hold_frames = 3}).recognised_at, 6);
  auto broken = Arm({170, 170, 90, 170, 10, 10, 10, 10});
  EXPECT_FALSE(JudgeWindow(broken, UpAndDown(), {.hold_frames = 3}).recognised_at);
}

TEST(KeyPoseRecogniser, CountsToleranceInclusively) {
  const TaughtMove move{.name = "up", .poses = {{{{Feature::kRH, 180, 20}}}}};
  EXPECT_TRUE(JudgeWindow(Arm({160, 160, 160}), move, {.hold_frames = 3}).recognised_at);
  EXPECT_FALSE(JudgeWindow(Arm({159.9, 159.9, 159.9}), move, {.hold_frames = 3}).recognised_at);
}

/// Both arms up; the left one is at 0°, thus wrong, and seen as `state`.
double ShareWithWrongLeftArm(TrackingState state, Weighting weights) {
  const TaughtPose both{{{Feature::kRH, 180, 20}, {Feature::kLH, 180, 20}}};
  FeatureFrame frame = ArmAt(180);
  frame.states[static_cast<std::size_t>(Feature::kLH)] = state;
  return MatchedShare(frame, both, {.weights = weights});
}

TEST(Weights, CountFixedFeaturesAlikeAndAdaptiveOnesByTheirTracking) {
  using enum TrackingState;
  for (TrackingState state : {kTracked, kInferred, kNotTracked}) {
    EXPECT_DOUBLE_EQ(ShareWithWrongLeftArm(state, Weighting::kFixed), 0.5);
  }
  EXPECT_DOUBLE_EQ(ShareWithWrongLeftArm(kTracked, Weighting::kAdaptive), 0.5);
  EXPECT_DOUBLE_EQ(ShareWithWrongLeftArm(kInferred, Weighting::kAdaptive), 1.0 / 1.3);
  EXPECT_DOUBLE_EQ(ShareWithWrongLeftArm(kNotTracked, Weighting::kAdaptive), 1.0);
}

TEST(Weights, NeverMakeAPoseOfNothingSeen) {
  const TaughtPose pose{{{Feature::kRH, 180, 20}}};
  const FeatureFrame unseen = ArmAt(180, TrackingState::kNotTracked);
  EXPECT_EQ(MatchedShare(unseen, pose, {.weights = Weighting::kAdaptive}), 0.0);
  EXPECT_EQ(SoftMatch(unseen, pose, {.weights = Weighting::kAdaptive}), 0.0);
  EXPECT_EQ(MatchedShare(unseen, pose, {.weights = Weighting::kFixed}), 1.0);
}

TEST(Score, IsOneForPerfectOneHalfAtTheToleranceAndFallsWithTheWorstPose) {
  EXPECT_DOUBLE_EQ(JudgeWindow(Arm({180, 0}), UpAndDown(), {.hold_frames = 1}).score, 1.0);
  EXPECT_DOUBLE_EQ(JudgeWindow(Arm({160, 0}), UpAndDown(), {.hold_frames = 1}).score, 0.5);
  EXPECT_DOUBLE_EQ(JudgeWindow(Arm({180, 40}), UpAndDown(), {.hold_frames = 1}).score, 0.2);
  EXPECT_LT(JudgeWindow(Arm({0, 180}), UpAndDown(), {.hold_frames = 1}).score, 0.02);  // control: wrong order
}

/// The definition by brute force: the best pair of windows of `hold` frames in order, by its worst frame.
double BestPairByBruteForce(const std::vector<FeatureFrame>& frames, const TaughtMove& move,
                            const KeyPoseOptions& options) {
  const int hold = options.hold_frames, count = static_cast<int>(frames.size());
  const auto worst = [&](int end, const TaughtPose& pose) {
    double score = 1;
    for (int i = end - hold + 1; i <= end; ++i) score = std::min(score, SoftMatch(frames[i], pose, options));
    return score;
  };
  double best = 0;
  for (int first = hold - 1; first < count; ++first) {
    for (int second = std::max(hold - 1, first + 1); second < count; ++second) {
      best = std::max(best, std::min(worst(first, move.poses[0]), worst(second, move.poses[1])));
    }
  }
  return best;
}

TEST(Score, EqualsTheBruteForceSearchOverAllPassages) {
  std::vector<double> degrees;
  for (int i = 0; i < 40; ++i) degrees.push_back(90 + 80 * std::sin(0.37 * i * i));
  for (int hold : {1, 2, 3}) {
    const KeyPoseOptions options{.hold_frames = hold};
    const auto frames = Arm(degrees);
    const Judgement judgement = JudgeWindow(frames, UpAndDown(), options);
    EXPECT_NEAR(judgement.score, BestPairByBruteForce(frames, UpAndDown(), options), 1e-12) << "hold " << hold;
    EXPECT_EQ(judgement.running_score.size(), frames.size());
  }
}

TEST(FindMove, FiresOncePerPassageHoweverLongTheLastPoseIsHeld) {
  const auto frames = Arm({170, 170, 10, 10, 10, 10, 10, 170, 170, 170, 10, 10, 10});
  EXPECT_EQ(FindMove(frames, UpAndDown(20), {.hold_frames = 2}), (std::vector<int>{3, 11}));
}

TEST(FindMove, ForgetsAFirstPoseThatIsTooLongAgo) {
  const auto frames = Arm({170, 170, 90, 90, 90, 90, 90, 10, 10});
  EXPECT_EQ(FindMove(frames, UpAndDown(7), {.hold_frames = 2}), (std::vector<int>{8}));
  EXPECT_TRUE(FindMove(frames, UpAndDown(6), {.hold_frames = 2}).empty());
}

TEST(SeeFeatures, TakesTheWorstStateAmongAFeaturesJoints) {
  SkeletonStream stream;
  SensedFrame frame;
  frame.body_seen = true;
  for (SensedJoint& joint : frame.joints) joint.state = TrackingState::kTracked;
  frame[Role::kRightElbow].state = TrackingState::kInferred;
  frame[Role::kRightWrist].state = TrackingState::kNotTracked;
  stream.frames.push_back(frame);
  const FeatureFrame seen = SeeFeatures(stream, 0.9).front();
  EXPECT_EQ(seen.states[static_cast<std::size_t>(Feature::kRH)], TrackingState::kInferred);
  EXPECT_EQ(seen.states[static_cast<std::size_t>(Feature::kRHE)], TrackingState::kNotTracked);
  EXPECT_EQ(seen.states[static_cast<std::size_t>(Feature::kLHE)], TrackingState::kTracked);
}

TEST(EstimateStandingHipHeight, FallsBackWhenNoBodyIsSeen) {
  EXPECT_EQ(EstimateStandingHipHeight(SkeletonStream{}), 0.9);
}

}  // namespace
}  // namespace etude
