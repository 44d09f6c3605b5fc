#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

struct DtwOptions {
  /// The distance to the nearest example at which the evidence is ½, as RMS per joint with the trunk scaled to 50 cm.
  /// The default (ours) lies between the typical distance of the same move by another person and the typical distance
  /// of the most similar other move.
  double half_at_cm = 11;
};

/// Makes the external baseline `dtw`: subsequence dynamic time warping of joints to the taught examples, without
/// training or tuning. The evidence is 1 / (1 + (d / half_at_cm)²), where d is the distance to the nearest example.
std::unique_ptr<Recogniser> MakeDtwRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                              const DtwOptions& options);

/// Makes the external baseline `nearest`: a nearest neighbour classifier without training, tuning or time warping. It
/// compares the last steps with the move's examples and with negatives: the mirrored examples, the examples at half
/// their amplitude, all other moves, and standing still. The evidence is n / (r + n), where r is the distance to the
/// nearest example of the move and n the distance to the nearest negative; the evidence is ½ if r = n. If the move was
/// not requested, any motion is possible. Then n also includes the distance to the example's mean pose, so that holding
/// still does not count as performing the move; and n is at most 21 cm, because other people's performances of the move
/// are rarely farther away.
std::unique_ptr<Recogniser> MakeNearestRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights);

}  // namespace etude
