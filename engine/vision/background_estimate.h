#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// The motion activity at every pixel of a picture, in any unit. Pixels with lower activity are more likely background.
using Activity = Image<float>;

struct MotionOptions {
  std::size_t lag = 1;  ///< picture n is compared with pictures n − lag and n + lag
  /// Half the side of the square in which motion around a pixel is counted, pixels. Choose about a quarter of a trunk's
  /// width: a trunk shows motion only at its rim, and the trunk's middle must not count as background.
  int reach = 12;
  int change = 14;  ///< colour difference, in levels, that counts as motion; several standard deviations of noise
};

/// Computes the activity of each picture and pixel: the share of changed pixels in the square around the pixel. A pixel
/// has changed if its colour in this picture differs from its colour in the picture `lag` pictures earlier or later (or
/// in the first or last picture, if there is none).
std::vector<Activity> MotionActivity(std::span<const ColourImage> pictures, const MotionOptions& options = {});

/// Estimates the background of a static scene: for each pixel and channel, the median over the `kept` pictures with the
/// lowest activity there. Of equally active pictures, the earliest are taken. A pixel that an object covers in all
/// pictures gets the object's colour. (B. Laugraud, S. Piérard, M. Van Droogenbroeck, "LaBGen: a method based on motion
/// detection for generating the background of a scene", Pattern Recognition Letters 96, 2017; they count motion in
/// patches.)
/// @param activity one per picture, of the picture's size
/// @param kept at least one; if it is the number of pictures, the result is the plain median
ColourImage EstimateBackground(std::span<const ColourImage> pictures, std::span<const Activity> activity,
                               std::size_t kept);

}  // namespace etude
