// Sensors and dances by the library's types are those of the engine's own, and so is the coach that dances one.
#include <etude/simulation.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/coaching/session.h"
#include "engine/recognition/recognisers.h"
#include "sim/choreography/dance_of.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude::sim {
namespace {

using testing::HasSubstr;

std::string WhyNot(const std::function<void()>& act) {
  try {
    act();
  } catch (const engine::BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Simulation, SensesAsTheSensorDoesToTheLastBit) {
  const Song song = LoadBuiltinSong("groove").value();
  BodyMotion motion = song.motion;
  motion.poses.resize(120);
  engine::Motion told;
  for (const BodyPose& pose : motion.poses) told.poses.push_back({pose.joints});
  const auto sensed = Sense(told, {.sensor = "v1", .strength = 0.5, .turn_rad = 0.3, .seed = 7});
  SkeletonSensorOptions errors = SensorV1();
  errors.strength = 0.5;
  const SkeletonStream wanted = SenseSkeleton(motion, SkeletonSensorAt({.turn = 0.3}, errors.view), {}, errors,
                                              {.suite_seed = 7, .scenario = "sensor", .trial = 0});
  ASSERT_EQ(sensed.size(), 120u);
  for (std::size_t i = 0; i < sensed.size(); ++i) {
    EXPECT_EQ(sensed[i].body_seen, wanted.frames[i].body_seen);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      EXPECT_EQ(sensed[i].pose.joints[j], wanted.frames[i].joints[j].position);
      EXPECT_EQ(static_cast<int>(sensed[i].seen[j]), static_cast<int>(wanted.frames[i].joints[j].state));
    }
  }
  const auto same = Sense(told, {.sensor = "v1", .strength = 0});
  EXPECT_EQ(same[60].pose.joints, told.poses[60].joints);
  EXPECT_THAT(WhyNot([&] { Sense(told, {.sensor = "v3"}); }), HasSubstr("sensor:1"));
  EXPECT_THAT(WhyNot([&] { Sense(told, {.strength = -1}); }), HasSubstr("strength -1; allowed: 0 to 10"));
  EXPECT_THAT(WhyNot([&] { Sense(told, {.distance_m = 0}); }), HasSubstr("0 m away"));
}

/// A player who dances along, and stands still from the 600th frame on.
engine::SensedPose PlayerAt(const BodyMotion& motion, std::size_t frame) {
  return {.pose = {motion.poses[std::min<std::size_t>(frame, 600)].joints}, .seen = {}, .body_seen = true};
}

TEST(Simulation, TheCoachOfASongStepsAsTheEnginesDoesToTheLastBit) {
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
  std::set<std::string> events, modes;
  for (std::size_t frame = 0; frame < 900; ++frame) {
    const engine::SensedPose player = PlayerAt(song.motion, frame);
    SensedFrame seen{.joints = {}, .body_seen = true};
    for (std::size_t j = 0; j < kRoleCount; ++j) seen.joints[j] = {player.pose.joints[j], TrackingState::kTracked};
    const double music_s = static_cast<double>(frame) / 30;
    const engine::CoachFrame shown = coach.Step(player, music_s);
    const CoachOutput output = session.Next(seen, {.music_s = music_s});
    ASSERT_EQ(shown.body.joints, output.body.joints) << frame;
    ASSERT_EQ(shown.mode, ModeName(output.mode)) << frame;
    ASSERT_EQ(shown.say, output.say) << frame;
    ASSERT_EQ(shown.decisions.size(), output.records.size());
    for (std::size_t i = 0; i < output.records.size(); ++i) {
      EXPECT_EQ(shown.decisions[i].why, output.records[i].why);
      EXPECT_EQ(shown.decisions[i].evidence, output.records[i].evidence);
      events.insert(shown.decisions[i].event);
    }
    modes.insert(shown.mode);
  }
  EXPECT_THAT(events, testing::IsSupersetOf({"right", "wrong", "corrects", "transition"}));
  EXPECT_THAT(modes, testing::IsSupersetOf({"dance", "correct"}));
}

TEST(Simulation, ACoachRefusesADanceThatIsNone) {
  const BuiltinDance builtin = DanceOfSong(SongNames().front());
  EXPECT_THAT(WhyNot([] { DanceOfSong("hymn"); }), HasSubstr("song 'hymn'; allowed: "));
  EXPECT_THAT(WhyNot([] { engine::Coach({}, {}); }), HasSubstr("has 0 frames; at least 2"));
  EXPECT_THAT(WhyNot([&] { engine::Coach(builtin.dance, {}); }), HasSubstr("0 moves; allowed: the "));
  EXPECT_THAT(WhyNot([&] { engine::Coach(builtin.dance, builtin.moves, {.policy = "oracle"}); }),
              HasSubstr("policy 'oracle'; allowed: at-first-mistake"));
  EXPECT_THAT(WhyNot([&] { engine::Coach(builtin.dance, builtin.moves, {.recogniser = "key-pose"}); }),
              HasSubstr("allowed: whole-body, dtw, nearest"));
  EXPECT_THAT(WhyNot([&] { engine::Coach(builtin.dance, builtin.moves, {.right_from = 0.0}); }),
              HasSubstr("right_from 0; allowed: above 0"));
  auto renamed = builtin.moves;
  renamed.front().name = "jig";
  EXPECT_THAT(WhyNot([&] { engine::Coach(builtin.dance, renamed); }), HasSubstr("move 0: 'jig'; allowed: the dance's"));
}

}  // namespace
}  // namespace etude::sim
