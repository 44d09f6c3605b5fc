#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/recognition/performance_measures.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// The purpose for which a performance is measured.
enum class Occasion {
  kAsked,    ///< it may be the one asked for, which began when its window opened
  kSpotted,  ///< it may have begun at any time
};

/// Says of measures how right the performance looks that ends now, in [0, 1].
using PerformanceJudge =
    std::function<double(Occasion occasion, std::size_t move, const PerformanceMeasures& measures)>;

/// Aligns what is seen with every example (limb directions, SubsequenceAligner) and has performances judged by their
/// measures: in every step the one asked for, by the clock of who asks (ClockComparison), too, and the one that any
/// time's nearest move may be. What is usual of the person is learnt from the performances asked for, each by its
/// nearest passage. Examples it cannot describe are left
/// out.
std::unique_ptr<Recogniser> MakeMeasuringRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                    PerformanceJudge judge);

}  // namespace etude
