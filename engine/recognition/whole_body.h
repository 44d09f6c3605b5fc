#pragma once

#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// Ours, for recordings of people: whole bodies (joints and limbs, both as far apart as two people who do the same
/// are) warped in time to every example and to its mirror image, beside a `judge` of single performances. A move is as
/// far as its three nearest examples are in the mean.
/// - Who is told where a performance begins and ends gets the nearest move (MoveFollower::Whole).
/// - Of the move asked for the judge's evidence counts, times the squared ratio of the distances to the mirror images
///   and to the examples where the images are nearer: somebody does it on the wrong side. A move that is its own image
///   has no sides.
/// - Unasked, a move is spotted by n / (r + n), with r its distance and n that of the nearest other move within a
///   second, at most so far as hardly a performance by another person lies. Where a move has fewer than three examples,
///   nobody knows how people differ, and the judge spots.
///
/// `judge` was taught the same moves.
std::unique_ptr<Recogniser> MakeWholeBodyRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                    std::unique_ptr<Recogniser> judge);

}  // namespace etude
