#pragma once

#include <ranges>
#include <span>
#include <vector>

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/controls.h"
#include "sim/choreography/move.h"
#include "tests/engine/transitions/lying_clips.h"
#include "tests/engine/transitions/random_clips.h"
#include "tests/support/fingerprint.h"

namespace etude {

inline auto JointsOf(std::span<const BodyPose> poses) { return poses | std::views::transform(&BodyPose::joints); }

inline void AddTo(testing::Fingerprint& print, const FuzzyDistance& distance) {
  print.Add(distance.value).Add(distance.partials);
}

inline void AddTo(testing::Fingerprint& print, const std::optional<PreferredJoin>& join) {
  print.Add(join.has_value());
  if (join) print.Add(join->blend_s).Add(join->way).Add(join->carried);
}

/// Adds all fields of a record to a fingerprint, except its text, which tests store as text.
inline void AddTo(testing::Fingerprint& print, const TransitionRecord& record) {
  print.Add(record.branch).Add(record.request_frame).Add(record.segments.size()).Add(record.candidates.size());
  for (const Segment& segment : record.segments) {
    print.Add(segment.clip).Add(segment.first).Add(segment.last).Add(segment.in_place).Add(JointsOf(segment.own));
    AddTo(print, segment.preferred);
  }
  for (const FuzzyDistance& distance : record.distances) AddTo(print, distance);
  for (const Candidate& candidate : record.candidates) {
    AddTo(print, candidate.distance);
    print.Add(candidate.from_frame).Add(candidate.to_frame).Add(candidate.cost);
    print.Add(candidate.outcome).Add(candidate.point);
  }
  print.Add(record.pairs_seen).Add(record.pairs_matched).Add(record.wait_s).Add(record.cost_unit);
}

/// Returns a library of a dance that repeats a few poses; grades are multiples of 1/8, so that most distances tie.
inline MotionLibrary LibraryOfTies() {
  RandomStream dice({.suite_seed = 6, .scenario = "ties", .trial = 0}, "poses");
  const BodyMotion poses = RandomClip(dice, 60, 0.6);
  std::vector<BodyMotion> clips(4);
  for (int clip = 0; clip < 4; ++clip) {
    for (int f = 0; f < 30 + 13 * clip; ++f) clips[clip].poses.push_back(poses.poses[(f * (5 + clip) % 7) * 8]);
  }
  MotionLibrary library = MakeLibraryOfOneBody({"a", "b", "c", "d"}, clips,
                                               MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight));
  for (int clip = 0; clip < 4; ++clip) {
    TaggedClip& tagged = library.tagged[clip];
    tagged.bridge_frames.clear();
    for (int f = 0; f < tagged.FrameCount(); ++f) {
      tagged.grades[f] = {};
      tagged.grades[f][0] = 0.125 * ((f * (3 + clip) + clip) % 9) + (f % 3 == 1 && clip % 2 == 1 ? 0.0625 : 0);
      tagged.tags[f] = {};
      tagged.tags[f][2] = f % 3 == clip % 2;
      if (f % 4 == clip) tagged.bridge_frames.push_back(f);
    }
  }
  library.in_betweens.keys = {{0, 4}, {1, 5}, {2, 2}, {3, 3}};
  return library;
}

/// Returns some built-in moves and acts, danced by one body with feet.
inline MotionLibrary LibraryOfMoves() {
  const std::vector<std::string> names = {"aerobic", "jump", "boxing", "sway", "wave", "praise"};
  std::vector<BodyMotion> clips;
  for (const std::string& name : names) clips.push_back(LoadBuiltinMove(name).value().motion);
  return MakeLibrary(names, clips, MakeBodyProportions(PoseOf(Controls{}), 0.9));
}

/// Returns clips that lie, stand up and lie down, and some that stand.
inline MotionLibrary LibraryOfLying() {
  RandomStream dice({.suite_seed = 6, .scenario = "lying", .trial = 0}, "clips");
  BodyMotion sinks = RisingClip(110), rises = RisingClip(75);
  std::ranges::reverse(sinks.poses);
  for (std::size_t f = 0; f < rises.poses.size(); ++f) {
    const FloorMove walk{.yaw = 0.01 * f, .x = 0.004 * f, .z = -0.002 * f};
    rises.poses[f] = walk.Apply(rises.poses[f]);
  }
  return MakeLibrary(
      {"lie", "wave", "rise", "dance", "sink", "soar"},
      std::vector{LyingClip(50), WavingClip(61), rises, RandomClip(dice, 47, 0.4), sinks, RisingClip(200)},
      MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight));
}

}  // namespace etude
