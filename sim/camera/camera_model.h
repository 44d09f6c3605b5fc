#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "sim/camera/camera_effects.h"
#include "sim/camera/lens.h"
#include "sim/camera/sensor.h"
#include "sim/random/stream.h"
#include "sim/render/scene.h"

namespace etude {

/// The times at which a camera takes its pictures. Times are in frames of the reference clock, which is also the clock
/// of the truth: an ideal camera takes frame k at time k.
class Shutter {
 public:
  /// @param is_reference true for the camera with the correct clock. The offsets and drifts of other cameras have the
  /// magnitudes in `effects` and random signs.
  Shutter(const CameraEffects& effects, double rate_hz, bool is_reference, RandomStream& random);

  /// Returns the time at which the middle row of the camera's own frame k is exposed: k (1 + drift) + offset.
  double TimeOf(std::size_t frame) const;

  /// A band of rows that are exposed at the same time.
  struct Band {
    RowRange rows;
    double time = 0;
  };
  /// Returns the bands of a frame. A rolling shutter reads the rows from the top. Its effect is approximated by kBands
  /// bands; all rows of a band are exposed at the time of the band's middle row. Without a rolling shutter there is one
  /// band.
  std::vector<Band> BandsOf(std::size_t frame, int height) const;
  static constexpr int kBands = 8;

  /// Returns the times at which a band is rendered for motion blur: kSubframes times, evenly spaced over the exposure,
  /// whose pictures are averaged. Without motion blur, there is only one time.
  std::vector<double> SubframesOf(const Band& band) const;
  static constexpr int kSubframes = 9;

 private:
  double offset_ = 0;    ///< offset of the camera's clock, frames
  double drift_ = 0;     ///< drift of the camera's clock, frames per frame
  double read_out_ = 0;  ///< time between the readings of the first and the last row, frames
  double open_ = 0;      ///< exposure time, frames
};

/// A camera's identity within its world. The identity is the key of the camera's random numbers.
struct CameraIdentity {
  WorldKey world;
  std::string name;          ///< such as "capture/camera-0"; the purposes of the camera's random streams begin with it
  bool is_reference = true;  ///< true if the camera's clock is the clock of the truth
};

/// A camera of a world. The camera takes pictures and applies the effects in the order in which these act on the light
/// (README.md). This class is not thread-safe, because it reuses buffers.
class CameraModel {
 public:
  /// Renders some rows, `rows`, of the ideal pinhole camera's picture (`pinhole()`). `frame` is the time, in frames of
  /// the reference clock. The view's height is the number of rows.
  using Scene = std::function<View(double frame, const RowRange& rows, Targets targets)>;

  /// @param camera the camera, including its lens distortion (LensDistortion); `effects` has all other effects
  CameraModel(const Camera& camera, const CameraEffects& effects, double rate_hz, CameraIdentity identity);

  /// Returns the camera for which scenes are rendered: it has no distortion, and its picture has a margin for the
  /// distortion.
  const Camera& pinhole() const { return lens_.pinhole(); }
  const Shutter& shutter() const { return shutter_; }

  /// Takes the camera's own frame k. Labels and depth, if requested, belong to each pixel's centre in the middle of the
  /// exposure, without blur, noise and dust.
  View Shoot(std::size_t frame, const Scene& scene, Targets targets);

  /// Takes a picture of the empty stage at time 0. The noise of this picture has its own random stream.
  ColourImage ShootBackground(const Scene& scene);

 private:
  View Develop(std::size_t frame, const Scene& scene, Targets targets, const std::string& noise_purpose);
  void AddBand(const Shutter::Band& band, const Scene& scene, Targets targets, View& view);
  void AddLight(const Shutter::Band& band, const Scene& scene, const View& middle);
  void DevelopLight(double seconds, RandomStream& random, ColourImage& out);
  bool NeedsLight(const Camera& camera) const;

  const CameraEffects effects_;
  const double rate_hz_;
  const CameraIdentity identity_;
  const int width_, height_;
  const LensWarp lens_;
  const bool needs_light_;  ///< false: only noise on 8-bit pictures is needed
  Shutter shutter_;
  AutomaticToning toning_;
  SensorNoise noise_;
  std::optional<CodeNoise> code_noise_;
  std::optional<Defocus> defocus_;
  std::optional<Transmission> transmission_;
  LightImage light_, pinhole_light_;
  Mosaic mosaic_;
  LightImage demosaiced_;
};

}  // namespace etude
