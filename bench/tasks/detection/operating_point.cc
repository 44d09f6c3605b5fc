#include "bench/tasks/detection/operating_point.h"

#include "bench/metrics/detection.h"
#include "bench/tasks/detection/run.h"

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
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto& [method, recogniser] = methods[m];
    if (method.threshold) continue;
    const SeenStream seen = SeeSession(*world, method);
    std::vector<EvidenceTrace> traces = FollowSession(*world, seen, repertoire, *recogniser);
    for (std::size_t t = 0; t < takes.size(); ++t) {
      const auto is_performance = [world, &repertoire, begin = takes[t].begin](const Detection& detection) {
        return IsPerformance(repertoire.taught[detection.move].name, begin + detection.frame, *world);
      };
      trials[m].push_back(
          {std::make_shared<const EvidenceTrace>(std::move(traces[t])), seen.filtered.rate_hz, is_performance});
    }
  }
}

std::vector<DecisionOptions> DecideBy(std::span<const ReadyMethod> methods, const TrialsOfMethods& trials,
                                      const std::optional<OperatingPoint>& point) {
  std::vector<DecisionOptions> decisions;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    DecisionOptions& decision = decisions.emplace_back(methods[m].method.Decision());
    if (!point || methods[m].method.threshold) continue;
    decision.threshold = ThresholdAt(trials[m], point->false_alarms_per_min, decision.refractory_s);
  }
  return decisions;
}

const std::vector<DecisionOptions>& MethodDecisions::For(const WorldKey& key) {
  const auto [known, is_new] = known_.try_emplace({key.suite_seed, std::string(key.scenario)});
  if (is_new) known->second = Set(key);
  return known->second;
}

std::vector<DecisionOptions> MethodDecisions::Set(const WorldKey& key) const {
  TrialsOfMethods trials(methods_.size());
  const int sessions = options_.operating_point ? options_.operating_point->sessions : 0;
  const std::string others = std::string(key.scenario) + "/operating-point";
  for (int session = 0; session < sessions; ++session) {
    const auto world = std::make_shared<const DetectionWorld>(
        MakeDetectionWorld(repertoire_, options_, {key.suite_seed, others, session}));
    AddTrials(world, methods_, repertoire_, trials);
  }
  return DecideBy(methods_, trials, options_.operating_point);
}

}  // namespace etude
