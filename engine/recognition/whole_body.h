#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// The minimum number of examples of every move with which a whole-body recogniser spots moves without its judge.
inline constexpr std::size_t kExamplesOfWholeBody = 3;

/// Makes a recogniser for recordings of people (ours). It aligns whole bodies with every example and its mirror image
/// by dynamic time warping. Distances of joints and of limbs are in units of the usual difference between two people
/// who do the same move. The distance of a move is the mean distance of its three nearest examples. The distances are
/// combined with the evidence of `judge`, which must have been taught the same moves.
/// - If the caller knows where a performance begins and ends, the nearest move is returned (MoveFollower::Whole).
/// - For the asked move, the evidence is the judge's. If the mirror images are nearer than the examples, the move was
///   done on the wrong side, and the evidence is multiplied by the squared ratio of the two distances. A move that is
///   its own mirror image has no wrong side.
/// - A move that was not asked for is spotted with evidence n / (r + n), where r is its distance and n the smallest
///   distance of another move within the last second. The value of n is limited to a distance that other people's
///   performances rarely exceed. If any move has fewer than three examples, the spread between people is unknown, and
///   the judge's evidence is used for all moves.
std::unique_ptr<Recogniser> MakeWholeBodyRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    std::unique_ptr<Recogniser> judge);

}  // namespace etude
