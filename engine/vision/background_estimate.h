#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// The activity at every pixel of a picture, in any unit: the less, the likelier the pixel shows the room behind.
using Activity = Image<float>;

struct MotionOptions {
  std::size_t lag = 1;  ///< how many pictures before and after each is compared with
  /// Half the side of the square about a pixel in which motion counts, pixels: a trunk moves at its rim only, and must
  /// not pass for a room in its middle. A quarter of a trunk's width.
  int reach = 12;
  int change = 14;  ///< levels by which a colour must differ to have moved: several deviations of noise
};

/// Computes, for each picture and pixel, the share of the pixels about it that are another colour in the picture `lag`
/// before or after.
std::vector<Activity> MotionActivity(std::span<const ColourImage> pictures, const MotionOptions& options = {});

/// Estimates the background of a static scene: per pixel and channel the median of the `kept` pictures with the least
/// motion there; ties go to the earliest. A pixel never uncovered keeps what hid it. (B. Laugraud, S. Piérard, M. Van
/// Droogenbroeck, "LaBGen: a method based on motion detection for generating the background of a scene", Pattern
/// Recognition Letters 96, 2017; theirs counts motion in patches.)
/// @param activity of each picture, of its size
/// @param kept at least one; as many as there are pictures gives their median
ColourImage EstimateBackground(std::span<const ColourImage> pictures, std::span<const Activity> activity,
                               std::size_t kept);

}  // namespace etude
