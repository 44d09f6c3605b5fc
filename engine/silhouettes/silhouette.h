#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"

namespace etude {

/// Computes how far every pixel's centre lies from the border of the mask, in pixels of the mask: positive outside,
/// negative inside. The border runs half a pixel beyond the centres of set pixels, so |distance| ≥ 0.5. Exact
/// (Euclidean), in time linear in the pixels: P. Felzenszwalb and D. Huttenlocher, "Distance transforms of sampled
/// functions", Theory of Computing 8 (2012), section 2. Where the mask has no set (no unset) pixel, the distance is
/// ±(width + height).
Image<float> SignedDistances(const Mask& mask);

struct SilhouetteOptions {
  /// The width of a mask pixel in pixels of the camera: 2 for a mask of half the picture's size.
  double mask_pixel = 1;
  /// The side, in mask pixels, of the squares in each of which the outline is sampled once. Fewer samples are quicker;
  /// 3 leaves about two hundred of a person who fills a picture of 320 × 240.
  int spacing = 3;
  /// The radius, in mask pixels, of the disc by which the mask is opened: what is thinner is no part of the person,
  /// such as lines of furniture, ragged edges. A forearm four metres away is five pixels wide in a mask of 320 × 240. 0
  /// takes the mask as it is.
  double thinnest = 1;
};

/// A point of a silhouette's outline, in the camera's pixels.
struct OutlinePoint {
  glm::dvec2 pixel{0};
  glm::dvec2 normal{0};  ///< unit, out of the silhouette
};

/// One camera's picture of a person, prepared for the fit. Of the distances only the box about the person is kept.
struct Silhouette {
  Image<float> distances;  ///< `SignedDistances` of the mask, in pixels of the mask, from (left, top) on
  int left = 0, top = 0;
  int width = 0, height = 0;  ///< of the whole mask
  double mask_pixel = 1;
  std::vector<OutlinePoint> outline;
  glm::dvec2 centre{0};  ///< mean of the set pixels, in the camera's pixels
  int area = 0;          ///< set pixels of the mask; 0 when the picture shows nobody, then it tells nothing
};

Silhouette MakeSilhouette(const Mask& mask, const SilhouetteOptions& options = {});

/// Returns the signed distance at a pixel of the camera, in pixels of the camera, and its gradient: bilinear between
/// pixel centres. Away from the person, where the box ends, the distance to the box is added to that on its edge: never
/// less than the true one. Outside the picture it is that of the nearest pixel within, so that what leaves the picture
/// is not pulled back. The silhouette shows somebody.
struct DistanceAt {
  double distance = 0;
  glm::dvec2 gradient{0};
};
DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel);

}  // namespace etude
