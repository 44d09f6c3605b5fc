#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/run.h"
#include "bench/tasks/detection/world.h"

namespace etude {

/// Describes the moves to outside methods, which are asked about sessions. Frames count from the session's first; a
/// pose is sixty numbers (EncodePose).
///
/// Setting: the moves that may be performed, as built-in recognisers are taught them:
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "moves": [{"name": "clap", "tempo_bpm": 120, "beats": 8, "rate_hz": 30, "poses": [[x, y, z, …], …],
///                 "key_poses": [{"beat": 1, "targets": [{"feature": "RH", "degrees": 90, "tolerance_deg": 20}]}],
///                 "file": "clap.bvh"}, …]}
///
/// `poses` is one perfect performance of the move. A key pose is reached if all its angles are within their tolerances
/// (features: paper A's ten, engine/fuzzy).
Payload MovesPayload(std::span<const Move> moves);

/// A performance that teaches a move, with its label.
struct ToldExample {
  std::string move, person, fault;  ///< no fault: right; person "" = unknown
  const SkeletonStream* stream = nullptr;
  int begin = 0, end = 0;  ///< frames [begin, end) of the stream
};

/// Describes moves that recordings teach: what built-in recognisers are taught, and who performed it. `names` are all
/// moves that may be asked for; a move without a teacher has no poses and no examples.
///
///     {"joints": […], "parents": […],
///      "moves": [{"name": "clap", "span_s": 3.1, "rate_hz": 30, "poses": [[x, y, z, …], …],
///                 "key_poses": [{"targets": [{"feature": "RH", "degrees": 90, "tolerance_deg": 20}]}],
///                 "file": "clap.bvh",
///                 "examples": [{"person": "ann", "is_right": true, "fault": "", "rate_hz": 30,
///                               "frames": [{"pose": […], "states": "ttt…", "body_seen": true}, …]}, …]}, …]}
///
/// `poses` and the file are the first right example.
Payload TaughtPayload(std::span<const std::string> names, std::span<const TaughtMove> taught,
                      std::span<const ToldExample> examples);

/// Returns the examples of taught moves whose people are unknown.
std::vector<ToldExample> ExamplesOf(std::span<const TaughtMove> taught);

/// Encodes the problem of a session: what the sensor saw, and what the coach asked for and when. A performance is
/// judged in its window [begin_frame, end_frame). `states` has one letter per joint: tracked, inferred, not tracked.
///
///     {"rate_hz": 30, "frames": [{"pose": [x, y, z, …], "states": "tttiiitttttttttttttn", "body_seen": true}, …],
///      "events": [{"move": "clap", "begin_frame": 30, "end_frame": 120}, …], "file": "stream.trc"}
///
/// The file holds the same positions, for other tools. For a recorded person all recordings follow one another;
/// `person` is the name, and `starts` are the first frames of all recordings but the first.
Payload SessionPayload(const DetectionWorld& world);

/// Encodes the truth of a session: the performed motion, and the truth about every performance. `first_right_s` is
/// absent if the performance was not right.
///
///     {"rate_hz": 30, "poses": [[x, y, z, …], …],
///      "events": [{"move": "clap", "is_right": true, "fault": "none", "danced": "clap", "begin_frame": 30,
///                  "end_frame": 120, "first_right_s": 2.9}, …],
///      "file": "truth.trc"}
///
/// For a recorded person also "action_points": [{"move": "clap", "frame": 88}, …], if the labels have some; "poses" are
/// the sensed ones if no true motion is known.
Payload TruthPayload(const DetectionWorld& world);

/// Reads an answer. `events` holds, for each performance asked for, in order, the frame within its window at which the
/// method calls it right (null: never), and a score on any scale, higher = more right. `alarms` holds every frame at
/// which the method detects one of the moves. Detections in a window in which their move was asked for or performed are
/// not false alarms (IsPerformance), so a method need not know the windows.
///
///     {"events": [{"right_at_frame": 88, "score": 0.83}, {"right_at_frame": null, "score": 0.1}, …],
///      "alarms": [{"move": "sway", "frame": 215}, …]}
///
/// An answer of another form is an error that names the position in it. The verdict's `filtered` is the stream itself,
/// and its running scores are the score.
Result<SessionVerdict> ReadSessionAnswer(const Json& answer, const DetectionWorld& world, const Repertoire& repertoire);

/// Returns the joints' states, one letter each: `t` tracked, `i` inferred, `n` not tracked.
std::string StateLetters(const SensedFrame& frame);

/// Records the session: tracks "truth" and "sensed" (as the recogniser saw it), and DetectionExtras.
Recording RecordSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire);

}  // namespace etude
