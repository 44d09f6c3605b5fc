#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/metrics/detection.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/run.h"

namespace etude {

/// Returns the performances asked for that are right or wrong, not grey, with their judgements (one judgement per
/// event).
std::vector<JudgedEvent> JudgedEvents(const DetectionWorld& world, std::span<const Judgement> judgements);

/// Measures the metrics of a session (docs/reference/metrics.md).
void ScoreSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire,
                  CellResult& result);

/// Returns the ids of all metrics, in the order in which they are measured.
std::vector<std::string> DetectionMetrics();

/// Returns the value of a metric for a method without an answer (Task::ValueOfFailure). A coach without answers praises
/// nobody, so every right performance is missed: `recall` and `f1` are 0 if some were right. The other metrics are
/// missing: nothing was called right (precision), nothing was ranked (roc_auc), no praise came (latency), and a method
/// without answers deserves no credit for having no false alarms.
std::optional<double> DetectionFailureValue(std::string_view metric, bool some_are_right);

using StageDigests = std::vector<std::pair<std::string, std::string>>;

/// Returns the digests of the session and of the stream, which are the same for every method.
StageDigests WorldDigests(const DetectionWorld& world);
/// Returns the digests of the filtered stream and of the verdicts.
StageDigests VerdictDigests(const SessionVerdict& verdict, const Repertoire& repertoire);

/// Returns, for each frame, the score so far of the requested move in its window; 0 between windows.
Series ScoreSeries(const DetectionWorld& world, const SessionVerdict& verdict);

/// Returns one value per performance, for curves over many sessions (reports/plots): `performance_score`; `_truth`: 1
/// right, ½ grey, 0 wrong; `_called`: 1 right; `_fault`: the index of the worst fault in AllFaults, −1 none, and its
/// `_severity`; `_asked`, `_danced` and `_named`: indices in Repertoire::names, −1 none. For right performances only:
/// `right_wait_s`, the time until they were called right, and `right_answered`, 1 if they were.
std::vector<Series> PerformanceSeries(const DetectionWorld& world, const SessionVerdict& verdict,
                                      const Repertoire& repertoire);

}  // namespace etude
