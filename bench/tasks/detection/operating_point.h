#pragma once

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

/// The evidence of a session, and a function that returns true for a true detection and false for a false alarm.
struct AlarmTrial {
  std::shared_ptr<const EvidenceTrace> trace;
  double rate_hz = kJudgedRateHz;
  std::function<bool(const Detection&)> is_performance;
};

/// Returns a threshold of spotting at which all trials together give at most `false_alarms_per_min`. Bisection, to a
/// resolution of 2⁻¹⁶, finds the smallest such threshold if a higher threshold never gives more false alarms. (It may
/// give more: evidence that varies can cross it more often.) Returns 1 if no threshold tried is high enough. At least
/// one trial is required, and each must have frames.
double ThresholdAt(std::span<const AlarmTrial> trials, double false_alarms_per_min, double refractory_s);

/// A method's results for other people: the evidence for all moves, and the scores of the requested performances before
/// a threshold is applied.
struct MethodTrials {
  std::vector<AlarmTrial> alarms;
  std::vector<JudgedEvent> events;
};
using TrialsOfMethods = std::vector<MethodTrials>;

/// Adds the results of one world, for each method that does not set a threshold. All methods must have been taught
/// `repertoire`.
void AddTrials(const std::shared_ptr<const DetectionWorld>& world, std::span<const ReadyMethod> methods,
               const Repertoire& repertoire, TrialsOfMethods& trials);

/// Returns the thresholds of each method. A method keeps a threshold that it sets. Otherwise, if there is an operating
/// point, the method gets the thresholds that reach this point on its trials. If no performance was right, the
/// threshold of spotting is also used for judging. `trials` come from people other than the judged one.
std::vector<MethodDecision> DecideBy(std::span<const ReadyMethod> methods, const TrialsOfMethods& trials,
                                     const std::optional<OperatingPoint>& point);

/// Computes and keeps the thresholds of each method of a scenario with simulated people. With an operating point,
/// thresholds that methods do not set are computed at the first request, on sessions of people who are not judged. If
/// the condition has a mixture of people, every kind is represented.
class MethodDecisions {
 public:
  /// The arguments must outlive this object.
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
