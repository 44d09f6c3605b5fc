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

/// Makes a recogniser that aligns the stream with every example (limb directions, SubsequenceAligner). The recogniser
/// measures the alignments, and `judge` scores the measures. In every step, `judge` is called with origin kAsked for
/// the move that the coach asked for. It is called with origin kSpotted for the move whose example is most similar to
/// the stream. For the move that the coach asked for, the timing relative to the window is measured as well
/// (ClockComparison). When a window ends, its best alignment is stored. The medians of the stored measures show how
/// this person usually performs (PersonBaseline). The recogniser ignores examples that show no body.
std::unique_ptr<Recogniser> MakeMeasuringRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    PerformanceJudge judge);

}  // namespace etude
