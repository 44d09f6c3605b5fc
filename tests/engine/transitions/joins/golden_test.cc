// The golden value of the joins: the shown motion along transitions of every kind, with every join. The other tests of
// this folder check that results are right.
#include <gtest/gtest.h>

#include "engine/transitions/joins/planted_feet.h"
#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/prints.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Returns built-in moves, and random clips in which limbs swing in any direction.
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

/// Returns sequences of two or three segments. Some begin or end at a clip's first or last frame. Some have in-between
/// frames, which are already aligned with the last shown frame (`in_place`) or not.
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

TEST(JoinsGolden, OfEveryJoinAlongWaysOfEveryKind) {
  struct Joined {
    const char* name;
    std::optional<PreferredJoin> preferred;
    std::vector<double> settings;
  };
  const std::vector<BodyMotion> clips = JoinedClips();
  Fingerprint print;
  for (const auto& [name, preferred, settings] :
       std::vector<Joined>{{"cut", {}, {}},
                           {"crossfade", {}, {}},
                           {"crossfade", {}, {0.51}},
                           {"inertialised-quintic", {}, {}},
                           {"inertialised-quintic", {}, {0.2}},
                           {"inertialised-spring", {}, {}},
                           {"minimum-jerk", {}, {}},
                           {"minimum-jerk", {}, {0.31, 1, 0}},
                           {"minimum-jerk", {}, {0.7, 1, 1}},
                           {"minimum-jerk", {}, {0, 0, 0}},
                           {"planted-feet", {}, {}},
                           {"planted-feet", {}, {0.8, 1, 0}},
                           {"planted-feet", {}, {0.04, 0, 0}},
                           {"planted-feet", PreferredJoin{.blend_s = 1.2, .way = JoinStyle::kDirect}, {}}}) {
    for (const std::vector<Segment>& way : Ways(clips, preferred)) {
      AddTo(print, SpliceSegments(clips, way, *FindJoin(name), settings));
    }
  }
  EXPECT_TRUE(print.Is(1032346, -2380.30896134));
}

TEST(PlantFeet, LeavesAMotionThatGoesOnAsItWas) {
  const BodyMotion clip = JoinedClips()[4];
  const std::vector<BodyPose> next(clip.poses.begin() + 21, clip.poses.begin() + 36);
  const auto upcoming = [&](std::size_t) { return next; };
  const PosePair here{clip.poses[19], clip.poses[20]};
  const JoinWindow window =
      WindowOf({.shown = here, .target = here, .continuation = upcoming, .upcoming = upcoming, .preferred = {}}, 15);
  std::vector<BodyPose> played = window.next;
  PlantFeet(window, PlanSteps(window), played);
  for (std::size_t f = 0; f < played.size(); ++f)
    EXPECT_EQ(played[f].joints, window.next[f].joints) << "to the last bit";
}

}  // namespace
}  // namespace etude
