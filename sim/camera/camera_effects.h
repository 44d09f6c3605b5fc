#pragma once

namespace etude {

/// The strengths of everything that a camera does to the light on its way from the room to the file. 0 leaves an effect
/// out: then every byte is as if it did not exist. An effect's dice do not depend on any strength. The defaults are a
/// noisy camera that does all else perfectly. How each is modelled stands in the header named beside it.
struct CameraEffects {
  // When: clocks and shutters (camera_model.h).
  double sync_offset_ms = 0;      ///< how far the clocks of all cameras but the first stand off, either way
  double clock_drift_ppm = 0;     ///< how much faster or slower they run, millionths
  double rolling_shutter_ms = 0;  ///< from the reading of the first row to that of the last
  double motion_blur = 0;         ///< how long the shutter is open, as a share of the time between frames

  // Where: the lens (lens.h).
  double radial_distortion = 0;      ///< how far the corner moves, of its distance from the middle; < 0 is a barrel
  double tangential_distortion = 0;  ///< likewise
  double defocus_px = 0;             ///< standard deviation of the Gaussian that a point is spread to
  double vignette = 0;               ///< 1: natural, cos⁴ of the angle from the axis; else a power of that
  double dust = 0;                   ///< the share of light that a speck keeps away, in its middle

  // How much: exposure and colours (sensor.h).
  double exposure_ev = 0;        ///< stops brighter
  double exposure_drift_ev = 0;  ///< how far an automatic exposure wanders from that, at most
  double gain_db = 0;            ///< amplification: so much less light for the same picture, and so much more noise
  double white_balance_ev = 0;   ///< red against blue, stops: > 0 is too warm
  double white_balance_drift_ev = 0;  ///< how far it wanders, at most

  // With what: the sensor (sensor.h) and the file (jpeg.h).
  double bayer = 0;      ///< 1: one colour a pixel, the others interpolated; between 0 and 1 a mix of both pictures
  double noise = 1;      ///< times the usual deviation of read and shot noise
  double jpeg_loss = 0;  ///< 100 − JPEG quality; 0 is no JPEG at all
};

}  // namespace etude
