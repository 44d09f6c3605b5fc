#include <etude/coaching.h>

#include <algorithm>
#include <cmath>

#include "engine/api/checks.h"
#include "engine/base/names.h"
#include "engine/coaching/session.h"

namespace etude::engine {
namespace {

void CheckCoached(const Dance& dance, std::span<const TaughtMove> moves) {
  Checked(dance.motion);
  for (const DanceMove& move : dance.moves) {
    Checked({.poses = {move.key_pose}});
    Checked(move.slow);
  }
  for (const CoachAct& act : dance.acts) Checked(act.motion);
  OrThrow(CheckDance(dance));
  StandingHipsOf(dance.motion.poses.front());
  if (moves.size() != dance.moves.size()) {
    throw BadInput(
        fmt::format("found {} moves; allowed: {}, one for each move of the dance", moves.size(), dance.moves.size()));
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const std::string& wanted = dance.moves[i].name;
    if (moves[i].name == wanted) continue;
    throw BadInput(fmt::format("move {} is '{}'; allowed: '{}', the move with this number in the dance", i,
                               moves[i].name, wanted));
  }
  CheckMoves(moves);
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
    throw BadInput(fmt::format("right_from is {}; allowed: above 0, up to 1", told.right_from));
  }
  if (!std::isfinite(told.sensor.x + told.sensor.y + told.sensor.z)) throw BadInput("sensor_m is not finite");
  return told;
}

}  // namespace

std::vector<std::string> CoachPolicies() { return LivePolicyNames(); }

struct Coach::Session {
  DanceLibrary library;
  DanceTransitions transitions;
  std::unique_ptr<etude::Recogniser> recogniser;
  etude::Coach coach;
  CoachSession session;

  Session(DanceLibrary made, const RecogniserKind& kind, std::span<const TaughtMove> taught,
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
  CheckCoached(dance, moves);
  session_ = std::make_unique<Session>(OrThrow(DanceLibrary::Make(dance)), kind, moves, options);
}

Coach::Coach(Coach&&) noexcept = default;
Coach& Coach::operator=(Coach&&) noexcept = default;
Coach::~Coach() = default;

CoachOutput Coach::Step(const SensedFrame& frame, std::optional<double> music_s) {
  if (music_s && !(*music_s >= 0 && *music_s <= 1e6)) {
    throw BadInput(fmt::format("music_s is {}; allowed: 0 to 1e6, or none", *music_s));
  }
  CheckFrame(frame);
  return session_->session.Next(frame, {.music_s = music_s});
}

}  // namespace etude::engine
