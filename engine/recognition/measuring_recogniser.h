#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/recognition/performance_measures.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// The origin of a measured performance.
enum class PerformanceOrigin {
  kAsked,    ///< judged as a performance of the asked move; it began after the window opened
  kSpotted,  ///< judged as if nobody had asked for it; it may have begun at any time
};

/// Judges a performance that ends now by its measures. Returns how right it looks, in [0, 1].
using PerformanceJudge = std::function<double(PerformanceOrigin origin, std::size_t move, const PerformanceMeasures& measures)>;

/// Makes a recogniser that aligns the stream with every example (limb directions, SubsequenceAligner) and lets `judge`
/// score the measures of the alignments. In every step, the recogniser judges the asked move with origin kAsked and the
/// nearest move with origin kSpotted. The timing of the asked move is also compared with its window (ClockComparison).
/// The recogniser learns the person's usual measures from the best alignments of asked performances. It ignores
/// examples that show no body.
std::unique_ptr<Recogniser> MakeMeasuringRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    PerformanceJudge judge);

}  // namespace etude
