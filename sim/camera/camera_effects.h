#pragma once

namespace etude {

/// The strengths of all effects that a camera has on the light between the room and the file. 0 switches an effect off:
/// every byte is then as if the effect did not exist. An effect's random numbers do not depend on any strength. The
/// default is a camera with noise and no other effect. The headers named below describe the models.
struct CameraEffects {
  // Time: clocks and shutters (camera_model.h).
  double sync_offset_ms = 0;      ///< offset of the clocks of all cameras but the first; the sign is random
  double clock_drift_ppm = 0;     ///< difference of their rates, millionths; the sign is random
  double rolling_shutter_ms = 0;  ///< time from the reading of the first row to that of the last
  double motion_blur = 0;         ///< exposure time as a share of the time between frames

  // The lens (lens.h).
  double radial_distortion = 0;      ///< shift of the corner as a share of its distance from the axis; < 0 is a barrel
  double tangential_distortion = 0;  ///< the same, in a random direction
  double defocus_px = 0;             ///< standard deviation of the Gaussian point spread function
  /// Power of the cosine of the angle from the axis, in units of 4: 1 is natural, cos⁴.
  double vignette = 0;
  double dust = 0;  ///< share of the light that a speck absorbs at its centre

  // Tones: exposure and colours (sensor.h).
  double exposure_ev = 0;        ///< stops brighter
  double exposure_drift_ev = 0;  ///< largest drift of an automatic exposure from `exposure_ev`
  /// Amplification: a picture of the same brightness needs less light and has more noise.
  double gain_db = 0;
  double white_balance_ev = 0;        ///< red over blue, stops: > 0 is too warm
  double white_balance_drift_ev = 0;  ///< its maximum drift

  // The sensor (sensor.h) and the file (jpeg.h).
  double bayer = 0;      ///< 1: one colour per pixel, the others interpolated; values between 0 and 1 mix both pictures
  double noise = 1;      ///< factor on the usual standard deviation of read and shot noise
  double jpeg_loss = 0;  ///< 100 − JPEG quality; 0: no JPEG at all
};

}  // namespace etude
