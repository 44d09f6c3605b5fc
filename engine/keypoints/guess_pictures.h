#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/people.h"
#include "engine/keypoints/pixel_fit.h"

namespace etude {

/// One film's keypoints as they are in the file, and the declared relation between its pictures and the rig's.
struct PictureOfFilm {
  Camera camera;
  PixelFit fit;           ///< the fit that the caller declares
  glm::dvec2 film_px{0};  ///< the size of the film's pictures
  SeenPeople people;      ///< the people in the film, in the file's pixels
  bool is_sized = false;  ///< true if the file states the picture size; `people` are then in the film's pixels
};

/// The map that converts the keypoints of a film to pixels of the rig.
struct PictureGuess {
  PixelFit fit;
  std::string told;  ///< explanation for users; "" if `fit` is as declared
};

/// Returns the matrices of the films' cameras, in the same order.
std::vector<ProjectionMatrix> MatricesOf(std::span<const PictureOfFilm> films);

/// Returns `film` with keypoints that are of pictures turned clockwise by `turns` more quarter turns than declared.
PictureOfFilm Turned(PictureOfFilm film, int turns);

/// Finds how keypoints map to the rig's pictures *(ours)*: as `fit` declares, or also rotated by quarter turns or
/// mirrored. Cameras are corrected one after the other. A camera's error is the distance of its keypoints from the
/// other cameras' epipolar lines: the median over frames, with the best-fitting person and labelling of sides in each
/// frame. Each time, the correction that leaves the smallest error is made. A camera is corrected only if its error
/// exceeds 0.3 % of the person's height, and if the correction at least halves the error and reduces it below 5 % of
/// the height. (A wrong correction cannot halve random errors.) If pictures were fitted, the estimator may have run
/// on the original pictures; the keypoints of all films are then pixels of the original pictures. They are
/// interpreted in this way if the distances become smaller by more than 3 %, and if no file states the size of its
/// pictures. `told` also names a second correction if it is nearly as good, as is common with two cameras.
std::vector<PictureGuess> GuessPictures(std::span<const PictureOfFilm> films, double min_confidence);

/// Maps the keypoints as declared, and returns their epipolar distance as a share of the person's height: the mean,
/// over pairs of cameras, of the median distance of one camera's keypoints from the other camera's epipolar lines.
/// Returns 1 if the distance cannot be computed.
double EpipolarDistanceOf(std::span<const PictureOfFilm> films, double min_confidence);

/// An epipolar distance above this share of the person's height indicates a mistake, not only imprecise keypoints.
constexpr double kMaxPlausibleMiss = 0.05;

}  // namespace etude
