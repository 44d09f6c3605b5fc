#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

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

/// The outside rival: nearest neighbour, nothing trained and nothing tuned, no warping of time. What was seen last is
/// compared with the move's examples and with what it is not: the examples mirrored and at half their amplitude, all
/// other moves, standing still. Evidence is n / (r + n), with r the distance to the nearest right one and n to the
/// nearest other: ½ where both are alike. Where nobody asked for the move, anything at all may be going on: there n is
/// also the distance to the example's mean pose, so that who holds still never comes nearer to the move, and at most
/// 21 cm, beyond which hardly a performance by another person lies.
std::unique_ptr<Recogniser> MakeNearestRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights);

}  // namespace etude
