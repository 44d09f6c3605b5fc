#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace etude::engine {

/// The pixels of a picture, row by row from the top; 0 where the person is not (as PersonFinder::Find returns).
struct PersonMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< width × height
};

/// A point of a mask's outline, in pixels; the first pixel's centre is (0.5, 0.5).
struct OutlinePoint {
  glm::dvec2 pixel{0};
  glm::dvec2 normal{0};  ///< unit vector, pointing away from the person
};

struct OutlineOptions {
  int spacing = 3;      ///< the outline is sampled once in every square of this many pixels, 1 to 1000
  double thinnest = 1;  ///< parts thinner than twice this many pixels do not count as person, 0 to 100
};

/// Returns points along the rim of a mask, from its top; none for an empty mask. Throws BadInput if the number of
/// pixels does not fit the size, and for sides that are not from 1 to 8192.
ETUDE_API std::vector<OutlinePoint> Outline(const PersonMask& mask, const OutlineOptions& options = {});

/// Returns the distance of each pixel's centre from the mask's rim, in pixels, positive outside: width × height
/// numbers. Throws as Outline.
ETUDE_API std::vector<float> SignedDistances(const PersonMask& mask);

struct SilhouetteOptions {
  double stature_m = 1.74;  ///< height of the person, who has an average adult's limbs for that height; 0.5 to 2.5
  /// Poses of this person from which limb lengths are measured; `stature_m` is then ignored.
  std::vector<Pose> measured = {};
  double rate_hz = 30;  ///< of the pictures, 1 to 1000; it determines how far a person can move between two pictures
};

/// Follows a person through films by outlines alone (engine/silhouettes), without marks or keypoints. Frames in which
/// fewer than two cameras show a person have no pose. Works best for a person who fills half of the picture's height.
/// @param cameras two or more fixed cameras without lens distortion: undistort the pictures first
/// @param masks for each camera and frame, all cameras at the same moments; of the camera's size, or smaller by the
/// same
///     whole factor in both directions
/// Throws BadInput for cameras and masks that do not fit each other, for lenses, and for limbs of length zero.
ETUDE_API std::vector<std::optional<Pose>> TrackSilhouettes(std::span<const Camera> cameras,
                                                            std::span<const std::vector<PersonMask>> masks,
                                                            const SilhouetteOptions& options = {});

}  // namespace etude::engine
