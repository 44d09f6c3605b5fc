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
  int turns = 0;                   ///< clockwise quarter turns of all films' keypoints, beside the declared ones
  std::string mended;              ///< description of the correction; "" if everything is as declared
  std::string doubt;  ///< the scale and shift of the keypoints that fit much better than every known mistake; or ""
};

/// Finds a mistake that concerns a whole session *(ours)*:
/// - the keypoints of all films are turned alike by quarter turns;
/// - the films of two cameras are exchanged (tried among at most eight films);
/// - the rig's poses map from the cameras to the world, its cameras look along −z (OpenGL), or both;
/// - the keypoints belong to pictures of another size, count v from below, have x and y exchanged, are all mirrored, or
///   are relative to a square around the picture or to its longer side.
/// The candidate with the smallest distance to epipolar lines (`MissOfPictures`) is taken if that distance is less than
/// 5 % of the height, and less than half of the distance that remains after `GuessPictures`. A half turn of all films
/// needs only nine tenths of the distance if the person is upright with it, and upside down without it.
///
/// If a scale and a shift of both coordinates, common to all films, leave less than half of the distance of a new size
/// of the pictures, nothing is corrected, and `doubt` says so. Without such a correction, this is tried if the distance
/// exceeds 3 % of the height; then they must leave less than a quarter.
/// @param R_WF rotation from the axes of the rig's file to the cameras' world
SessionGuess GuessSession(std::span<const PictureOfFilm> films, std::span<const std::string> names,
                          const glm::dmat3& R_WF, double min_confidence);

}  // namespace etude
