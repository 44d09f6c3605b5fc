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

/// The shutter says when a camera takes its pictures. Times are in frames of the reference clock, as is the truth:
/// frame k of a faultless camera is taken at k.
class Shutter {
 public:
  /// @param is_reference the camera whose clock is right; the others' offset and drift have a sign by throws, their
  ///        size is the effect's
  Shutter(const CameraEffects& effects, double rate_hz, bool is_reference, RandomStream& random);

  /// Returns the time at which the middle row of the camera's own frame k is taken: k (1 + drift) + offset.
  double TimeOf(std::size_t frame) const;

  /// A band of rows that are taken at one time.
  struct Band {
    RowRange rows;
    double time = 0;
  };
  /// Returns the bands of a frame. A rolling shutter reads row after row, from the top; it is drawn in kBands bands,
  /// each at the time of its middle; without one there is a single band.
  std::vector<Band> BandsOf(std::size_t frame, int height) const;
  static constexpr int kBands = 8;

  /// Returns the times, while the shutter is open, whose pictures are averaged: kSubframes of them, evenly spread about
  /// the band's; one without motion blur.
  std::vector<double> SubframesOf(const Band& band) const;
  static constexpr int kSubframes = 9;

 private:
  double offset_ = 0;    ///< frames
  double drift_ = 0;     ///< frames per frame
  double read_out_ = 0;  ///< frames from the first row to the last
  double open_ = 0;      ///< frames
};

/// The identity of a camera within its world, which keys its dice.
struct CameraIdentity {
  WorldKey world;
  std::string name;          ///< "capture/camera-0": its purposes begin so
  bool is_reference = true;  ///< its clock is the one that the truth is told by
};

/// A camera of a world: everything that its pictures have in common. It applies the effects in the order in which light
/// meets them (README.md). Not thread-safe: it reuses its buffers.
class CameraModel {
 public:
  /// Draws what a faultless pinhole (`pinhole()`) would see in some rows, at a time in frames of the reference clock,
  /// as a view as high as there are rows.
  using Scene = std::function<View(double frame, const RowRange& rows, Targets targets)>;

  /// @param camera with its distortion (LensDistortion); `effects` has the rest
  CameraModel(const Camera& camera, const CameraEffects& effects, double rate_hz, CameraIdentity identity);

  /// Returns the camera that scenes are drawn for: without distortion, with a margin for it.
  const Camera& pinhole() const { return lens_.pinhole(); }
  const Shutter& shutter() const { return shutter_; }

  /// Takes the camera's own frame k. Labels and depth, if asked for, are those of the light on each pixel's middle, in
  /// the middle of the exposure: free of blur, noise and dust.
  View Shoot(std::size_t frame, const Scene& scene, Targets targets);

  /// Takes a picture of the empty stage at the beginning, with dice of its own.
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
  const bool needs_light_;  ///< else noise on 8-bit pictures is all there is
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
