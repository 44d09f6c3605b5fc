#include <etude/coaching.h>

#include <algorithm>
#include <cmath>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "engine/coaching/session.h"

namespace etude::engine {
namespace {

etude::Dance ToEngineDance(const Dance& dance) {
  etude::Dance told{.title = dance.title, .motion = ToBodyMotion(dance.motion)};
  for (const DanceMove& move : dance.moves) {
    const BodyMotion key = ToBodyMotion({.rate_hz = kJudgedRateHz, .poses = {move.key_pose}});
    told.moves.push_back({move.name, move.hint, key.poses.front(), ToBodyMotion(move.slow)});
  }
  for (const Repetition& each : dance.repetitions) told.repetitions.push_back({each.move, each.first, each.end});
  for (const MusicTag& tag : dance.tags) told.tags.push_back({tag.frame, tag.music_s});
  for (const CoachAct& act : dance.acts) told.acts.push_back({act.name, ToBodyMotion(act.motion), act.loops});
  OrThrow(CheckDance(told).map([] { return true; }));
  StandingHipsOf(told.motion.poses.front());
  return told;
}

std::vector<etude::TaughtMove> MovesOfDance(const etude::Dance& dance, std::span<const TaughtMove> moves) {
  if (moves.size() != dance.moves.size()) {
    throw BadInput(fmt::format("{} moves; allowed: the {} of the dance", moves.size(), dance.moves.size()));
  }
  std::vector<etude::TaughtMove> taught;
  for (const TaughtMove& move : moves) {
    const std::string& wanted = dance.moves[taught.size()].name;
    if (move.name != wanted) {
      throw BadInput(fmt::format("move {}: '{}'; allowed: the dance's move, '{}'", taught.size(), move.name, wanted));
    }
    taught.push_back(ToEngineMove(move));
  }
  return taught;
}

const Policy* PolicyNamed(const std::string& name) {
  const std::vector<std::string> names = LivePolicyNames();
  if (std::ranges::find(names, name) != names.end()) return FindPolicy(name);
  throw BadInput(fmt::format("policy '{}'; allowed: {}", name, Join(names)));
}

etude::CoachOptions ToEngineOptions(const CoachOptions& options, const RecogniserKind& kind) {
  etude::CoachOptions told;
  told.right_from = options.right_from.value_or(kind.threshold);
  told.player_mirrors = options.mirrors;
  told.sensor = options.sensor_m;
  if (!(told.right_from > 0 && told.right_from <= 1)) {
    throw BadInput(fmt::format("right_from {}; allowed: above 0, up to 1", told.right_from));
  }
  if (!std::isfinite(told.sensor.x + told.sensor.y + told.sensor.z)) throw BadInput("sensor_m is not finite");
  return told;
}

CoachDecision FromRecord(const CoachRecord& record) {
  return {.event = std::string(EventName(record.event)),
          .frame = record.frame,
          .move = record.move >= 0 ? std::optional(record.move) : std::nullopt,
          .mistake = record.mistake == Mistake::kNone ? "" : std::string(MistakeName(record.mistake)),
          .evidence = record.evidence,
          .why = record.why};
}

CoachFrame FromOutput(const CoachOutput& output) {
  CoachFrame frame{.mode = std::string(ModeName(output.mode)),
                   .body = {output.body.joints},
                   .clip = std::string(output.clip),
                   .clip_frame = output.clip_frame,
                   .in_transition = output.in_transition,
                   .asked = output.open ? std::optional(output.open->move) : std::nullopt,
                   .say = std::string(output.say),
                   .hint = std::string(output.hint),
                   .stand = std::string(HintText(output.stand)),
                   .play_from_s = {},
                   .pause_music = output.music.kind == MusicCommand::Kind::kPause,
                   .decisions = {}};
  if (output.music.kind == MusicCommand::Kind::kPlayFrom) frame.play_from_s = output.music.music_s;
  std::ranges::transform(output.records, std::back_inserter(frame.decisions), FromRecord);
  return frame;
}

}  // namespace

std::vector<std::string> RequiredActs() { return etude::RequiredActs(); }
std::vector<std::string> CoachPolicies() { return LivePolicyNames(); }

struct Coach::Session {
  DanceLibrary library;
  DanceTransitions transitions;
  std::unique_ptr<etude::Recogniser> recogniser;
  etude::Coach coach;
  CoachSession session;

  Session(DanceLibrary made, const RecogniserKind& kind, std::span<const etude::TaughtMove> taught,
          const CoachOptions& options)
      : library(std::move(made)),
        transitions(library, WayNamed(options.choice, options.join)),
        recogniser(OrThrow(MakeRecogniser({.kind = &kind}, taught))),
        coach(transitions, ToEngineOptions(options, kind), {PolicyNamed(options.policy), {}}),
        session({.coach = &coach,
                 .recogniser = recogniser.get(),
                 .filter = {.kind = options.smooths ? FilterKind::kHolt : FilterKind::kNone}},
                options.dances_at_once ? coach.BeginDancing() : coach.Begin()) {}
};

Coach::Coach(const Dance& dance, std::span<const TaughtMove> moves, const CoachOptions& options) {
  const RecogniserKind& kind = KindOfExamples(options.recogniser);
  WayNamed(options.choice, options.join);
  PolicyNamed(options.policy);
  ToEngineOptions(options, kind);
  etude::Dance told = ToEngineDance(dance);
  const std::vector<etude::TaughtMove> taught = MovesOfDance(told, moves);
  session_ = std::make_unique<Session>(OrThrow(DanceLibrary::Make(std::move(told))), kind, taught, options);
}

Coach::Coach(Coach&&) noexcept = default;
Coach& Coach::operator=(Coach&&) noexcept = default;
Coach::~Coach() = default;

CoachFrame Coach::Step(const SensedPose& frame, std::optional<double> music_s) {
  if (music_s && !(*music_s >= 0 && *music_s <= 1e6)) {
    throw BadInput(fmt::format("music_s {}; allowed: 0 to 1e6, or none", *music_s));
  }
  return FromOutput(session_->session.Next(ToEngineFrame(frame), {.music_s = music_s}));
}

}  // namespace etude::engine
