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

/// Returns the lens distortion for these effects and intrinsics. k1 = radial / r², where r is the distance of the
/// picture's farthest corner from the axis at depth 1. The vector (p1, p2) has the length tangential / 3r and a random
/// direction (one draw).
Distortion LensDistortion(const CameraEffects& effects, const Intrinsics& intrinsics, RandomStream& random);

/// Warps pictures of a pinhole camera into pictures of a lens with distortion. The renderer draws straight lines only,
/// so it draws the picture of a pinhole camera with the same scale and a margin. Every pixel of the lens's picture is
/// then looked up in the pinhole's picture by `UndistortPixel`.
class LensWarp {
 public:
  /// Every pixel of the camera must have a source in the pinhole's picture; for usual cameras this holds if a barrel
  /// distortion has a `CameraEffects::radial_distortion` above −0.14.
  explicit LensWarp(const Camera& camera);

  /// Returns the pinhole camera for which scenes are rendered. Its picture is enlarged so that every pixel of the lens
  /// has a source pixel in the enlarged picture. If the lens has no distortion, this is the camera itself.
  const Camera& pinhole() const { return pinhole_; }
  bool is_none() const { return sources_.empty(); }

  /// Returns the pinhole's rows from which these rows of the camera are computed.
  RowRange SourceRows(const RowRange& rows) const;

  /// Computes these rows of `out`: light by bilinear interpolation, labels and depths from the nearest pixel. `source`
  /// must hold exactly the pinhole's rows SourceRows(rows). If the lens has no distortion, labels and depths are
  /// copied, and the overload for light must not be called.
  void Warp(const LightImage& source, const RowRange& rows, LightImage& out) const;
  void Warp(const LabelImage& source, const RowRange& rows, LabelImage& out) const;
  void Warp(const DepthImage& source, const RowRange& rows, DepthImage& out) const;

  /// Warps a whole picture of the pinhole into the lens's picture. Colour is interpolated in linear light. An empty
  /// image (colour, labels or depth) of `pinhole` stays empty.
  View Warp(const View& pinhole) const;

 private:
  /// The source of a pixel: a pixel's upper left neighbour in the pinhole's picture, and the offset from that
  /// neighbour.
  struct Source {
    std::int32_t x, y;
    float right, down;
  };
  template <typename Pixel>
  void Nearest(const Image<Pixel>& source, const RowRange& rows, Image<Pixel>& out) const;

  int width_, height_;
  Camera pinhole_;
  std::vector<Source> sources_;          ///< one source per pixel; empty without distortion
  std::vector<std::int32_t> nearest_;    ///< index of each pixel's nearest source pixel; empty without distortion
  std::vector<RowRange> source_of_row_;  ///< for each row, the source pixels' rows; empty without distortion
};

/// Blurs with a Gaussian of standard deviation `sigma_px`, truncated at three deviations. Outside the picture the
/// nearest pixel is repeated. (A defocused lens spreads a point to a disc, but aberrations and the sensor's pixels
/// smooth the disc.) MTF(f) = exp(−2π²σ²f²), with f in cycles per pixel. The blur does not depend on depth.
class Defocus {
 public:
  explicit Defocus(double sigma_px);
  /// Blurs a picture in place.
  void Apply(LightImage& light);

 private:
  void BlurAcross(const Light* row, std::size_t width, Light* out);

  std::vector<float> weights_;  ///< weights of the centre pixel and of pixels at distances 1, 2, …
  std::vector<Light> padded_row_, across_;
  std::vector<const float*> rows_;
};

/// The share of the light that reaches each pixel, 0 to 1.
using Transmission = Image<float>;

/// Darkens the corners by cos(θ) to the power 4 · strength, where θ is the angle between the pixel's ray and the axis.
/// A strength of 1 is the geometric effect of any lens; mounts and filters can make the corners darker still.
void AddVignette(const Camera& camera, double strength, Transmission& transmission);

/// A speck of dust in front of the sensor. The speck's shadow is soft, because light arrives from the whole lens.
struct Speck {
  double x = 0, y = 0;  ///< position of the centre, pixels
  double radius = 0;    ///< radius at which half of the shadow is left, pixels
};

/// Draws ten specks with radii of 2 to 6 pixels, uniformly over a picture of this size.
std::vector<Speck> DrawSpecks(int width, int height, RandomStream& random);

/// Darkens `transmission` by dust: a speck absorbs, at distance d from the speck's centre, the share strength / (1 + (d
/// / radius)⁴) of the light. Where shadows overlap, their transmissions are multiplied.
void AddDust(const std::vector<Speck>& specks, double strength, Transmission& transmission);

}  // namespace etude
