#include "bench/tasks/capture/camera_fields.h"

namespace etude {
namespace {

Field<StudioOptions> Effect(const std::string& key, double CameraEffects::*effect, Range range, std::string meaning) {
  return Field<StudioOptions>::Number(key, Path(&StudioOptions::camera, effect), range, std::move(meaning));
}

}  // namespace

std::vector<Field<StudioOptions>> CameraFields() {
  using E = CameraEffects;
  return {
      Effect("sync_offset_ms", &E::sync_offset_ms, {0, 500},
             "How far the clocks of all cameras but the first stand off, either way."),
      Effect("clock_drift_ppm", &E::clock_drift_ppm, {0, 50000},
             "How much faster or slower those clocks run, millionths."),
      Effect("rolling_shutter_ms", &E::rolling_shutter_ms, {0, 66},
             "From the reading of a picture's first row to that of its last."),
      Effect("motion_blur", &E::motion_blur, {0, 1},
             "How long the shutter is open, as a share of the time between frames."),
      Effect("radial_distortion", &E::radial_distortion, {-0.12, 0.25},
             "How far the lens moves the picture's corner, of its distance from the middle; below 0 a barrel."),
      Effect("tangential_distortion", &E::tangential_distortion, {0, 0.05},
             "Likewise, of a lens that is not parallel to the sensor."),
      Effect("defocus_px", &E::defocus_px, {0, 10}, "Standard deviation of the Gaussian that a point is spread to."),
      Effect("vignette", &E::vignette, {0, 4},
             "Darkness of the corners: 1 is natural, the cosine of the angle from the axis to the fourth power."),
      Effect("dust", &E::dust, {0, 1}, "The share of the light that a speck of dust keeps away, in its middle."),
      Effect("exposure_ev", &E::exposure_ev, {-4, 4}, "Stops by which pictures are too bright."),
      Effect("exposure_drift_ev", &E::exposure_drift_ev, {0, 2},
             "How far an automatic exposure wanders, stops at most."),
      Effect("gain_db", &E::gain_db, {0, 36}, "Amplification: as bright a picture of less light, with more noise."),
      Effect("white_balance_ev", &E::white_balance_ev, {-2, 2}, "Stops of red against blue: above 0 too warm."),
      Effect("white_balance_drift_ev", &E::white_balance_drift_ev, {0, 2},
             "How far an automatic white balance wanders, stops at most."),
      Effect("bayer", &E::bayer, {0, 1},
             "1: each pixel measures one colour, the others are interpolated; between, a mix of both pictures."),
      Effect("camera_noise", &E::noise, {0, 20}, "Multiplies the camera's usual noise."),
      Effect("jpeg_loss", &E::jpeg_loss, {0, 99}, "100 less the quality of the JPEG file; 0 is no JPEG.")};
}

}  // namespace etude
