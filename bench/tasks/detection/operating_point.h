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

/// A method with a recogniser that was taught all moves.
struct ReadyMethod {
  DetectionMethod method;
  std::unique_ptr<Recogniser> recogniser;
};

/// The evidence of a session, and a function that tells true detections from false alarms.
struct AlarmTrial {
  std::shared_ptr<const EvidenceTrace> trace;
  double rate_hz = kJudgedRateHz;
  std::function<bool(const Detection&)> is_performance;
};

/// Returns the smallest threshold of spotting, to 1 in 2¹⁶, at which all trials together give at most
/// `false_alarms_per_min`. The rate falls as the threshold rises, except for alarms that a refractory time hides.
/// Returns 1 if even a threshold of 1 gives more. At least one trial is required, each with frames.
double ThresholdAt(std::span<const AlarmTrial> trials, double false_alarms_per_min, double refractory_s);

/// A method's results for other people: its evidence for all moves, and the requested performances, judged without a
/// threshold.
struct MethodTrials {
  std::vector<AlarmTrial> alarms;
  std::vector<JudgedEvent> events;
};
using TrialsOfMethods = std::vector<MethodTrials>;

/// Adds the results, in one world, of each method without a threshold of its own. All methods were taught `repertoire`.
void AddTrials(const std::shared_ptr<const DetectionWorld>& world, std::span<const ReadyMethod> methods,
               const Repertoire& repertoire, TrialsOfMethods& trials);

/// Returns the thresholds of each method: its own, or those of the operating point on its trials, if there is an
/// operating point. If no performance was right, the threshold of spotting is also used for judging. `trials` come from
/// all people except the judged one.
std::vector<MethodDecision> DecideBy(std::span<const ReadyMethod> methods, const TrialsOfMethods& trials,
                                     const std::optional<OperatingPoint>& point);

/// The thresholds of each method of a scenario with simulated people. With an operating point, thresholds that methods
/// do not set are computed at the first request, on sessions of other people than the judged ones; if the condition has
/// a mixture of people, every kind has its share.
class MethodDecisions {
 public:
  /// The arguments must outlive this.
  MethodDecisions(const std::vector<ReadyMethod>& methods, const Repertoire& repertoire,
                  const DetectionOptions& options)
      : methods_(methods), repertoire_(repertoire), options_(options) {}

  /// Returns one decision per method, for all worlds of this key's scenario and seed.
  const std::vector<MethodDecision>& For(const WorldKey& key);

 private:
  std::vector<MethodDecision> Set(const WorldKey& key) const;

  const std::vector<ReadyMethod>& methods_;
  const Repertoire& repertoire_;
  const DetectionOptions& options_;
  std::map<std::pair<Seed, std::string>, std::vector<MethodDecision>> known_;
};

}  // namespace etude
