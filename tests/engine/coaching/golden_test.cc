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

// What is shown and what is said, apart: letters are large numbers.
struct SessionPrint {
  Fingerprint shown, said;
  std::string last_words;

  void Add(const CoachOutput& out) {
    shown.Add(out.mode).Add(out.clip_frame).Add(out.in_transition).Add(out.repetition).Add(out.asks).Add(out.stand);
    shown.Add(out.body[Role::kHipCentre]).Add(out.body[Role::kLeftHand]).Add(out.body[Role::kRightElbow]);
    shown.Add(out.open.has_value());
    if (out.open) shown.Add(out.open->repetition).Add(out.open->move);
    shown.Add(out.music.kind).Add(out.music.music_s).Add(out.beat_error_s);
    shown.Add(out.picture == nullptr ? 0.0 : (*out.picture)[Role::kLeftHand].y);
    for (const CoachRecord& record : out.records) {
      shown.Add(record.event).Add(static_cast<double>(record.frame) / 100).Add(record.repetition).Add(record.move);
      shown.Add(record.tag).Add(record.mistake).Add(record.evidence).Add(record.beat_error_s).Add(record.rate);
      shown.Add(record.transition != nullptr);
      said.Add(record.why);
    }
    const std::string words = std::string(out.clip) + "|" + std::string(out.say) + "|" + std::string(out.hint);
    if (words != last_words) said.Add(words);
    last_words = words;
  }

  void Add(const CoachState& state) {
    shown.Add(state.mode).Add(state.mode_since).Add(state.idle_since).Add(state.rate).Add(state.next_tag);
    shown.Add(state.next_window).Add(state.correcting).Add(state.corrections_here).Add(state.moment_waits);
    shown.Add(state.clap.since_apart).Add(state.clap.together).Add(state.stillness.seen).Add(state.stillness.moving);
    shown.Add(state.stillness.frames).Add(state.stand_frames).Add(state.clap_waits).Add(state.music_plays);
    for (const MoveMemory& memory : {state.moves[0], state.moves[1], state.song}) {
      shown.Add(memory.judged).Add(memory.mistakes).Add(memory.mistakes_in_row).Add(memory.corrections);
    }
  }
};

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
    Kept shown, said;
  };
  const std::vector<Setting> settings = {
      {"at-first-mistake",
       "now",
       "crossfade",
       {},
       {.idle_s = 9, .doze_s = 5},
       {54854, 9105.89804347},
       {3866, 2089.53415594}},
      {"never", "fuzzy-bridge", "cut", {}, {}, {56291, 5827.97930299}, {4120, 1505.71657964}},
      {"after-n",
       "now",
       "cut",
       {2},
       {.reaction_s = 0.5, .most_corrections = 1, .idle_s = 7},
       {54967, 3398.1368808},
       {2431, 2966.6439934}},
      {"confidence",
       "fuzzy-bridge",
       "crossfade",
       {0.7},
       {.right_from = 0.7, .puzzled_after = 2},
       {55458, -7385.37901717},
       {4938, 2381.499361}},
      {"fading",
       "played",
       "planted-feet",
       {},
       {.praise_share = 0.4, .still_share = 0.6},
       {55779, 215.887595025},
       {5714, 1890.15928434}},
      {"oracle",
       "now",
       "crossfade",
       {},
       {.slowest = 0.9, .fastest = 1.1, .nearest_m = 2.9},
       {54441, -3186.43304152},
       {4433, 3238.32347159}},
      {"yoked",
       "now",
       "crossfade",
       {},
       {.idle_s = 6, .follows_tags = false, .farthest_m = 2.7},
       {55349, -6092.0324234},
       {3640, 991.431813546}},
  };
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& [policy, choice, join, values, options, shown, said] = settings[i];
    Dice dice(i);
    SmallSession session(options, policy, values, choice, join);
    if (i % 3 == 0) session.state() = session.coach().Begin();
    SessionPrint print;
    for (int frame = 0; frame < 2500; ++frame) {
      PlayAnything(dice, session);
      print.Add(session.Next());
      if (frame % 100 == 0) print.Add(session.state());
    }
    EXPECT_TRUE(print.shown.Is(shown.first, shown.second)) << policy;
    EXPECT_TRUE(print.said.Is(said.first, said.second)) << policy;
  }
}

// A sensor, a filter and a recogniser; with and without a look at the mirror image, in the mirror and not.
TEST(Coaching, GoldenSessionsWithASensor) {
  const std::array<Kept, 3> kept = {{{25287, -5386.07465168}, {25851, -4948.78255111}, {25287, -5150.79497704}}};
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
    const Kept& golden = kept[static_cast<std::size_t>(setup)];
    EXPECT_TRUE(print.shown.Is(golden.first, golden.second)) << setup;
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
      for (const double evidence : {0.0, 0.2, 0.25, 0.45, 0.6}) {
        const PolicyInput input{
            .verdict = in_row == 0 ? WindowVerdict::kRight : WindowVerdict::kWrong,
            .evidence = evidence,
            .right_from = 0.5,
            .move = {.judged = 5, .mistakes = 3, .mistakes_in_row = in_row, .corrections = in_row / 2}};
        const PolicyDecision decision = policy.decide(input, {});
        decided.Add(decision.corrects);
        said.Add(decision.why);
      }
    }
  }
  EXPECT_TRUE(decided.Is(166, -58.8136110594));
  EXPECT_TRUE(said.Is(5380, 3524.93544567));
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

TEST(Coaching, ComplaintsOfDancesAreWhole) {
  const auto complaint = [](const auto& spoil) {
    Dance dance = SmallDance();
    spoil(dance);
    const auto checked = CheckDance(dance);
    return checked ? std::string("none") : checked.error().message;
  };
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].end = d.repetitions[1].first + 2; }), "none");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[3].end = d.motion.poses.size(); }), "none");
  EXPECT_EQ(complaint([](Dance& d) { d.moves[0].slow.poses.resize(2); }), "none");
  EXPECT_EQ(complaint([](Dance& d) { d.moves[0].slow.poses.resize(1); }),
            "dance 'small': the slow demonstration of 'first' has 1 frames; at least 2");
  EXPECT_EQ(complaint([](Dance& d) { d.motion.rate_hz = 60; }), "dance 'small': the song runs at 60 Hz; must be 30");
  EXPECT_EQ(complaint([](Dance& d) { d.acts[3].motion.poses.clear(); }),
            "dance 'small': the act 'wake' has 0 frames; at least 2");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[2].move = -1; }), "dance 'small', repetition 2: move -1 of 2");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].end = d.repetitions[1].first + 1; }),
            "dance 'small', repetition 1: frames 120 to 121; allowed: 120 to 420, two at least");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[3].end = 421; }),
            "dance 'small', repetition 3: frames 300 to 421; allowed: 300 to 420, two at least");
  EXPECT_EQ(complaint([](Dance& d) { d.repetitions[1].first = 119; }),
            "dance 'small', repetition 1: frames 119 to 210; allowed: 120 to 420, two at least");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[3].frame = 420; }),
            "dance 'small': a music-time tag at frame 420, 10 s; the dance has 420 frames");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[3].frame = 419; }), "none");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[1].frame = d.tags[0].frame; }),
            "dance 'small': music-time tags must ascend; frame 30, 4 s comes after frame 30, 1 s");
  EXPECT_EQ(complaint([](Dance& d) { d.tags[1].music_s = d.tags[0].music_s; }),
            "dance 'small': music-time tags must ascend; frame 120, 1 s comes after frame 30, 1 s");
}

}  // namespace
}  // namespace etude
