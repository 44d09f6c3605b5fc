#pragma once

namespace etude {

/// The strengths of all effects that a camera has on the light between the room and the file. An effect of strength 0
/// changes no byte. The random numbers of an effect do not depend on any strength. By default, a camera has noise and
/// no other effect. The headers named below describe the models.
struct CameraEffects {
  // Time: clocks and shutters (camera_model.h).
  double sync_offset_ms = 0;      ///< clock offset of every camera except the first; the sign is random
  double clock_drift_ppm = 0;     ///< rate error of every camera's clock except the first, millionths; random sign
  double rolling_shutter_ms = 0;  ///< time between the readings of the first and the last row
  double motion_blur = 0;         ///< exposure time as a share of the time between frames

  // The lens (lens.h).
  double radial_distortion = 0;      ///< a corner's shift ÷ the corner's distance from the optical axis; < 0: a barrel
  double tangential_distortion = 0;  ///< shift of that corner in a random direction, as a share like radial_distortion
  double defocus_px = 0;             ///< standard deviation of the Gaussian point spread function
  /// Vignetting: light decreases by cos(θ) to the power 4 · vignette, where θ is the angle from the axis. 1 is natural
  /// (cos⁴).
  double vignette = 0;
  double dust = 0;  ///< share of the light that a speck of dust absorbs at the speck's centre

  // Tones: exposure and colours (sensor.h).
  double exposure_ev = 0;        ///< exposure in stops: > 0 is brighter
  double exposure_drift_ev = 0;  ///< largest deviation of an automatic exposure from `exposure_ev`
  /// Amplification, decibels: with gain, a picture of the same brightness needs less light and has more noise.
  double gain_db = 0;
  double white_balance_ev = 0;        ///< ratio of red to blue, stops: > 0 is too warm
  double white_balance_drift_ev = 0;  ///< largest deviation of an automatic white balance from `white_balance_ev`

  // The sensor (sensor.h) and the file (jpeg.h).
  double bayer = 0;      ///< 1: each pixel senses one colour, others are interpolated; < 1: mixed with full colours
  double noise = 1;      ///< factor on the usual standard deviations of read noise and shot noise
  double jpeg_loss = 0;  ///< 100 − JPEG quality; 0: no JPEG at all
};

}  // namespace etude
