#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"
#include "engine/recognition/weighting.h"

namespace etude {

struct DtwOptions {
  /// The distance to the nearest example, RMS per joint with the trunk scaled to 50 cm, at which the evidence is ½.
  /// Ours: between that of the same move by another person and that of the nearest other move (algorithms A7).
  double half_at_cm = 11;
};

/// The outside rival: subsequence dynamic time warping to the taught examples on joints, nothing trained and nothing
/// tuned. Evidence is 1 / (1 + (distance / half_at_cm)²) of the nearest example.
std::unique_ptr<Recogniser> MakeDtwRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                              const DtwOptions& options);

}  // namespace etude
