#pragma once

#include <algorithm>
#include <cassert>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"

namespace [[gnu::visibility("default")]] etude {

/// Computes the signed Euclidean distance from every pixel's centre to the border of the mask, in mask pixels: positive
/// outside, negative inside. The border runs half a pixel outside the centres of set pixels, so |distance| ≥ 0.5. The
/// distances are exact; the time is linear in the number of pixels (P. Felzenszwalb and D. Huttenlocher, "Distance
/// transforms of sampled functions", Theory of Computing 8 (2012), section 2). If no pixel is set, every distance is
/// width + height; if all pixels are set, −(width + height).
Image<float> SignedDistances(const Mask& mask);

struct SilhouetteOptions {
  /// The width of a mask pixel in pixels of the camera: 2 for a mask of half the picture's size.
  double mask_pixel = 1;
  /// Outline points are sampled on a grid of squares: one point per square, whose side is this many mask pixels. Larger
  /// squares give fewer points and a faster fit; with 3, a person as tall as a picture of 320 × 240 has about two
  /// hundred points.
  int spacing = 3;
  /// The radius, in mask pixels, of the disc of the morphological opening. The opening removes parts thinner than the
  /// disc, such as lines of furniture and ragged edges. For comparison, a forearm four metres away is five pixels wide
  /// in a mask of 320 × 240. With 0 the mask is not opened.
  double thinnest = 1;
};

/// A point of a silhouette's outline, in the camera's pixels.
struct OutlinePoint {
  glm::dvec2 pixel{0};
  glm::dvec2 normal{0};  ///< unit vector, points out of the silhouette
};

/// An outline's points as columns of coordinates, sorted so that the points of a block are neighbours
/// (nearest_cones.h).
struct OutlineColumns {
  std::vector<int> places;  ///< the column of each outline point
  std::vector<double> u, v;
  std::vector<double> centre_u, centre_v, radius;  ///< circles around blocks of columns
};
OutlineColumns MakeColumns(const std::vector<OutlinePoint>& outline);

/// One camera's picture of a person, prepared for the fit. Distances are stored only for the box around the person.
struct Silhouette {
  Image<float> distances;  ///< `SignedDistances` of the mask, in mask pixels; begins at (left, top)
  int left = 0, top = 0;
  int width = 0, height = 0;  ///< size of the whole mask
  double mask_pixel = 1;
  std::vector<OutlinePoint> outline;
  OutlineColumns columns;  ///< the points of `outline`, sorted into columns
  glm::dvec2 centre{0};    ///< mean of the set pixels, in the camera's pixels
  int area = 0;            ///< number of set pixels of the mask; 0 if the picture shows nobody and is not used
};

Silhouette MakeSilhouette(const Mask& mask, const SilhouetteOptions& options = {});

/// The result of DistanceAtPixel: the signed distance at a pixel of the camera, in the camera's pixels, and the
/// gradient of this distance. Both come from bilinear interpolation between pixel centres. Outside the box around the
/// person, the distance is the sum of the distance at the box's edge and the distance to the box; this is never less
/// than the true distance. Outside the picture, the distance equals the distance at the nearest pixel inside, and the
/// gradient across the picture's edge is 0, so flesh outside the picture is not pulled back. Precondition:
/// `silhouette.area` > 0.
struct DistanceAt {
  double distance = 0;
  glm::dvec2 gradient{0};
};
inline DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel) {
  assert(silhouette.area > 0);
  const Image<float>& field = silhouette.distances;
  // Clamp the pixel to the picture, then to the box that holds distances.
  const glm::dvec2 wanted = pixel / silhouette.mask_pixel - 0.5;
  const glm::dvec2 seen = glm::clamp(wanted, glm::dvec2(0), glm::dvec2(silhouette.width - 1, silhouette.height - 1));
  const glm::dvec2 in_box = seen - glm::dvec2(silhouette.left, silhouette.top);
  const glm::dvec2 at = glm::clamp(in_box, glm::dvec2(0), glm::dvec2(field.width - 1, field.height - 1));
  // Interpolate the distance and its gradient between the four pixel centres.
  const int x = std::min(static_cast<int>(at.x), field.width - 2),
            y = std::min(static_cast<int>(at.y), field.height - 2);
  const double s = at.x - x, t = at.y - y;
  const double a = field.At(x, y), b = field.At(x + 1, y), c = field.At(x, y + 1), d = field.At(x + 1, y + 1);
  DistanceAt found{(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d),
                   {(1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b)}};
  if (seen == wanted && at == in_box) {  // the usual case
    found.distance *= silhouette.mask_pixel;
    return found;
  }
  // Set the gradient to 0 along each axis on which the point was clamped.
  const glm::dvec2 beyond = in_box - at;
  for (int axis = 0; axis < 2; ++axis) {
    if (beyond[axis] != 0 || seen[axis] != wanted[axis]) found.gradient[axis] = 0;
  }
  // Outside the box, add the distance to the box.
  const double away = glm::length(beyond);
  if (away > 0) {
    found.distance += away;
    for (int axis = 0; axis < 2; ++axis) {
      if (seen[axis] == wanted[axis]) found.gradient[axis] += beyond[axis] / away;
    }
  }
  found.distance *= silhouette.mask_pixel;
  return found;
}

}  // namespace etude
