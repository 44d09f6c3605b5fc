#pragma once

#include <string>
#include <vector>

#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"

namespace etude {

/// A recogniser that fired outside every performance of its move.
struct Alarm {
  std::string move;
  int frame = 0;
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

/// Filters the stream, judges every event in its window, and lets the recognisers of all moves run
/// through the whole session for false alarms. Firing while its move is asked for or danced is none.
SessionVerdict JudgeSession(const DetectionWorld& world, const Repertoire& repertoire, const DetectionMethod& method);

}  // namespace etude
