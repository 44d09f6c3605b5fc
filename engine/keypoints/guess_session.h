#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/guess_pictures.h"

namespace etude {

/// The correction of a mistake that concerns a whole session.
struct SessionGuess {
  std::vector<Camera> cameras;     ///< corrected cameras, one per film
  std::vector<SeenPeople> people;  ///< corrected keypoints of each film, in the films' pixels
  std::vector<PixelFit> fits;      ///< the fit of each film's keypoints; other turns than declared if `turns` is not 0
  int turns = 0;                   ///< clockwise quarter turns of all films' keypoints, added to the declared ones
  std::string mended;              ///< description of the correction; "" if everything is as declared
  std::string doubt;  ///< the scale and shift of the keypoints that fit much better than every known mistake; or ""
};

/// Finds a mistake that concerns a whole session *(ours)*:
/// - the keypoints of all films are turned alike by quarter turns;
/// - the films of two cameras are exchanged (tried among at most eight films);
/// - the rig's poses map from the cameras to the world, its cameras look along −z (OpenGL), or both;
/// - the keypoints belong to pictures of another size, count v from below, have x and y exchanged, are all mirrored, or
///   are relative to a square around the picture or to its longer side. The candidate with the smallest distance to
///   epipolar lines (`EpipolarDistanceOf`) is taken if that distance is less than 5 % of the height, and less than half
///   of the distance that remains after `GuessPictures`. For a half turn of all films, less than nine tenths of the
///   uncorrected distance is enough if the turn makes an upside-down person upright.
///
/// A scale and a shift of both coordinates, common to all films, are compared with the correction of the picture size.
/// If they leave less than half of the distance that this correction leaves, nothing is corrected, and `doubt` states
/// the scale and the shift. If nothing is corrected, they are tried if the distance exceeds 3 % of the height; `doubt`
/// then states them if they leave less than a quarter of the distance.
/// @param R_WF rotation from the axes of the rig's file to the cameras' world
SessionGuess GuessSession(std::span<const PictureOfFilm> films, std::span<const std::string> names,
                          const glm::dmat3& R_WF, double min_confidence);

}  // namespace etude
