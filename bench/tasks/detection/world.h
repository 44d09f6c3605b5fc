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

/// The occluders between the sensor and a performer at the origin who moves for so many frames: nothing; a desk with a
/// closed front, 75 cm high, 80 cm before the performer; a chair a little to the side, 90 cm high; a second person who
/// sways 1.2 m before the performer, beside the line to the sensor (all ours).
Occluders MakeOccluders(OccluderKind kind, const SensorPlacement& sensor, std::size_t frames);

/// The moves that may be performed, and what recognisers were taught of them.
struct Repertoire {
  std::vector<Move> moves;         ///< as authored; none where recordings are all there is
  std::vector<TaughtMove> taught;  ///< sorted by name
  std::vector<std::string> names;  ///< of all moves that may be asked for or taught, sorted

  /// The index of the move's name among `names`, which must hold it.
  std::size_t IndexOf(std::string_view move) const;
  /// The taught move of that name; nothing where nobody could teach it.
  std::optional<std::size_t> TaughtIndexOf(std::string_view move) const;
};

/// The labelled clips of the library, each move once. Empty when there are none.
Repertoire RepertoireOf(const ClipLibrary& library);

class CameraTake;

/// A performance that was asked for, and what is true of it. All times are seconds from the world's first frame.
struct DetectionEvent {
  std::string move;                      ///< asked for
  std::vector<GradedFault> faults = {};  ///< of simulated people
  std::string told_fault = {};           ///< of a recording: what its label says was wrong
  std::string danced;                    ///< the move that was truly danced; empty: none, or nobody knows
  double start_s = 0, end_s = 0;         ///< from the first beat to the last
  FrameInterval performed;               ///< the same in frames
  FrameInterval window;                  ///< in which it is judged; none overlaps another
  Truth truth = Truth::kRight;
  /// The time at which it had truly passed through every key pose asked for; of right ones alone.
  std::optional<double> first_right_s = {};

  bool IsRight() const { return truth == Truth::kRight; }
  bool HasFault() const;
  /// "none", or names joined by "+".
  std::string FaultText() const;
};

/// A moment at which somebody who watched says that a move was done.
struct ActionPoint {
  std::string move;
  int frame = 0;
};

/// One trial: what was truly performed, and how the sensor saw it. Of a recorded person: all their recordings, one
/// after another.
struct DetectionWorld {
  BodyMotion motion;  ///< as performed; of a recording, whose truth nobody knows, as sensed
  std::vector<DetectionEvent> events;
  SkeletonStream stream;    ///< of a skeleton sensor; before cameras, whose skeletons are up to each method, of nobody
  std::string person = {};  ///< of recordings
  std::vector<ActionPoint> points = {};      ///< of recordings
  std::shared_ptr<CameraTake> cameras = {};  ///< null: there are none
  std::vector<int> starts = {};              ///< the first frames of all recordings but the first

  /// The stretches that are followed in one go: each recording.
  std::vector<FrameInterval> Takes() const;
  bool IsRecorded() const { return !person.empty(); }
};

/// `options` must outlive a world with cameras.
DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key);

/// The event of a session that `stream` shows.
DetectionEvent EventOf(const SessionEvent& event, const SkeletonStream& stream);

/// The skeletons that a sensor before this performer sees under this condition.
SkeletonStream Sense(const BodyMotion& motion, const DetectionOptions& options, const WorldKey& key);

/// True when a recogniser that takes `move` for performed at this frame is not wrong: it was asked for or performed
/// there.
bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world);

}  // namespace etude
