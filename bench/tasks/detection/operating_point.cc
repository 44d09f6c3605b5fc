#include "bench/tasks/detection/operating_point.h"

#include <algorithm>
#include <iterator>

#include "bench/tasks/detection/run.h"
#include "bench/tasks/detection/score.h"
#include "engine/base/named.h"

namespace etude {
namespace {

double AlarmsPerMinute(std::span<const AlarmTrial> trials, const DecisionOptions& decision) {
  std::size_t alarms = 0;
  double seconds = 0;
  for (const AlarmTrial& trial : trials) {
    for (const Detection& detection : FindMoves(*trial.trace, trial.rate_hz, decision)) {
      if (!trial.is_performance(detection)) ++alarms;
    }
    seconds += static_cast<double>(trial.trace->asked.size()) / trial.rate_hz;
  }
  return FalseAlarmsPerMinute(alarms, seconds);
}

}  // namespace

double ThresholdAt(std::span<const AlarmTrial> trials, double false_alarms_per_min, double refractory_s) {
  double too_low = 0, enough = 1;
  for (int halving = 0; halving < 16; ++halving) {
    const double middle = 0.5 * (too_low + enough);
    const double rate = AlarmsPerMinute(trials, {.threshold = middle, .refractory_s = refractory_s});
    (rate > false_alarms_per_min ? too_low : enough) = middle;
  }
  return enough;
}

void AddTrials(const std::shared_ptr<const DetectionWorld>& world, std::span<const ReadyMethod> methods,
               const Repertoire& repertoire, TrialsOfMethods& trials) {
  const std::vector<FrameInterval> takes = world->Takes();
  const std::vector<std::string> names = NamesOf(repertoire.taught);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto& [method, recogniser] = methods[m];
    if (method.threshold) continue;
    const SeenStream seen = SeeSession(*world, method);
    std::vector<EvidenceTrace> traces = FollowSession(*world, seen, repertoire, *recogniser);
    std::ranges::copy(JudgedEvents(*world, JudgeEvents(*world, traces, 1)), std::back_inserter(trials[m].events));
    for (std::size_t t = 0; t < takes.size(); ++t) {
      const auto is_performance = [world, names, begin = takes[t].begin](const Detection& detection) {
        return IsPerformance(names[detection.move], begin + detection.frame, *world);
      };
      trials[m].alarms.push_back(
          {std::make_shared<const EvidenceTrace>(std::move(traces[t])), seen.filtered.rate_hz, is_performance});
    }
  }
}

std::vector<MethodDecision> DecideBy(std::span<const ReadyMethod> methods, const TrialsOfMethods& trials,
                                     const std::optional<OperatingPoint>& point) {
  std::vector<MethodDecision> decisions;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    auto& [spotting, judging] = decisions.emplace_back(methods[m].method.Decision());
    if (!point || methods[m].method.threshold) continue;
    spotting.threshold = ThresholdAt(trials[m].alarms, point->false_alarms_per_min, spotting.refractory_s);
    // The threshold stays positive. A performance without evidence is therefore never judged right, even at full
    // recall.
    constexpr double kMinJudging = 1e-4;
    judging = std::max(kMinJudging, ThresholdAtRecall(trials[m].events, point->recall).value_or(spotting.threshold));
  }
  return decisions;
}

const std::vector<MethodDecision>& MethodDecisions::For(const WorldKey& key) {
  const auto [known, is_new] = known_.try_emplace({key.suite_seed, std::string(key.scenario)});
  if (is_new) known->second = Set(key);
  return known->second;
}

std::vector<MethodDecision> MethodDecisions::Set(const WorldKey& key) const {
  TrialsOfMethods trials(methods_.size());
  const int sessions = options_.operating_point ? options_.operating_point->sessions : 0;
  const std::string others = std::string(key.scenario) + "/operating-point";
  DetectionOptions usual = options_;
  usual.session = {.people = options_.session.people, .events = options_.session.events};
  for (int session = 0; session < sessions; ++session) {
    if (options_.session.people == People::kMixed) usual.session.people = KindInMixture((session + 0.5) / sessions);
    const auto world = std::make_shared<const DetectionWorld>(
        MakeDetectionWorld(repertoire_, usual, {key.suite_seed, others, session}));
    AddTrials(world, methods_, repertoire_, trials);
  }
  return DecideBy(methods_, trials, options_.operating_point);
}

}  // namespace etude
