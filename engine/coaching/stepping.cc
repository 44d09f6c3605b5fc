#include "engine/coaching/stepping.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "engine/coaching/dance.h"

namespace etude {
namespace {

/// The number of frames for which a new position hint must be due before it replaces the current one.
constexpr int kHintFrames = 15;

std::string_view WordsOf(CoachMode mode) {
  switch (mode) {
    case CoachMode::kStandby:
    case CoachMode::kAttract:
      return "Clap, and we dance!";
    case CoachMode::kDoze:
      return "Clap to wake me up";
    case CoachMode::kDemonstrate:
      return "Watch me";
    default:
      return "";
  }
}

}  // namespace

Stepping::Stepping(const DanceTransitions& transitions, const CoachOptions& options, const Coach::PolicyChoice& policy,
                   const CoachInput& input, CoachStep& step)
    : transitions_(transitions),
      library_(transitions.library()),
      dance_(transitions.dance()),
      options_(options),
      policy_(policy),
      input_(input),
      state_(step.state),
      out_(step.output) {}

void Stepping::Run() {
  const std::optional<OpenWindow> before = state_.open;
  Watch();
  if (state_.frame > 0) Advance(state_.playback, library_, state_.rate);
  Show();
  Decide();
  Picture();
  out_.open = state_.open;
  out_.asks = state_.open != before;
  ++state_.frame;
}

void Stepping::Watch() {
  if (SeeClap(input_.seen.skeleton, state_.clap)) state_.clap_waits = true;
  const bool moves = SeeMotion(input_.seen.skeleton, state_.stillness);
  // A player who only watches a demonstration counts as taking part.
  const bool is_asked = state_.mode == CoachMode::kStandby || state_.mode == CoachMode::kDance;
  if (moves || !is_asked) state_.idle_since = state_.frame;
  if (input_.moment) state_.moment_waits = true;

  // Replace the position hint once another hint has been due for kHintFrames frames.
  const PlayerHint hint = WhereToStand();
  state_.stand_frames = hint == state_.stand ? 0 : state_.stand_frames + 1;
  if (state_.stand_frames < kHintFrames) return;
  state_.stand = hint;
  state_.stand_frames = 0;
}

PlayerHint Stepping::WhereToStand() const {
  const SensedFrame& seen = input_.seen.skeleton;
  if (!seen.body_seen) return PlayerHint::kComeIntoView;
  const glm::dvec3 way = seen[Role::kHipCentre].position - options_.sensor;
  const double distance = glm::length(glm::dvec2(way.x, way.z));
  if (distance < options_.nearest_m) return PlayerHint::kStepBack;
  return distance > options_.farthest_m ? PlayerHint::kComeNearer : PlayerHint::kNone;
}

bool Stepping::IsIdleFor(double seconds) const {
  return static_cast<double>(state_.frame - state_.idle_since) >= seconds * kJudgedRateHz;
}

void Stepping::Show() {
  out_.mode = state_.mode;
  out_.body = ShownPose(state_.playback, library_);
  out_.stand = state_.stand;
  const double dance_frame = DanceFrame(state_.playback, library_);
  if (dance_frame >= 0) out_.repetition = library_.RepetitionAt(dance_frame);
  if (!state_.playback.path || library_.IsReturning(state_.playback.path->clip)) {
    out_.clip = "dance";
    out_.clip_frame = dance_frame;
    out_.in_transition = dance_frame < 0;
    return;
  }
  const PlayedClip played = PlayedOf(state_.playback, library_);
  out_.clip = library_.library().names[played.clip];
  out_.clip_frame = played.frame;
  out_.in_transition = played.in_transition;
}

void Stepping::Picture() {
  out_.say = state_.frame < state_.say_until ? state_.say : WordsOf(state_.mode);
  const bool shows_again = state_.mode == CoachMode::kCorrect || state_.mode == CoachMode::kDemonstrate;
  const int repetition = shows_again ? state_.correcting : out_.repetition;
  if (repetition < 0) return;
  const DanceMove& move = dance_.moves[MoveOf(repetition)];
  out_.hint = move.hint;
  out_.picture = &move.key_pose;
}

void Stepping::Decide() {
  switch (state_.mode) {
    case CoachMode::kStandby:
    case CoachMode::kAttract:
    case CoachMode::kDoze:
      return Wait();
    case CoachMode::kWake:
      if (IsOver(state_.playback, library_, kBeforeEndFrames)) BeginSong();
      return;
    case CoachMode::kDance:
      return DanceOn();
    case CoachMode::kCorrect:
    case CoachMode::kDemonstrate:
      return Correct();
    case CoachMode::kPraise:
      if (!IsOver(state_.playback, library_)) return;
      LeaveForHome(library_.ClipEntering(library_.ClipOfAct("standby")), state_.playback, transitions_);
      NoteTransition();
      return Become(CoachMode::kStandby);
  }
}

void Stepping::Wait() {
  if (!IsSettled(state_.playback)) return;
  if (state_.clap_waits) {
    Note(CoachEvent::kWoken, "a clap was seen");
    if (state_.mode != CoachMode::kDoze) return BeginSong();
    LeaveFor(library_.ClipEntering(library_.ClipOfAct("wake")), state_.playback, transitions_);
    NoteTransition();
    return Become(CoachMode::kWake);
  }
  const double seconds = static_cast<double>(state_.frame - state_.mode_since) / kJudgedRateHz;
  if (state_.mode == CoachMode::kStandby && IsIdleFor(options_.idle_s)) {
    Enter(CoachMode::kAttract, "attract", CoachEvent::kAttracts,
          fmt::format("nobody has moved for {:.0f} s", options_.idle_s));
  } else if (state_.mode == CoachMode::kAttract && seconds >= options_.doze_s) {
    Enter(CoachMode::kDoze, "doze", CoachEvent::kDozes,
          fmt::format("nobody has clapped for {:.0f} s", options_.doze_s));
  }
}

void Stepping::DanceOn() {
  const double dance_frame = DanceFrame(state_.playback, library_);
  if (dance_frame < 0) return;
  FollowMusic(dance_frame);
  JudgeEarly();
  if (IsSettled(state_.playback)) {
    if (state_.moment_waits && policy_.policy->takes_moments) AnswerMoment(dance_frame);
    if (state_.mode == CoachMode::kDance) CloseWindow();
    if (state_.mode == CoachMode::kDance && IsIdleFor(options_.idle_s)) {
      if (state_.open && !state_.decided) Remember(WindowVerdict::kUnknown);
      StopMusic();
      return Enter(CoachMode::kAttract, "attract", CoachEvent::kAttracts,
                   fmt::format("nobody has moved for {:.0f} s", options_.idle_s));
    }
    if (state_.mode == CoachMode::kDance && IsOver(state_.playback, library_)) return EndSong();
  }
  if (state_.mode == CoachMode::kDance) OpenWindowAt(dance_frame);
}

void Stepping::Correct() {
  if (!IsSettled(state_.playback) || !IsOver(state_.playback, library_, kBeforeEndFrames)) return;
  if (state_.mode == CoachMode::kDemonstrate) return ReturnToDance();
  LeaveFor(library_.ClipEntering(library_.ClipOfSlow(MoveOf(state_.correcting))), state_.playback, transitions_);
  Note(CoachEvent::kShows, fmt::format("shows '{}' slowly", NameOf(state_.correcting))).repetition = state_.correcting;
  NoteTransition();
  Become(CoachMode::kDemonstrate);
}

void Stepping::BeginSong() {
  LeaveForHome(library_.ClipReturning(-1), state_.playback, transitions_);
  state_.moves.assign(dance_.moves.size(), {});
  state_.song = {};
  state_.next_window = 0;
  state_.correcting = -1;
  state_.corrections_here = 0;
  Note(CoachEvent::kSongBegins, fmt::format("'{}', {} performances", dance_.title, dance_.repetitions.size()));
  NoteTransition();
  Become(CoachMode::kDance);
}

void Stepping::EndSong() {
  const int right = state_.song.judged - state_.song.mistakes;
  const bool praises = right > 0 && right >= options_.praise_share * state_.song.judged;
  Note(CoachEvent::kSongEnds, fmt::format("{} of {} judged performances were right", right, state_.song.judged));
  StopMusic();
  if (praises) {
    Enter(CoachMode::kPraise, "praise", CoachEvent::kPraises,
          fmt::format("at least {:.0f} % were right", 100 * options_.praise_share));
    return;
  }
  LeaveForHome(library_.ClipEntering(library_.ClipOfAct("standby")), state_.playback, transitions_);
  NoteTransition();
  Become(CoachMode::kStandby);
}

void Stepping::Interrupt(int repetition, std::string why) {
  const bool is_puzzled = state_.song.mistakes_in_row >= options_.puzzled_after;
  state_.corrections_here = state_.correcting == repetition ? state_.corrections_here + 1 : 1;
  state_.correcting = repetition;
  ++state_.moves[MoveOf(repetition)].corrections;
  ++state_.song.corrections;
  // Shake the head at the first correction of a repetition; wave for attention at later corrections; after many
  // consecutive mistakes, act puzzled.
  const std::string_view act = is_puzzled ? "puzzled" : state_.corrections_here > 1 ? "wave" : "head_shake";
  if (is_puzzled) why += fmt::format("; {} in a row: puzzled", state_.song.mistakes_in_row);
  StopMusic();
  state_.open.reset();
  Enter(CoachMode::kCorrect, act, CoachEvent::kCorrects, std::move(why));
}

void Stepping::ReturnToDance() {
  LeaveForHome(library_.ClipReturning(state_.correcting), state_.playback, transitions_);
  state_.next_window = state_.correcting;
  Note(CoachEvent::kReturns, fmt::format("back to '{}'", NameOf(state_.correcting))).repetition = state_.correcting;
  NoteTransition();
  Become(CoachMode::kDance);
}

void Stepping::Enter(CoachMode mode, std::string_view act, CoachEvent event, std::string why) {
  LeaveFor(library_.ClipEntering(library_.ClipOfAct(act)), state_.playback, transitions_);
  CoachRecord& record = Note(event, std::move(why));
  if (mode == CoachMode::kCorrect) {
    record.repetition = state_.correcting;
    record.move = MoveOf(state_.correcting);
  }
  NoteTransition();
  Become(mode);
}

void Stepping::Become(CoachMode mode) {
  state_.mode = mode;
  state_.mode_since = state_.frame;
  state_.idle_since = state_.frame;
  state_.rate = 1;
  // Claps during a dance are part of the dance, so ignore them.
  state_.clap_waits = false;
  if (mode != CoachMode::kDance) state_.open.reset();
}

void Stepping::StopMusic() {
  if (state_.music_plays) out_.music = {.kind = MusicCommand::Kind::kPause};
  state_.music_plays = false;
}

void Stepping::NoteTransition() {
  const auto& record = state_.playback.path->record;
  Note(CoachEvent::kTransition, record->why).transition = record;
}

CoachRecord& Stepping::Note(CoachEvent event, std::string why) {
  CoachRecord& record = out_.records.emplace_back();
  record.event = event;
  record.frame = state_.frame;
  record.why = std::move(why);
  return record;
}

void Stepping::Say(std::string_view words, double seconds) {
  state_.say = words;
  state_.say_until = state_.frame + static_cast<std::int64_t>(seconds * kJudgedRateHz);
}

void Stepping::FollowMusic(double dance_frame) {
  // When the dance begins or continues, start the music.
  if (!state_.music_plays) {
    out_.music = {.kind = MusicCommand::Kind::kPlayFrom, .music_s = MusicAt(dance_, dance_frame)};
    state_.music_plays = true;
    state_.next_tag = NextTag(dance_, dance_frame);
    return;
  }
  // There is nothing to follow without music or after the last frame of the dance.
  if (!input_.music_s || IsOver(state_.playback, library_)) return;
  const double error_s = *input_.music_s - MusicAt(dance_, dance_frame);
  out_.beat_error_s = error_s;
  const int count = static_cast<int>(dance_.tags.size());
  // At each tag that the dance reaches, set the rate so that the next tag is reached on time.
  while (state_.next_tag < count && dance_frame >= static_cast<double>(dance_.tags[state_.next_tag].frame)) {
    const int tag = state_.next_tag++;
    if (options_.follows_tags) {
      state_.rate =
          RateToTag(dance_, state_.next_tag, dance_frame, *input_.music_s, options_.slowest, options_.fastest);
    }
    CoachRecord& record =
        Note(CoachEvent::kTag, fmt::format("the dance is {:.0f} ms {}; it continues at {:.3f} times the recorded speed",
                                           1000 * std::abs(error_s), error_s > 0 ? "late" : "early", state_.rate));
    record.tag = tag;
    record.beat_error_s = error_s;
    record.rate = state_.rate;
  }
}

}  // namespace etude
