#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"
#include "engine/keypoints/pixel_fit.h"

namespace etude {

/// One film's keypoints as their file has them, and how its pictures are said to have come of the rig's.
struct PictureOfFilm {
  Camera camera;
  PixelFit fit;           ///< as said
  glm::dvec2 film_px{0};  ///< the size of the film's pictures
  SeenPeople people;      ///< in the file's pixels
  bool is_sized = false;  ///< the file names the size of the film's pictures: its pixels are theirs
};

/// The way in which the keypoints of a film are to be read.
struct PictureGuess {
  PixelFit fit;
  std::string told;  ///< "" where it is as said
};

/// Finds how keypoints lie in the rig's pictures *(ours)*: as said by `fit`, or, one camera after the other and each
/// time the one that gains most, turned by quarters or mirrored, where that brings the keypoints to less than half of
/// the distance from the other cameras' epipolar lines (median over frames, people that fit best and either labelling,
/// as a share of the height), to less than 5 % of the height, and they were more than 0.3 % off (what errs by itself is
/// never halved). Where pictures were fitted, keypoints of all films may be the rig's own pixels instead (an estimator
/// that ran on the original pictures): whichever misses less, unless a file names the film's size. Of two cameras, and
/// where a second guess is nearly as good, `told` says so.
std::vector<PictureGuess> GuessPictures(std::span<const PictureOfFilm> films, double least_confidence);

/// Measures how far keypoints that are read as said lie from the other cameras' epipolar lines, as a share of the
/// height: the mean over pairs of cameras of those medians. 1 where nothing can be said.
double MissOfPictures(std::span<const PictureOfFilm> films, double least_confidence);

/// Beyond this share of the height something is wrong, not only imprecise.
constexpr double kNotAsSaid = 0.05;

/// A mistake of a whole session that its keypoints show.
struct SessionGuess {
  std::vector<Camera> cameras;     ///< of the films
  std::vector<SeenPeople> people;  ///< of the films, in their pixels
  std::string mended;              ///< what was done, "" where all is as said
};

/// Finds what is wrong with a whole session *(ours)*: the films of two cameras exchanged; a rig whose poses lead from
/// the cameras to the world, whose cameras look along −z (OpenGL's), or both; keypoints of pictures of another size,
/// counted from below, with x and y exchanged, all mirrored, or shares of a square about the picture or of its longer
/// side. Of these the one with which keypoints are nearest to the other cameras' epipolar lines (`MissOfPictures`) is
/// taken where that is less than half of what is left otherwise, pictures read as `GuessPictures` finds them, and less
/// than 5 % of the height. Exchanges are looked for among at most eight films.
/// @param R_WF from the axes of the rig's file to the cameras' world
SessionGuess GuessSession(std::span<const PictureOfFilm> films, std::span<const std::string> names,
                          const glm::dmat3& R_WF, double least_confidence);

}  // namespace etude
