#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/clips/clip_library.h"
#include "bench/tasks/detection/options.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/taught_move.h"
#include "sim/performer/session.h"

namespace etude {

/// What may be performed, and what recognisers were taught of it.
struct Repertoire {
  std::vector<Move> moves;
  std::vector<TaughtMove> taught;  ///< sorted by name

  /// Of a taught move's name.
  std::size_t IndexOf(std::string_view move) const;
};

/// The labelled clips of the library, each move once. Empty when there are none.
Repertoire RepertoireOf(const ClipLibrary& library);

/// What recognisers are taught of a move.
TaughtMove TaughtOf(const Move& move);

class CameraTake;

/// One trial: a session as it was truly performed, and as the sensor saw it.
struct DetectionWorld {
  Performance session;
  SkeletonStream stream;  ///< of a skeleton sensor; before cameras, whose skeletons are up to each method, of nobody
  std::shared_ptr<CameraTake> cameras = {};  ///< null: there are none
};

/// `options` must outlive a world with cameras.
DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key);

/// The frames in which an event is judged: first beat to half a second after the last.
FrameInterval WindowOf(const SessionEvent& event, const SkeletonStream& stream);

/// Whether the frame lies in a window in which the move was asked for or performed: taking it for performed is no false
/// alarm there.
bool IsPerformance(std::string_view move, int frame, const DetectionWorld& world);

}  // namespace etude
