#include <gtest/gtest.h>

#include <utility>

#include "engine/transitions/library/transition_points.h"
#include "tests/engine/transitions/prints.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddTo(Fingerprint& print, const std::vector<TaggedClip>& tagged) {
  for (const TaggedClip& clip : tagged) {
    print.Add(clip.rate_hz).Add(clip.grades).Add(clip.tags).Add(clip.bridge_frames);
  }
}

void AddTo(Fingerprint& print, const InBetweenNet& net) {
  for (const InBetweenNet::Key& key : net.keys) print.Add(key.clip).Add(key.frame);
  print.Add(net.keys.size()).Add(net.tween.turn_speed).Add(net.tween.shortest_s).Add(net.tween.widest_turn);
}

Fingerprint PrintOfLibrary(const MotionLibrary& library) {
  Fingerprint print;
  print.Add(library.proportions.limb_lengths).Add(library.proportions.standing_hip_height).Add(library.names);
  for (const BodyMotion& motion : library.motions) print.Add(motion.rate_hz).Add(JointsOf(motion.poses));
  AddTo(print, library.tagged);
  print.Add(library.features).Add(library.usual_accelerations);
  for (const auto& stances : library.stances) {
    for (const Stance& stance : stances) print.Add(stance.is_down).Add(stance.hips);
  }
  AddTo(print, library.in_betweens);
  return print;
}

/// People of several sizes, floors and lengths of clips, one without forearms, one that never moves, one of 24 Hz.
std::vector<BodyMotion> MotleyClips() {
  RandomStream dice({.suite_seed = 6, .scenario = "golden", .trial = 0}, "library");
  std::vector<BodyMotion> clips;
  for (const int frames : {41, 1, 2, 39, 60, 83}) clips.push_back(RandomClip(dice, frames, 0.15 + 0.1 * clips.size()));
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (BodyPose& pose : clips[c].poses) {
      for (glm::dvec3& joint : pose.joints) joint = joint * (c < 4 ? 1 : 0.7) + glm::dvec3(0, 0.05 * (c % 3), 0);
    }
  }
  for (BodyPose& pose : clips[3].poses) pose[Role::kLeftWrist] = pose[Role::kLeftHand] = pose[Role::kLeftElbow];
  clips[5].rate_hz = 24;
  clips.push_back(StandingClip(30, 20));
  clips.push_back({});
  return clips;
}

const BodyProportions kProportions = MakeBodyProportions(PosedBody().Pose(), 0.87);

std::vector<std::string> NamesFor(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back("clip" + std::to_string(i));
  return names;
}

TEST(LibraryGolden, OfLibrariesMadeByAnyRules) {
  const std::vector<BodyMotion> clips = MotleyClips();
  EXPECT_TRUE(PrintOfLibrary(MakeLibrary(NamesFor(clips.size()), clips, kProportions)).Is(32731, 105.521057577));
  EXPECT_TRUE(PrintOfLibrary(LibraryOfMoves()).Is(85926, -547.421044283));
  EXPECT_TRUE(PrintOfLibrary(LibraryOfLying()).Is(69556, -934.755049444));
  TagRules rules;
  rules.head = {.max_bend = 0.3, .max_turn_speed = 0.5};
  rules.min_clips = 3;
  rules.most_per_class = 2;
  rules.weights = {0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5};
  EXPECT_TRUE(PrintOfLibrary(MakeLibrary(NamesFor(clips.size()), clips, kProportions, rules,
                                         {.turn_speed = 2, .shortest_s = 0.5, .widest_turn = 1}))
                  .Is(32660, 150.768752734));
  rules.min_clips = 30;  // no bridge frames: keys are any frames
  EXPECT_TRUE(PrintOfLibrary(MakeLibraryOfOneBody(NamesFor(4), {clips.begin(), clips.begin() + 4}, kProportions, rules))
                  .Is(10636, -269.342389703));
}

TEST(LibraryGolden, OfRatingsAndKeys) {
  Fingerprint print;
  for (const MotionLibrary& library : {LibraryOfTies(), LibraryOfMoves()}) {
    for (const auto& clip : RateFrames(library.tagged, {0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5})) {
      for (const FrameRating& rating : clip) print.Add(rating.clips).Add(rating.frames).Add(rating.difference);
    }
    for (const double threshold : {0.0, 0.125, 0.3, 1.0}) {
      AddTo(print, BuildInBetweens(library.tagged, {.weights = PaperWeights(), .threshold = threshold, .tween = {}}));
    }
  }
  EXPECT_TRUE(print.Is(3960, 1382.26962143));
}

TEST(LibraryGolden, OfTweens) {
  std::vector<BodyPose> poses = {PosedBody().Pose(), StandingClip(1, 180).poses[0], TippedBody(90), TippedBody(-40),
                                 BodyPose()};
  for (const BodyMotion& motion : LibraryOfMoves().motions) poses.push_back(motion.poses[motion.poses.size() / 3]);
  for (const BodyMotion& motion : MotleyClips()) {
    if (!motion.poses.empty()) poses.push_back(motion.poses.back());
  }
  Fingerprint print;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Tween tween(poses[i], poses[(i * 5 + 1) % poses.size()]);
    print.Add(tween.WidestTurn());
    for (const double part : {0.0, 0.2, 0.55, 1.0}) print.Add(tween.At(part).joints);
    const TweenRules rules{.turn_speed = 3, .shortest_s = 0.1 * static_cast<double>(i % 4), .widest_turn = 1};
    std::vector<BodyPose> frames = SampleTween(tween, 24, rules);
    AppendTween(poses[(i + 3) % poses.size()], 30, rules, frames);
    print.Add(JointsOf(frames)).Add(LongestTween(rules)).Add(LongestInBetween(rules, 24));
  }
  print.Add(LongestTween({})).Add(LongestInBetween({}, 30)).Add(LongestTween({.turn_speed = 40, .shortest_s = 0.3}));
  EXPECT_TRUE(print.Is(79497, -124.777536494));
}

TEST(LibraryGolden, OfCoverageAndTransitionPoints) {
  Fingerprint print;
  std::vector<std::size_t> told;
  for (const MotionLibrary& library : {LibraryOfTies(), LibraryOfMoves()}) {
    for (const double threshold : {0.125, 0.4, 0.9}) {
      for (const bool within_class : {false, true}) {
        const MatchRules rules{.threshold = threshold, .pick = Pick::kSmallest, .within_class = within_class};
        const auto tell = [&](std::size_t done, std::size_t all) { told.insert(told.end(), {done, all}); };
        const Coverage coverage(library.tagged, rules, 0.4, tell);
        for (int from = 0; from < coverage.ClipCount(); ++from) {
          print.Add(coverage.WithoutWayInto(from));
          for (int to = 0; to < coverage.ClipCount(); ++to) {
            const PairCoverage& pair = coverage.Of(from, to);
            print.Add(pair.frame_share).Add(pair.bridge_share).Add(pair.worst_wait_s).Add(pair.in_between_share);
            for (const Pick pick : {Pick::kFirst, Pick::kSmallest}) {
              MatchRules picks = rules;
              picks.pick = pick;
              const auto point =
                  FindTransitionPoint(library.tagged[from], {from, 20 + from}, library.tagged[to], picks);
              print.Add(point.has_value());
              if (point) print.Add(point->from).Add(point->to);
              if (point) AddTo(print, point->distance);
            }
          }
        }
      }
    }
  }
  EXPECT_TRUE(print.Add(told).Is(8081, 565.054184193));
}

TEST(LibraryGolden, OfWindowsAndHeadsAtTheirLimits) {
  const TaggedClip clip = ClipOfLevels(std::vector<double>(20, 0.0), {0, 4, 9, 18, 19});
  EXPECT_EQ(FramesWithin({3, 6}), (std::vector{3, 4, 5, 6}));
  EXPECT_EQ(FramesWithin({3, 3}), std::vector{3});
  EXPECT_TRUE(FramesWithin({3, 2}).empty() && FramesWithin({3, 0}).empty());
  EXPECT_EQ(BridgeFramesWithin(clip, {4, 18}), (std::vector{4, 9, 18}));
  EXPECT_EQ(BridgeFramesWithin(clip, EntryWindow(clip)), (std::vector{0, 4, 9, 18}));
  const HeadRule still{.max_bend = 0, .max_turn_speed = 0};
  EXPECT_EQ(FindQuietHeads(StandingClip(2, 30), still), std::vector<bool>(2, true)) << "at its limits it is quiet";
}

TEST(LibraryGolden, OfStancesAtTheirLimits) {
  Fingerprint print;
  for (double degrees = -120; degrees <= 120; degrees += 3.7) {
    for (const double height : {0.5, 0.9, 1.4}) {
      const Stance stance = StanceOf(TippedBody(degrees), height);
      print.Add(stance.is_down).Add(stance.hips);
    }
    PosedBody body;
    body.left_leg = body.right_leg = {PosedBody::Raised(degrees, kForward), PosedBody::Raised(0.4 * degrees, kForward)};
    print.Add(StanceOf(body.Pose(), 0.9).is_down);
  }
  EXPECT_TRUE(print.Is(455, -7.33420840114));
  EXPECT_TRUE(StanceOf(PosedBody().Pose(), 0.84 / 0.6 + 1e-9).hips <= 0.84);
  EXPECT_FALSE(NeedsClip({.is_down = true, .hips = 0.5}, {.is_down = false, .hips = 0.75 - 0.05}));
  EXPECT_TRUE(NeedsClip({.is_down = true, .hips = 0.5}, {.is_down = false, .hips = 0.75 - 0.0499}));
}

}  // namespace
}  // namespace etude
