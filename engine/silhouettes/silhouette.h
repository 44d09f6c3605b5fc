#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"

namespace etude {

struct SilhouetteOptions {
  /// How many pixels of the camera a pixel of the mask is wide: 2 for a mask of half the picture's size.
  double mask_pixel = 1;
  /// The outline is sampled once in every square of this many mask pixels. Fewer samples are quicker; 3 leaves about
  /// two hundred of a person who fills a picture of 320 × 240.
  int spacing = 3;
  /// What is thinner than twice this, in mask pixels, is no part of the person (opening by a disc): lines of furniture,
  /// ragged edges. A forearm four metres away is five pixels wide
  /// in a mask of 320 × 240. 0 takes the mask as it is.
  double thinnest = 1;
};

/// Where the outline of a silhouette runs, in the camera's pixels.
struct OutlinePoint {
  glm::dvec2 pixel{0};
  glm::dvec2 normal{0};  ///< unit, out of the silhouette
};

/// One camera's picture of a person as the fit reads it. Of the distances only the box about the person is kept.
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

/// The signed distance at a pixel of the camera, in pixels of the camera, and its gradient: bilinear between pixel
/// centres. Away from the person, where the box ends, the distance to the box is added to that on its edge: never less
/// than the true one. Outside the picture it is that of the nearest pixel within, so that what leaves the picture is
/// not pulled back. The silhouette shows somebody.
struct DistanceAt {
  double distance = 0;
  glm::dvec2 gradient{0};
};
DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel);

}  // namespace etude
