#include "engine/recognition/recognise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kFrames = 90;  // three seconds
constexpr int kUp = 30, kDown = 60;

/// A standing body whose right arm hangs (RH 0°), is raised (180°) in the frames from kUp, and hangs again from kDown;
/// every joint tracked. Before it, `lost` frames in which no body is seen.
SkeletonStream RaisedArm(int lost = 0) {
  SkeletonStream stream;
  stream.frames.resize(static_cast<std::size_t>(lost + kFrames));
  for (int t = 0; t < kFrames; ++t) {
    SensedFrame& frame = stream.frames[static_cast<std::size_t>(lost + t)];
    frame.body_seen = true;
    for (SensedJoint& joint : frame.joints) joint.state = TrackingState::kTracked;
    frame[Role::kLeftShoulder].position = {0.2, 1.4, 0};
    frame[Role::kRightShoulder].position = {-0.2, 1.4, 0};
    frame[Role::kLeftHip].position = {0.1, 0.9, 0};
    frame[Role::kRightHip].position = {-0.1, 0.9, 0};
    frame[Role::kRightElbow].position = {-0.2, t >= kUp && t < kDown ? 1.7 : 1.1, 0};
  }
  return stream;
}

TaughtMove RaisedTo(const std::string& name, double degrees) {
  return {.name = name, .poses = {{{{Feature::kRH, degrees, 20}}}}};
}

const std::vector<TaughtMove> kTaught = {RaisedTo("hang", 0), RaisedTo("raise", 180)};

Recognition RecogniseIn(const SkeletonStream& stream, const std::vector<AskedMove>& asked,
                        const std::vector<TaughtMove>& taught = kTaught, const KeyPoseOptions& options = {}) {
  const SeenStream seen = SeeStream(stream, {});
  return *Recognise({.seen = seen, .asked = asked, .taught = taught}, options);
}

std::vector<std::string> Told(const Recognition& recognition) {
  std::vector<std::string> told;
  for (const Detection& detection : recognition.detections) {
    told.push_back(detection.move + " " + std::to_string(detection.frame));
  }
  return told;
}

TEST(FramesBetween, TakesEveryFrameTouchedAndCutsAtTheStreamsEnds) {
  const auto window = [](double start_s, double end_s) {
    const FrameInterval frames = FramesBetween(start_s, end_s, RaisedArm());
    return std::pair(frames.begin, frames.end);
  };
  EXPECT_EQ(window(0.5, 2), std::pair(15, 60));
  EXPECT_EQ(window(0.51, 1.99), std::pair(15, 60));
  EXPECT_EQ(window(-1, 99), std::pair(0, kFrames));
  EXPECT_EQ(window(5, 6), std::pair(kFrames, kFrames));
  EXPECT_EQ(window(2, 1), std::pair(60, 60)) << "never ends before it begins";
}

TEST(StreamOf, TellsAMotionAsASensorWithoutErrorsWould) {
  BodyMotion motion{.rate_hz = 25, .poses = std::vector<BodyPose>(2)};
  motion.poses[1].joints[3] = {1, 2, 3};
  const SkeletonStream stream = etude::StreamOf(motion);
  EXPECT_EQ(stream.rate_hz, 25);
  ASSERT_EQ(stream.frames.size(), 2u);
  for (const SensedFrame& frame : stream.frames) {
    EXPECT_TRUE(frame.body_seen);
    for (const SensedJoint& joint : frame.joints) EXPECT_EQ(joint.state, TrackingState::kTracked);
  }
  EXPECT_EQ(MotionOf(stream).poses[1].joints, motion.poses[1].joints);
}

TEST(SeeStream, ReadsTheFeaturesOffTheFilteredStream) {
  const SkeletonStream stream = RaisedArm();
  const SeenStream raw = SeeStream(stream, {}), smooth = SeeStream(stream, {.kind = FilterKind::kHolt});
  ASSERT_EQ(raw.frames.size(), stream.frames.size());
  EXPECT_NEAR(raw.frames[kUp].features[Feature::kRH], 180, 1e-9);
  const auto expected = SeeFeatures(smooth.filtered, EstimateStandingHipHeight(smooth.filtered));
  for (std::size_t t = 0; t < expected.size(); ++t) {
    EXPECT_EQ(smooth.frames[t].features.values, expected[t].features.values) << "frame " << t;
  }
  const auto elbow = [&](const SeenStream& seen) { return seen.filtered.frames[kUp + 3][Role::kRightElbow].position; };
  EXPECT_EQ(elbow(raw), stream.frames[kUp + 3][Role::kRightElbow].position);
  EXPECT_NE(elbow(smooth), elbow(raw)) << "control: the filter was asked";
}

TEST(Recognise, AnswersInTheThirdFrameOfThePoseCountedFromTheWindowsFirst) {
  const auto judgements = RecogniseIn(RaisedArm(), {{"raise", {15, 75}}, {"raise", {31, 34}}}).judgements;
  ASSERT_EQ(judgements.size(), 2u);
  EXPECT_EQ(judgements[0].recognised_at, kUp + 2 - 15);
  EXPECT_EQ(judgements[1].recognised_at, 2);
  EXPECT_DOUBLE_EQ(judgements[0].score, 1.0);
  EXPECT_EQ(judgements[0].running_score.size(), 60u);
}

TEST(Recognise, DoesNotFindAPoseThatIsNotInTheWindowOrTooShort) {
  const auto judgements = RecogniseIn(RaisedArm(), {{"raise", {kDown, kFrames}}, {"raise", {31, 33}}}).judgements;
  EXPECT_EQ(judgements[0].recognised_at, std::nullopt);
  EXPECT_NEAR(judgements[0].score, 1.0 / (1 + 9 * 9), 1e-12);  // 180° off, of a tolerance of 20°
  EXPECT_EQ(judgements[1].recognised_at, std::nullopt);
  EXPECT_EQ(judgements[1].score, 0);  // two frames hold nothing for three
}

TEST(Recognise, LooksForEveryMoveTaughtWhateverIsAskedFor) {
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {})), ElementsAre("hang 2", "hang 62", "raise 32"));
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {{"raise", {15, 75}}})), ElementsAre("hang 2", "hang 62", "raise 32"));
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {}, {kTaught[1], kTaught[0]})),
              ElementsAre("raise 32", "hang 2", "hang 62"));
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {}, {RaisedTo("sideways", 90)})), ElementsAre());  // control
}

TEST(Recognise, FindsNoMoveThatTookLongerThanItsSpan) {
  TaughtMove swing{.name = "swing", .poses = {RaisedTo("", 0).poses[0], RaisedTo("", 180).poses[0]}};
  // Hangs until frame 29, held high in frame 32.
  swing.span_frames = 3;
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {}, {swing})), ElementsAre("swing 32"));
  swing.span_frames = 2;
  EXPECT_THAT(Told(RecogniseIn(RaisedArm(), {}, {swing})), ElementsAre());
  EXPECT_EQ(RecogniseIn(RaisedArm(), {{"swing", {0, 60}}}, {swing}).judgements[0].recognised_at, 32)
      << "a window is a span of its own";
}

TEST(Recognise, AnswersLaterByTheFramesInWhichNobodyWasSeen) {
  constexpr int kLost = 20;
  const std::vector<AskedMove> asked = {{"raise", {15, 75}}, {"hang", {40, 90}}};
  std::vector<AskedMove> later = asked;
  for (AskedMove& move : later) move.window = {move.window.begin + kLost, move.window.end + kLost};
  const Recognition at_once = RecogniseIn(RaisedArm(), asked), delayed = RecogniseIn(RaisedArm(kLost), later);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(delayed.judgements[i].recognised_at, at_once.judgements[i].recognised_at);
    EXPECT_EQ(delayed.judgements[i].running_score, at_once.judgements[i].running_score);
  }
  ASSERT_EQ(delayed.detections.size(), at_once.detections.size());
  for (std::size_t i = 0; i < at_once.detections.size(); ++i) {
    EXPECT_EQ(delayed.detections[i].frame, at_once.detections[i].frame + kLost);
  }
}

TEST(Recognise, GoesByItsOptions) {
  EXPECT_EQ(RecogniseIn(RaisedArm(), {{"raise", {15, 75}}}, kTaught, {.hold_frames = 1}).judgements[0].recognised_at,
            kUp - 15);
  // The arm is up as asked, the left elbow, which is not tracked, is not: adaptive weights let it pass.
  TaughtMove both = RaisedTo("both", 180);
  both.poses[0].targets.push_back({Feature::kLHE, 150, 20});
  SkeletonStream stream = RaisedArm();
  for (SensedFrame& frame : stream.frames) frame[Role::kLeftWrist].state = TrackingState::kNotTracked;
  EXPECT_THAT(Told(RecogniseIn(stream, {}, {both}, {.weights = Weighting::kFixed})), ElementsAre());
  EXPECT_THAT(Told(RecogniseIn(stream, {}, {both}, {.weights = Weighting::kAdaptive})), ElementsAre("both 32"));
}

TEST(Recognise, RefusesWhatItCannotJudgeAndSaysWhatIsAllowed) {
  const SeenStream seen = SeeStream(RaisedArm(), {});
  const auto complaint = [&](const AskedMove& asked, const TaughtMove& taught, const KeyPoseOptions& options) {
    const auto recognised = Recognise({.seen = seen, .asked = {&asked, 1}, .taught = {&taught, 1}}, options);
    return recognised ? "no complaint" : recognised.error().message;
  };
  const AskedMove asked{"raise", {15, 75}};
  const TaughtMove raise = kTaught[1], without_target{.name = "raise", .poses = {{}}},
                   without_pose{.name = "raise", .poses = {}};
  TaughtMove exact = raise;
  exact.poses[0].targets[0].tolerance_deg = 0;
  EXPECT_EQ(complaint(asked, raise, {}), "no complaint");  // the control
  EXPECT_EQ(complaint({"raize", {15, 75}}, raise, {}), "unknown move 'raize'; did you mean 'raise'? Allowed: raise");
  for (const FrameInterval window : {FrameInterval{-1, 9}, FrameInterval{9, 8}, FrameInterval{0, 91}}) {
    EXPECT_THAT(complaint({"raise", window}, raise, {}), HasSubstr("; the stream has 90"));
  }
  EXPECT_EQ(complaint(asked, without_pose, {}), "move 'raise' has no key pose");
  EXPECT_EQ(complaint(asked, without_target, {}), "a key pose of move 'raise' has no target");
  EXPECT_EQ(complaint(asked, exact, {}), "a target of move 'raise' has no tolerance above 0");
  EXPECT_EQ(complaint(asked, raise, {.threshold = 0}), "threshold 0; allowed: above 0, up to 1");
  EXPECT_EQ(complaint(asked, raise, {.threshold = 1.1}), "threshold 1.1; allowed: above 0, up to 1");
  EXPECT_EQ(complaint(asked, raise, {.threshold = 1}), "no complaint") << "the whole match is a threshold, too";
  EXPECT_EQ(complaint(asked, raise, {.hold_frames = 0}), "hold_frames 0; allowed: 1 or more");
}

}  // namespace
}  // namespace etude
