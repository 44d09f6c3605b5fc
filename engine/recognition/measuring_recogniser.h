#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/recognition/performance_measures.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// Tells whether a measured performance was asked for.
enum class PerformanceOrigin {
  kAsked,    ///< it may be the performance asked for, and began when the window opened
  kSpotted,  ///< nobody asked for it, and it may have begun at any time
};

/// Returns from its measures how right the performance that ends now looks, in [0, 1].
using PerformanceJudge = std::function<double(PerformanceOrigin origin, std::size_t move, const PerformanceMeasures& measures)>;

/// Makes a recogniser that aligns the stream with every example (limb directions, SubsequenceAligner) and lets `judge`
/// score the measures of the alignments. In every step it judges the asked move, whose timing it also compares with the
/// window's (ClockComparison), and the nearest move as a spotted one. It learns the person's usual measures from the
/// best alignments of the performances asked for. It ignores examples that show no body.
std::unique_ptr<Recogniser> MakeMeasuringRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    PerformanceJudge judge);

}  // namespace etude
