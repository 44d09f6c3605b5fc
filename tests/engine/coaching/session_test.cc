// The coach with a sensor: filter, recogniser and state machine together, on a body that dances a built-in song.

#include "engine/coaching/session.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/motion/edit.h"
#include "engine/recognition/recognisers.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "sim/choreography/dance_of.h"

namespace etude {
namespace {

/// Returns what recognisers are taught: the moves' key poses.
std::vector<TaughtMove> TaughtBy(const std::vector<Move>& moves) {
  std::vector<TaughtMove> taught;
  for (const Move& move : moves) {
    TaughtMove& entry = taught.emplace_back();
    entry.name = move.name;
    for (const KeyPose& key_pose : move.key_poses) {
      TaughtPose& pose = entry.poses.emplace_back();
      for (const KeyPose::Target& target : key_pose.targets) {
        pose.targets.push_back({*FindFeature(target.feature), target.degrees, target.tolerance_deg});
      }
    }
  }
  return taught;
}

struct Studio {
  Song song = LoadBuiltinSong("warm_up").value();
  DanceLibrary library = DanceLibrary::Make(DanceOf(song).value()).value();
  DanceTransitions transitions{library, {.choice = FindChoice("now"), .join = FindJoin("crossfade")}};
  std::unique_ptr<Recogniser> recogniser =
      MakeRecogniser({.kind = FindRecogniser("key-pose")}, TaughtBy(MovesOf(song).value())).value();

  /// Dances `motion` in front of a coach from the song's first frame on.
  std::vector<CoachRecord> Coached(const BodyMotion& motion, const CoachOptions& options, const char* policy) {
    const Coach coach(transitions, options, {FindPolicy(policy), {}});
    CoachSession session({.coach = &coach, .recogniser = recogniser.get()}, coach.BeginDancing());
    std::vector<CoachRecord> records;
    for (const SensedFrame& frame : StreamOf(motion).frames) {
      for (CoachRecord& record : session.Next(frame).records) records.push_back(std::move(record));
    }
    return records;
  }
};

int Count(const std::vector<CoachRecord>& records, CoachEvent event) {
  return static_cast<int>(std::ranges::count(records, event, &CoachRecord::event));
}

TEST(CoachSession, FindsEveryPerformanceOfWhoDancesTheSongItself) {
  Studio studio;
  const auto records = studio.Coached(studio.song.motion, {}, "at-first-mistake");
  EXPECT_EQ(Count(records, CoachEvent::kRight), static_cast<int>(studio.library.dance().repetitions.size()));
  EXPECT_EQ(Count(records, CoachEvent::kCorrects), 0);
}

TEST(CoachSession, TakesTheMirrorImageForTheWrongSideOfMovesThatHaveOne) {
  Studio studio;
  const auto records = studio.Coached(Mirror(studio.song.motion), {}, "never");
  const auto wrong_sides = std::ranges::count(records, Mistake::kWrongSide, &CoachRecord::mistake);
  EXPECT_GE(wrong_sides, 4);
  for (const CoachRecord& record : records) {
    if (record.mistake != Mistake::kWrongSide) continue;
    const std::string& move = studio.library.dance().moves[record.move].name;
    for (const char* symmetric : {"stretch", "bird", "clap", "jump"}) EXPECT_NE(move, symmetric);
  }
}

TEST(CoachSession, LooksIntoTheMirrorWhenPlayersDo) {
  Studio studio;
  const auto records = studio.Coached(Mirror(studio.song.motion), {.player_mirrors = true}, "at-first-mistake");
  EXPECT_EQ(Count(records, CoachEvent::kRight), static_cast<int>(studio.library.dance().repetitions.size()));
}

TEST(CoachSession, CorrectsWhoStandsThere) {
  Studio studio;
  const BodyMotion standing{.poses = std::vector<BodyPose>(600, studio.song.motion.poses.front())};
  const auto records = studio.Coached(standing, {}, "at-first-mistake");
  EXPECT_EQ(Count(records, CoachEvent::kRight), 0);
  EXPECT_GE(Count(records, CoachEvent::kCorrects), 1);
}

}  // namespace
}  // namespace etude
