#pragma once

#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/capture/clock_search.h"
#include "engine/vision/strokes.h"

namespace etude {

/// How late each camera's pictures are *(ours)*, in frames: its frame k was taken at k + offset of the first camera's
/// time. Each camera is set by the first one alone: the offset at which what both have marked, ends and strokes, meets
/// best (`FindOffset`), the mean of their squared distances (`EpipolarGeometry`), the camera's marks taken between its
/// frames (`PixelBetween`). A camera of which nothing tells the time (nobody moves, or too little is marked) has
/// offset 0.
std::vector<double> EstimateOffsets(std::span<const ProjectionMatrix> cameras,
                                    std::span<const std::vector<Marks>> marks, const SyncOptions& options = {});

/// What a camera would have marked at `frame`, between its frames: a cubic through the two frames on either side
/// (Catmull-Rom), straight where one of the outer two lacks the mark; nothing where one of the inner two does. Where
/// only every n-th frame is marked, give those frames alone.
Marks MarksAt(std::span<const Marks> track, double frame);

/// The marks of all cameras at the first one's times.
std::vector<std::vector<Marks>> Synchronised(std::span<const std::vector<Marks>> marks,
                                             std::span<const double> offsets);

}  // namespace etude
