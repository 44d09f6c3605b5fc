#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/judge.h"

namespace etude {

/// The metrics of a session (metrics.md, "detection").
void ScoreSession(const DetectionWorld& world, const SessionVerdict& verdict, CellResult& result);

/// Every metric missing, for one reason.
void MissAllDetectionMetrics(const std::string& reason, CellResult& result);

using StageDigests = std::vector<std::pair<std::string, std::string>>;

/// Fingerprints of the session and of the stream: the same for every method.
StageDigests WorldDigests(const DetectionWorld& world);
/// Fingerprints of the filtered stream and of the verdicts.
StageDigests VerdictDigests(const SessionVerdict& verdict);

/// Per frame, how well the move asked for was seen to be danced so far in its window; 0 between windows.
Series ScoreSeries(const DetectionWorld& world, const SessionVerdict& verdict);

/// The session: tracks "truth" and "sensed" (as the recogniser saw it), and in `extras_json`
///
///     {"format": "etude-detection", "version": 1,
///      "events": [{"move": "clap", "fault": "none", "danced": "clap", "begin_frame": 30, "end_frame": 120,
///                  "called_right": true, "called_frame": 88, "score": 0.83}, …],
///      "alarms": [{"move": "sway", "frame": 215}, …],
///      "joint_states": ["tttttttttttttttiiiii", …]}   one letter per joint and frame: tracked, inferred, not tracked
///
/// `called_frame` is absent when the move was not recognised.
Recording RecordSession(const DetectionWorld& world, const SessionVerdict& verdict);

}  // namespace etude
