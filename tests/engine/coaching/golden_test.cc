// Golden values of whole sessions: every frame that a coach shows to players who do anything, and every word.
#include <gtest/gtest.h>

#include "engine/coaching/coach.h"
#include "engine/coaching/policy.h"
#include "engine/coaching/session.h"
#include "engine/recognition/recognisers.h"
#include "tests/engine/coaching/small_dance.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;
using Kept = std::pair<std::size_t, double>;

// What is shown, decided and said, apart: sums are not to hide small numbers behind large ones.
struct SessionPrint {
  Fingerprint shown, decided, said;
  std::string last_words;

  void Add(const CoachOutput& out) {
    shown.Add(out.body[Role::kHipCentre]).Add(out.body[Role::kLeftHand]).Add(0.001 * out.clip_frame);
    shown.Add(out.beat_error_s).Add(out.picture == nullptr ? 0.0 : (*out.picture)[Role::kLeftHand].y);
    decided.Add(out.mode).Add(out.in_transition).Add(out.repetition).Add(out.asks).Add(out.stand);
    decided.Add(out.open.has_value()).Add(out.music.kind).Add(out.music.music_s);
    if (out.open) decided.Add(out.open->repetition).Add(out.open->move);
    for (const CoachRecord& record : out.records) {
      decided.Add(record.event).Add(0.01 * static_cast<double>(record.frame)).Add(record.repetition).Add(record.move);
      decided.Add(record.tag).Add(record.mistake).Add(record.transition != nullptr);
      shown.Add(record.evidence).Add(record.beat_error_s).Add(record.rate);
      said.Add(record.why);
    }
    const std::string words = std::string(out.clip) + "|" + std::string(out.say) + "|" + std::string(out.hint);
    if (words != last_words) said.Add(words);
    last_words = words;
  }

  void Add(const CoachState& state) {
    decided.Add(state.mode).Add(state.mode_since).Add(state.idle_since).Add(state.rate).Add(state.next_tag);
    decided.Add(state.next_window).Add(state.correcting).Add(state.corrections_here).Add(state.moment_waits);
    decided.Add(state.clap.since_apart).Add(state.clap.together).Add(state.stillness.seen).Add(state.stillness.moving);
    decided.Add(state.stillness.frames).Add(state.stand_frames).Add(state.clap_waits).Add(state.music_plays);
    for (const MoveMemory& memory : {state.moves[0], state.moves[1], state.song}) {
      decided.Add(memory.judged).Add(memory.mistakes).Add(memory.mistakes_in_row).Add(memory.corrections);
    }
  }
};

// The small dance of a body that goes somewhere and turns in every clip, so that it matters where clips are laid.
Dance WanderingDance() {
  Dance dance = SmallDance();
  const auto wander = [](BodyMotion& motion, double pace) {
    double t = 0;
    for (BodyPose& pose : motion.poses) {
      pose = FloorMove{.yaw = 0.002 * pace * t, .x = 0.003 * t, .z = 0.001 * pace * t}.Apply(pose);
      ++t;
    }
  };
  wander(dance.motion, 1);
  for (DanceMove& move : dance.moves) wander(move.slow, -2);
  for (CoachAct& act : dance.acts) wander(act.motion, 3);
  return dance;
}

// A player who does something else every now and then, to music that is anywhere near.
void PlayAnything(Dice& dice, SmallSession& session) {
  SmallSession::Player& player = session.player;
  const auto chance = [&dice](std::size_t of_thousand) { return dice.Below(1000) < of_thousand; };
  if (chance(8)) player.seen = !chance(250);
  if (chance(8)) player.moves = !chance(300);
  if (chance(15)) player.claps = chance(300);
  if (chance(20)) player.evidence = 0.5 + 0.5 * dice.Signed();
  if (chance(20)) player.other_side = 0.5 + 0.5 * dice.Signed();
  if (chance(20)) player.told_right = chance(500);
  player.moment = chance(3);
  if (session.music_s && chance(20)) *session.music_s += 0.3 * dice.Signed();
}

TEST(Coaching, GoldenSessionsOfEveryPolicy) {
  struct Setting {
    const char *policy, *choice, *join;
    std::vector<double> settings;
    CoachOptions options;
  };
  const std::vector<Setting> settings = {
      {"at-first-mistake", "now", "crossfade", {}, {.idle_s = 9, .doze_s = 5}},
      {"never", "fuzzy-bridge", "cut", {}, {}},
      {"after-n", "now", "cut", {2}, {.reaction_s = 0.5, .most_corrections = 1, .idle_s = 7}},
      {"confidence", "now", "crossfade", {0.7}, {.right_from = 0.7, .puzzled_after = 2}},
      {"fading", "played", "planted-feet", {}, {.praise_share = 0.4, .still_share = 0.6}},
      {"oracle", "now", "crossfade", {}, {.slowest = 0.9, .fastest = 1.1, .nearest_m = 2.9}},
      {"yoked", "now", "crossfade", {}, {.idle_s = 6, .follows_tags = false, .farthest_m = 2.7}},
  };
  const std::vector<std::array<Kept, 3>> kept = {
      {{{24040, -37.2228352729}, {23314, -2149.77777398}, {3866, 2089.53415594}}},
      {{{24513, -106.606711066}, {24278, 7887.87123122}, {4122, -12.6520554405}}},
      {{{24042, -26.8915283804}, {23425, -316.861855614}, {2431, 2966.6439934}}},
      {{{24118, -4.65322094756}, {23488, 5319.44783906}, {2963, 2572.071895}}},
      {{{24339, 4.19474189136}, {23913, 407.1839484}, {5676, 4145.97645561}}},
      {{{23938, -2.05538702258}, {23003, 5302.47176478}, {4433, 3238.32347159}}},
      {{{24198, -57.8725657385}, {23651, 6757.19716325}, {3640, 991.431813546}}},
  };
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& [policy, choice, join, values, options] = settings[i];
    const auto& [shown, decided, said] = kept[i];
    Dice dice(i);
    SmallSession session(options, policy, values, choice, join, WanderingDance());
    if (i % 3 == 0) session.state() = session.coach().Begin();
    SessionPrint print;
    for (int frame = 0; frame < 2500; ++frame) {
      PlayAnything(dice, session);
      print.Add(session.Next());
      if (frame % 100 == 0) print.Add(session.state());
    }
    EXPECT_TRUE(print.shown.Is(shown.first, shown.second)) << policy;
    EXPECT_TRUE(print.decided.Is(decided.first, decided.second)) << policy;
    EXPECT_TRUE(print.said.Is(said.first, said.second)) << policy;
  }
}

// A sensor, a filter and a recogniser; with and without a look at the mirror image, in the mirror and not.
TEST(Coaching, GoldenSessionsWithASensor) {
  const std::array<Kept, 6> kept = {{{11254, 20.0741362434},
                                     {10433, 18.6662270506},
                                     {11528, 136.021207489},
                                     {10723, 494.206407837},
                                     {11254, 20.2186004827},
                                     {10433, 15.2538771983}}};
  const DanceLibrary library = DanceLibrary::Make(SmallDance()).value();
  const DanceTransitions transitions(library, {.choice = FindChoice("now"), .join = FindJoin("crossfade")});
  const std::vector<TaughtMove> taught = {
      {.name = "first", .poses = {{{{Feature::kRH, 50, 20}}}, {{{Feature::kRH, 20, 15}}}}},
      {.name = "second", .poses = {{{{Feature::kLH, 60, 12}}}}}};
  const auto recogniser = MakeRecogniser({}, taught).value();
  for (int setup = 0; setup < 3; ++setup) {
    const Coach coach(transitions, {.player_mirrors = setup == 1}, {FindPolicy("at-first-mistake"), {}});
    CoachSession session({.coach = &coach,
                          .recogniser = recogniser.get(),
                          .filter = {.kind = setup == 2 ? FilterKind::kHolt : FilterKind::kNone},
                          .tells_wrong_side = setup != 2},
                         coach.BeginDancing());
    Dice dice(3);
    SessionPrint print;
    for (int t = 0; t < 1200; ++t) {
      SensedFrame frame = StreamOf({.poses = {ArmsAt(30 + 35 * std::sin(0.06 * t))}}).frames.front();
      for (SensedJoint& joint : frame.joints) joint.position += 0.01 * dice.Vector();
      if (t % 300 > 150) frame[Role::kLeftElbow].position.y -= 0.2;  // one arm does something else
      print.Add(session.Next(MirrorImage(frame), {.music_s = t / 30.0}));
    }
    print.Add(session.state());
    EXPECT_TRUE(print.shown.Is(kept[2 * setup].first, kept[2 * setup].second)) << setup;
    EXPECT_TRUE(print.decided.Is(kept[2 * setup + 1].first, kept[2 * setup + 1].second)) << setup;
  }
}

TEST(Coaching, GoldenSenses) {
  Fingerprint print;
  Dice dice(12);
  ClapState clap;
  StillnessState stillness;
  for (int t = 0; t < 3000; ++t) {
    SensedFrame frame = StreamOf({.poses = {ArmsAt(20)}}).frames.front();
    const double reach = t % 1000 < 500 ? 0.06 : 0.03;
    for (SensedJoint& joint : frame.joints) {
      if (dice.Below(10) == 0) joint.state = TrackingState::kInferred;
      joint.position += reach * std::sin(0.11 * t) * dice.Vector();
    }
    const double gap = t % 40 < 9 ? 0.42 + 0.04 * dice.Signed() : 0.15 + 0.1 * dice.Signed();
    const double height = 1.2 + (dice.Below(12) == 0 ? -0.6 : 0);
    frame[Role::kLeftHand] = {{gap / 2, height, 0.4}, TrackingState::kTracked};
    frame[Role::kRightHand] = {{-gap / 2, height, 0.4}, TrackingState::kTracked};
    if (dice.Below(60) == 0) frame.body_seen = false;
    print.Add(SeeClap(frame, clap)).Add(SeeMotion(frame, stillness));
    print.Add(0.1 * std::min(clap.since_apart, 50)).Add(clap.together).Add(stillness.started);
    print.Add(stillness.rest[5]).Add(0.01 * stillness.seen).Add(0.01 * stillness.moving).Add(0.01 * stillness.frames);
    if (t % 170 == 169) ResetCounts(stillness);
  }
  EXPECT_TRUE(print.Is(33000, -82.4257512603));
}

TEST(Coaching, GoldenDecisionsOfEveryPolicy) {
  Fingerprint decided, said;
  for (const Policy& policy : AllPolicies()) {
    for (const NumberSetting& setting : policy.settings) {
      decided.Add(setting.fallback).Add(setting.lowest).Add(setting.largest).Add(setting.is_whole);
    }
    decided.Add(policy.asks_truth).Add(policy.takes_moments);
    for (int in_row = 0; in_row < 4; ++in_row) {
      for (const double evidence : {0.0, 0.2, 0.25, 0.45, 1.0}) {
        const PolicyInput input{
            .verdict = in_row == 0 ? WindowVerdict::kRight : WindowVerdict::kWrong,
            .evidence = evidence,
            .right_from = 0.5,
            .move = {.judged = 5, .mistakes = 3, .mistakes_in_row = in_row, .corrections = in_row / 2}};
        const PolicyDecision decision = policy.decide(input, {});
        decided.Add(decision.corrects);
        if (policy.name == "confidence") decided.Add(policy.decide(input, std::vector<double>{0}).corrects);
        said.Add(decision.why);
      }
    }
  }
  EXPECT_TRUE(decided.Is(186, -56.6842951635));
  EXPECT_TRUE(said.Is(5380, 3538.85564572));
}

// The requests of a plan ahead, which change no answer but keep live sessions from waiting.
TEST(Coaching, GoldenLibrariesAndPlansAhead) {
  static std::vector<TransitionRequest> asked;
  static const Choice* const now = FindChoice("now");
  Choice remembers = *now;
  remembers.plan = [](const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                      std::span<const double> values) {
    asked.push_back(request);
    return now->plan(library, request, rules, values);
  };
  Fingerprint print, names;
  for (const bool is_short : {false, true}) {
    Dance dance = SmallDance();
    if (is_short) {
      dance.motion.poses.resize(dance.repetitions.back().end + 5);
      dance.acts[4].motion.poses.resize(11);
      dance.moves[1].slow.poses.resize(9);
    }
    const DanceLibrary library = DanceLibrary::Make(dance).value();
    const DanceTransitions transitions(library, {.choice = &remembers, .join = FindJoin("crossfade")});
    const int clips = static_cast<int>(library.library().motions.size());
    for (int clip = 0; clip < clips; ++clip) {
      names.Add(library.library().names[clip]);
      print.Add(library.library().motions[clip].poses.size()).Add(library.WholeOf(clip)).Add(library.IsLoop(clip));
      print.Add(library.library().motions[clip].poses[1][Role::kLeftHand]).Add(library.IsReturning(clip));
      if (clip >= library.ClipLeaving(-1) && (clip < library.ClipEntering(0) || library.IsReturning(clip))) {
        print.Add(library.DanceFrameOf(clip));
      }
    }
    for (const double frame : {0.0, 29.9, 30.0, 120.0, 299.5, 300.0, 9999.0}) print.Add(library.RepetitionAt(frame));
    asked.clear();
    Coach(transitions, {}, {FindPolicy("never"), {}}).PlanAhead();
    print.Add(asked.size());
    for (const TransitionRequest& request : asked) {
      print.Add(request.from).Add(request.request_frame).Add(request.to).Add(request.budget_s);
    }
  }
  EXPECT_TRUE(print.Is(804, -56.0442288971));
  EXPECT_TRUE(names.Is(588, -590.440832069));
}

// A choice that finds no way from some clips: with nothing to show, or with nothing but what plays already.
TEST(Coaching, CutsWhereItsWayFindsNoTransition) {
  static const Choice* const now = FindChoice("now");
  static std::size_t kept_segments;
  Choice fails = *now;
  fails.plan = [](const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                  std::span<const double> values) {
    TransitionRecord record = now->plan(library, request, rules, values);
    record.segments.resize(kept_segments);
    return record;
  };
  const DanceLibrary library = DanceLibrary::Make(WanderingDance()).value();
  const int from = library.ClipOfAct("wave"), to = library.ClipEntering(library.ClipOfSlow(1));
  const std::vector<BodyMotion>& clips = library.library().motions;
  for (kept_segments = 0; kept_segments < 2; ++kept_segments) {
    const DanceTransitions transitions(library, {.choice = &fails, .join = FindJoin("crossfade")});
    const auto path = transitions.Find(from, 40, to);
    ASSERT_EQ(path->frames.size(), clips[to].poses.size());
    EXPECT_EQ(path->entered, 0u);
    EXPECT_EQ(path->clip, library.ClipOfSlow(1));
    const glm::dvec3 left = clips[from].poses[40][Role::kHipCentre], begun = path->frames[0][Role::kHipCentre];
    EXPECT_LT(glm::length(glm::dvec2(begun.x - left.x, begun.z - left.z)), 1e-9) << "laid where the other one stood";
    const FloorMove home{.yaw = 0.3, .x = 1};
    EXPECT_EQ(transitions.FindHome(from, 40, home, to)->frames[3].joints, clips[to].poses[3].joints);
  }
}

TEST(Coaching, OpensAWindowThatItComesToALittleLate) {
  for (const double late : {-0.25, 0.0, 3.0, 3.25}) {
    SmallSession session;
    session.state().playback.dance_frame = 30 + 9 + late - 1;
    session.state().frame = 1;
    EXPECT_EQ(session.Next().open.has_value(), late >= 0 && late <= 3) << late;
    EXPECT_EQ(session.state().next_window, late >= 0 ? 1 : 0) << late;
  }
}

}  // namespace
}  // namespace etude
