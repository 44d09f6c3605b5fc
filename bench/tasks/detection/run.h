#pragma once

#include <vector>

#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"

namespace etude {

/// The result of a method in one session.
struct SessionVerdict {
  SkeletonStream filtered;
  std::vector<Judgement> events;  ///< one per event; frames count from its window's first
  /// One per event: the move (Repertoire::taught) with the most evidence in its window. None at all: an answer from
  /// outside, which names no moves.
  std::vector<std::optional<std::size_t>> named = {};
  std::vector<Detection> alarms;         ///< false ones: by move (Repertoire::taught), then by time
  std::vector<Detection> spotted = {};   ///< all of them, true and false
  std::optional<double> threshold = {};  ///< that events were judged by; an answer from outside tells none
};

/// Filters what the sensor saw, or, for an oracle, how it was truly performed; every recording for itself. Cameras that
/// failed saw nobody.
SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method);

/// The evidence of each recording (DetectionWorld::Takes), one after another: the recogniser is told what is asked for
/// when its window opens.
std::vector<EvidenceTrace> FollowSession(const DetectionWorld& world, const SeenStream& seen,
                                         const Repertoire& repertoire, const Recogniser& recogniser);

/// One per event: what the evidence of each recording, as FollowSession gives it, says of the performance asked for.
std::vector<Judgement> JudgeEvents(const DetectionWorld& world, std::span<const EvidenceTrace> traces,
                                   double threshold);

/// Decides on that evidence: a judgement of every performance asked for, and the false alarms. `seen` must be what
/// the method sees of the world.
SessionVerdict JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser, const MethodDecision& decision);

}  // namespace etude
