#include "bench/tasks/transition/follow.h"

namespace etude {
namespace {

Grades GradesAt(const Leg& leg, int frame, const Stage& stage) {
  if (leg.clip != Leg::kOwnFrames) return stage.library.tagged[leg.clip].grades[frame];
  return Fuzzify(ComputeFeatures(leg.own[frame], stage.library.physique.standing_hip_height), stage.fuzzy.memberships);
}

/// As a built-in choice would have told it.
SwitchRecord RecordOf(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  SwitchRecord record;
  record.request_frame = request.request_frame;
  record.legs = answer.legs;
  record.wait_s = WaitOf(record.legs, kJudgedRateHz);
  record.why = "a method outside the program says so";
  for (std::size_t i = 0; i + 1 < record.legs.size(); ++i) {
    const Leg &old = record.legs[i], &next = record.legs[i + 1];
    record.meetings.push_back(
        ComputeDistance(GradesAt(old, old.last, stage), GradesAt(next, next.first, stage), stage.fuzzy.weights));
  }
  const bool is_front = stage.library.tagged[request.to].InFrontHalf(record.legs.back().first);
  record.branch = record.legs.size() > 2 ? Branch::kInBetween : is_front ? Branch::kFrontHalf : Branch::kRearHalf;
  return record;
}

}  // namespace

SwitchOutcome FollowAnswer(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  SwitchOutcome outcome{.request = request,
                        .matched = answer.matched,
                        .rules = {.weights = stage.fuzzy.weights},
                        .record = RecordOf(answer, stage, request),
                        .splice = {}};
  outcome.splice = SpliceLegs(stage.library.motions, outcome.record.legs, *answer.join);
  return outcome;
}

}  // namespace etude
