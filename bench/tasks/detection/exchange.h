#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/run.h"
#include "bench/tasks/detection/world.h"

namespace etude {

/// Describes the moves to methods outside the program, which are told about sessions. Frames count from the session's
/// first; a pose is sixty numbers (EncodePose).
///
/// Setting, what may be performed, as built-in recognisers are taught it:
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "moves": [{"name": "clap", "tempo_bpm": 120, "beats": 8, "rate_hz": 30, "poses": [[x, y, z, …], …],
///                 "key_poses": [{"beat": 1, "targets": [{"feature": "RH", "degrees": 90, "tolerance_deg": 20}]}],
///                 "file": "clap.bvh"}, …]}
///
/// `poses` is one performance of the move, done perfectly; a key pose is reached when all its angles are (features:
/// paper A's ten, engine/fuzzy).
Payload MovesPayload(std::span<const Move> moves);

/// Describes the moves by their names alone, where recordings are all there is. What they look like, others must have
/// taught.
Payload NamesPayload(std::span<const std::string> names);

/// Makes the problem of a session: what the sensor saw, and what the coach asked for and when. A performance is judged
/// in its window [begin_frame, end_frame). `states` has one letter per joint: tracked, inferred, not tracked.
///
///     {"rate_hz": 30, "frames": [{"pose": [x, y, z, …], "states": "tttiiitttttttttttttn", "body_seen": true}, …],
///      "events": [{"move": "clap", "begin_frame": 30, "end_frame": 120}, …], "file": "stream.trc"}
///
/// The file holds the same positions, for other tools. Of a recorded person `person` says who, all recordings stand one
/// after another, and `starts` are the first frames of all but the first.
Payload SessionPayload(const DetectionWorld& world);

/// Makes the truth of a session: how it was performed. `first_right_s` is absent when the performance was not right.
///
///     {"rate_hz": 30, "poses": [[x, y, z, …], …],
///      "events": [{"move": "clap", "is_right": true, "fault": "none", "danced": "clap", "begin_frame": 30,
///                  "end_frame": 120, "first_right_s": 2.9}, …],
///      "file": "truth.trc"}
///
/// Of a recorded person also "action_points": [{"move": "clap", "frame": 88}, …], where labels have some; "poses" are
/// as sensed where nobody knows better.
Payload TruthPayload(const DetectionWorld& world);

/// Reads an answer: for each performance asked for, in order, the frame at which the method calls it right (in its
/// window; null: it is wrong), and how right it looks, higher = righter, on any scale; then every frame at which it
/// takes one of the moves for performed. Alarms in a window in which their move was asked for or performed are none
/// (IsPerformance), so a method need not know where they are.
///
///     {"events": [{"right_at_frame": 88, "score": 0.83}, {"right_at_frame": null, "score": 0.1}, …],
///      "alarms": [{"move": "sway", "frame": 215}, …]}
///
/// Refuses what is not as told here, naming where in the answer. The verdict's `filtered` is the stream itself, and
/// its running scores are the score.
Result<SessionVerdict> ReadSessionAnswer(const Json& answer, const DetectionWorld& world, const Repertoire& repertoire);

/// Writes the joints' states, a letter each: `t` tracked, `i` inferred, `n` not tracked.
std::string StateLetters(const SensedFrame& frame);

/// Records the session: tracks "truth" and "sensed" (as the recogniser saw it), and DetectionExtras.
Recording RecordSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire);

}  // namespace etude
