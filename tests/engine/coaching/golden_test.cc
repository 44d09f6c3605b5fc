// The golden value of the coaching pipeline: sessions of every policy with random players, and every text.
#include <gtest/gtest.h>

#include <set>

#include "engine/coaching/coach.h"
#include "tests/engine/coaching/small_dance.h"
#include "tests/support/fingerprint.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

using testing::Dice;

// Digests of the frames and decisions, and each text once.
struct SessionPrint {
  testing::Fingerprint print;
  std::set<std::string> heard;
  std::vector<std::string> said;

  void Say(const std::string& line) {
    if (heard.insert(line).second) said.push_back(line);
  }
  void Add(const CoachOutput& out) {
    print.Add(out.body[Role::kHipCentre]).Add(out.body[Role::kLeftHand]).Add(0.001 * out.clip_frame);
    print.Add(out.beat_error_s).Add(out.picture == nullptr ? 0.0 : (*out.picture)[Role::kLeftHand].y);
    print.Add(out.mode).Add(out.in_transition).Add(out.repetition).Add(out.asks).Add(out.stand);
    print.Add(out.open.has_value()).Add(out.music.kind).Add(0.1 * out.music.music_s);
    if (out.open) print.Add(out.open->repetition).Add(out.open->move);
    for (const CoachRecord& record : out.records) {
      print.Add(record.event).Add(0.01 * static_cast<double>(record.frame)).Add(record.repetition).Add(record.move);
      print.Add(record.tag).Add(record.mistake).Add(record.transition != nullptr);
      print.Add(record.evidence).Add(record.beat_error_s).Add(record.rate);
      if (!record.why.empty()) Say("why: " + record.why);
    }
    if (!out.say.empty() || !out.hint.empty()) {
      Say(std::string(out.clip) + ": " + std::string(out.say) + "|" + std::string(out.hint));
    }
  }
};

// Returns the small dance of a body that travels and turns in every clip, so that clip placement matters.
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

// A player who changes behaviour at random, with music near the right time.
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
  SessionPrint print;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& [policy, choice, join, values, options] = settings[i];
    Dice dice(i);
    SmallSession session(options, policy, values, choice, join, WanderingDance());
    if (i % 3 == 0) session.state() = session.coach().Begin();
    print.Say("== " + std::string(policy));
    for (int frame = 0; frame < 1500; ++frame) {
      PlayAnything(dice, session);
      print.Add(session.Next());
    }
  }
  EXPECT_TRUE(print.print.Is(198004, 312.552212159));
  EXPECT_TRUE(testing::AreKept(print.said, "tests/engine/coaching/said.txt"));
}

// A choice finds no transition: its plan has no segment, or only a segment of the current clip.
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
    EXPECT_EQ(transitions.FindHome(from, 40, {.yaw = 0.3, .x = 1}, to)->frames[3].joints, clips[to].poses[3].joints);
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
