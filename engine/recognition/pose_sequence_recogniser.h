#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// How well a frame in which a body is seen matches a key pose, in [0, 1].
using PoseMatcher = std::function<double(const FeatureFrame& frame, const TaughtPose& pose)>;

/// Recognises a move by passing its key poses in order (PoseSequence), however a frame is matched with one.
std::unique_ptr<Recogniser> MakePoseSequenceRecogniser(std::span<const TaughtMove> taught, int hold_frames,
                                                       PoseMatcher match);

}  // namespace etude
