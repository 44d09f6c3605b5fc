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
  /// The maximum offset that is searched, in frames either way. Raise it for cameras that were started by hand.
  int max_frames = 16;
  /// The epipolar distance, pixels, at which the distance of a pair of sightings is capped, so that a single mark on
  /// the wrong limb does not determine the offset.
  double max_px = 20;
};

struct ClockOffset {
  double frames = 0;
  /// True if the misfits determine the offset: their mean is at least a quarter above the minimum, and the minimum is
  /// not at an end of the search. If false, nobody moves or the true offset is out of range, and `frames` is a guess.
  bool is_told = false;
  double misfit = 0;  ///< the misfit at `frames`, squared pixels; 0 if no misfit is defined
  /// The share of the mean misfit that is absent at the minimum, 0 to 1: how clearly the misfits show the offset.
  double explained = 0;
};

/// Finds the offset that minimises `misfit`, in squared pixels: first the best whole number of frames, then the minimum
/// of the parabola through its neighbourhood. The misfit is evaluated at whole frames only. (Between frames, pixels
/// would be interpolated and so have smaller errors, which would bias the offset towards half frames.) Returns 0 if
/// the minimum is hardly below the misfit at 0, or if the misfit at 0 is undefined.
ClockOffset FindOffset(const std::function<std::optional<double>(int offset)>& misfit, int max_frames);

using OptionalPixel = std::optional<glm::dvec2>;
/// Returns the pixel at the fraction `share` of the way from b to c, for consecutive frames a, b, c, d. A Catmull-Rom
/// spline runs through all four; if a or d is missing, the interpolation is linear. Returns nullopt if b is missing, or
/// if c is missing and `share` is not 0.
OptionalPixel PixelBetween(const OptionalPixel& a, const OptionalPixel& b, const OptionalPixel& c, const OptionalPixel& d, double share);

/// Estimates the delay of each camera's pictures in frames *(ours)*: frame k of a camera was taken at the first
/// camera's time k + offset. Each camera is compared with the first one. The offset minimises the mean squared epipolar
/// distance (`EpipolarGeometry`, `FindOffset`) of all ends and strokes that are marked in the pictures of the two
/// cameras; the marks of the compared camera are interpolated between its frames (`MarksAt`). The offset is 0 if
/// nothing determines it (nobody moves, or there are too few marks).
std::vector<double> EstimateOffsets(std::span<const ProjectionMatrix> cameras,
                                    std::span<const std::vector<Marks>> marks, const SyncOptions& options = {});

/// Returns the marks of a camera at a time between frames. A mark follows a Catmull-Rom spline through the two frames
/// before this time and the two frames after it. If one of the outer two frames lacks the mark, the mark is
/// interpolated linearly; if one of the inner two frames lacks the mark, the result lacks it. If only every n-th frame
/// is marked, pass the marked frames alone.
Marks MarksAt(std::span<const Marks> track, double frame);

/// Returns the marks of all cameras at the frame times of the first camera.
std::vector<std::vector<Marks>> Synchronised(std::span<const std::vector<Marks>> marks,
                                             std::span<const double> offsets);

}  // namespace etude
