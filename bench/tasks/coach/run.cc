#include "bench/tasks/coach/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bench/tasks/coach/exchange.h"
#include "bench/tasks/coach/learner_player.h"

namespace etude {
namespace {

/// Corrects at the frames at which another session did.
class Moments final : public MomentSource {
 public:
  explicit Moments(const SessionLog& other) {
    for (const GivenCorrection& correction : other.corrections) frames_.push_back(correction.decided_frame);
  }
  bool Now(int frame, const CoachOutput& /*before*/) override { return std::ranges::binary_search(frames_, frame); }

 private:
  std::vector<int> frames_;
};

/// The session that a yoked one takes its moments from: another person's, under the same condition.
Result<SessionLog> RunPartner(const ReadyCoach& ready, const CoachCondition& condition, const CoachStage& stage,
                              const CoachWorld& world) {
  const std::string scenario = fmt::format("{}/partner", world.key.scenario);
  const CoachWorld other = MakeCoachWorld(condition, {world.key.suite_seed, scenario, world.key.trial});
  LearnerPlayer player(other, stage);
  const SessionParts parts{*ready.partner, *ready.recogniser, ready.method.sight.filter, ready.method.sight.sees_truth,
                           ready.method.sight.Capture()};
  return RunSession(parts, other, player, nullptr);
}

bool AreAlike(const TransitionWay& a, const TransitionWay& b) {
  return a.choice == b.choice && a.join == b.join && a.choice_settings == b.choice_settings &&
         a.join_settings == b.join_settings && a.rules.threshold == b.rules.threshold && a.rules.pick == b.rules.pick &&
         a.rules.within_class == b.rules.within_class;
}

/// The policy that the coach itself has: a program in that seat says when to correct, and so does a partner.
Coach::PolicyChoice PolicyOf(const CoachMethod& method) {
  if (method.seat == Seat::kPolicy) return {FindPolicy("yoked"), {}};
  return method.policy;
}

}  // namespace

Result<std::vector<ReadyCoach>> MakeReady(std::vector<CoachMethod> methods, const CoachStage& stage) {
  std::vector<ReadyCoach> all;
  for (CoachMethod& method : methods) {
    ReadyCoach ready;
    for (const ReadyCoach& other : all) {
      if (AreAlike(other.method.transition.way, method.transition.way)) ready.transitions = other.transitions;
    }
    if (!ready.transitions) {
      ready.transitions = std::make_shared<DanceTransitions>(*stage.library, method.transition.way);
    }
    auto recogniser = MakeRecogniser(method.sight.recogniser, stage.taught);
    if (!recogniser) return Fail({}, "method {}: {}", method.name, recogniser.error().message);
    ready.recogniser = *std::move(recogniser);
    method.coach.right_from = method.sight.Decision().judging;
    ready.coach = std::make_unique<Coach>(*ready.transitions, method.coach, PolicyOf(method));
    if (method.policy.policy->takes_moments) {
      ready.partner =
          std::make_unique<Coach>(*ready.transitions, method.coach, Coach::PolicyChoice{method.partner, {}});
    }
    ready.method = std::move(method);
    all.push_back(std::move(ready));
  }
  return all;
}

Result<SessionLog> RunMethod(const ReadyCoach& ready, const CoachCondition& condition, const CoachStage& stage,
                             const CoachWorld& world, LiveProgram* program) {
  const Seat seat = program != nullptr ? ready.method.seat : Seat::kNone;
  SeatComplaint complaint;
  std::unique_ptr<Recogniser> seated_recogniser;
  std::unique_ptr<MomentSource> moments;
  std::unique_ptr<Player> player;
  if (seat == Seat::kRecogniser) seated_recogniser = MakeSeatedRecogniser(*program, stage, complaint);
  if (seat == Seat::kPolicy) moments = MakeSeatedPolicy(*program, stage, complaint);
  if (seat == Seat::kLearner) player = MakeSeatedLearner(*program, stage, complaint);
  if (player == nullptr) player = std::make_unique<LearnerPlayer>(world, stage);
  if (ready.partner != nullptr) {
    ASSIGN_OR_RETURN(const SessionLog partner, RunPartner(ready, condition, stage, world));
    moments = std::make_unique<Moments>(partner);
  }

  const SessionParts parts{*ready.coach, seated_recogniser ? *seated_recogniser : *ready.recogniser,
                           ready.method.sight.filter, ready.method.sight.sees_truth, ready.method.sight.Capture()};
  if (program != nullptr && !program->Begin(SessionBeginPayload(seat))) return SessionLog{};
  ASSIGN_OR_RETURN(SessionLog log, RunSession(parts, world, *player, moments.get()));
  if (complaint.error()) return tl::unexpected(*complaint.error());
  return log;
}

}  // namespace etude
