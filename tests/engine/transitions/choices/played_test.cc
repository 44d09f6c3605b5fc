#include "engine/transitions/choices/played.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/motion/support.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "tests/engine/transitions/lying_clips.h"

namespace etude {
namespace {

constexpr double kHipHeight = PosedBody::kStandingHipHeight;

MotionLibrary LibraryOfClips(std::vector<std::string> names, const std::vector<BodyMotion>& clips) {
  return MakeLibrary(std::move(names), clips, MakeBodyProportions(PosedBody().Pose(), kHipHeight));
}

TransitionRecord PlayedFrom(const MotionLibrary& library, int from, int frame, int to, PlayedOptions options = {}) {
  return PlanPlayed(library, {.from = from, .request_frame = frame, .to = to}, {}, options);
}

TEST(Stance, IsDownWhereTheMassIsLowAndBesideTheFeet) {
  EXPECT_FALSE(StanceOf(PosedBody().Pose(), kHipHeight).is_down);
  EXPECT_DOUBLE_EQ(StanceOf(PosedBody().Pose(), kHipHeight).hips, 0.84) << "the toes stand where the ankles do";
  EXPECT_TRUE(StanceOf(TippedBody(90), kHipHeight).is_down);
  EXPECT_NEAR(StanceOf(TippedBody(90), kHipHeight).hips, 0, 1e-12);
  EXPECT_FALSE(StanceOf(TippedBody(20), kHipHeight).is_down) << "beside its feet, but high: it falls, or dives";
  PosedBody squat;
  for (PosedBody::Limb* leg : {&squat.left_leg, &squat.right_leg}) {
    *leg = {PosedBody::Raised(110, kForward), PosedBody::Raised(-60, kForward)};
  }
  EXPECT_LT(StanceOf(squat.Pose(), kHipHeight).hips, 0.3);
  EXPECT_FALSE(StanceOf(squat.Pose(), kHipHeight).is_down) << "low, but above its feet: it gets up by itself";
}

TEST(NeedsClip, AsksForHipsThatRiseByMoreThanAHandAndAHalf) {
  const Stance lies{.is_down = true, .hips = 0.1}, sits{.is_down = true, .hips = 0.45};
  const Stance squats{.is_down = false, .hips = 0.29}, stands{.is_down = false, .hips = 0.9};
  EXPECT_TRUE(NeedsClip(lies, stands));
  EXPECT_TRUE(NeedsClip(stands, lies));
  EXPECT_TRUE(NeedsClip(lies, sits));
  EXPECT_FALSE(NeedsClip(lies, lies));
  EXPECT_FALSE(NeedsClip(lies, squats));
  EXPECT_FALSE(NeedsClip(squats, stands));
  EXPECT_FALSE(NeedsClip(stands, stands));
}

TEST(Played, GoesThroughTheClipThatStandsUp) {
  const MotionLibrary library = LibraryOfClips({"lie", "stand", "wave", "rise"},
                                               {LyingClip(60), StandingClip(60, 0), WavingClip(60), RisingClip(60)});
  const TransitionRequest request{.from = 0, .request_frame = 20, .to = 1};
  const Transition made = MakeTransition(library, request,
                                         {.choice = FindChoice("played"),
                                          .join = FindJoin("planted-feet"),
                                          .rules = {},
                                          .choice_settings = {},
                                          .join_settings = {}});
  const TransitionRecord& record = made.record;
  ASSERT_EQ(record.segments.size(), 3u) << record.why;
  EXPECT_EQ(record.branch, Branch::kInBetween);
  const Segment& rise = record.segments[1];
  EXPECT_EQ(rise.clip, 3);
  EXPECT_LE(record.segments[0].last, 50) << "left within the wait of a second";
  EXPECT_TRUE(library.stances[3][rise.first].is_down);
  EXPECT_FALSE(library.stances[3][rise.last].is_down);
  EXPECT_EQ(record.wait_s, WaitOf(record.segments, kJudgedRateHz));
  EXPECT_EQ(
      record.why.substr(0, record.why.find("rise from frame ")),
      "in lie, the body lies, sits or kneels with the hips at 0.00 m at every frame where the clip can be left, "
      "and in stand, the body stands with the hips at 0.83 m at every frame where the clip can be entered; no join "
      "can raise a body without support; through ");
  ASSERT_EQ(made.splice.between.size(), 1u);
  EXPECT_EQ(made.splice.between[0].size(), 60u - rise.first) << "of the clip from its point on";
  // While the body rises, its hips follow the clip, apart from the decay of the two joins.
  const int shown = made.splice.points.front().frame;
  for (int f = rise.first; f <= rise.last; ++f) {
    const double hips = made.splice.motion.poses[shown + f - rise.first][Role::kHipCentre].y;
    EXPECT_NEAR(hips, library.motions[3].poses[f][Role::kHipCentre].y, 0.1) << f;
  }
}

TEST(Played, GoesOnInAClipThatStandsUpItself) {
  const MotionLibrary library = LibraryOfClips({"rise", "stand"}, {RisingClip(240), StandingClip(60, 0)});
  const TransitionRecord record = PlayedFrom(library, 0, 70, 1);
  ASSERT_EQ(record.segments.size(), 3u) << record.why;
  EXPECT_EQ(record.segments[1].clip, 0);
  EXPECT_EQ(record.segments[0].last, record.segments[1].first) << "it is not left at all";
}

TEST(Played, SaysThatNoClipShowsHowABodyLiesDown) {
  const MotionLibrary library =
      LibraryOfClips({"stand", "lie", "rise"}, {StandingClip(60, 0), LyingClip(60), RisingClip(60)});
  const TransitionRecord down = PlayedFrom(library, 0, 10, 1);
  EXPECT_TRUE(down.segments.empty()) << "who can stand up cannot lie down backwards";
  EXPECT_EQ(
      down.why,
      "in stand, the body stands with the hips at 0.83 m at every frame where the clip can be left, and in lie, the "
      "body lies, sits or kneels with the hips at 0.00 m at every frame where the clip can be entered; no join can "
      "lower a body without support; and no clip shows this movement within 4 s");
  EXPECT_FALSE(PlayedFrom(library, 1, 10, 0).segments.empty());
  EXPECT_TRUE(PlayedFrom(library, 1, 10, 0, {.most_through_s = 0.2}).segments.empty()) << "no time for it";
  EXPECT_EQ(PlayedFrom(library, 0, 10, 0).segments.size(), 2u) << "who stands is joined as before";
}

/// Stands still with both straight legs spread by this angle.
BodyMotion StraddlingClip(int frames, double degrees) {
  PosedBody body;
  body.left_leg = {PosedBody::Raised(degrees, kLeftwards), PosedBody::Raised(degrees, kLeftwards)};
  body.right_leg = {PosedBody::Raised(-degrees, kLeftwards), PosedBody::Raised(-degrees, kLeftwards)};
  BodyPose pose = body.Pose();
  const double floor = pose[Role::kLeftFoot].y;
  for (glm::dvec3& joint : pose.joints) joint.y -= floor;
  return {kJudgedRateHz, std::vector<BodyPose>(static_cast<std::size_t>(frames), pose)};
}

/// Returns the longest run of unsupported frames after the last transition point.
int LongestFloat(const Splice& splice, const BodyMotion& left) {
  const int first = splice.points.front().frame, last = static_cast<int>(splice.motion.poses.size()) - 1;
  const std::vector<SupportingClip> clips = {{.poses = left.poses, .begin = 0, .left_at = first},
                                             {.poses = splice.wanted, .begin = splice.points.back().frame}};
  int run = 0, longest = 0;
  for (const Support& support : FindSupport(splice.motion.poses, clips, first, last, kJudgedRateHz)) {
    run = support.Holds() ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest;
}

TEST(Played, StepsWhereTheShortestJoinWouldHop) {
  const MotionLibrary library = LibraryOfClips({"wide", "narrow"}, {StraddlingClip(90, 45), StraddlingClip(90, 20)});
  TransitionRecord record = PlayedFrom(library, 0, 20, 1);
  const auto shown = [&] { return SpliceSegments(library.motions, record.segments, *FindJoin("planted-feet")); };
  EXPECT_LE(LongestFloat(shown(), library.motions[0]), 2) << record.why;
  record.segments.back().preferred->blend_s = 0.3;
  EXPECT_GE(LongestFloat(shown(), library.motions[0]), 4) << "both feet are on their way at once";
}

}  // namespace
}  // namespace etude
