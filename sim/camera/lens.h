#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "sim/camera/camera_effects.h"
#include "sim/camera/light.h"
#include "sim/random/stream.h"
#include "sim/render/scene.h"

namespace etude {

/// Returns the distortion of those strengths for a camera with those intrinsics: k1 = radial / r², where r is the
/// distance of the picture's farthest corner from the axis at distance 1; tangential |p| = strength / 3r, its direction
/// by one throw.
Distortion LensDistortion(const CameraEffects& effects, const Intrinsics& intrinsics, RandomStream& random);

/// Turns pictures of a pinhole into those of a lens. The renderer draws straight lines only: it draws a pinhole's
/// picture of the same scale with a margin, and each pixel of the lens's picture is looked up there, by
/// `UndistortPixel`.
class LensWarp {
 public:
  /// Every pixel of the camera must have a source: |radial| of a barrel stays below 0.14 for usual cameras.
  explicit LensWarp(const Camera& camera);

  /// Returns the camera to draw for: without distortion, with as much more picture as the corners need; the camera
  /// itself when it has no distortion.
  const Camera& pinhole() const { return pinhole_; }
  bool is_none() const { return sources_.empty(); }

  /// Returns the pinhole's rows that these rows of the camera are made of.
  RowRange SourceRows(const RowRange& rows) const;

  /// Fills those rows (of a camera with distortion; else labels and depths are copied): light between four pixels,
  /// labels and depths of the nearest. `source` holds the pinhole's rows SourceRows(rows) and no others. Empty pictures
  /// stay empty.
  void Warp(const LightImage& source, const RowRange& rows, LightImage& out) const;
  void Warp(const LabelImage& source, const RowRange& rows, LabelImage& out) const;
  void Warp(const DepthImage& source, const RowRange& rows, DepthImage& out) const;

  /// Returns a whole picture of the pinhole as the lens shows it; colour goes through light and back.
  View Warp(const View& pinhole) const;

 private:
  /// The source of a pixel: its upper left neighbour, and its distance from there.
  struct Source {
    std::int32_t x, y;
    float right, down;
  };
  template <typename Pixel>
  void Nearest(const Image<Pixel>& source, const RowRange& rows, Image<Pixel>& out) const;

  int width_, height_;
  Camera pinhole_;
  std::vector<Source> sources_;          ///< empty without distortion
  std::vector<std::int32_t> nearest_;    ///< likewise: each pixel's place in the pinhole's picture
  std::vector<RowRange> source_of_row_;  ///< likewise
};

/// Spreads every point to a Gaussian of standard deviation `sigma_px`, cut off beyond three of them; what lies outside
/// is taken to be like the nearest pixel. A lens out of focus spreads a point to a disc, but its aberrations and the
/// sensor's pixels round that off; MTF(f) = exp(−2π²σ²f²), f in cycles per pixel. Not deeper or shallower with
/// distance.
class Defocus {
 public:
  explicit Defocus(double sigma_px);
  void Apply(LightImage& light);

 private:
  void BlurAcross(const Light* row, std::size_t width, Light* out);

  std::vector<float> weights_;  ///< of the middle, and of those 1, 2, … away
  std::vector<Light> padded_row_, across_;
  std::vector<const float*> rows_;
};

/// The share of the light that reaches a pixel, 0…1.
using Transmission = Image<float>;

/// Darkens towards the corners: cos(θ) to the power 4 · strength, θ between the pixel's ray and the axis. 1 is what
/// geometry alone does to a lens; mounts and filters add to it.
void AddVignette(const Camera& camera, double strength, Transmission& transmission);

/// A speck of dust before the sensor: its shadow is soft, because the light comes from the whole lens.
struct Speck {
  double x = 0, y = 0;  ///< pixels
  double radius = 0;    ///< pixels, to where half of the shadow is left
};

/// Draws ten specks of 2 to 6 pixels, anywhere in a picture of that size.
std::vector<Speck> ThrowSpecks(int width, int height, RandomStream& random);

/// Darkens `transmission` by dust: each speck keeps `strength` of the light away in its middle, and half as much at its
/// radius: strength / (1 + (d / radius)⁴) at distance d. Shadows of several multiply.
void AddDust(const std::vector<Speck>& specks, double strength, Transmission& transmission);

}  // namespace etude
