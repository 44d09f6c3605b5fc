#pragma once

#include <algorithm>
#include <cmath>

#include "engine/coaching/coach.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "sim/choreography/canonical_body.h"

namespace etude {

/// Returns a body in the ready stance with its arms raised by `degrees`.
inline BodyPose ArmsAt(double degrees) {
  Controls controls = ReadyStance();
  for (Side side : {Side::kLeft, Side::kRight})
    controls.Of(side, SideControl::kArmSide) = degrees * 3.14159265358979 / 180;
  return PoseOf(controls);
}

/// Returns a motion of `frames` frames in which the arms go up and down again.
inline BodyMotion Flap(std::size_t frames, double height_deg) {
  BodyMotion motion;
  for (std::size_t i = 0; i < frames; ++i) {
    motion.poses.push_back(ArmsAt(height_deg * 0.5 * (1 - std::cos(2 * 3.14159265358979 * i / (frames - 1.0)))));
  }
  return motion;
}

constexpr std::size_t kRepetitionFrames = 90;

/// Returns a dance of two moves, each danced twice in succession: four repetitions of three seconds, the first at one
/// second. There is a tag at the beginning of each repetition, and the music has the dance's own tempo.
inline Dance SmallDance() {
  Dance dance{.title = "small", .tempo_bpm = 120, .motion = Flap(4 * kRepetitionFrames + 60, 60)};
  for (const char* name : {"first", "second"}) {
    dance.moves.push_back({.name = name, .hint = name, .key_pose = ArmsAt(60), .slow = Flap(120, 50)});
  }
  for (int i = 0; i < 4; ++i) {
    const std::size_t first = 30 + i * kRepetitionFrames;
    dance.repetitions.push_back({.move = i / 2, .first = first, .end = first + kRepetitionFrames});
    dance.tags.push_back({.frame = first, .music_s = first / kJudgedRateHz});
  }
  for (const std::string& act : RequiredActs()) {
    const bool loops = act == "standby" || act == "attract" || act == "doze";
    dance.acts.push_back({.name = act, .motion = Flap(100, 40), .loops = loops});
  }
  return dance;
}

/// A session of a coach with the small dance and a player whose behaviour the test sets.
class SmallSession {
 public:
  explicit SmallSession(const CoachOptions& options = {}, const char* policy = "at-first-mistake",
                        std::vector<double> settings = {}, const char* choice = "now", const char* join = "crossfade",
                        Dance dance = SmallDance())
      : library_(DanceLibrary::Make(std::move(dance)).value()),
        transitions_(library_, {.choice = FindChoice(choice), .join = FindJoin(join)}),
        coach_(transitions_, options, {FindPolicy(policy), std::move(settings)}) {
    state_ = coach_.BeginDancing();
  }

  struct Player {
    bool seen = true;
    bool moves = true;
    bool claps = false;
    double evidence = 0;  ///< the evidence while a window is open
    std::optional<double> other_side = {};
    std::optional<bool> told_right = {};
    bool moment = false;
  } player;

  /// Plays at most `frames` frames, until the coach records `event`. Returns false if it does not record `event`.
  bool Until(CoachEvent event, int frames = 3000) {
    for (int i = 0; i < frames; ++i) {
      Next();
      for (const CoachRecord& record : out_.records) {
        if (record.event == event) {
          record_ = record;
          return true;
        }
      }
    }
    return false;
  }

  const CoachOutput& Next() {
    const SensedFrame frame = Sensed();
    FeatureFrame features{.body_seen = player.seen};
    CoachInput input{.seen = {frame, features},
                     .evidence = {.asked = state_.open ? player.evidence : 0, .spotted = {}},
                     .other_side = player.other_side,
                     .music_s = music_s,
                     .told_right = player.told_right,
                     .moment = player.moment};
    CoachStep step = coach_.Step(state_, input);
    state_ = std::move(step.state);
    out_ = std::move(step.output);
    for (const CoachRecord& record : out_.records) all.push_back(record);
    if (music_s) *music_s += 1 / kJudgedRateHz;
    if (out_.music.kind == MusicCommand::Kind::kPlayFrom) music_s = out_.music.music_s + 1 / kJudgedRateHz;
    if (out_.music.kind == MusicCommand::Kind::kPause) music_s.reset();
    player.moment = false;
    return out_;
  }

  SensedFrame Sensed() const {
    const double swing = player.moves ? 0.25 * std::sin(0.3 * static_cast<double>(state_.frame)) : 0;
    SensedFrame frame = StreamOf({.poses = {ArmsAt(20)}}).frames.front();
    for (SensedJoint& joint : frame.joints) joint.position.x += swing;
    if (player.claps) {  // the hands move apart and together four times a second
      const double gap = state_.frame % 8 < 4 ? 0.6 : 0.05;
      frame[Role::kLeftHand].position = {gap / 2, 1.4, 0.4};
      frame[Role::kRightHand].position = {-gap / 2, 1.4, 0.4};
    }
    frame.body_seen = player.seen;
    if (!player.seen) {
      for (SensedJoint& joint : frame.joints) joint.state = TrackingState::kNotTracked;
    }
    return frame;
  }

  const Coach& coach() const { return coach_; }
  CoachState& state() { return state_; }
  const CoachOutput& out() const { return out_; }
  const CoachRecord& record() const { return record_; }
  int Count(CoachEvent event) const { return static_cast<int>(std::ranges::count(all, event, &CoachRecord::event)); }

  std::optional<double> music_s;
  std::vector<CoachRecord> all;

 private:
  DanceLibrary library_;
  DanceTransitions transitions_;
  Coach coach_;
  CoachState state_;
  CoachOutput out_;
  CoachRecord record_;
};

}  // namespace etude
