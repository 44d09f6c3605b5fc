#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"
#include "engine/recognition/weighting.h"

namespace etude {

/// The outside rival: nearest neighbour, nothing trained and nothing tuned, no warping of time. What was seen last is
/// compared with the move's examples and with what it is not: the examples mirrored and at half their amplitude, all
/// other moves, standing still. Evidence is n / (r + n), with r the distance to the nearest right one and n to the
/// nearest other: ½ where both are alike. Where nobody asked for the move, anything at all may be going on: there n is
/// also the distance to the example's mean pose, so that who holds still never comes nearer to the move, and at most
/// 21 cm, beyond which hardly a performance by another person lies.
std::unique_ptr<Recogniser> MakeNearestRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights);

}  // namespace etude
