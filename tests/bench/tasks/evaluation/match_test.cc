#include "bench/tasks/evaluation/match.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/evaluation/options.h"
#include "bench/tasks/evaluation/run.h"
#include "bench/tasks/evaluation/side_files.h"
#include "tests/bench/tasks/evaluation/motions.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CellResult ResultOf(const RawMotion& truth, const RawMotion& answer, const std::string& joints = "roles") {
  const auto matched = Match(truth, answer, joints, Lag::kNone);
  EXPECT_TRUE(matched) << ToString(matched.error());
  return JudgeMotion(*matched);
}

TEST(Match, AShiftIsAllThatIsLeftOfAnAnswerAtAnotherRate) {
  RawMotion answer = Gliding(12.5, 26);
  for (glm::dvec3& p : answer.positions) p.x += 0.01;
  const CellResult result = ResultOf(Gliding(30, 60), answer);
  EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 10, 1e-9);
  EXPECT_NEAR(ValueIn(result, "mpjpe_root_mm"), 0, 1e-9);
  EXPECT_NEAR(ValueIn(result, "mpjpe_take_mm"), 0, 1e-9);
  EXPECT_EQ(ValueIn(result, "accel_error_mps2"), -1) << "no accelerations of interpolated frames";
  EXPECT_EQ(ValueIn(result, "seen_share"), 1);
  EXPECT_THAT(result.reason, HasSubstr("20 joints, root hip_centre, 25 frames at 12.5 Hz (the truth has 30 Hz, the "
                                       "answer 12.5 Hz), for which the truth was interpolated"));
}

TEST(Match, AnAnswerThatEndsEarlyIsJudgedWhereItIs) {
  const CellResult result = ResultOf(Gliding(30, 60), Gliding(30, 45));
  EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_NEAR(ValueIn(result, "seen_share"), 0.75, 1e-12);
  EXPECT_THAT(result.reason, HasSubstr("15 frames of the truth outside the answer"));
}

/// Of 60 frames × 20 joints, the answer lacks 6 frames and one joint, and the truth lacks another joint in 30 frames.
TEST(Match, SaysWhatTheMeansLeaveOut) {
  const glm::dvec3 unseen(std::nan(""));
  RawMotion truth = Gliding(30, 60), answer = Gliding(30, 60);
  const auto head = static_cast<std::size_t>(Index(Role::kHead)),
             foot = static_cast<std::size_t>(Index(Role::kLeftFoot));
  for (std::size_t f = 0; f < 60; ++f) {
    answer.positions[f * kRoleCount + head] = unseen;
    if (f < 30) truth.positions[f * kRoleCount + foot] = unseen;
    for (std::size_t j = 0; f >= 54 && j < kRoleCount; ++j) answer.positions[f * kRoleCount + j] = unseen;
  }
  const CellResult result = ResultOf(truth, answer);
  // The truth shows 1200 − 30 positions; of these, the answer lacks 54 of the head and 6 × 20.
  EXPECT_NEAR(ValueIn(result, "seen_share"), 1 - 174.0 / 1170, 1e-12);
  EXPECT_THAT(result.reason, HasSubstr("the truth has no value for 2.5 % of the joints and frames, which no mean "
                                       "includes, the answer has no value for 14.9 % of the joints and frames, which "
                                       "no mean includes, and no joint in 6 of 60 frames, and never shows head"));
  EXPECT_THAT(ResultOf(Gliding(30, 60), Gliding(30, 60)).reason, ::testing::Not(HasSubstr("no value")));
  EXPECT_THAT(ResultOf(Gliding(30, 60), Gliding(30, 45)).reason, ::testing::Not(HasSubstr("no value")))
      << "frames outside the answer have a note of their own";
}

TEST(Match, FramesOfTheAnswerOutsideTheTruthAreSaid) {
  EXPECT_THAT(ResultOf(Gliding(30, 60), Gliding(30, 120)).reason,
              HasSubstr("60 frames of the answer outside the truth"));
  EXPECT_THAT(ResultOf(Gliding(30, 60), Gliding(60, 240)).reason,
              HasSubstr("120 frames of the answer outside the truth"));
  RawMotion truth = Gliding(30, 60), answer = Gliding(30, 60);
  truth.start_s = 10;
  answer.start_s = 9;
  EXPECT_THAT(ResultOf(truth, answer).reason, HasSubstr("30 frames of the answer outside the truth, 30 frames of the"));
  for (const RawMotion& same : {Gliding(30, 60), Gliding(12.5, 26), Gliding(60, 120), Gliding(30, 30)}) {
    EXPECT_THAT(ResultOf(Gliding(30, 60), same).reason, ::testing::Not(HasSubstr("outside the truth")));
  }
}

TEST(Match, ABodyOfAnotherSizeIsRightOnceScaled) {
  RawMotion answer = Gliding(30, 10);
  for (glm::dvec3& p : answer.positions) p *= 1.1;
  const CellResult result = ResultOf(Gliding(30, 10), answer);
  EXPECT_GT(ValueIn(result, "mpjpe_root_mm"), 10);
  for (const char* id : {"mpjpe_root_scaled_mm", "mpjpe_first_frame_scaled_mm", "mpjpe_take_scaled_mm",
                         "mpjpe_each_frame_scaled_mm", "wa_mpjpe_mm@wham"}) {
    EXPECT_NEAR(ValueIn(result, id), 0, 1e-9) << id;
  }
}

TEST(Match, ATurnedAndMovedBodyIsRightOnceMoved) {
  RawMotion answer = Gliding(30, 10);
  for (glm::dvec3& p : answer.positions) p = {p.z + 2, p.y, -p.x};
  const CellResult result = ResultOf(Gliding(30, 10), answer);
  EXPECT_GT(ValueIn(result, "mpjpe_unaligned_mm"), 1000);
  for (const char* id : {"mpjpe_first_frame_mm", "mpjpe_take_mm", "mpjpe_each_frame_mm", "rte@wham"}) {
    EXPECT_NEAR(ValueIn(result, id), 0, 1e-9) << id;
  }
}

TEST(Match, JudgesWhatBothHaveOfASet) {
  RawMotion answer = Gliding(30, 3);
  answer.roles[Index(Role::kLeftElbow)] = -1;
  answer.joints[Index(Role::kLeftElbow)] = "something";
  const auto matched = Match(Gliding(30, 3), answer, "lsp-14", Lag::kNone);
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->joints.size(), 13u);
  EXPECT_THAT(matched->lacking, ElementsAre("left_elbow"));
  EXPECT_NEAR(ValueIn(JudgeMotion(*matched), "seen_share"), 13.0 / 14, 1e-12) << "of the joints that the truth shows";
  EXPECT_EQ(matched->bends.size(), 3u) << "both knees, and the right elbow";
  const std::size_t sizes[] = {0, 0, 20, 17, 17, 22, 24, 14};
  const auto sets = JointSetNames();
  ASSERT_EQ(sets.size(), std::size(sizes));
  for (std::size_t i = 0; i < sets.size(); ++i) EXPECT_EQ(JointsOfSet(sets[i]).size(), sizes[i]) << sets[i];
}

TEST(Match, EqualNamesArePairedWhateverTheirRoles) {
  RawMotion truth = Gliding(30, 3), answer = Gliding(30, 3);
  truth.joints[0] = answer.joints[5] = "mine";
  const auto matched = Match(truth, answer, "same", Lag::kNone);
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->joints.front(), "mine");
  EXPECT_EQ(matched->joints.size(), 19u);
  EXPECT_GT(ValueIn(JudgeMotion(*matched), "mpjpe_unaligned_mm"), 0);
  // A point that the file does not name is compared by its role alone: an End Site, the middle of the hips.
  truth.added = {1, static_cast<int>(Index(Role::kHead))};
  EXPECT_EQ(Match(truth, answer, "same", Lag::kNone)->joints.size(), 17u);
  EXPECT_EQ(Match(truth, answer, "roles", Lag::kNone)->joints.size(), 20u);
}

TEST(Match, TheRootIsTheFilesOwnIfBothHaveOneElseTheMiddleOfTheHips) {
  // Only the answer's pelvis is 37 mm too high.
  const auto pelvis = static_cast<std::size_t>(Index(Role::kHipCentre));
  RawMotion truth = Gliding(30, 5), answer = truth;
  for (std::size_t at = pelvis; at < answer.positions.size(); at += kRoleCount) answer.positions[at].y += 0.037;
  CellResult own = ResultOf(truth, answer, "lsp-14");
  EXPECT_NEAR(ValueIn(own, "mpjpe_root_mm"), 37, 1e-9) << "every joint but the pelvis, which is not judged";
  EXPECT_THAT(own.reason, HasSubstr("14 joints, root hip_centre, 5 frames"));
  EXPECT_NEAR(ValueIn(ResultOf(truth, answer), "mpjpe_root_mm"), 37 * 19.0 / 20, 1e-9);
  // If one file has no pelvis, the middle of the hips replaces it in both files; there the two agree.
  truth.joints[pelvis] = "(none)";
  truth.roles[pelvis] = -1;
  AddMidwayHips(truth);
  for (const auto& [a, b] : {std::pair(truth, answer), {answer, truth}}) {
    own = ResultOf(a, b);
    EXPECT_NEAR(ValueIn(own, "mpjpe_root_mm"), 0, 1e-9);
    EXPECT_NEAR(ValueIn(own, "mpjpe_unaligned_mm"), 0, 1e-9) << "hip_centre is the root";
    EXPECT_THAT(own.reason, HasSubstr("20 joints, root midway between the hips"));
  }
}

/// Returns the motion as a file's skeleton with other joint names: "Chest" plays the spine, and the End Site "Head_End"
/// plays the head.
RawMotion AsSkeleton(const RawMotion& motion) {
  RawMotion own = motion;
  for (const Role role : AllRoles()) own.joints[Index(role)] = "bone " + std::to_string(Index(role));
  own.joints[Index(Role::kSpine)] = "Chest";
  own.joints[Index(Role::kHead)] = "Head_End";
  own.parents.assign(own.joints.size(), 0);
  own.parents[0] = -1;
  own.added = {static_cast<int>(Index(Role::kHead))};
  return own;
}

TEST(Match, MarkersNamedAsASkeletonsJointsHaveTheirRoles) {
  const RawMotion truth = AsSkeleton(Gliding(30, 5));
  // The same points without the End Site. The answer's "spine" is the head's point, 40 cm from the skeleton's spine.
  RawMotion answer = truth;
  answer.parents.clear();
  answer.added.clear();
  answer.joints[Index(Role::kHead)] = "spine";
  answer.roles = RawMotion::NoRoles();
  answer.roles[Index(Role::kSpine)] = static_cast<int>(Index(Role::kHead));
  for (glm::dvec3& p : answer.positions) p.x += 0.012;
  for (const auto& [a, b] : {std::pair(truth, answer), {answer, truth}}) {
    const CellResult result = ResultOf(a, b);
    EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 12, 1e-9);
    EXPECT_NEAR(ValueIn(result, "mpjpe_root_mm"), 0, 1e-9);
    EXPECT_THAT(result.reason, HasSubstr("19 joints (not found in both files: head), root bone 0"));
  }
  // If one joint has no namesake, the answer's names are not the skeleton's names. Only the role spine is then common,
  // and one joint is too few.
  answer.joints[Index(Role::kLeftKnee)] = "knee";
  EXPECT_THAT(testing::Refusal(Match(truth, answer, "roles", Lag::kNone)),
              HasSubstr("has 1 joint in common with the truth (joints: roles); its joints are bone 0, Chest, "));
}

TEST(Match, NamesJointsThatBothFilesContainButThatAreNotJudged) {
  RawMotion truth = Gliding(30, 5);
  truth.joints[Index(Role::kSpine)] = "Torso";
  truth.roles[Index(Role::kSpine)] = -1;
  EXPECT_THAT(ResultOf(truth, truth).reason,
              HasSubstr("19 joints (not found in both files: spine), both files also contain "
                        "Torso, which are not judged (--joints same judges them), root"));
  EXPECT_THAT(ResultOf(truth, truth, "same").reason, ::testing::StartsWith("20 joints, root"));
  EXPECT_THAT(ResultOf(truth, Gliding(30, 5)).reason, HasSubstr("(not found in both files: spine), root"));
}

/// 120 beats a minute during a motion of 60 s: every 21.5 frames of librosa, or 15 frames of the motion.
TEST(MusicBeats, InAnotherUnitThanSecondsAreDoubted) {
  const auto doubt = [](double step, double count) {
    std::vector<double> beats;
    for (int i = 0; i < count; ++i) beats.push_back(step * (0.3 + i));
    return DoubtOnBeats(beats, 60, 30);
  };
  EXPECT_THAT(doubt(22050.0 / 512 / 2, 119), HasSubstr("are they frames of librosa (512 samples at 22050 Hz) instead"));
  EXPECT_THAT(doubt(15, 119),
              HasSubstr("15 s apart and end at 1774 s, after the motion's end (60 s): are they frames of "
                        "the motion (30 Hz) instead of seconds?"));
  EXPECT_THAT(doubt(500, 119), HasSubstr("are they milliseconds instead"));
  for (const auto& [step, count] : {std::pair(0.5, 119), {0.5, 400}, {2.0, 60}, {4.0, 14}, {4.0, 60}, {70.0, 1}}) {
    EXPECT_EQ(doubt(step, count), "") << step << " s, " << count;
  }
}

// Beats that were written by a clock that began before the motion would silently give another value.
TEST(MusicBeats, AreSaidToCountFromTheTruthsFirstFrame) {
  RawMotion truth = Gliding(30, 5);
  const EvaluationSideData side{.music_beats_s = std::vector{0.1, 0.6}};
  const auto reason = [&] { return JudgeMotion(*Match(truth, truth, "roles", Lag::kNone), side).reason; };
  EXPECT_THAT(reason(), ::testing::Not(HasSubstr("the music's beats")));
  truth.start_s = 60;
  EXPECT_THAT(reason(), HasSubstr("counted from the truth's first frame, which is at 60 s of its clock"));
  EXPECT_THAT(JudgeMotion(*Match(truth, truth, "roles", Lag::kNone), {}).reason,
              ::testing::Not(HasSubstr("the music's beats")));
}

TEST(Match, FewJointsAreRefusedIfTheFilesNameManyMore) {
  const RawMotion truth = Gliding(30, 5);
  const auto only = [&](std::size_t with_role, std::size_t without) {
    RawMotion motion = truth;
    for (std::size_t i = with_role; i < kRoleCount; ++i) motion.roles[i] = -1;
    std::vector<glm::dvec3> kept;
    for (std::size_t f = 0; f < 5; ++f) {
      for (std::size_t i = 0; i < with_role + without; ++i) kept.push_back(truth.At(f, i));
    }
    motion.joints.resize(with_role + without);
    motion.positions = kept;
    return motion;
  };
  EXPECT_EQ(Match(truth, only(3, 0), "roles", Lag::kNone)->joints.size(), 3u) << "head and hands, say";
  EXPECT_EQ(Match(truth, only(3, 3), "roles", Lag::kNone)->joints.size(), 3u) << "half of the names";
  EXPECT_EQ(Match(truth, only(12, 8), "roles", Lag::kNone)->joints.size(), 12u);
  EXPECT_THAT(testing::Refusal(Match(truth, only(3, 4), "roles", Lag::kNone)),
              HasSubstr("only 3 joints in common with the truth (joints: roles); its joints are hip_centre, "));
  EXPECT_THAT(testing::Refusal(Match(only(3, 4), truth, "roles", Lag::kNone)),
              HasSubstr("only 3 joints in common with the answer (joints: roles)"));
  EXPECT_EQ(Match(truth, only(3, 4), "same", Lag::kNone)->joints.size(), 7u) << "by name, all take part";
}

TEST(Match, AJointThatIsAnotherPointOfTheBodyIsNamed) {
  const auto off_by = [](Role role, double metres, double all) {
    RawMotion motion = Gliding(30, 30);
    unsigned state = 7;
    for (std::size_t at = 0; at < motion.positions.size(); ++at) {
      state = state * 1664525u + 1013904223u;
      motion.positions[at].x += all * (0.5 + static_cast<double>(state >> 8) / 16777216.0);
      if (at % kRoleCount == static_cast<std::size_t>(Index(role))) motion.positions[at].y += metres;
    }
    return motion;
  };
  const auto doubts_on = [](const RawMotion& answer) {
    return Match(Gliding(30, 30), answer, "roles", Lag::kNone)->doubts;
  };
  const auto said = HasSubstr(
      "head 101 mm away from the truth in all frames (median joint 9.9 mm): is it the same point in both files?");
  EXPECT_THAT(doubts_on(off_by(Role::kHead, 0.1, 0.01)), ElementsAre(said));
  // This is not asked if the whole body is displaced, or if the joint is displaced in some frames only.
  const auto silent = ::testing::Not(::testing::Contains(HasSubstr("the same point")));
  EXPECT_THAT(doubts_on(off_by(Role::kHead, 0.1, 0.1)), silent);
  RawMotion flickering = off_by(Role::kHead, 0, 0.01);
  for (std::size_t f = 0; f < 30; f += 2) flickering.positions[f * kRoleCount + Index(Role::kHead)].y += 0.4;
  EXPECT_THAT(doubts_on(flickering), silent);
}

TEST(Match, FailsWithoutACommonJointOrAnySeen) {
  RawMotion others = Gliding(30, 3);
  others.roles = RawMotion::NoRoles();
  for (std::string& name : others.joints) name += "_x";
  const auto none = Match(Gliding(30, 3), others, "roles", Lag::kNone);
  ASSERT_FALSE(none);
  EXPECT_THAT(ToString(none.error()), HasSubstr("no joint in common"));
  RawMotion blind = Gliding(30, 3);
  for (glm::dvec3& p : blind.positions) p = NotSeen();
  const auto unseen = Match(Gliding(30, 3), blind, "roles", Lag::kNone);
  ASSERT_FALSE(unseen);
  EXPECT_THAT(ToString(unseen.error()), HasSubstr("ever seen in both motions"));
}

TEST(Match, HEAVY_FindsALagToAFractionOfAFrame) {
  unsigned state = 61;
  for (const double late_s : {0.0, 0.0123, 0.31, -0.4567}) {
    for (const double rate_hz : {30.0, 24.0}) {
      // The answer is moved, turned, 10 % larger, and has noise of some millimetres.
      RawMotion answer = Swaying(rate_hz, 150, late_s);
      for (glm::dvec3& p : answer.positions) {
        p = 1.1 * glm::dvec3(p.z + 2, p.y, -p.x);
        for (int k = 0; k < 3; ++k) {
          state = state * 1664525u + 1013904223u;
          p[k] += 0.006 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
        }
      }
      const RawMotion truth = Swaying(30, 150, 0);
      const auto matched = Match(truth, answer, "roles", Lag::kFind);
      ASSERT_TRUE(matched) << ToString(matched.error());
      ASSERT_TRUE(matched->lag && matched->lag->half_width_s);
      EXPECT_NEAR(matched->lag->shift_s, late_s, 0.0005) << "a sixtieth of a frame";
      EXPECT_LT(std::abs(matched->lag->shift_s - late_s), 3 * *matched->lag->half_width_s);
      EXPECT_LT(*matched->lag->half_width_s, 0.001);
      const CellResult with = JudgeMotion(*matched), without = ResultOf(truth, answer);
      EXPECT_LT(ValueIn(with, "mpjpe_take_scaled_mm"), 7);
      if (std::abs(late_s) > 0.1) {
        EXPECT_GT(ValueIn(without, "mpjpe_take_scaled_mm"), 20);
      }
      EXPECT_NEAR(ValueIn(with, "lag_ms"), 1000 * matched->lag->shift_s, 1e-9);
      EXPECT_THAT(with.reason, HasSubstr("which was removed"));
    }
  }
}

TEST(Match, SaysThatALagCannotBeTold) {
  // For a gliding body, a shift in time and a shift in place look the same, so no lag is reported.
  for (const RawMotion& truth : {Gliding(30, 90), Swaying(30, 3, 0)}) {
    const auto matched = Match(truth, truth, "roles", Lag::kFind);
    ASSERT_FALSE(matched);
    EXPECT_THAT(ToString(matched.error()), HasSubstr("no lag within ±2 s is found"));
  }
  // At every lag, another motion explains little of the truth.
  RawMotion other = Swaying(30, 150, 0);
  unsigned state = 7;
  for (glm::dvec3& p : other.positions) {
    for (int k = 0; k < 3; ++k) {
      state = state * 1664525u + 1013904223u;
      p[k] += 0.6 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
    }
  }
  const auto matched = Match(Swaying(30, 150, 0), other, "roles", Lag::kFind);
  ASSERT_FALSE(matched);
  EXPECT_THAT(ToString(matched.error()), HasSubstr("the answer moves differently at every lag"));
}

TEST(JudgeMotion, TakesStatisticsAndBeats) {
  const auto matched = Match(Swaying(30, 90, 0), Swaying(30, 90, 0.02), "roles", Lag::kNone);
  ASSERT_TRUE(matched);
  EXPECT_EQ(ValueIn(JudgeMotion(*matched), "l2p@lafan1"), -1);
  std::string heading, means, deviations;
  for (const std::string& joint : matched->joints) {
    for (const char* axis : {"x", "y", "z"}) {
      heading += (heading.empty() ? "" : ",") + joint + "_" + axis + "_m";
      means += (means.empty() ? "" : ",") + std::string("0.5");
      deviations += (deviations.empty() ? "" : ",") + std::string("0.1");
    }
  }
  EvaluationSideData side;
  const auto statistics = ReadJointStatistics(heading + "\n" + means + "\n" + deviations + "\n", "s.csv");
  ASSERT_TRUE(statistics) << ToString(statistics.error());
  side.statistics = *statistics;
  const auto beats = ReadMusicBeats("0.5\n1.0\n1.5\n", "b.txt");
  ASSERT_TRUE(beats);
  side.music_beats_s = *beats;
  const CellResult result = JudgeMotion(*matched, side);
  // The means cancel, and all deviations are 0.1 m. So a frame's distance is the norm of all its differences in tenths
  // of a metre.
  double sum = 0;
  for (std::size_t f = 0; f < 90; ++f) {
    double square = 0;
    for (std::size_t j = 0; j < matched->joints.size(); ++j) {
      const glm::dvec3 off = matched->pair.found.Frame(f)[j] - matched->pair.truth.Frame(f)[j];
      square += glm::dot(off, off);
    }
    sum += std::sqrt(square) / 0.1 / 90;
  }
  EXPECT_NEAR(ValueIn(result, "l2p@lafan1"), sum, 1e-9);
  EXPECT_GT(ValueIn(result, "beat_alignment@bailando"), 0);
  // A joint that the statistics lack is named.
  side.statistics->erase("head");
  const CellResult lacking = JudgeMotion(*matched, side);
  EXPECT_TRUE(std::ranges::any_of(lacking.metrics, [](const MetricValue& metric) {
    return metric.id == "l2p@lafan1" && !metric.value && metric.null_reason.find("head") != std::string::npos;
  }));
}

TEST(SideFiles, AreRefusedWithTheLine) {
  const auto told = [](const auto& result) { return result ? std::string("read") : ToString(result.error()); };
  EXPECT_THAT(told(ReadJointStatistics("a_x_m,a_y_m,a_z_m\n1,2,3\n1,0,1\n", "s.csv")), HasSubstr("s.csv:3"));
  EXPECT_THAT(told(ReadJointStatistics("a_x_m,a_z_m,a_y_m\n1,2,3\n1,1,1\n", "s.csv")), HasSubstr("a_z_m"));
  EXPECT_THAT(told(ReadJointStatistics("a_x_m,a_y_m\n1,2\n1,1\n", "s.csv")), HasSubstr("2 coordinates; needed: three"));
  EXPECT_THAT(told(ReadJointStatistics("1,2,3\n1,1,1\n", "s.csv")), HasSubstr("allowed: a heading"));
  EXPECT_THAT(told(ReadMusicBeats("1\n3\n2\n", "b.txt")), HasSubstr("b.txt:3"));
  EXPECT_THAT(told(ReadMusicBeats("1 2\n", "b.txt")), HasSubstr("allowed: one"));
}

TEST(Match, TimesOfOneClockBelongTogether) {
  const auto begins = [](double start_s, std::size_t frames, double rate_hz = 30) {
    RawMotion motion = Gliding(rate_hz, frames);
    motion.start_s = start_s;
    return motion;
  };
  const auto moved = [](RawMotion motion, double seconds) {
    for (glm::dvec3& p : motion.positions) p.z += 0.3 * seconds;
    return motion;
  };
  const RawMotion truth = begins(10, 60);
  // By its clock, the answer begins a second later.
  const CellResult later = ResultOf(truth, moved(begins(11, 30), 1));
  EXPECT_NEAR(ValueIn(later, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_EQ(ValueIn(later, "seen_share"), 0.5);
  EXPECT_THAT(later.reason,
              HasSubstr("the truth begins at 10 s, the answer begins at 11 s: judged by these clocks (--lag find "
                        "searches the lag), 30 frames of the truth outside the answer"));
  EXPECT_THAT(ResultOf(begins(1.7e9, 60), begins(1.7e9 + 1.25, 30)).reason,
              HasSubstr("the truth begins at 1700000000 s, the answer begins at 1700000001.25 s: judged by"));
  // The answer begins before the truth by a fraction of a frame, and has another rate.
  EXPECT_NEAR(ValueIn(ResultOf(truth, moved(begins(9.5, 90), -0.5)), "mpjpe_unaligned_mm"), 0, 1e-9);
  const CellResult between = ResultOf(truth, moved(begins(10.01, 60), 0.01));
  EXPECT_NEAR(ValueIn(between, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_THAT(
      between.reason,
      HasSubstr(
          "at 30 Hz, for which the truth was interpolated, so acceleration errors have no value, the truth begins "
          "at 10 s, the answer begins at 10.01 s: judged by these clocks"));
  EXPECT_NEAR(ValueIn(ResultOf(truth, moved(begins(10.5, 50, 50), 0.5)), "mpjpe_unaligned_mm"), 0, 1e-9);
  // If a clock is missing, or the two have no time in common, the first frames are matched.
  const CellResult none = ResultOf(truth, Gliding(30, 60));
  EXPECT_NEAR(ValueIn(none, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_THAT(none.reason,
              HasSubstr("the truth begins at 10 s, the answer states no clock: their first frames are taken "
                        "as simultaneous"));
  const CellResult apart = ResultOf(truth, begins(0, 60));
  EXPECT_NEAR(ValueIn(apart, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_THAT(apart.reason, HasSubstr("begins at 0 s: their first frames are taken as simultaneous"));
  // Clocks that agree to their printed digits give no note.
  for (const RawMotion& same : {begins(10, 60), begins(10.003, 60)}) {
    const CellResult result = ResultOf(truth, same);
    EXPECT_EQ(ValueIn(result, "mpjpe_unaligned_mm"), 0);
    EXPECT_THAT(result.reason, ::testing::Not(HasSubstr("begins")));
  }
  // A lag is searched in addition to the clocks.
  RawMotion dancing = begins(10, 90), late = begins(10.5, 90);
  const auto wave = [](double t) { return 0.2 * std::sin(5 * t) + 0.1 * std::sin(7.3 * t); };
  const std::size_t hand = Index(Role::kLeftHand), joints = dancing.joints.size();
  for (std::size_t f = 0; f < 90; ++f) {
    dancing.positions[f * joints + hand].y += wave(static_cast<double>(f) / 30);
    late.positions[f * joints + hand].y += wave(static_cast<double>(f) / 30 + 0.4);
  }
  const auto found = Match(dancing, late, "roles", Lag::kFind);
  ASSERT_TRUE(found) << ToString(found.error());
  EXPECT_NEAR(found->lag->shift_s, 0.1, 0.005);
  // The same holds if the answer is the last three seconds of a long truth.
  RawMotion whole = begins(10, 600), part = begins(27, 90);
  for (std::size_t f = 0; f < 600; ++f) whole.positions[f * joints + hand].y += wave(static_cast<double>(f) / 30);
  for (std::size_t f = 0; f < 90; ++f) part.positions[f * joints + hand].y += wave(static_cast<double>(f) / 30 + 16.9);
  const auto of_part = Match(whole, part, "roles", Lag::kFind);
  ASSERT_TRUE(of_part) << ToString(of_part.error());
  EXPECT_NEAR(of_part->lag->shift_s, 0.1, 0.005);
}

TEST(JudgeMotion, ReportsEveryMetricOfTheTask) {
  const CellResult result = ResultOf(Gliding(30, 1), Gliding(30, 1));  // too short for most metrics
  for (const std::string& id : EvaluationMetrics()) {
    EXPECT_NE(ValueIn(result, id), -2) << id;
    EXPECT_NE(FindMetric(id), nullptr) << id;
  }
  EXPECT_EQ(result.metrics.size(), EvaluationMetrics().size());
}

TEST(Match, RefusesMotionsThatNeverShowAJoint) {
  RawMotion hidden = Swaying(30, 60, 0);
  hidden.roles = RawMotion::NoRoles();  // readers give no roles to joints that are never seen
  for (glm::dvec3& p : hidden.positions) p = glm::dvec3(std::nan(""));
  for (const bool is_truth : {true, false}) {
    const auto refused =
        Match(is_truth ? hidden : Swaying(30, 60, 0), is_truth ? Swaying(30, 60, 0) : hidden, "roles", Lag::kNone);
    EXPECT_THAT(testing::Refusal(refused), HasSubstr("shows no joint in any frame"));
  }
}

TEST(Match, NamesTheSearchForTheLagOnlyIfItWasNotMade) {
  RawMotion truth = Swaying(30, 150, 0), answer = Swaying(30, 150, 0.2);
  truth.start_s = 10;
  answer.start_s = 10.5;
  for (const Lag lag : {Lag::kNone, Lag::kFind}) {
    ASSERT_OK(matched, Match(truth, answer, "roles", lag));
    EXPECT_THAT(matched->note, HasSubstr("judged by these clocks"));
    EXPECT_EQ(matched->note.find("--lag find") == std::string::npos, lag == Lag::kFind) << matched->note;
  }
}

// Doubts about truth and answer together (DoubtsOnPair).

std::vector<std::string> Doubts(const RawMotion& truth, const RawMotion& answer, Lag lag = Lag::kNone) {
  const auto matched = Match(truth, answer, "roles", lag);
  EXPECT_TRUE(matched) << ToString(matched.error());
  return matched->doubts;
}

RawMotion Changed(RawMotion motion, const std::function<glm::dvec3(glm::dvec3)>& change) {
  for (glm::dvec3& p : motion.positions) p = change(p);
  return motion;
}

/// Returns `motion` with an error of at most `size_m` in each coordinate, which differs from joint to joint and from
/// frame to frame.
RawMotion WithErrors(RawMotion motion, double size_m) {
  double at = 0;
  return Changed(std::move(motion), [&](const glm::dvec3& p) {
    at += 1;
    return p + size_m * glm::dvec3(std::sin(12.9 * at), std::sin(78.2 * at), std::sin(37.7 * at));
  });
}

/// Returns the motion in reverse.
RawMotion Reversed(const RawMotion& motion) {
  RawMotion reversed = motion;
  const std::size_t joints = motion.joints.size(), frames = motion.FrameCount();
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) reversed.positions[f * joints + j] = motion.At(frames - 1 - f, j);
  }
  return reversed;
}

TEST(DoubtsOnPair, AreNoneOfAnswersThatAreOnlyWrong) {
  const RawMotion truth = Swaying(30, 150, 0);
  EXPECT_THAT(Doubts(truth, truth), IsEmpty());
  for (const double size_m : {0.01, 0.1, 0.5}) EXPECT_THAT(Doubts(truth, WithErrors(truth, size_m)), IsEmpty());
  // A part of the truth, and another rate, which the file states.
  EXPECT_THAT(Doubts(truth, Swaying(30, 60, 0)), IsEmpty());
  EXPECT_THAT(Doubts(truth, Swaying(120, 600, 0)), IsEmpty());
  // A body that stands still fits at every time.
  EXPECT_THAT(Doubts(truth, Gliding(30, 150)), IsEmpty());
  EXPECT_THAT(Doubts(Gliding(30, 150), WithErrors(Gliding(30, 150), 0.1)), IsEmpty());
  // A kick that the answer misses, after standing still: the part before it fits at every time.
  RawMotion kick = Gliding(30, 120);
  const auto foot = static_cast<std::size_t>(kick.roles[Index(Role::kLeftFoot)]);
  for (std::size_t f = 0; f < 40; ++f) {
    kick.positions[(80 + f) * kick.joints.size() + foot] += glm::dvec3(0, 0.02, 0.03) * static_cast<double>(f);
  }
  EXPECT_THAT(Doubts(kick, WithErrors(Gliding(30, 120), 0.005)), IsEmpty());
  EXPECT_THAT(Doubts(kick, WithErrors(Gliding(30, 50), 0.005)), IsEmpty());
  EXPECT_THAT(Doubts(Reversed(kick), WithErrors(Gliding(30, 50), 0.005)), IsEmpty());
  // The motion in reverse, and one whose limbs sway at other times.
  RawMotion other = Reversed(truth);
  EXPECT_THAT(Doubts(truth, other), IsEmpty());
  for (std::size_t j = 0; j < truth.joints.size(); ++j) {
    const RawMotion late = Swaying(30, 150, 0.7 * static_cast<double>(j));
    for (std::size_t f = 0; f < 150; ++f) {
      other.positions[f * truth.joints.size() + j] = late.At(f, j);
    }
  }
  EXPECT_THAT(Doubts(truth, other), IsEmpty());
}

TEST(DoubtsOnPair, NameARootThatStaysAtTheOrigin) {
  const RawMotion truth = Swaying(30, 60, 0);
  const auto hip = static_cast<std::size_t>(truth.roles[Index(Role::kHipCentre)]);
  RawMotion answer = truth;
  for (std::size_t f = 0; f < 60; ++f) {
    for (std::size_t j = 0; j < truth.joints.size(); ++j) {
      answer.positions[f * truth.joints.size() + j] -= truth.At(f, hip);
    }
  }
  EXPECT_THAT(Doubts(truth, answer), ElementsAre(HasSubstr("the root of the answer stays at the origin")));
  EXPECT_THAT(Doubts(answer, truth), ElementsAre(HasSubstr("the root of the truth stays at the origin")));
  EXPECT_THAT(Doubts(answer, answer), IsEmpty());
}

TEST(DoubtsOnPair, NameTheAxesThatFit) {
  const RawMotion truth = Swaying(30, 60, 0);
  // The truth's X is the answer's Z, and the truth's Z is the answer's −X.
  const auto turned = WithErrors(Changed(truth, [](const glm::dvec3& p) { return glm::dvec3(-p.z, p.y, p.x); }), 0.01);
  EXPECT_THAT(Doubts(truth, turned),
              ElementsAre(HasSubstr("seem to point along the truth's −Z, Y, X: with these axes")));
  const auto round = Changed(truth, [](const glm::dvec3& p) { return glm::dvec3(3 - p.x, p.y, -p.z); });
  EXPECT_THAT(Doubts(truth, round), ElementsAre(HasSubstr("along the truth's −X, Y, −Z")));
  RawMotion doubted = truth;
  doubted.Doubt("freezes");
  EXPECT_THAT(Doubts(doubted, round), ElementsAre(HasSubstr("along the truth's −X, Y, −Z")));
  // A doubt about the up axis of a file is not said twice.
  const auto lying = Changed(truth, [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); });
  EXPECT_THAT(Doubts(truth, lying), ElementsAre(HasSubstr("along the truth's X, −Z, Y")));
  EXPECT_THAT(Doubts(doubted, lying), IsEmpty());
}

TEST(DoubtsOnPair, NameTheDisplacementOfAllPositions) {
  const RawMotion truth = Swaying(30, 60, 0);
  const auto raised = Changed(truth, [](const glm::dvec3& p) { return p + glm::dvec3(0, 1.04, -0.25); });
  EXPECT_THAT(Doubts(truth, raised),
              ElementsAre(HasSubstr("all of the answer is displaced by (0.000, 1.040, -0.250) m")));
  EXPECT_THAT(Doubts(truth, WithErrors(raised, 0.03)), ElementsAre(HasSubstr("all of the answer is displaced by")));
  // A displacement that errors hide, and a small one, are not doubted.
  EXPECT_THAT(Doubts(truth, WithErrors(raised, 0.3)), IsEmpty());
  EXPECT_THAT(Doubts(truth, Changed(truth, [](const glm::dvec3& p) { return p + glm::dvec3(0, 0.04, 0); })), IsEmpty());
}

TEST(DoubtsOnPair, NameTheHeadingAndTheSizeOfAllPositions) {
  const RawMotion truth = Swaying(30, 60, 0);
  // A turn about Y with cosine 0.8 takes Z towards X, or X towards Z.
  for (const double sine : {0.6, -0.6}) {
    const auto turned = Changed(truth, [&](const glm::dvec3& p) {
      return glm::dvec3(0.8 * p.x + sine * p.z + 2, p.y, 0.8 * p.z - sine * p.x);
    });
    const std::string turn = sine > 0 ? "turned by 37° about Y:" : "turned by -37° about Y:";
    EXPECT_THAT(Doubts(truth, turned), ElementsAre(HasSubstr(turn)));
    EXPECT_THAT(Doubts(truth, WithErrors(turned, 0.03)), ElementsAre(HasSubstr(turn)));
    EXPECT_THAT(Doubts(truth, WithErrors(turned, 0.3)), IsEmpty());
    const auto small = Changed(turned, [](const glm::dvec3& p) { return 0.8 * p; });
    EXPECT_THAT(Doubts(truth, small), ElementsAre(HasSubstr("° about Y and 0.800 times as large:")));
  }
  const auto leaning =
      Changed(truth, [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.8 * p.y - 0.6 * p.z, 0.8 * p.z + 0.6 * p.y); });
  EXPECT_THAT(Doubts(truth, leaning), ElementsAre(HasSubstr("turned by 37°, and its up axis leans by 37°:")));
  const auto large = Changed(truth, [](const glm::dvec3& p) { return 1.1 * p; });
  EXPECT_THAT(Doubts(truth, large), ElementsAre(HasSubstr("all of the answer is 1.100 times as large:")));
  // A doubt about the up axis of a file is not said twice; and a small difference is none.
  RawMotion doubted = truth;
  doubted.Doubt("freezes");
  EXPECT_THAT(Doubts(doubted, leaning), IsEmpty());
  EXPECT_THAT(Doubts(truth, Changed(truth, [](const glm::dvec3& p) { return 1.01 * p; })), IsEmpty());
}

TEST(DoubtsOnPair, NameALateAndAnEarlyAnswer) {
  const RawMotion truth = Swaying(30, 150, 0);
  EXPECT_THAT(Doubts(truth, Swaying(30, 150, 0.5)), ElementsAre(HasSubstr("the answer seems to be 0.5 s late")));
  EXPECT_THAT(Doubts(truth, WithErrors(Swaying(120, 600, -0.2), 0.01)),
              ElementsAre(HasSubstr("the answer seems to be 0.2 s early")));
  // With errors, neighbours of the true shift fit nearly as well; the best one counts, not the smallest.
  EXPECT_THAT(Doubts(Swaying(120, 600, 0), WithErrors(Swaying(120, 600, 0.25), 0.02)),
              ElementsAre(AllOf(HasSubstr("the answer seems to be 0.25 s late"), HasSubstr("--lag find"))));
  EXPECT_THAT(Doubts(truth, Swaying(30, 150, 0.5), Lag::kFind), IsEmpty()) << "the lag was removed";
  EXPECT_THAT(Doubts(Swaying(120, 600, 0), Swaying(30, 150, 0.012)), IsEmpty()) << "less than a frame";
  // The lag adds to the offset of the files' clocks, which may be longer than the longest lag.
  RawMotion begin = Swaying(30, 300, 0), later = Swaying(30, 210, 0.5 - 3);
  begin.start_s = 60;
  later.start_s = 63;
  EXPECT_THAT(Doubts(begin, later), ElementsAre(HasSubstr("the answer seems to be 0.5 s late")));
}

TEST(DoubtsOnPair, NameNoLagIfMuchIsLeft) {
  const auto large = [](const glm::dvec3& p) { return 4.0 * p; };
  const RawMotion truth = Changed(Swaying(30, 150, 0), large), late = Changed(Swaying(30, 150, 0.5), large);
  EXPECT_THAT(Doubts(truth, WithErrors(late, 0.05)), ElementsAre(HasSubstr("the answer seems to be 0.5 s late")));
  EXPECT_THAT(Doubts(truth, WithErrors(late, 0.15)), IsEmpty());
}

TEST(DoubtsOnPair, NameExchangedSidesInsteadOfALag) {
  // A walk in place: the left joints move as the right ones, half a second later.
  RawMotion walk = Gliding(30, 180);
  const auto joint_of = [&](Role role) { return static_cast<std::size_t>(walk.roles[Index(role)]); };
  for (std::size_t f = 0; f < 180; ++f) {
    for (const Role role : {Role::kLeftFoot, Role::kLeftAnkle, Role::kLeftKnee, Role::kLeftWrist, Role::kLeftElbow}) {
      const double phase = 2 * 3.14159265358979 * static_cast<double>(f) / 30;
      const glm::dvec3 swing(0, 0.1, 0.3);
      walk.positions[f * walk.joints.size() + joint_of(role)] += std::sin(phase) * swing;
      walk.positions[f * walk.joints.size() + joint_of(Mirrored(role))] -= std::sin(phase) * swing;
    }
  }
  RawMotion exchanged = walk;
  for (const Role role : AllRoles()) {
    for (std::size_t f = 0; f < 180; ++f) {
      exchanged.positions[f * walk.joints.size() + joint_of(role)] = walk.At(f, joint_of(Mirrored(role)));
    }
  }
  EXPECT_THAT(Doubts(walk, WithErrors(exchanged, 0.01)),
              ElementsAre(HasSubstr("the answer's left and right seem to be exchanged")));
  EXPECT_THAT(Doubts(walk, WithErrors(walk, 0.01)), IsEmpty());
  // Exchanged sides from the middle on are no jump of the clock.
  RawMotion half = exchanged;
  std::copy_n(walk.positions.begin(), walk.positions.size() / 2, half.positions.begin());
  EXPECT_THAT(Doubts(walk, WithErrors(half, 0.005)), IsEmpty());
  // The control: the limbs move half a cycle later, but the hips do not change places.
  RawMotion late = exchanged;
  for (const Role role : {Role::kLeftHip, Role::kLeftShoulder, Role::kLeftHand}) {
    for (const Role same : {role, Mirrored(role)}) {
      for (std::size_t f = 0; f < 180; ++f)
        late.positions[f * walk.joints.size() + joint_of(same)] = walk.At(f, joint_of(same));
    }
  }
  for (std::size_t f = 0; f < 180; ++f) {
    for (const Role role : {Role::kLeftFoot, Role::kLeftAnkle, Role::kLeftKnee, Role::kLeftWrist, Role::kLeftElbow}) {
      for (const Role same : {role, Mirrored(role)}) {
        late.positions[f * walk.joints.size() + joint_of(same)] = walk.At((f + 15) % 180, joint_of(same));
      }
    }
  }
  EXPECT_THAT(Doubts(walk, WithErrors(late, 0.005)),
              ::testing::Not(::testing::Contains(HasSubstr("left and right seem to be exchanged"))));
}

TEST(DoubtsOnPair, OfAMotionThatRepeatsNameTheSmallestShift) {
  const auto stepping = [](double late_s) {
    RawMotion motion = Gliding(30, 240);
    for (std::size_t f = 0; f < 240; ++f) {
      const double phase = 2 * 3.14159265358979 * (static_cast<double>(f) / 30 - late_s);  // a step a second
      for (std::size_t j = 0; j < motion.joints.size(); ++j) {
        motion.positions[f * motion.joints.size() + j] += 0.1 * glm::dvec3(0, std::sin(phase + 1.0 * j), 0);
      }
    }
    return motion;
  };
  for (const double late_s : {0.1, -0.1}) {
    const RawMotion answer = WithErrors(stepping(late_s), 0.005);
    EXPECT_THAT(Doubts(stepping(0), answer), ElementsAre(AllOf(HasSubstr("the answer seems to be 0.1"),
                                                               HasSubstr(late_s > 0 ? " s late" : " s early"))));
    const auto found = Match(stepping(0), answer, "roles", Lag::kFind);
    ASSERT_TRUE(found && found->lag);
    EXPECT_NEAR(found->lag->shift_s, late_s, 0.003);
  }
}

TEST(DoubtsOnPair, NameAClockThatDrifts) {
  const RawMotion truth = Swaying(30, 900, 0);
  RawMotion answer = Swaying(29.4, 882, -0.3);
  answer.rate_hz = 30;  // each second of the file is 1.02 s
  EXPECT_THAT(Doubts(truth, WithErrors(answer, 0.01)),
              ElementsAre(AllOf(HasSubstr("clock seems to drift, from 0.3 s early to 0.9 s early"),
                                HasSubstr("as at 29.399 Hz instead of 30"))));
  const auto constant = Match(truth, answer, "roles", Lag::kFind);
  ASSERT_FALSE(constant) << "no constant lag fits";
  EXPECT_THAT(ToString(constant.error()), HasSubstr("the answer's clock drifts"));
  RawMotion slight = Swaying(29.99, 900, 0);
  slight.rate_hz = 30;
  EXPECT_THAT(Doubts(truth, slight), IsEmpty()) << "a hundredth of a second in half a minute";
}

TEST(DoubtsOnPair, NameAClockThatJumps) {
  // Without frames 200 to 211, and with frames 200 to 211 twice.
  const RawMotion truth = Swaying(30, 400, 0);
  const std::size_t joints = truth.joints.size();
  RawMotion missing = truth, twice = truth;
  const auto at = [&](RawMotion& motion, std::size_t frame) { return motion.positions.begin() + frame * joints; };
  missing.positions.erase(at(missing, 200), at(missing, 212));
  twice.positions.insert(at(twice, 212), at(twice, 200), at(twice, 212));
  EXPECT_THAT(
      Doubts(truth, WithErrors(missing, 0.01)),
      ElementsAre(AllOf(ContainsRegex("jump by -0.4 s about (6.[6-9].?|7(.[01].?)?) s"), HasSubstr("are frames missing?"))));
  EXPECT_THAT(Doubts(truth, WithErrors(twice, 0.01)),
              ElementsAre(AllOf(ContainsRegex("jump by 0.4 s about (6.[6-9].|7|7.[0-4].?) s"),
                                HasSubstr("are frames there twice"))));
  // One frame is too little beside these errors.
  RawMotion almost = truth;
  almost.positions.erase(at(almost, 200), at(almost, 201));
  EXPECT_THAT(Doubts(truth, WithErrors(almost, 0.03)), IsEmpty());
}

TEST(DoubtsOnPair, NameTheRateAtWhichTheAnswerSpansTheTruth) {
  // Every second frame, with the rate of all frames.
  const RawMotion truth = Swaying(30, 151, 0);
  RawMotion answer = Swaying(15, 76, 0);
  EXPECT_THAT(Doubts(truth, answer), IsEmpty());
  answer.rate_hz = 30;
  EXPECT_THAT(Doubts(truth, answer), ElementsAre(HasSubstr("is its rate about 15 Hz instead of 30?")));
  // All frames, with half the rate.
  answer = truth;
  answer.rate_hz = 15;
  EXPECT_THAT(Doubts(truth, answer), ElementsAre(HasSubstr("is its rate about 30 Hz instead of 15?")));
}

}  // namespace
}  // namespace etude
