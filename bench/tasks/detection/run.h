#pragma once

#include <string>
#include <vector>

#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/recognition/features_seen.h"

namespace etude {

/// A recogniser that fired outside every performance of its move.
struct Alarm {
  std::string move;
  int frame = 0;
};

/// A session as methods with the same filter see it.
struct SeenSession {
  SkeletonStream filtered;
  std::vector<FeatureFrame> frames;
};

/// What a method made of one session.
struct SessionVerdict {
  SkeletonStream filtered;
  std::vector<Judgement> events;  ///< one per event; frames count from its window's first
  std::vector<Alarm> alarms;      ///< by move, then by time
};

/// A frame interval [begin, end) of the session.
struct Window {
  int begin = 0;
  int end = 0;
};

/// The frames in which an event is judged: first beat to half a second after the last.
Window WindowOf(const SessionEvent& event, const SkeletonStream& stream);

/// Whether the frame lies in a window in which the move was asked for or danced: taking it for danced is no false
/// alarm there.
bool IsPerformance(const std::string& move, int frame, const DetectionWorld& world);

/// Filters what the sensor saw, or, for an oracle, how it was truly danced.
SeenSession SeeSession(const DetectionWorld& world, const DetectionMethod& method);

/// Judges every event in its window, and lets the recognisers of all moves run through the whole session for false
/// alarms. `seen` must be what the method sees of the world.
SessionVerdict JudgeSession(const DetectionWorld& world, const SeenSession& seen, const Repertoire& repertoire,
                            const DetectionMethod& method);

}  // namespace etude
