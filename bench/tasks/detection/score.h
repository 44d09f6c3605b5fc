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

/// Returns the requested performances that are right or wrong, with their judgements. Grey performances (neither right
/// nor wrong) are left out. `judgements` has one entry per event.
std::vector<JudgedEvent> JudgedEvents(const DetectionWorld& world, std::span<const Judgement> judgements);

/// Adds the metrics of a session to a result (docs/reference/metrics.md).
void ScoreSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire,
                  CellResult& result);

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> DetectionMetrics();

/// Returns the value of a metric for a method without an answer (Task::ValueOfFailure). A coach without answers calls
/// no performance right, so every right performance is missed: `recall` and `f1` are 0 if some performances were right.
/// The other metrics are missing: precision has no performance called right, roc_auc no scores, and latency no call;
/// and a method without answers deserves no credit for having no false alarms.
std::optional<double> DetectionFailureValue(std::string_view metric, bool some_are_right);

using StageDigests = std::vector<std::pair<std::string, std::string>>;

/// Returns the digests of the session and of the stream. They are the same for every method.
StageDigests WorldDigests(const DetectionWorld& world);
/// Returns the digests of the filtered stream and of the verdicts.
StageDigests VerdictDigests(const SessionVerdict& verdict, const Repertoire& repertoire);

/// Returns, for each frame in a window, the score that the requested move has reached so far; 0 between windows.
Series ScoreSeries(const DetectionWorld& world, const SessionVerdict& verdict);

/// Returns curves with one value per performance, for curves over many sessions (reports/plots). `performance_score` is
/// the score. `performance_truth` is 1 if right, ½ if grey, 0 if wrong; `performance_called` is 1 if called right.
/// `performance_fault` is the index of the worst fault in AllFaults (−1 = none), `performance_severity` its severity.
/// `performance_asked`, `performance_danced` and `performance_named` are indices in Repertoire::names (−1 = none). Two
/// curves have right performances only: `right_wait_s` is the time until they were called right, and `right_answered`
/// is 1 if they were.
std::vector<Series> PerformanceSeries(const DetectionWorld& world, const SessionVerdict& verdict,
                                      const Repertoire& repertoire);

}  // namespace etude
