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

/// The performances asked for that are right or wrong, not grey, and how each was judged (one judgement per event).
std::vector<JudgedEvent> JudgedEvents(const DetectionWorld& world, std::span<const Judgement> judgements);

/// The metrics of a session (docs/reference/metrics.md).
void ScoreSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire,
                  CellResult& result);

/// The ids of all of them, in the order in which they are measured.
std::vector<std::string> DetectionMetrics();

/// The value of a metric for a method without an answer (Task::ValueOfFailure): a coach that says nothing praises
/// nobody, so every right performance is missed: `recall` and `f1` are 0, if some were right. The rest is missing:
/// nothing was called right (precision), nothing was ranked (roc_auc), no praise came (latency), and no false alarm
/// either, which is no merit.
std::optional<double> DetectionFailureValue(std::string_view metric, bool some_are_right);

using StageDigests = std::vector<std::pair<std::string, std::string>>;

/// Fingerprints of the session and of the stream: the same for every method.
StageDigests WorldDigests(const DetectionWorld& world);
/// Fingerprints of the filtered stream and of the verdicts.
StageDigests VerdictDigests(const SessionVerdict& verdict, const Repertoire& repertoire);

/// Returns how well the move asked for was seen to be performed so far in its window, frame by frame; 0 between
/// windows.
Series ScoreSeries(const DetectionWorld& world, const SessionVerdict& verdict);

/// One value per performance, for curves over many sessions (reports/plots): `performance_score`; `_truth`, 1 right, ½
/// grey, 0 wrong; `_called`, 1 right; `_fault`, the worst one's place in AllFaults, −1 none, and its `_severity`;
/// `_asked`, `_danced` and `_named`, places in Repertoire::names, −1 none. Of right performances alone `right_wait_s`,
/// how long they waited to be called right, and `right_answered`, 1 when they were.
std::vector<Series> PerformanceSeries(const DetectionWorld& world, const SessionVerdict& verdict,
                                      const Repertoire& repertoire);

}  // namespace etude
