// Ways to cheat a metric, each beside the metric that it cheats; `clean_share` must credit none of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "bench/metrics/transition_smoothness.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/run.h"
#include "bench/tasks/transition/stage.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/crossfade.h"
#include "tests/bench/tasks/transition/transition_fixture.h"

namespace etude {
namespace {

constexpr int kRequests = 60;
constexpr int kManyRequests = 480;  // for results that depend on the requested clip

class Controls : public TransitionFixture {
 protected:
  static const Stage& TheStage() {
    static const Stage kStage = SetStage(EveryMove());
    return kStage;
  }

  static TransitionOutcome Outcome(const TransitionRequest& request, TransitionRecord record, const char* join) {
    TransitionOutcome outcome{
        .request = request, .matched = false, .rules = {}, .record = std::move(record), .splice = {}};
    outcome.splice = SpliceSegments(TheStage().library.motions, outcome.record.segments, *FindJoin(join));
    return outcome;
  }

  static TransitionRecord Plan(const char* choice, const TransitionRequest& request) {
    return FindChoice(choice)->plan(TheStage().library, request, {}, {});
  }

  /// Returns the share of the answered requests for which a metric is 1; `make` may leave a request unanswered.
  using Way = std::function<std::optional<TransitionOutcome>(const TransitionRequest&)>;
  static double ShareOf(const char* metric, const Way& make, int requests = kRequests) {
    double sum = 0;
    int count = 0;
    for (int trial = 0; trial < requests; ++trial) {
      const auto request = DrawRequest(TheStage(), Trial(trial));
      if (!request) continue;
      const auto outcome = make(*request);
      if (!outcome) continue;
      CellResult result = CellResult::Ended(Status::kOk, "");
      ScoreTransition(*outcome, TheStage(), result);
      sum += ValueOf(result, metric);
      ++count;
    }
    EXPECT_GT(count, requests / 3) << "enough to judge by";
    return sum / count;
  }

  /// Returns a way that changes to the wanted clip at once, and shows `shown(k, outcome, wanted pose)` k frames after
  /// the transition point.
  static Way AtOnce(std::function<BodyPose(int, const TransitionOutcome&, const BodyPose&)> shown) {
    return [shown](const TransitionRequest& request) -> std::optional<TransitionOutcome> {
      TransitionOutcome outcome = Outcome(request, Plan("now", request), "cut");
      const int point = outcome.splice.points.front().frame;
      BodyMotion motion = outcome.splice.motion;
      for (int k = 1; point + k < static_cast<int>(motion.poses.size()); ++k) {
        motion.poses[point + k] = shown(k, outcome, outcome.splice.wanted[k]);
      }
      outcome.splice.motion = std::move(motion);
      return outcome;
    };
  }
};

TEST_F(Controls, UnbrokenMotionIsCleanAndSearchingWithFeetMostly) {
  const auto by = [](const char* choice, const char* join) {
    return [=](const TransitionRequest& request) -> std::optional<TransitionOutcome> {
      return Outcome(request, Plan(choice, request), join);
    };
  };
  EXPECT_GE(ShareOf("clean_share", by("unbroken", "cut")), 0.85);
  EXPECT_EQ(ShareOf("calm_natural_share", by("unbroken", "cut")), 1);
  EXPECT_GE(ShareOf("clean_share", by("played", "planted-feet")), 0.75);
  EXPECT_EQ(ShareOf("skipped_share", by("unbroken", "cut")), 0);
  EXPECT_LE(ShareOf("clean_share", by("now", "cut")), 0.02);
}

TEST_F(Controls, FreezingAndThenFadingForThreeSecondsFoolsNaturalAloneAndIsNotClean) {
  const Way freeze = AtOnce([](int k, const TransitionOutcome& outcome, const BodyPose& wanted) {
    constexpr double kFrames = 90;
    const BodyPose& frozen = outcome.splice.points.front().leaving;
    // The body comes to rest within a third of a second, so even the freezing is smooth.
    BodyPose resting = frozen;
    const double reach = 5 * (1 - std::pow(1 - std::min(k / 10.0, 1.0), 3)) / 1.5;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      resting.joints[j] += reach * (frozen.joints[j] - outcome.splice.points.front().leaving_before.joints[j]);
    }
    return PoseBetween(resting, wanted, Smootherstep(k / kFrames));
  });
  EXPECT_GE(ShareOf("natural_share", freeze), 0.8) << "what it fools";
  EXPECT_LE(ShareOf("clean_share", freeze), 0.02);
}

TEST_F(Controls, ACrossfadeOfThreeSecondsIsNotClean) {
  const Way fade = AtOnce([](int k, const TransitionOutcome& outcome, const BodyPose& wanted) {
    const std::vector<BodyPose>& old = TheStage().library.motions[outcome.request.from].poses;
    const std::size_t frame = std::min<std::size_t>(outcome.splice.points.front().frame + k, old.size() - 1);
    return PoseBetween(old[frame], wanted, Smootherstep(k / 90.0));
  });
  EXPECT_GE(ShareOf("natural_share", fade), 0.7) << "what it fools";
  EXPECT_LE(ShareOf("clean_share", fade), 0.05);
}

TEST_F(Controls, TeleportingWhereTheOldClipIsFastestIsNotClean) {
  const Way teleport = [](const TransitionRequest& request) -> std::optional<TransitionOutcome> {
    const std::vector<double> jumps = SecondDifferencesCm(TheStage().library.motions[request.from]);
    const auto begin = jumps.begin() + request.request_frame;
    const auto end = begin + std::min<std::ptrdiff_t>(30, jumps.end() - begin - 1);
    const int leave = static_cast<int>(std::max_element(begin, end) - jumps.begin());
    TransitionRecord record = Plan("now", request);
    record.segments.front().last = leave;
    record.wait_s = WaitOf(record.segments, kJudgedRateHz);
    return Outcome(request, std::move(record), "cut");
  };
  EXPECT_LE(ShareOf("clean_share", teleport), 0.02);
}

TEST_F(Controls, WaitingIsNotClean) {
  // Leaves the old clip only at its last frame, at least 1.5 s after the request, and plants the feet.
  const Way wait = [](const TransitionRequest& request) -> std::optional<TransitionOutcome> {
    TransitionRequest patient = request;
    patient.budget_s = 60;
    TransitionRecord record = Plan("played", patient);
    record.segments.front().last = TheStage().library.tagged[request.from].FrameCount() - 1;
    if (record.segments.front().last - request.request_frame < 45) return std::nullopt;
    return Outcome(request, std::move(record), "planted-feet");
  };
  EXPECT_EQ(ShareOf("clean_share", wait), 0);
  CellResult never = CellResult::Ended(Status::kUnsolved, "it still waits");
  MeasureNoWay(never);
  EXPECT_EQ(ValueOf(never, "clean_share"), 0);
  EXPECT_EQ(ValueOf(never, "clean_share_v3"), 0);
  EXPECT_EQ(ValueOf(never, "supported_share"), 0);
  EXPECT_EQ(ValueOf(never, "calm_natural_share"), 0);
}

TEST_F(Controls, AGlideLiftedOffTheFloorFoolsTheFootSlideAloneAndIsNotClean) {
  // A minimum-jerk join, which plants no foot, lifted to 2.8 cm above the floor; at that height no foot counts as
  // sliding.
  const Way lifted = [](const TransitionRequest& request) -> std::optional<TransitionOutcome> {
    TransitionOutcome outcome = Outcome(request, Plan("motion-matching", request), "minimum-jerk");
    std::vector<BodyPose>& poses = outcome.splice.motion.poses;
    constexpr int kRise = 6, kSink = 36;  // frames after the transition point
    const int point = outcome.splice.points.front().frame;
    for (int k = 1; k <= kSink + kRise && point + k < static_cast<int>(poses.size()); ++k) {
      BodyPose& pose = poses[point + k];
      const auto lower = [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; };
      const double sunk = std::min(std::ranges::min(pose.joints, lower).y, 0.0);
      const double share =
          Smootherstep(k / static_cast<double>(kRise)) - Smootherstep((k - kSink) / static_cast<double>(kRise));
      for (glm::dvec3& joint : pose.joints) joint.y += (0.028 - sunk) * share;
    }
    return outcome;
  };
  EXPECT_LE(ShareOf("join_slide_cmps", lifted), 2) << "what it fools";
  // Two thirds of the requests that count as clean go to or from the boxer, whose heel is as high while he bounces on
  // his toes.
  EXPECT_LE(ShareOf("clean_share", lifted, kManyRequests), 0.1);
}

TEST_F(Controls, SkatingOverAtAConstantPoseIsNotClean) {
  const Way skate = AtOnce([](int k, const TransitionOutcome& outcome, const BodyPose& wanted) {
    // The body glides to the wanted clip's place, a metre to its side, and then takes its pose.
    constexpr double kGlide = 30, kTurn = 15;  // frames
    constexpr glm::dvec3 kAside{1, 0, 0};
    BodyPose stiff = outcome.splice.points.front().leaving, there = wanted;
    for (glm::dvec3& joint : stiff.joints) joint += kAside * Smootherstep(k / kGlide);
    for (glm::dvec3& joint : there.joints) joint += kAside;
    return PoseBetween(stiff, there, Smootherstep((k - kGlide) / kTurn));
  });
  EXPECT_GE(ShareOf("natural_share", skate), 0.7) << "what it fools";
  EXPECT_LE(ShareOf("supported_share", skate), 0.1);
  EXPECT_LE(ShareOf("clean_share", skate), 0.02);
}

TEST_F(Controls, AWildClipDoesNotExcuseABreakInACalmOne) {
  ClipLibrary clips = SmallLibrary();
  BodyMotion& wild = clips.clips[1].motion;
  for (std::size_t f = 0; f < wild.poses.size(); f += 2) {
    for (Role role : {Role::kLeftHand, Role::kLeftWrist}) wild.poses[f][role].y += 0.3;
  }
  const Stage stage = SetStage(clips);
  const TransitionRequest request{.from = 0, .request_frame = 40, .to = 1};
  const TransitionOutcome cut{
      .request = request,
      .matched = false,
      .rules = {},
      .record = FindChoice("now")->plan(stage.library, request, {}, {}),
      .splice = SpliceSegments(stage.library.motions, FindChoice("now")->plan(stage.library, request, {}, {}).segments,
                               *FindJoin("cut"))};
  EXPECT_GT(NaturalLimitCm(NaturalJumpsOf(stage, 0, 1)), 5 * CalmerLimitCm(stage, 0, 1));
  CellResult result = CellResult::Ended(Status::kOk, "");
  ScoreTransition(cut, stage, result);
  EXPECT_EQ(ValueOf(result, "calm_natural_share"), 0);
  EXPECT_EQ(ValueOf(result, "clean_share"), 0);
}

}  // namespace
}  // namespace etude
