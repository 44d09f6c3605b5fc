#include "bench/tasks/transition/follow.h"

namespace etude {
namespace {

/// As a built-in choice would have told it.
SwitchRecord RecordOf(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  SwitchRecord record;
  record.request_frame = request.request_frame;
  record.legs = answer.legs;
  record.wait_s = WaitOf(record.legs, kJudgedRateHz);
  record.why = "a method outside the program says so";
  for (std::size_t i = 0; i + 1 < record.legs.size(); ++i) {
    const Leg &old = record.legs[i], &next = record.legs[i + 1];
    const auto grades = [&](const Leg& leg, int frame) {
      return leg.clip == Leg::kOwnFrames
                 ? Fuzzify(ComputeFeatures(leg.own[frame], stage.library.physique.standing_hip_height))
                 : stage.library.tagged[leg.clip].grades[frame];
    };
    record.meetings.push_back(ComputeDistance(grades(old, old.last), grades(next, next.first), PaperWeights()));
  }
  const bool is_front = record.legs.back().first < stage.library.tagged[request.to].FrameCount() / 2;
  record.branch = record.legs.size() > 2 ? Branch::kInBetween : is_front ? Branch::kFrontHalf : Branch::kRearHalf;
  return record;
}

}  // namespace

SwitchOutcome FollowAnswer(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  SwitchOutcome outcome{.matched = answer.matched, .weights = PaperWeights(), .record = {}, .splice = {}};
  outcome.record = RecordOf(answer, stage, request);
  outcome.splice = SpliceLegs(stage.library.motions, outcome.record.legs, *answer.join);
  return outcome;
}

}  // namespace etude
