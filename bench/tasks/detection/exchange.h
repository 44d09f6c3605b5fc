#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/run.h"
#include "bench/tasks/detection/world.h"

namespace etude {

/// Describes the moves to outside methods, which judge sessions. Frames count from the session's first frame; a pose is
/// sixty numbers (EncodePose).
///
/// The setting holds the moves that may be performed, as built-in recognisers are taught them:
///
///     {"joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "moves": [{"name": "clap", "tempo_bpm": 120, "beats": 8, "rate_hz": 30, "poses": [[x, y, z, …], …],
///                 "key_poses": [{"beat": 1, "targets": [{"feature": "RH", "degrees": 90, "tolerance_deg": 20}]}],
///                 "file": "clap.bvh"}, …]}
///
/// `poses` is one perfect performance of the move. A key pose is reached if all its angles are within their tolerances.
/// The features are paper A's ten (engine/fuzzy).
Payload MovesPayload(std::span<const Move> moves);

/// A performance that teaches a move, with its label and its person.
struct ToldExample {
  std::string move, person, fault;  ///< fault "": the performance is right; person "": unknown
  const SkeletonStream* stream = nullptr;
  int begin = 0, end = 0;  ///< frames [begin, end) of the stream
};

/// Describes moves that recordings teach, with everything that built-in recognisers are taught and with the performers'
/// names. `names` are all moves that may be requested; a move that nobody taught has no poses and no examples.
///
///     {"joints": […], "parents": […],
///      "moves": [{"name": "clap", "span_s": 3.1, "rate_hz": 30, "poses": [[x, y, z, …], …],
///                 "key_poses": [{"targets": [{"feature": "RH", "degrees": 90, "tolerance_deg": 20}]}],
///                 "file": "clap.bvh",
///                 "examples": [{"person": "ann", "is_right": true, "fault": "", "rate_hz": 30,
///                               "frames": [{"pose": […], "states": "ttt…", "body_seen": true}, …]}, …]}, …]}
///
/// `poses` and `file` hold the first right example.
Payload TaughtPayload(std::span<const std::string> names, std::span<const TaughtMove> taught,
                      std::span<const ToldExample> examples);

/// Returns the examples of taught moves. The people in them are unknown.
std::vector<ToldExample> ExamplesOf(std::span<const TaughtMove> taught);

/// Encodes the problem of a session: the sensor's frames, and the moves that the coach requested with their windows. A
/// performance is judged in its window [begin_frame, end_frame). `states` has one letter per joint (StateLetters).
///
///     {"rate_hz": 30, "frames": [{"pose": [x, y, z, …], "states": "tttiiitttttttttttttn", "body_seen": true}, …],
///      "events": [{"move": "clap", "begin_frame": 30, "end_frame": 120}, …], "file": "stream.trc"}
///
/// The file holds the same positions, for other tools. For a recorded person, all recordings follow one another. There
/// are two more keys: `person` is the name, and `starts` are the first frames of all recordings except the first.
Payload SessionPayload(const DetectionWorld& world);

/// Encodes the truth of a session: the performed motion, and the truth about every performance. `first_right_s` is
/// absent if the performance was not right.
///
///     {"rate_hz": 30, "poses": [[x, y, z, …], …],
///      "events": [{"move": "clap", "is_right": true, "fault": "none", "danced": "clap", "begin_frame": 30,
///                  "end_frame": 120, "first_right_s": 2.9}, …],
///      "file": "truth.trc"}
///
/// For a recorded person, `poses` are the sensed poses if no true motion is known. If the labels have action points,
/// there is another key: "action_points": [{"move": "clap", "frame": 88}, …].
Payload TruthPayload(const DetectionWorld& world);

/// Reads an answer. `events` has one entry for each requested performance, in order: the frame within its window at
/// which the method calls it right (null: never), and a score on any scale (higher = more right). `alarms` holds every
/// frame at which the method detects one of the moves. A detection in a window in which its move was requested or
/// performed is not a false alarm (IsPerformance), so a method need not know the windows.
///
///     {"events": [{"right_at_frame": 88, "score": 0.83}, {"right_at_frame": null, "score": 0.1}, …],
///      "alarms": [{"move": "sway", "frame": 215}, …]}
///
/// Fails on an answer of another form, naming the position in it. In the returned verdict, `filtered` is the unfiltered
/// stream, and the running score is constant.
Result<SessionVerdict> ReadSessionAnswer(const Json& answer, const DetectionWorld& world, const Repertoire& repertoire);

/// Returns the joints' states, one letter each: `t` tracked, `i` inferred, `n` not tracked.
std::string StateLetters(const SensedFrame& frame);

/// Records the session: DetectionExtras and the tracks "truth" and "sensed". "sensed" is the motion that the recogniser
/// received.
Recording RecordSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire);

}  // namespace etude
