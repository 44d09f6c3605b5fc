#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/vision/strokes.h"

namespace etude {

struct SyncOptions {
  /// The largest offset that is looked for, in frames either way. Raise it for cameras that were started by hand.
  int most_frames = 16;
  /// The distance in pixels beyond which two sightings that miss each other count no more: a mark on the wrong limb
  /// must not set a clock.
  double most_px = 20;
};

struct ClockOffset {
  double frames = 0;
  /// True when the misfits determine the offset: on average they are a quarter more than the least, which is not at an
  /// end of the search. False: nobody moves, or the clock is further off, and `frames` is a guess.
  bool is_told = false;
};

/// Finds the offset at which `misfit`, in pixels squared, is least: of all whole frames the best one, then where the
/// parabola through its neighbourhood is lowest. Between frames nothing is asked, because an interpolated pixel errs
/// less than those it is made of, which would draw every offset to a half. 0 where it is hardly less than at 0, or
/// nothing there.
ClockOffset FindOffset(const std::function<std::optional<double>(int offset)>& misfit, int most_frames);

/// Returns the pixel `share` of the way from b to c, frames next to each other whose neighbours are a and d: a cubic
/// through all (Catmull-Rom), straight where a or d is missing, nothing where b or c is.
using SomePixel = std::optional<glm::dvec2>;
SomePixel PixelBetween(const SomePixel& a, const SomePixel& b, const SomePixel& c, const SomePixel& d, double share);

/// Estimates how late each camera's pictures are *(ours)*, in frames: its frame k was taken at k + offset of the first
/// camera's time. Each camera is set by the first one alone: the offset at which what both have marked, ends and
/// strokes, meets best (`FindOffset`), the mean of their squared distances (`EpipolarGeometry`), the camera's marks
/// taken between its frames (`PixelBetween`). A camera of which nothing tells the time (nobody moves, or too little is
/// marked) has offset 0.
std::vector<double> EstimateOffsets(std::span<const ProjectionMatrix> cameras,
                                    std::span<const std::vector<Marks>> marks, const SyncOptions& options = {});

/// Returns what a camera would have marked at `frame`, between its frames: a cubic through the two frames on either
/// side (Catmull-Rom), straight where one of the outer two lacks the mark; nothing where one of the inner two does.
/// Where only every n-th frame is marked, give those frames alone.
Marks MarksAt(std::span<const Marks> track, double frame);

/// Returns the marks of all cameras at the first one's times.
std::vector<std::vector<Marks>> Synchronised(std::span<const std::vector<Marks>> marks,
                                             std::span<const double> offsets);

}  // namespace etude
