#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/base/angles.h"
#include "engine/transitions/joins/planted_feet.h"
#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/prints.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Moves with feet, and dances of limbs that swing any way.
std::vector<BodyMotion> JoinedClips() {
  std::vector<BodyMotion> clips = LibraryOfMoves().motions;
  RandomStream dice({.suite_seed = 6, .scenario = "golden", .trial = 0}, "joins");
  for (int frames : {71, 26, 44}) clips.push_back(RandomClip(dice, frames, 0.7));
  return clips;
}

void AddTo(Fingerprint& print, const Splice& splice) {
  print.Add(splice.motion.rate_hz).Add(JointsOf(splice.motion.poses)).Add(JointsOf(splice.wanted));
  for (const PlacedPoint& point : splice.points) {
    print.Add(point.frame).Add(point.leaving_before.joints).Add(point.leaving.joints);
    print.Add(point.arriving.joints).Add(point.arriving_after.joints);
  }
  print.Add(splice.between.size());
  for (const std::vector<BodyPose>& poses : splice.between) print.Add(JointsOf(poses));
}

/// Two clips, three clips, at their first and last frames, and frames of the way's own, in place and not.
std::vector<std::vector<Segment>> Ways(const std::vector<BodyMotion>& clips, std::optional<PreferredJoin> preferred) {
  const auto last = [&](int clip) { return static_cast<int>(clips[clip].poses.size()) - 1; };
  const auto to = [&](int clip, int first, int end) {
    return Segment{.clip = clip, .first = first, .last = end, .own = {}, .preferred = preferred};
  };
  const std::vector<BodyPose> own(clips[7].poses.begin() + 3, clips[7].poses.begin() + 14);
  const Segment laid{.clip = Segment::kOwnFrames, .first = 0, .last = 10, .own = own, .preferred = preferred};
  Segment in_place = laid;
  in_place.in_place = true;
  in_place.first = 2;
  return {{to(0, 3, 21), to(4, 7, 60)},
          {to(1, 0, 0), to(2, 0, last(2))},
          {to(6, 5, last(6)), to(8, 20, 41)},
          {to(4, 0, 30), to(5, 40, 47), to(3, 5, last(3))},
          {to(7, 0, 9), laid, to(6, 11, 30)},
          {to(8, 0, 9), in_place, to(7, 1, 25)},
          {to(5, 0, 63), to(1, 30, last(1) - 1)},
          {to(3, 0, last(3) - 2), to(6, 66, last(6))},
          {to(0, 3, 21), to(4, last(4) - 5, last(4))}};
}

Fingerprint PrintOfJoin(const std::string& name, std::optional<PreferredJoin> preferred,
                        const std::vector<double>& settings) {
  const std::vector<BodyMotion> clips = JoinedClips();
  Fingerprint print;
  for (const std::vector<Segment>& way : Ways(clips, preferred)) {
    AddTo(print, SpliceSegments(clips, way, *FindJoin(name), settings));
  }
  return print;
}

TEST(JoinsGolden, OfEveryJoinByItsDefaults) {
  EXPECT_TRUE(PrintOfJoin("cut", {}, {}).Is(73739, -484.866587436));
  EXPECT_TRUE(PrintOfJoin("crossfade", {}, {}).Is(73739, -488.034760042));
  EXPECT_TRUE(PrintOfJoin("inertialised-quintic", {}, {}).Is(73739, -488.075047856));
  EXPECT_TRUE(PrintOfJoin("inertialised-spring", {}, {}).Is(73739, -487.866174296));
  EXPECT_TRUE(PrintOfJoin("minimum-jerk", {}, {}).Is(73739, -490.011389517));
  EXPECT_TRUE(PrintOfJoin("planted-feet", {}, {}).Is(73739, -493.384091208));
}

TEST(JoinsGolden, OfEveryJoinByOtherSettings) {
  EXPECT_TRUE(PrintOfJoin("crossfade", {}, {0.51}).Is(73739, -492.875807405));
  EXPECT_TRUE(PrintOfJoin("inertialised-quintic", {}, {0.2}).Is(73739, -487.341409928));
  EXPECT_TRUE(PrintOfJoin("minimum-jerk", {}, {0.31, 1, 0}).Is(73739, -487.371737614));
  EXPECT_TRUE(PrintOfJoin("minimum-jerk", {}, {0.7, 1, 1}).Is(73739, -491.131676245));
  EXPECT_TRUE(PrintOfJoin("minimum-jerk", {}, {0, 0, 0}).Is(73739, -484.866587436));
  EXPECT_TRUE(PrintOfJoin("planted-feet", {}, {0.8, 1, 0}).Is(73739, -491.812234387));
  EXPECT_TRUE(PrintOfJoin("planted-feet", {}, {0.04, 0, 0}).Is(73739, -487.064751697));
  EXPECT_TRUE(PrintOfJoin("planted-feet", PreferredJoin{.blend_s = 1.2, .way = JoinWay::kDirect}, {})
                  .Is(73739, -483.973794269));
}

/// The window of two clips from these frames on, the second one laid somewhere beside the first.
JoinWindow WindowAt(const BodyMotion& old, int left, const BodyMotion& next, int entered, int frames) {
  const FloorMove aside{.yaw = 0.4, .x = 0.08, .z = -0.05};
  const auto from = [frames](const BodyMotion& clip, int first, const FloorMove& place) {
    std::vector<BodyPose> poses;
    for (int f = first + 1; f <= std::min(first + frames, static_cast<int>(clip.poses.size()) - 1); ++f) {
      poses.push_back(place.Apply(clip.poses[f]));
    }
    return poses;
  };
  return WindowOf({.shown = {old.poses[std::max(left - 1, 0)], old.poses[left]},
                   .target = {aside.Apply(next.poses[std::max(entered - 1, 0)]), aside.Apply(next.poses[entered])},
                   .continuation = [&](std::size_t) { return from(old, left, {}); },
                   .upcoming = [&](std::size_t) { return from(next, entered, aside); },
                   .preferred = {}},
                  frames);
}

TEST(JoinsGolden, OfStepsAndWhereTheyPutTheFeet) {
  const std::vector<BodyMotion> clips = JoinedClips();
  Fingerprint plans, played;
  for (const int frames : {0, 1, 2, 5, 9, 16, 31, 63, 64, 70}) {
    for (const auto& [old, next] : {std::pair{0, 4}, {4, 5}, {2, 1}, {1, 3}, {3, 6}}) {
      const int last = static_cast<int>(clips[old].poses.size()) - 1;
      for (const auto& [left, entered] : {std::pair{0, 5}, {31, 12}, {last - 1, 9}, {last, 3}}) {
        const JoinWindow window = WindowAt(clips[old], left, clips[next], entered, frames);
        if (frames > 1) {
          const FootPlan plan = PlanSteps(window);
          plans.Add(plan.unborne);
          for (const FootStep& step : plan.steps) {
            plans.Add(step.keeps).Add(step.begin).Add(step.end).Add(step.lift).Add(std::min(step.stays_from, 99));
            plans.Add(step.waits_until);
          }
        }
        const JoinWay way = std::array{JoinWay::kDecays, JoinWay::kFades, JoinWay::kDirect}[frames % 3];
        std::vector<BodyPose> poses = PlayMinimumJerk(window, way);
        played.Add(JointsOf(poses)).Add(PlantFeet(window, poses)).Add(JointsOf(poses));
      }
    }
  }
  EXPECT_TRUE(plans.Is(2080, -321.487561194));
  EXPECT_TRUE(played.Is(661840, 536.848976792));
}

TEST(JoinsGolden, OfAMotionThatGoesOnAsItWas) {
  const BodyMotion clip = JoinedClips()[4];
  const std::vector<BodyPose> next(clip.poses.begin() + 21, clip.poses.begin() + 36);
  const auto upcoming = [&](std::size_t) { return next; };
  const PosePair here{clip.poses[19], clip.poses[20]};
  const JoinWindow window =
      WindowOf({.shown = here, .target = here, .continuation = upcoming, .upcoming = upcoming, .preferred = {}}, 15);
  std::vector<BodyPose> played = window.next;
  PlantFeet(window, played);
  for (std::size_t f = 0; f < played.size(); ++f)
    EXPECT_EQ(played[f].joints, window.next[f].joints) << "to the last bit";
}

TEST(JoinsGolden, OfWhereStandingFeetLayAClip) {
  const std::vector<BodyMotion> clips = JoinedClips();
  Fingerprint print;
  for (const std::size_t count : {1, 4, 15}) {
    for (std::size_t old = 0; old < clips.size(); ++old) {
      const std::size_t next = (old + 2) % clips.size();
      std::vector<BodyPose> poses = clips[next].poses;
      for (BodyPose& pose : poses) pose = FloorMove{.yaw = 0.7 * static_cast<double>(old), .x = 1}.Apply(pose);
      const FloorMove move = AlignOnPlantedFeet(std::span(clips[old].poses).subspan(5, count),
                                                std::span(poses).subspan(2, count + 2), kJudgedRateHz);
      print.Add(move.yaw).Add(move.x).Add(move.z);
    }
  }
  EXPECT_TRUE(print.Is(81, -9.03659910256));
}

TEST(JoinsGolden, OfLimbsAndLegs) {
  testing::Dice dice(5);
  std::vector<glm::dvec3> vectors = {{0, 0, 0}, {1, 0, 0},  {-1, 0, 0}, {0, 2, 0},   {0, -1, 0},
                                     {0, 0, 1}, {0, 0, -3}, {1, 1, 0},  {-1, -1, 0}, {0.1, 0.1, 0.95}};
  for (int i = 0; i < 5; ++i) vectors.push_back(dice.Vector());
  Fingerprint print;
  for (const glm::dvec3& a : vectors) {
    for (const glm::dvec3& b : vectors) {
      const LimbTurn turn = TurnBetween(a, b);
      print.Add(turn).Add(Turned(dice.Vector(), turn)).Add(CarriedOffset(dice.Vector(), a, b));
      print.Add(KneeOffset(a, dice.Vector(), b));
      const double thigh = 0.3 + std::abs(dice.Signed()), shin = 0.3 + std::abs(dice.Signed());
      for (const glm::dvec3& pole : {vectors[10], a, vectors[0]}) {
        const Leg leg = SolveLeg(a, 0.5 * b, thigh, shin, pole);
        print.Add(leg.knee).Add(leg.ankle);
      }
    }
  }
  EXPECT_TRUE(print.Is(6750, 36.3599335965));
}

TEST(JoinsGolden, OfLawsThatDecay) {
  testing::Dice dice(6);
  Fingerprint print;
  for (int i = 0; i < 12; ++i) {
    const Offset offset{.value = i == 0 ? glm::dvec3(0) : dice.Vector(), .velocity = 8.0 * dice.Vector()};
    const Movement movement{.start = dice.Vector(), .start_velocity = dice.Vector(), .end_velocity = dice.Vector()};
    for (const double seconds : {0.0, 0.03, 0.11, 0.25, 0.33, 0.4}) {
      print.Add(SpringDecay(offset, seconds)).Add(SpringDecay(offset, seconds, {.half_life_s = 0.3}));
      print.Add(QuinticDecay(offset, seconds)).Add(QuinticDecay(offset, seconds, {.blend_s = 0.9}));
      print.Add(MinimumJerkAt(movement, seconds, 0.4));
    }
  }
  EXPECT_TRUE(print.Is(1080, -0.460555954089));
}

TEST(JoinsGolden, OfWhatIsSaidOfThem) {
  Fingerprint print;
  for (const JoinKind& join : AllJoins()) {
    print.Add(join.name).Add(join.description).Add(join.align != nullptr);
    AddTo(print, join.settings);
  }
  EXPECT_TRUE(print.Is(1304, 1755.3091092));
}

}  // namespace
}  // namespace etude
