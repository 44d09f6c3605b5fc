#include "bench/tasks/coach/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/metrics/coach.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/model/recording.h"
#include "bench/statistics/curves/curves.h"
#include "bench/tasks/coach/exchange.h"
#include "bench/tasks/coach/learner_player.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

/// Lets the coach correct the learner at exactly the frames at which it corrected in another session.
class Moments final : public MomentSource {
 public:
  explicit Moments(const SessionLog& other) {
    for (const GivenCorrection& correction : other.corrections) frames_.push_back(correction.decided_frame);
  }
  bool Now(int frame, const CoachOutput& /*before*/) override { return std::ranges::binary_search(frames_, frame); }

 private:
  std::vector<int> frames_;
};

SessionParts PartsOf(const ReadyCoach& ready, const Coach& coach, const Recogniser& recogniser) {
  const DetectionMethod& sight = ready.method.sight;
  return {coach, recogniser, sight.filter, sight.sees_truth, sight.Capture()};
}

/// Runs a session of another person under the same condition. A method with the policy `yoked` then corrects at the
/// times at which the other person was corrected.
Result<SessionLog> RunPartner(const ReadyCoach& ready, const CoachCondition& condition, const CoachStage& stage,
                              const CoachWorld& world) {
  const std::string scenario = fmt::format("{}/partner", world.key.scenario);
  const CoachWorld other = MakeCoachWorld(condition, {world.key.suite_seed, scenario, world.key.trial});
  LearnerPlayer player(other, stage);
  return RunSession(PartsOf(ready, *ready.partner, *ready.recogniser), other, player, nullptr);
}

bool AreAlike(const TransitionWay& a, const TransitionWay& b) {
  return a.choice == b.choice && a.join == b.join && a.choice_settings == b.choice_settings &&
         a.join_settings == b.join_settings && a.rules.threshold == b.rules.threshold && a.rules.pick == b.rules.pick &&
         a.rules.within_class == b.rules.within_class;
}

/// Returns the coach's own policy. If a program replaces the policy, returns the policy `yoked`, which corrects only at
/// the moments that it is given, because the program then decides when to correct.
Coach::PolicyChoice PolicyOf(const CoachMethod& method) {
  if (method.seat == Seat::kPolicy) return {FindPolicy("yoked"), {}};
  return method.policy;
}

CoachedSession SessionOf(const SessionLog& log) {
  CoachedSession session{.rate_hz = kJudgedRateHz, .frames = log.Frames(), .performances = {}, .corrections = {}};
  for (const LoggedPerformance& performance : log.performances) session.performances.push_back(performance.judged);
  session.corrections = log.corrections;
  return session;
}

/// Returns the truths of the performances, for each move of the dance.
std::vector<std::vector<PerformanceTruth>> TruthsByMove(const SessionLog& log, std::size_t moves) {
  std::vector<std::vector<PerformanceTruth>> truths(moves);
  for (const LoggedPerformance& performance : log.performances) {
    truths[static_cast<std::size_t>(performance.move)].push_back(performance.judged.truth);
  }
  return truths;
}

/// Returns the jump of every transition whose whole window lies in the session, centimetres.
std::vector<double> JumpsOf(const SessionLog& log) {
  const std::vector<double> jumps = SecondDifferencesCm(log.coach);
  std::vector<double> worst;
  for (const LoggedTransition& transition : log.transitions) {
    double jump = -1;
    for (const int point : transition.points) {
      const int first = std::max(0, point - kWindowReach), last = point + kWindowReach;
      if (last >= log.Frames()) continue;
      for (int frame = first; frame <= last; ++frame) jump = std::max(jump, jumps[static_cast<std::size_t>(frame)]);
    }
    if (jump >= 0) worst.push_back(jump);
  }
  return worst;
}

void MeasureCorrections(const CoachedSession& session, CellResult& result) {
  const CorrectionTally tally = TallyCorrections(session);
  const std::string no_mistake = "no performance was wrong";
  result.MeasureOr("answered_share", AnsweredShare(tally), no_mistake);
  result.Measure("corrections_due_per_min", tally.due / session.Minutes());
  result.Measure("corrections_given_per_min", tally.given / session.Minutes());
  result.Measure("corrections_missed_per_min", tally.missed / session.Minutes());
  result.Measure("corrections_unneeded_per_min", tally.unneeded / session.Minutes());
  result.Measure("wrong_praise_per_min", tally.wrong_praise / session.Minutes());
  result.MeasureOr("decision_delay_s", DecisionDelaySeconds(session),
                   tally.due == 0 ? no_mistake : "fewer than half of the mistakes were recognised");
  result.MeasureOr("feedback_delay_s", FeedbackDelaySeconds(session),
                   tally.given == 0 ? "nothing was corrected" : "fewer than half of the acts began");
  result.MeasureOr("feedback_delay_max_s", MaxFeedbackDelaySeconds(session),
                   tally.given == 0 ? "nothing was corrected" : "no act began");
}

std::string MotionDigest(const BodyMotion& motion) {
  Digest digest;
  for (const BodyPose& pose : motion.poses) AddTo(digest, pose);
  return digest.Hex();
}

std::string DecisionDigest(const SessionLog& log) {
  Digest digest;
  for (const CoachRecord& record : log.records) {
    digest.Add(EventName(record.event)).Add(record.frame).Add(std::int64_t{record.repetition}).Add(record.evidence);
  }
  for (const LoggedPerformance& performance : log.performances) {
    digest.Add(std::int64_t{performance.repetition}).Add(static_cast<std::int64_t>(performance.judged.truth));
  }
  return digest.Hex();
}

/// Returns 1, ½ or 0 (right, grey or wrong) for each performance.
Series TruthSeries(const SessionLog& log) {
  Series series{.name = "right", .axis = "performance", .values = {}};
  for (const LoggedPerformance& performance : log.performances) {
    const PerformanceTruth truth = performance.judged.truth;
    series.values.push_back(truth == PerformanceTruth::kRight ? 1 : truth == PerformanceTruth::kGrey ? 0.5 : 0);
  }
  return series;
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
  // If there is a program, let it replace its part of the loop: recogniser, policy or learner.
  const Seat seat = program != nullptr ? ready.method.seat : Seat::kNone;
  std::optional<SeatedCoachProgram> seated;
  if (program != nullptr) seated.emplace(*program, stage);
  std::unique_ptr<Recogniser> seated_recogniser;
  std::unique_ptr<MomentSource> moments;
  std::unique_ptr<Player> player;
  if (seat == Seat::kRecogniser) seated_recogniser = MakeSeatedRecogniser(*seated);
  if (seat == Seat::kPolicy) moments = MakeSeatedPolicy(*seated);
  if (seat == Seat::kLearner) player = MakeSeatedLearner(*seated);
  if (player == nullptr) player = std::make_unique<LearnerPlayer>(world, stage);
  // A method with the policy `yoked` corrects at the times of a session of another person. Run that session first.
  if (ready.partner != nullptr) {
    ASSIGN_OR_RETURN(const SessionLog partner, RunPartner(ready, condition, stage, world));
    moments = std::make_unique<Moments>(partner);
  }

  const SessionParts parts = PartsOf(ready, *ready.coach, seated_recogniser ? *seated_recogniser : *ready.recogniser);
  if (program != nullptr && !program->Begin(SessionBeginPayload(seat))) return SessionLog{};
  ASSIGN_OR_RETURN(SessionLog log, RunSession(parts, world, *player, moments.get()));
  if (seated && seated->error()) return tl::unexpected(*seated->error());
  return log;
}

void ScoreCoaching(const CoachWorld& world, const CoachStage& stage, const SessionLog& log, CellResult& result) {
  // Measure the success of learner and coach.
  result.MeasureOr("retention", Retention(log.test), "nothing in the test was right or wrong");
  const CoachedSession session = SessionOf(log);
  MeasureCorrections(session, result);
  result.MeasureOr("repetitions_until_right", RepetitionsUntilRight(TruthsByMove(log, stage.moves.size())),
                   "no move began wrong, or fewer than half became right");
  const auto danced = std::ranges::count(log.modes, CoachMode::kDance);
  result.Measure("danced_share", static_cast<double>(danced) / world.frames);
  result.Measure("gave_up", log.given_up_at ? 1 : 0);
  // Measure the quality of the dance: beats and transitions.
  result.MeasureOr("beat_error_ms", BeatErrorMs(log.beat_errors_s), "nothing was danced to music");
  const auto bridged = std::ranges::count_if(log.transitions, &LoggedTransition::is_bridged);
  result.MeasureOr("transition_bridged_share", Share(bridged, static_cast<std::int64_t>(log.transitions.size())),
                   "there was no transition");
  const std::vector<double> jumps = JumpsOf(log);
  result.MeasureOr("transition_jump_cm", MedianOf(jumps), "there was no transition");
  result.MeasureOr("transition_natural_share", NaturalShare(jumps, stage.natural_jumps_cm), "there was no transition");

  // Compute the digests of the session's stages.
  Digest sensed;
  for (const SensedFrame& frame : log.sensed.frames) {
    for (const SensedJoint& joint : frame.joints) {
      sensed.Add(joint.position.x).Add(joint.position.y).Add(joint.position.z).Add(std::int64_t(joint.state));
    }
  }
  result.digests = {{"danced", MotionDigest(log.learner)},
                    {"sensed", sensed.Hex()},
                    {"decided", DecisionDigest(log)},
                    {"shown", MotionDigest(log.coach)}};
  result.series.push_back(TruthSeries(log));
}

std::vector<std::string> CoachMetrics() {
  return {"retention",
          "answered_share",
          "corrections_unneeded_per_min",
          "corrections_due_per_min",
          "corrections_given_per_min",
          "corrections_missed_per_min",
          "wrong_praise_per_min",
          "decision_delay_s",
          "feedback_delay_s",
          "feedback_delay_max_s",
          "repetitions_until_right",
          "danced_share",
          "gave_up",
          "beat_error_ms",
          "transition_jump_cm",
          "transition_natural_share",
          "transition_bridged_share"};
}

}  // namespace etude
