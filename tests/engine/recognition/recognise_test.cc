#include "engine/recognition/recognise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/recognition/recognisers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kFrames = 90;  // frames, three seconds
constexpr int kUp = 30, kDown = 60;

/// A standing body whose right arm hangs (RH 0°), is up (180°) from kUp on, and hangs again from kDown on; all joints
/// are tracked. Before it there are `lost` frames without a body.
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

struct Recognition {
  std::vector<Judgement> judgements;
  std::vector<std::string> told;  ///< detections, such as "raise 32"
};

/// Judges the performances in `asked`, which are in the order of time, and detects moves with the default
/// DecisionOptions.
Recognition RecogniseIn(const SkeletonStream& stream, const std::vector<AskedMove>& asked,
                        const std::vector<TaughtMove>& taught = kTaught, const RecogniserOptions& options = {}) {
  const SeenStream seen = SeeStream(stream, {});
  const auto recogniser = *MakeRecogniser(options, taught);
  const auto trace = *FollowStream(*recogniser, taught.size(), seen, asked);
  Recognition recognition;
  for (const AskedMove& move : asked) recognition.judgements.push_back(JudgeWindow(trace, move.window, 0.5));
  for (const auto& [move, frame] : FindMoves(trace, stream.rate_hz, {})) {
    recognition.told.push_back(taught[move].name + " " + std::to_string(frame));
  }
  return recognition;
}

constexpr std::size_t kHang = 0, kRaise = 1;

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
  const double standing = StandingHipHeight(PoseOf(stream.frames.front()));  // the legs keep still
  const SkeletonStream filtered = Smooth(stream, {.kind = FilterKind::kHolt});
  for (std::size_t t = 0; t < smooth.frames.size(); ++t) {
    const FeatureFrame expected = SeeFeatures(filtered.frames[t], standing > 0 ? standing : 0.9);
    EXPECT_EQ(smooth.frames[t].features.values, expected.features.values) << "frame " << t;
  }
  const auto elbow = [&](const SeenStream& seen) { return seen.filtered.frames[kUp + 3][Role::kRightElbow].position; };
  EXPECT_EQ(elbow(raw), stream.frames[kUp + 3][Role::kRightElbow].position);
  EXPECT_NE(elbow(smooth), elbow(raw)) << "control: the filter was asked";
}

TEST(StandingHeight, IsTheMedianOfTheFirstSecondInWhichABodyWasSeen) {
  StandingHeight standing(4);
  EXPECT_EQ(standing.Value(), 0.9) << "before a body was seen";
  SensedFrame frame;
  standing.Update(frame);
  EXPECT_EQ(standing.Value(), 0.9);
  frame.body_seen = true;
  std::vector<double> heights;
  for (double leg : {0.8, 1.4, 0.7, 1.0, 9.0, 9.0}) {
    for (Role role : {Role::kLeftHip, Role::kRightHip}) frame[role].position.y = leg;
    heights.push_back(StandingHipHeight(PoseOf(frame)));
    standing.Update(frame);
  }
  std::sort(heights.begin(), heights.begin() + 4);
  EXPECT_EQ(standing.Value(), heights[2]) << "the upper middle of four";
}

TEST(Recognise, AnswersInTheThirdFrameOfThePoseCountedFromTheWindowsFirst) {
  EXPECT_EQ(RecogniseIn(RaisedArm(), {{kRaise, {31, 34}}}).judgements[0].recognised_at, 2);
  const Judgement judgement = RecogniseIn(RaisedArm(), {{kRaise, {15, 75}}}).judgements[0];
  EXPECT_EQ(judgement.recognised_at, kUp + 2 - 15);
  EXPECT_DOUBLE_EQ(judgement.score, 1.0);
  EXPECT_EQ(judgement.running_score.size(), 60u);
}

TEST(Recognise, DoesNotFindAPoseThatIsNotInTheWindowOrTooShort) {
  const auto judgements = RecogniseIn(RaisedArm(), {{kRaise, {31, 33}}, {kRaise, {kDown, kFrames}}}).judgements;
  EXPECT_EQ(judgements[0].recognised_at, std::nullopt);
  EXPECT_EQ(judgements[0].score, 0);  // two frames do not contain three held ones
  EXPECT_EQ(judgements[1].recognised_at, std::nullopt);
  EXPECT_NEAR(judgements[1].score, 1.0 / (1 + 9 * 9), 1e-12);  // 180° off, with a tolerance of 20°
}

TEST(Recognise, LooksForEveryMoveTaughtWhateverIsAskedFor) {
  EXPECT_THAT(RecogniseIn(RaisedArm(), {}).told, ElementsAre("hang 2", "hang 62", "raise 32"));
  EXPECT_THAT(RecogniseIn(RaisedArm(), {{kRaise, {15, 75}}}).told, ElementsAre("hang 2", "hang 62", "raise 32"));
  EXPECT_THAT(RecogniseIn(RaisedArm(), {}, {kTaught[1], kTaught[0]}).told,
              ElementsAre("raise 32", "hang 2", "hang 62"));
  EXPECT_THAT(RecogniseIn(RaisedArm(), {}, {RaisedTo("sideways", 90)}).told, ElementsAre());  // control
}

TEST(Recognise, FindsNoMoveThatTookLongerThanItsSpan) {
  TaughtMove swing{.name = "swing", .poses = {RaisedTo("", 0).poses[0], RaisedTo("", 180).poses[0]}};
  // The arm hangs until frame 29 and is held high in frame 32.
  swing.span_s = 0.1;
  EXPECT_THAT(RecogniseIn(RaisedArm(), {}, {swing}).told, ElementsAre("swing 32"));
  swing.span_s = 0.05;
  EXPECT_THAT(RecogniseIn(RaisedArm(), {}, {swing}).told, ElementsAre());
  EXPECT_EQ(RecogniseIn(RaisedArm(), {{0, {0, 60}}}, {swing}).judgements[0].recognised_at, 32)
      << "a window is a span of its own";
}

TEST(Recognise, AnswersLaterByTheFramesInWhichNobodyWasSeen) {
  constexpr int kLost = 20;
  const std::vector<AskedMove> asked = {{kRaise, {15, 40}}, {kHang, {40, 90}}};
  std::vector<AskedMove> later = asked;
  for (AskedMove& move : later) move.window = {move.window.begin + kLost, move.window.end + kLost};
  const Recognition at_once = RecogniseIn(RaisedArm(), asked), delayed = RecogniseIn(RaisedArm(kLost), later);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(delayed.judgements[i].recognised_at, at_once.judgements[i].recognised_at);
    EXPECT_EQ(delayed.judgements[i].running_score, at_once.judgements[i].running_score);
  }
  EXPECT_THAT(delayed.told, ElementsAre("hang 22", "hang 82", "raise 52"));
}

TEST(Recognise, GoesByItsOptions) {
  const RecogniserOptions quick{.settings = {1, 0.8, 1}};
  EXPECT_EQ(RecogniseIn(RaisedArm(), {{kRaise, {15, 75}}}, kTaught, quick).judgements[0].recognised_at, kUp - 15);
  // The right arm is up as taught, but the left elbow's angle is wrong. Adaptive weights ignore this angle, because
  // the left wrist is not tracked.
  TaughtMove both = RaisedTo("both", 180);
  both.poses[0].targets.push_back({Feature::kLHE, 150, 20});
  SkeletonStream stream = RaisedArm();
  for (SensedFrame& frame : stream.frames) frame[Role::kLeftWrist].state = TrackingState::kNotTracked;
  EXPECT_THAT(RecogniseIn(stream, {}, {both}).told, ElementsAre());
  const RecogniserOptions adaptive{.weights = {.weighting = Weighting::kAdaptive}};
  EXPECT_THAT(RecogniseIn(stream, {}, {both}, adaptive).told, ElementsAre("both 32"));
}

TEST(MoveSpotter, SpotsAMoveWhenItsEvidenceRisesAndNotAgainForAWhile) {
  MoveSpotter spotter(1, {.threshold = 0.5, .refractory_s = 0.3}, 10);
  const std::vector<double> evidence = {0.4, 0.5, 0.9, 0.2, 0.6, 0.7, 0.1, 0.8, 0.8};
  std::vector<int> fired;
  for (int t = 0; t < 9; ++t) {
    if (!spotter.Update(std::span(&evidence[static_cast<std::size_t>(t)], 1)).empty()) fired.push_back(t);
  }
  EXPECT_THAT(fired, ElementsAre(1, 4, 7));
  MoveSpotter patient(1, {.threshold = 0.5, .refractory_s = 0.4}, 10);
  fired.clear();
  for (int t = 0; t < 9; ++t) {
    if (!patient.Update(std::span(&evidence[static_cast<std::size_t>(t)], 1)).empty()) fired.push_back(t);
  }
  EXPECT_THAT(fired, ElementsAre(1, 7)) << "what rose while it had to be silent does not count";
}

TEST(MoveSpotter, ALostBodySpotsNoMoveAgain) {
  // At 30 Hz a step of a recogniser has two frames, so its evidence is 0 until the second frame with a body.
  MoveSpotter spotter(1, {.threshold = 0.5, .refractory_s = 0.1}, 30);
  std::vector<double> evidence(60, 0.9);
  std::vector<bool> seen(60, true);
  for (std::size_t t = 20; t < 26; ++t) seen[t] = false;
  for (std::size_t t = 21; t < 27; ++t) evidence[t] = 0;
  for (std::size_t t = 40; t < 50; ++t)
    evidence[t] = 0.1;  // falls while the body is seen: a new performance may follow
  const auto fired = [&](bool is_told) {
    MoveSpotter one = spotter;
    std::vector<int> at;
    for (std::size_t t = 0; t < 60; ++t) {
      if (!one.Update(std::span(&evidence[t], 1), is_told ? seen[t] : true).empty()) at.push_back(static_cast<int>(t));
    }
    return at;
  };
  EXPECT_THAT(fired(true), ElementsAre(0, 50));
  EXPECT_THAT(fired(false), ElementsAre(0, 27, 50)) << "the control: the loss counts as fallen evidence";
}

TEST(MakeRecogniser, RefusesMovesItCannotBeTaughtAndSaysWhatIsAllowed) {
  const auto complaint = [&](const std::vector<TaughtMove>& taught) {
    return testing::Message(MakeRecogniser({}, taught));
  };
  const TaughtMove raise = kTaught[1], without_target{.name = "raise", .poses = {{}}}, without_pose{.name = "raise"};
  TaughtMove exact = raise, endless = raise;
  exact.poses[0].targets[0].tolerance_deg = 0;
  endless.span_s = 61;
  EXPECT_EQ(complaint({raise}), "accepted");  // the control
  EXPECT_EQ(complaint({}), "accepted") << "of no move there is nothing to know";
  EXPECT_EQ(complaint({raise, raise}), "two moves are called 'raise'");
  EXPECT_EQ(complaint({without_pose}), "recogniser key-pose: move 'raise' has no key pose");
  EXPECT_EQ(complaint({without_target}), "recogniser key-pose: a key pose of move 'raise' has no target");
  EXPECT_EQ(complaint({exact}), "recogniser key-pose: a target of move 'raise' has no tolerance above 0");
  EXPECT_EQ(complaint({endless}), "move 'raise' lasts 61 s; allowed: above 0, up to 60 s");
}

TEST(FollowStream, RefusesWindowsThatItCannotFollow) {
  const SeenStream seen = SeeStream(RaisedArm(), {});
  const auto recogniser = *MakeRecogniser({}, kTaught);
  const auto complaint = [&](const std::vector<AskedMove>& asked) {
    return testing::Message(FollowStream(*recogniser, kTaught.size(), seen, asked));
  };
  EXPECT_EQ(complaint({{kRaise, {15, 75}}, {kHang, {75, 75}}, {kHang, {75, 90}}}), "accepted");  // the control
  EXPECT_EQ(complaint({{2, {15, 75}}}),
            "move number 2 is requested, but only 2 moves were taught; moves are counted from 0");
  for (const FrameInterval window : {FrameInterval{-1, 9}, FrameInterval{9, 8}, FrameInterval{0, 91}}) {
    EXPECT_THAT(complaint({{kRaise, window}}), HasSubstr(", but the stream has 90 frames"));
  }
  EXPECT_EQ(complaint({{kRaise, {15, 75}}, {kHang, {74, 80}}}),
            "a move is requested from frame 74 on, but the previous request lasts until frame 75");
}

TEST(JudgeWindow, OfNoFramesIsNothing) {
  const Judgement judgement = JudgeWindow({.moves = 1, .asked = {0.9, 0.9}, .spotted = {0, 0}}, {1, 1}, 0.5);
  EXPECT_EQ(judgement.score, 0);
  EXPECT_FALSE(judgement.recognised_at);
  EXPECT_TRUE(judgement.running_score.empty());
}

}  // namespace
}  // namespace etude
