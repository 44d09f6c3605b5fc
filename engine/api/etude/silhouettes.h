#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace etude::engine {

/// A picture's pixels in rows from the top, 0 where the person is not (what PersonFinder::Find gives).
struct PersonMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< width × height
};

/// A point of a mask's outline, in pixels; the first pixel's centre is (0.5, 0.5).
struct OutlinePoint {
  glm::dvec2 pixel{0};
  glm::dvec2 normal{0};  ///< unit, out of the person
};

struct OutlineOptions {
  int spacing = 3;      ///< the outline is sampled once in every square of so many pixels, 1 to 1000
  double thinnest = 1;  ///< what is thinner than twice this many pixels is no part of the person, 0 to 100
};

/// Returns points all along the rim of a mask, from its top; none of an empty one. Throws BadInput for a mask of
/// another size than it tells, and for sides that are not from 1 to 8192.
ETUDE_API std::vector<OutlinePoint> Outline(const PersonMask& mask, const OutlineOptions& options = {});

/// Returns how far each pixel's centre is from the mask's rim, pixels, positive outside: width × height. Throws as
/// Outline.
ETUDE_API std::vector<float> SignedDistances(const PersonMask& mask);

struct SilhouetteOptions {
  double stature_m = 1.74;  ///< of the person, whose limbs are an average adult's of that stature; 0.5 to 2.5
  /// Poses of this person, of which limb lengths are measured; `stature_m` counts nothing then.
  std::vector<Pose> measured = {};
  double rate_hz = 30;  ///< of the pictures, 1 to 1000: how far a person moves from one to the next
};

/// Follows a person through films by nothing but the outlines (engine/silhouettes): no marks, no keypoints. Nothing
/// in frames in which fewer than two cameras show anybody. Made for a person who fills half of the picture's height.
/// @param cameras two or more that stand still, without lens errors: straighten the pictures first
/// @param masks of each camera, of each frame, taken at the same moments; of the camera's size, or smaller by one whole
///     factor in both directions
/// Throws BadInput for cameras and masks that do not go together, lenses, and limbs that have no length.
ETUDE_API std::vector<std::optional<Pose>> TrackSilhouettes(std::span<const Camera> cameras,
                                                            std::span<const std::vector<PersonMask>> masks,
                                                            const SilhouetteOptions& options = {});

}  // namespace etude::engine
