#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/clips/clip_library.h"
#include "bench/tasks/detection/options.h"
#include "engine/recognition/key_pose.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/performer/session.h"

namespace etude {

/// What may be danced, and what recognisers were taught of it.
struct Repertoire {
  std::vector<Move> moves;
  std::map<std::string, TaughtMove> taught;  ///< by the move's name
  /// The longest that each move's window may be, in frames: how far apart its key poses may lie.
  std::map<std::string, int> span_frames;
};

/// The labelled clips of the library, each move once. Empty when there are none.
Repertoire RepertoireOf(const ClipLibrary& library);

/// One trial: a session as it was truly danced, and as the sensor saw it.
struct DetectionWorld {
  Performance session;
  SkeletonStream stream;
};

DetectionWorld MakeDetectionWorld(const Repertoire& repertoire, const DetectionOptions& options, const WorldKey& key);

}  // namespace etude
