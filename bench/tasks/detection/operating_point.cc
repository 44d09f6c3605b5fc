#include "bench/tasks/detection/operating_point.h"

#include "bench/metrics/detection.h"
#include "bench/tasks/detection/run.h"

namespace etude {
namespace {

double AlarmsPerMinute(std::span<const AlarmTrial> trials, const DecisionOptions& decision) {
  std::size_t alarms = 0;
  double seconds = 0;
  for (const AlarmTrial& trial : trials) {
    for (const Detection& detection : FindMoves(trial.trace, trial.rate_hz, decision)) {
      if (!trial.is_performance(detection)) ++alarms;
    }
    seconds += static_cast<double>(trial.trace.asked.size()) / trial.rate_hz;
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

const std::vector<DecisionOptions>& MethodDecisions::For(const WorldKey& key) {
  const auto [known, is_new] = known_.try_emplace({key.suite_seed, std::string(key.scenario)});
  if (is_new) known->second = Set(key);
  return known->second;
}

std::vector<DecisionOptions> MethodDecisions::Set(const WorldKey& key) const {
  std::vector<DecisionOptions> decisions;
  for (const ReadyMethod& ready : methods_) decisions.push_back(ready.method.Decision());
  if (!options_.operating_point) return decisions;

  const std::string others = std::string(key.scenario) + "/operating-point";
  std::vector<std::vector<AlarmTrial>> trials(methods_.size());
  for (int session = 0; session < options_.operating_point->sessions; ++session) {
    const auto world = std::make_shared<const DetectionWorld>(
        MakeDetectionWorld(repertoire_, options_, {key.suite_seed, others, session}));
    const auto is_performance = [this, world](const Detection& detection) {
      return IsPerformance(repertoire_.taught[detection.move].name, detection.frame, *world);
    };
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const auto& [method, recogniser] = methods_[m];
      if (method.threshold) continue;
      const SeenStream seen = SeeSession(*world, method);
      trials[m].push_back(
          {FollowSession(*world, seen, repertoire_, *recogniser), seen.filtered.rate_hz, is_performance});
    }
  }
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    if (methods_[m].method.threshold) continue;
    decisions[m].threshold =
        ThresholdAt(trials[m], options_.operating_point->false_alarms_per_min, decisions[m].refractory_s);
  }
  return decisions;
}

}  // namespace etude
