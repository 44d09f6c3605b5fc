#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/detection/options.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/taught_move.h"
#include "io/clips/clip_library.h"
#include "sim/performer/session.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

/// Returns the occluders between the sensor and a performer at the origin, for `frames` frames: none; a desk with a
/// closed front, 75 cm high, 80 cm in front of the performer; a chair, 90 cm high, a little to the side; or a second
/// person who sways 1.2 m in front of the performer, beside the line to the sensor (all ours).
Occluders MakeOccluders(OccluderKind kind, const SensorPlacement& sensor, std::size_t frames);

/// The moves that may be performed, and what recognisers were taught of them.
struct Repertoire {
  std::vector<Move> moves;         ///< as authored; empty if there are only recordings
  std::vector<TaughtMove> taught;  ///< sorted by name
  std::vector<std::string> names;  ///< of all moves that may be asked for or taught, sorted

  /// Returns the index of the move's name in `names`, which must contain it.
  std::size_t IndexOf(std::string_view move) const;
  /// Returns the index of the taught move of that name; nothing if it could not be taught.
  std::optional<std::size_t> TaughtIndexOf(std::string_view move) const;
};

/// Returns the moves of the library's labelled clips, each once; empty if there are none.
Repertoire RepertoireOf(const ClipLibrary& library);

class CameraTake;

/// A performance that was asked for, with its truth. All times are seconds from the world's first frame.
struct DetectionEvent {
  std::string move;                      ///< asked for
  std::vector<GradedFault> faults = {};  ///< of simulated people
  std::string labelled_fault = {};           ///< of a recording: the fault that its label names
  std::string danced;                    ///< from the first beat to the last beat
  double start_s = 0, end_s = 0;         ///< from the first beat to the last
  FrameInterval performed;               ///< the same in frames
  FrameInterval window;                  ///< in which it is judged; windows do not overlap
  Truth truth = Truth::kRight;
  /// The time at which the performer had truly passed every requested key pose; only for right performances.
  std::optional<double> first_right_s = {};

  bool IsRight() const { return truth == Truth::kRight; }
  bool HasFault() const;
  /// Returns "none", or the faults' names joined by "+".
  std::string FaultText() const;
};

/// A frame that a label marks as the moment of a move.
struct ActionPoint {
  std::string move;
  int frame = 0;
};

/// One trial: what was truly performed, and what the sensor saw. For a recorded person it holds all their recordings,
/// one after another.
struct DetectionWorld {
  BodyMotion motion;  ///< as performed; if the truth of a recording is unknown, as sensed
  std::vector<DetectionEvent> events;
  /// The output of a skeleton sensor; with cameras it has no bodies, because skeletons depend on the method.
  SkeletonStream stream;
  std::string person = {};  ///< of recordings
  std::vector<ActionPoint> points = {};      ///< of recordings
  std::shared_ptr<CameraTake> cameras = {};  ///< null without cameras
  std::vector<int> starts = {};              ///< the first frames of all recordings but the first

  /// Returns the intervals that recognisers follow without interruption: one per recording.
  std::vector<FrameInterval> Takes() const;
  bool IsRecorded() const { return !person.empty(); }
};

/// Makes the world of `key`. `options` must outlive a world with cameras.
DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key);

/// Returns a session's event in the frames of `stream`.
DetectionEvent EventOf(const SessionEvent& event, const SkeletonStream& stream);

/// Returns the skeletons that a sensor sees of this motion under this condition.
SkeletonStream Sense(const BodyMotion& motion, const DetectionOptions& options, const WorldKey& key);

/// Returns true if a detection of `move` at this frame is not a false alarm: the move was asked for or performed there.
bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world);

}  // namespace etude
