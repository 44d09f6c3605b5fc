#pragma once

#include <vector>

#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"

namespace etude {

/// The results of a method in one session.
struct SessionVerdict {
  SkeletonStream filtered;
  /// One judgement per event; the frames of a judgement count from the first frame of the event's window.
  std::vector<Judgement> events;
  /// For each event, the index (in Repertoire::taught) of the recognised move. In a simulated session, this is the
  /// move with the most evidence in the event's window; in a labelled recording, the class of the performance as a
  /// whole. Empty for an outside method, which names no moves.
  std::vector<std::optional<std::size_t>> named = {};
  std::vector<Detection> alarms;         ///< false alarms, by move (Repertoire::taught), then by time
  std::vector<Detection> spotted = {};   ///< all detections, true and false
  std::optional<double> threshold = {};  ///< threshold of judging; empty for an outside method
};

/// Filters the sensor's stream or, for an oracle, the true motion. Each recording is filtered separately. If cameras
/// have failed, the result shows no body.
SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method);

/// Returns the evidence of each recording (DetectionWorld::Takes), in order. The recogniser receives the requested move
/// when its window opens.
std::vector<EvidenceTrace> FollowSession(const DetectionWorld& world, const SeenStream& seen,
                                         const Repertoire& repertoire, const Recogniser& recogniser);

/// Returns one judgement per event. `traces` must be the result of FollowSession.
std::vector<Judgement> JudgeEvents(const DetectionWorld& world, std::span<const EvidenceTrace> traces,
                                   double threshold);

/// Judges every requested performance and collects the false alarms. `seen` must be the result of SeeSession for this
/// method.
SessionVerdict JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser, const MethodDecision& decision);

}  // namespace etude
