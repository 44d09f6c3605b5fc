// The coach of a dance in the library's types takes the same steps as the engine's coach.
#include <etude/sim/dances.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/coaching/session.h"
#include "engine/recognition/recognisers.h"
#include "sim/choreography/dance_of.h"
#include "tests/support/refusal.h"

namespace etude::sim {
namespace {

using etude::testing::RefusalOf;
using ::testing::HasSubstr;

/// A player who dances along, and stands still from frame 600 on.
SensedFrame PlayerAt(const BodyMotion& motion, std::size_t frame) {
  return StreamOf({.poses = {motion.poses[std::min<std::size_t>(frame, 600)]}}).frames.front();
}

TEST(BuiltinDance, TheCoachOfASongStepsAsTheEnginesDoesToTheLastBit) {
  const BuiltinDance builtin = DanceOfSong("groove");
  engine::Coach coach(builtin.dance, builtin.moves, {.dances_at_once = true});

  const Song song = LoadBuiltinSong("groove").value();
  std::vector<TaughtMove> taught;
  const std::vector<Move> moves = MovesOf(song).value();
  for (const Move& move : moves) {
    taught.push_back({.name = move.name, .examples = {StreamOf(move.motion)}});
  }
  const RecogniserKind* kind = FindRecogniser("whole-body");
  const auto recogniser = MakeRecogniser({.kind = kind}, taught);
  const auto library = DanceLibrary::Make(DanceOf(song).value());
  const DanceTransitions transitions(*library, {.choice = FindChoice("played"), .join = FindJoin("planted-feet")});
  CoachOptions options;
  options.right_from = kind->threshold;
  const Coach wanted(transitions, options, {FindPolicy("at-first-mistake"), {}});
  CoachSession session({.coach = &wanted, .recogniser = recogniser->get(), .filter = {.kind = FilterKind::kNone}},
                       wanted.BeginDancing());
  std::set<std::string_view> events, modes;
  for (std::size_t frame = 0; frame < 900; ++frame) {
    const SensedFrame seen = PlayerAt(song.motion, frame);
    const double music_s = static_cast<double>(frame) / 30;
    const CoachOutput shown = coach.Step(seen, music_s);
    const CoachOutput output = session.Next(seen, {.music_s = music_s});
    ASSERT_EQ(shown.body.joints, output.body.joints) << frame;
    ASSERT_EQ(shown.mode, output.mode) << frame;
    ASSERT_EQ(shown.say, output.say) << frame;
    ASSERT_EQ(shown.records.size(), output.records.size());
    for (std::size_t i = 0; i < output.records.size(); ++i) {
      EXPECT_EQ(shown.records[i].why, output.records[i].why);
      EXPECT_EQ(shown.records[i].evidence, output.records[i].evidence);
      events.insert(EventName(shown.records[i].event));
    }
    modes.insert(ModeName(shown.mode));
  }
  EXPECT_THAT(events, ::testing::IsSupersetOf({"right", "wrong", "corrects", "transition"}));
  EXPECT_THAT(modes, ::testing::IsSupersetOf({"dance", "correct"}));
}

TEST(BuiltinDance, ACoachRefusesADanceThatIsNone) {
  const BuiltinDance builtin = DanceOfSong(SongNames().front());
  EXPECT_THAT(RefusalOf([] { DanceOfSong("hymn"); }), HasSubstr("song 'hymn'; allowed: "));
  EXPECT_THAT(RefusalOf([] { engine::Coach({}, {}); }), HasSubstr("has 0 frames; allowed: at least 2"));
  EXPECT_THAT(RefusalOf([&] { engine::Coach(builtin.dance, {}); }), HasSubstr("found 0 moves; allowed: 8"));
  EXPECT_THAT(RefusalOf([&] { engine::Coach(builtin.dance, builtin.moves, {.policy = "oracle"}); }),
              HasSubstr("policy 'oracle'; allowed: at-first-mistake"));
  EXPECT_THAT(RefusalOf([&] { engine::Coach(builtin.dance, builtin.moves, {.recogniser = "key-pose"}); }),
              HasSubstr("allowed: whole-body, dtw, nearest"));
  EXPECT_THAT(RefusalOf([&] { engine::Coach(builtin.dance, builtin.moves, {.right_from = 0.0}); }),
              HasSubstr("right_from is 0; allowed: above 0"));
  auto renamed = builtin.moves;
  renamed.front().name = "jig";
  EXPECT_THAT(RefusalOf([&] { engine::Coach(builtin.dance, renamed); }), HasSubstr("move 0 is 'jig'; allowed: 'clap'"));
}

}  // namespace
}  // namespace etude::sim
