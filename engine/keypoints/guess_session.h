#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/keypoints/guess_pictures.h"

namespace etude {

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
