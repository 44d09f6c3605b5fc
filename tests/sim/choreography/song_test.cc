#include "sim/choreography/song.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "sim/choreography/canonical_body.h"
#include "tests/sim/choreography/key_poses_shown.h"
#include "tests/sim/choreography/measures.h"
#include "tests/support/kept_answers.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<Song>& AllSongs() {
  static const std::vector<Song> songs = [] {
    std::vector<Song> loaded;
    for (const std::string& name : BuiltinSongNames()) {
      auto song = LoadBuiltinSong(name);
      EXPECT_TRUE(song) << ToString(song.error());
      if (song) loaded.push_back(std::move(*song));
    }
    return loaded;
  }();
  return songs;
}

double Seconds(const Song& song, double beat) { return beat * 60 / song.tempo_bpm; }
double EndBeat(const SongPart& part) { return part.start_beat + part.beats; }

/// Returns the beats at which one move follows another or the ready stance, and at which the last move ends.
std::vector<double> JoinsOf(const Song& song) {
  std::vector<double> joins;
  for (const SongPart& part : song.parts) joins.push_back(part.start_beat);
  joins.push_back(EndBeat(song.parts.back()));
  return joins;
}

/// Returns the largest second difference of a joint, cm per frame².
double JumpAt(const BodyPose& before, const BodyPose& at, const BodyPose& after) {
  double worst = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    worst = std::max(worst, glm::length(before.joints[i] - 2.0 * at.joints[i] + after.joints[i]));
  }
  return 100 * worst;
}

double JumpAt(const BodyMotion& motion, std::size_t frame) {
  return JumpAt(motion.poses[frame - 1], motion.poses[frame], motion.poses[frame + 1]);
}

TEST(BuiltinSongs, AreASlowAMediumAndAFastOneOfEightToTwelveMovesEachTwiceInARow) {
  EXPECT_THAT(BuiltinSongNames(), ::testing::ElementsAre("groove", "sprint", "warm_up"));
  std::vector<double> tempos;
  for (const Song& song : AllSongs()) {
    EXPECT_THAT(BuiltinSongNames(), ::testing::Contains(song.name));
    tempos.push_back(song.tempo_bpm);
    std::set<std::string> different;
    for (const SongPart& part : song.parts) {
      different.insert(part.move);
      EXPECT_GE(part.times, 2) << song.name << " " << part.move;
    }
    EXPECT_GE(different.size(), 8u) << song.name;
    EXPECT_LE(different.size(), 12u) << song.name;
  }
  EXPECT_THAT(tempos, ::testing::ElementsAre(112, 140, 96));
}

TEST(BuiltinSongs, TagEveryRepetitionWithItsMomentOfTheMusic) {
  for (const Song& song : AllSongs()) {
    std::vector<double> moments;
    for (const SongPart& part : song.parts) {
      for (int i = 0; i < part.times; ++i) {
        moments.push_back(Seconds(song, part.start_beat + part.beats * i / part.times));
      }
    }
    ASSERT_EQ(song.tags.size(), moments.size()) << song.name;
    for (std::size_t i = 0; i < moments.size(); ++i) {
      EXPECT_NEAR(song.tags[i].music_s, moments[i], 1e-9) << song.name;
      EXPECT_NEAR(static_cast<double>(song.tags[i].frame) / kJudgedRateHz, moments[i], 0.5 / kJudgedRateHz + 1e-9);
    }
  }
}

TEST(BuiltinSongs, BeginAndEndInTheReadyStance) {
  const BodyPose ready = PoseOf(ReadyStance());
  for (const Song& song : AllSongs()) {
    EXPECT_LT(WorstJointDistance(song.motion.poses.front(), ready), 1e-9) << song.name;
    EXPECT_LT(WorstJointDistance(song.motion.poses.back(), ready), 1e-9) << song.name;
    EXPECT_GE(song.motion.DurationSeconds(), Seconds(song, EndBeat(song.parts.back()))) << song.name;
  }
}

TEST(BuiltinSongs, ShowTheKeyPosesOfEveryRepetition) {
  for (const Song& song : AllSongs()) {
    std::size_t tag = 0;
    for (const SongPart& part : song.parts) {
      const auto move = LoadBuiltinMove(part.move);
      for (int i = 0; i < part.times; ++i, ++tag) {
        const double start = song.tags[tag].music_s;
        const double end = start + Seconds(song, part.beats / part.times);
        EXPECT_TRUE(FirstReached(move->key_poses, song.motion, start, end))
            << song.name << " " << part.move << " " << i;
      }
    }
  }
}

TEST(BuiltinSongs, DanceTheirMovesAsTheyAreBetweenTheJoins) {
  for (const Song& song : AllSongs()) {
    for (const SongPart& part : song.parts) {
      const double pace = part.half_time ? 0.5 : 1;
      ASSERT_OK(move, AtTempo(*LoadBuiltinMove(part.move), pace * song.tempo_bpm, {}));
      const auto frame =
          static_cast<std::size_t>(std::lround(Seconds(song, part.start_beat + 0.5 * part.beats) * kJudgedRateHz));
      const double beat = static_cast<double>(frame) / kJudgedRateHz * song.tempo_bpm / 60;
      const BodyPose alone = PoseOf(move->curves.At(pace * (beat - part.start_beat)));
      EXPECT_LT(WorstJointDistance(song.motion.poses[frame], alone), 1e-6) << song.name << " " << part.move;
    }
  }
}

/// Returns the largest allowed jump at a join: the 95th percentile of the jumps within moves, or 5 % more than
/// `of_neighbours`, the largest jump of the two moves danced alone, whichever is larger.
double AllowedJump(std::vector<double> within, double of_neighbours) {
  std::ranges::sort(within);
  return std::max(within[within.size() * 95 / 100], 1.05 * of_neighbours);
}

TEST(BuiltinSongs, FlowFromMoveToMove) {
  for (const Song& song : AllSongs()) {
    const double beats_per_frame = song.tempo_bpm / 60 / kJudgedRateHz;
    const std::vector<double> joins = JoinsOf(song);
    const auto is_near_a_join = [&](double beat) {
      return std::ranges::any_of(
          joins, [beat](double join) { return beat > join - kBlendBeatsBefore && beat < join + kBlendBeatsAfter; });
    };
    std::vector<double> within;
    for (std::size_t frame = 1; frame + 1 < song.motion.poses.size(); ++frame) {
      const double beat = static_cast<double>(frame) * beats_per_frame;
      if (beat > joins.front() && beat < joins.back() && !is_near_a_join(beat)) {
        within.push_back(JumpAt(song.motion, frame));
      }
    }

    std::vector<Move> moves;
    for (const SongPart& part : song.parts) {
      moves.push_back(AtTempo(*LoadBuiltinMove(part.move), (part.half_time ? 0.5 : 1) * song.tempo_bpm, {}).value());
    }
    double worst_cut = 0;
    for (std::size_t i = 0; i + 1 < moves.size(); ++i) {
      const double join = joins[i + 1];
      // Returns the pose of a move danced alone, `beat` beats of music after the join.
      const auto alone = [&](std::size_t part, double beat) {
        return PoseOf(moves[part].curves.At((song.parts[part].half_time ? 0.5 : 1) * beat));
      };
      double at_join = 0, of_neighbours = 0;
      const auto first = static_cast<std::size_t>(std::ceil((join - kBlendBeatsBefore) / beats_per_frame));
      for (std::size_t frame = first; static_cast<double>(frame) * beats_per_frame <= join + kBlendBeatsAfter;
           ++frame) {
        at_join = std::max(at_join, JumpAt(song.motion, frame));
        const double beat = static_cast<double>(frame) * beats_per_frame - join;
        for (std::size_t part : {i, i + 1}) {
          const double jump =
              JumpAt(alone(part, beat - beats_per_frame), alone(part, beat), alone(part, beat + beats_per_frame));
          of_neighbours = std::max(of_neighbours, jump);
        }
      }
      const double allowed = AllowedJump(within, of_neighbours);
      EXPECT_LE(at_join, allowed) << song.name << ": " << song.parts[i].move << " to " << song.parts[i + 1].move;
      // The control: a cut from one move to the other.
      const double cut = JumpAt(alone(i, -beats_per_frame), alone(i + 1, 0), alone(i + 1, beats_per_frame));
      worst_cut = std::max(worst_cut, cut / allowed);
    }
    EXPECT_GT(worst_cut, 2) << song.name;
  }
}

TEST(BuiltinSongs, NeverSlideOnAStandingFoot) {
  for (const Song& song : AllSongs()) {
    for (Role toe : {Role::kLeftFoot, Role::kRightFoot}) {
      const auto [fastest, down] = FastestSlide(song.motion, toe);
      EXPECT_LT(fastest, kStillMmps) << song.name;
      EXPECT_GT(down, static_cast<int>(song.motion.poses.size() / 3)) << song.name;
    }
  }
  // The control: the same dance, drifting at 1 cm/s.
  BodyMotion drifting = AllSongs().front().motion;
  for (std::size_t i = 0; i < drifting.poses.size(); ++i) {
    drifting.poses[i] = FloorMove{.x = 0.01 * static_cast<double>(i) / kJudgedRateHz}.Apply(drifting.poses[i]);
  }
  EXPECT_GT(FastestSlide(drifting, Role::kLeftFoot).first, kStillMmps);
}

/// Eight moves that suit 96 beats a minute.
constexpr std::string_view kSmallSong = R"(song: small
tempo_bpm: 96
parts:
  - {move: stretch}
  - {move: side_stretch}
  - {move: sway}
  - {move: bird}
  - {move: clap, times: 3}
  - {move: robot}
  - {move: boxing}
  - {move: jump}
)";

std::string With(const std::string& from, const std::string& to) { return testing::Replaced(kSmallSong, from, to); }

TEST(ParseSong, LaysThePartsOutBeatByBeat) {
  ASSERT_OK(song, ParseSong(kSmallSong, "small.yaml"));
  ASSERT_EQ(song->parts.size(), 8u);
  EXPECT_EQ(song->parts[0].start_beat, 4) << "a bar to count in";
  EXPECT_EQ(song->parts[0].beats, 16);
  EXPECT_EQ(song->parts[4].times, 3);
  EXPECT_EQ(song->parts[4].beats, 12);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_EQ(song->parts[i].start_beat, EndBeat(song->parts[i - 1]));
  EXPECT_EQ(song->tags.size(), 17u);
  EXPECT_EQ(song->tags[1].frame, 225u) << "12 beats of 0.625 s";
}

TEST(ParseSong, DancesInHalfTimeWithTwoBeatsForEveryOne) {
  const auto song = ParseSong(With("tempo_bpm: 96", "tempo_bpm: 192"), "small.yaml");
  EXPECT_FALSE(song) << "nothing suits 192 beats a minute";
  std::string yaml = With("tempo_bpm: 96", "tempo_bpm: 180");
  for (std::size_t at = 0; (at = yaml.find('}', at)) != std::string::npos; at += 20) {
    yaml.insert(at, ", half_time: true");
  }
  ASSERT_OK(halved, ParseSong(yaml, "small.yaml"));
  EXPECT_EQ(halved->parts[0].beats, 32);
  EXPECT_NEAR(halved->tags[1].music_s, (4 + 16) * 60.0 / 180, 1e-12);
}

TEST(ParseSong, TellsWhereAndWhatIsWrong) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/sim/choreography/song_complaints.txt", [](const std::string& edit) {
    return testing::Refusal(ParseSong(testing::Edited(std::string(kSmallSong), edit), "small.yaml"));
  }));
}

TEST(ParseSong, RefusesWhatWouldGoOnForEver) {
  std::string yaml(kSmallSong);
  for (int i = 0; i < 20; ++i) yaml += "  - {move: robot, times: 32}\n";
  EXPECT_THAT(testing::Refusal(ParseSong(yaml, "long.yaml")),
              AllOf(HasSubstr("long.yaml:15:"), HasSubstr("at most 600")));
}

TEST(LoadBuiltinSong, NamesTheNearestKnownSong) {
  EXPECT_THAT(testing::Message(LoadBuiltinSong("grove")), HasSubstr("'groove'"));
}

const Move& Boxing() {
  static const Move move = LoadBuiltinMove("boxing").value();
  return move;
}
const Move& Kick() {
  static const Move move = LoadBuiltinMove("side_kick").value();
  return move;
}

/// A bar of waiting, boxing from beat 4, half-time kicks from beat 12, waiting from beat 28.
std::vector<Turn> Turns() {
  return {{.start_beat = 0, .beats = 4},
          {.start_beat = 4, .beats = 8, .move = &Boxing()},
          {.start_beat = 12, .beats = 16, .move = &Kick(), .pace = 0.5},
          {.start_beat = 28, .beats = 4}};
}

double Difference(const Controls& a, const Controls& b) {
  double worst = 0;
  for (std::size_t i = 0; i < kControlCount; ++i) worst = std::max(worst, std::abs(a.values[i] - b.values[i]));
  return worst;
}

TEST(SequenceAt, DancesEachTurnAtItsPaceOutsideTheBlends) {
  const std::vector<Turn> turns = Turns();
  for (double beat : {4.5, 7.3, 11.0}) EXPECT_EQ(SequenceAt(turns, beat).values, Boxing().curves.At(beat - 4).values);
  for (double beat : {12.5, 20.0, 27.0}) {
    EXPECT_EQ(SequenceAt(turns, beat).values, Kick().curves.At(0.5 * (beat - 12)).values);
  }
  EXPECT_GT(Difference(SequenceAt(turns, 11.5), Boxing().curves.At(7.5)), 0.05) << "the control: within a blend";
}

TEST(SequenceAt, BeginsAndEndsInTheReadyStance) {
  for (double beat : {-3.0, 0.0, 32.0, 40.0}) {
    Controls at = SequenceAt(Turns(), beat);
    at[MiddleControl::kHipsDrop] = ReadyStance()[MiddleControl::kHipsDrop];  // the knees follow the music
    EXPECT_LT(Difference(at, ReadyStance()), 1e-12) << beat;
  }
  for (double beat : {0.0, 32.0}) EXPECT_LT(Difference(SequenceAt(Turns(), beat), ReadyStance()), 1e-12);
}

TEST(SequenceAt, HasNoStepInPlaceOrSpeed) {
  const std::vector<Turn> turns = Turns();
  constexpr double kStep = 1e-5;
  double fastest = 0;
  for (double change : {4.0, 12.0, 28.0}) {
    for (double beat : {change - kBlendBeatsBefore, change, change + kBlendBeatsAfter}) {
      const Controls before = SequenceAt(turns, beat - kStep), at = SequenceAt(turns, beat),
                     after = SequenceAt(turns, beat + kStep);
      for (std::size_t i = 0; i < kControlCount; ++i) {
        const double arriving = (at.values[i] - before.values[i]) / kStep;
        const double leaving = (after.values[i] - at.values[i]) / kStep;
        EXPECT_NEAR(arriving, leaving, 0.01) << "control " << i << " at beat " << beat;
        fastest = std::max(fastest, std::abs(leaving));
      }
    }
  }
  EXPECT_GT(fastest, 0.5) << "there must be speed for the comparison to mean anything";
}

TEST(SequenceAt, LeavesTheFeetToOneTurnAtATime) {
  const std::vector<Turn> turns = Turns();
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (SideControl control : {SideControl::kLegFree, SideControl::kLegSide, SideControl::kFootSide,
                                SideControl::kFootAhead, SideControl::kFootLift, SideControl::kFootTurn}) {
      // During the blend, boxing runs on to its beat 8, and the beats of the kick are still negative.
      for (double beat : {11.1, 11.6, 11.99}) {
        EXPECT_EQ(SequenceAt(turns, beat).Of(side, control), Boxing().curves.At(beat - 4).Of(side, control));
      }
      for (double beat : {12.01, 12.3}) {
        EXPECT_EQ(SequenceAt(turns, beat).Of(side, control), Kick().curves.At(0.5 * (beat - 12)).Of(side, control));
      }
    }
  }
}

}  // namespace

}  // namespace etude
