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

/// Returns the occluders between the sensor and a performer at the origin, for `frames` frames. kTable is a desk with a
/// closed front, 75 cm high, 80 cm in front of the performer. kChair is a chair, 90 cm high, a little to the side.
/// kPerson is a second person who sways 1.2 m in front of the performer, beside the line to the sensor. All measures
/// are Etude's choices.
Occluders MakeOccluders(OccluderKind kind, const SensorPlacement& sensor, std::size_t frames);

/// The moves that may be performed, and the moves that recognisers were taught.
struct Repertoire {
  std::vector<Move> moves;         ///< the moves as authored; empty if there are only recordings
  std::vector<TaughtMove> taught;  ///< taught moves, sorted by name
  std::vector<std::string> names;  ///< names of all moves that may be requested or taught, sorted

  /// Returns the index of a move in `names`, which must contain it.
  std::size_t IndexOf(std::string_view move) const;
  /// Returns the index in `taught` of the move with this name; nothing if the move could not be taught.
  std::optional<std::size_t> TaughtIndexOf(std::string_view move) const;
};

/// Returns the moves of the library's labelled clips, each once. Empty if no clip has labels.
Repertoire RepertoireOf(const ClipLibrary& library);

class CameraTake;

/// A performance that was requested, with its truth. Times are in seconds from the world's first frame.
struct DetectionEvent {
  std::string move;                      ///< the requested move
  std::vector<GradedFault> faults = {};  ///< faults of a simulated person
  std::string labelled_fault = {};       ///< the fault that a recording's label names
  std::string danced;                    ///< the move that was performed; "" if none was
  double start_s = 0, end_s = 0;         ///< time of the performance, from the first beat to the last
  FrameInterval performed;               ///< time of the performance, frames
  FrameInterval window;                  ///< the frames in which the performance is judged; windows do not overlap
  Truth truth = Truth::kRight;
  /// The time at which the performer had truly passed every requested key pose. Only right performances have it.
  std::optional<double> first_right_s = {};

  bool IsRight() const { return truth == Truth::kRight; }
  bool HasFault() const;
  /// Returns "none", or the faults' names joined by "+".
  std::string FaultText() const;
};

/// A frame that a label marks as the moment at which a move is recognisable.
struct ActionPoint {
  std::string move;
  int frame = 0;
};

/// One trial: the true performances, and the sensor's stream. For a recorded person it contains all their recordings,
/// one after another.
struct DetectionWorld {
  BodyMotion motion;  ///< the motion as performed or, if the truth of a recording is unknown, as sensed
  std::vector<DetectionEvent> events;
  /// The output of a skeleton sensor. If cameras are used instead, the stream has no bodies, because each method makes
  /// its own skeletons from the pictures.
  SkeletonStream stream;
  std::string person = {};                   ///< the person's name, for recordings
  std::vector<ActionPoint> points = {};      ///< labelled action points, for recordings
  std::shared_ptr<CameraTake> cameras = {};  ///< the cameras' take; null without cameras
  std::vector<int> starts = {};              ///< the first frames of all recordings except the first

  /// Returns the intervals that recognisers follow without interruption, one per recording.
  std::vector<FrameInterval> Takes() const;
  bool IsRecorded() const { return !person.empty(); }
};

/// Makes the world of `key`. If cameras are the sensor, `options` must outlive the world.
DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key);

/// Returns a session's event with its times as frames of `stream`.
DetectionEvent EventOf(const SessionEvent& event, const SkeletonStream& stream);

/// Returns the skeletons that a sensor under this condition reports for this motion.
SkeletonStream Sense(const BodyMotion& motion, const DetectionOptions& options, const WorldKey& key);

/// Returns true if a detection of `move` at this frame is not a false alarm, because the move was requested or
/// performed at that time.
bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world);

}  // namespace etude
