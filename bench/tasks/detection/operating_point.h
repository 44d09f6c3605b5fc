#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/metrics/detection.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// A method whose recogniser was taught all moves.
struct ReadyMethod {
  DetectionMethod method;
  std::unique_ptr<Recogniser> recogniser;
};

/// The evidence of a session, and what is no false alarm in it.
struct AlarmTrial {
  std::shared_ptr<const EvidenceTrace> trace;
  double rate_hz = kJudgedRateHz;
  std::function<bool(const Detection&)> is_performance;
};

/// The least threshold of spotting, to 1 in 2¹⁶, at which the trials together give at most so many false alarms a
/// minute; alarms become fewer as it rises, but for some that a refractory time hides. 1 where even that gives more. At
/// least one trial, none without frames.
double ThresholdAt(std::span<const AlarmTrial> trials, double false_alarms_per_min, double refractory_s);

/// The evidence that a method saw of other people: all that it may take for a move, and what was asked for, judged at
/// no threshold.
struct MethodTrials {
  std::vector<AlarmTrial> alarms;
  std::vector<JudgedEvent> events;
};
using TrialsOfMethods = std::vector<MethodTrials>;

/// Adds what each method that says no threshold of its own sees in a world. `repertoire`: what all were taught.
void AddTrials(const std::shared_ptr<const DetectionWorld>& world, std::span<const ReadyMethod> methods,
               const Repertoire& repertoire, TrialsOfMethods& trials);

/// The thresholds of each method: its own, else those of the operating point on its trials, when there is an
/// operating point. Where nobody was right, the threshold of spotting serves for judging, too. `trials`: everybody's
/// but those of the person judged.
std::vector<MethodDecision> DecideBy(std::span<const ReadyMethod> methods, const TrialsOfMethods& trials,
                                     const std::optional<OperatingPoint>& point);

/// The thresholds of each method of a scenario of simulated people. With an operating point, thresholds that methods do
/// not say themselves are set the first time they are asked for, on sessions of people that are keyed apart from those
/// judged; of a mixture every kind has its share.
class MethodDecisions {
 public:
  /// The arguments must outlive this.
  MethodDecisions(const std::vector<ReadyMethod>& methods, const Repertoire& repertoire,
                  const DetectionOptions& options)
      : methods_(methods), repertoire_(repertoire), options_(options) {}

  /// One per method, for all worlds of this key's scenario and seed.
  const std::vector<MethodDecision>& For(const WorldKey& key);

 private:
  std::vector<MethodDecision> Set(const WorldKey& key) const;

  const std::vector<ReadyMethod>& methods_;
  const Repertoire& repertoire_;
  const DetectionOptions& options_;
  std::map<std::pair<Seed, std::string>, std::vector<MethodDecision>> known_;
};

}  // namespace etude
