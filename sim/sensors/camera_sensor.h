#pragma once

#include "engine/base/image.h"
#include "sim/random/stream.h"

namespace etude {

/// What a camera adds to the light it sees, in counts of an 8-bit picture. The defaults are those of an
/// indoor webcam: about 2 counts in the dark and 3 in the light.
struct CameraNoise {
  double read_noise = 1.5;          ///< standard deviation in complete darkness
  double photon_noise = 2.5;        ///< standard deviation added at full white; grows with √brightness
  double exposure_deviation = 0.0;  ///< relative gain of the whole frame, drawn once per frame
};

/// The picture as the camera's sensor delivers it. Noise is independent per pixel and channel, its
/// variance is read² + photon² · value / 255. The Gaussian is a table of 4096 equally likely quantiles
/// (standard deviation within 0.1 % of 1, nothing beyond 3.7 deviations), because five numbers then come
/// out of one draw. The number of draws depends on the picture's size alone.
ColourImage AddCameraNoise(const ColourImage& image, const CameraNoise& options, RandomStream& random);

}  // namespace etude
