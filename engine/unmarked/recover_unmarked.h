#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/vision/change_detection.h"

namespace etude {

/// Films of one person by cameras that stand still.
struct UnmarkedTake {
  /// Of this height or width, whichever is longer, settings are at home with a person who fills half of it.
  static constexpr int kPictureSide = 480;
  /// Pinholes, two at least, each in the pixels of its pictures; their world's Y points up.
  std::span<const Camera> cameras;
  /// `pictures[camera][frame]`, taken at the same moments.
  std::span<const std::vector<ColourImage>> pictures;
  /// Of each camera the room without anybody; none at all: it is estimated from the pictures.
  std::span<const ColourImage> rooms;
  double rate_hz = 30;
  /// The person's, metres; nothing: found from the pictures.
  std::optional<double> stature_m;
};

struct UnmarkedOptions {
  /// Pieces are smaller here than in pictures of 640 × 480: see `PersonOptions`.
  PersonOptions person = {.segmenter = Segmenter::kRatio,
                          .change = {},
                          .pieces = PersonPieces::kLarge,
                          .smallest_piece = 60,
                          .piece_reach = 30};
  TrackOptions track;
  /// How often rooms are estimated, each time from the body that was found with the ones before. On the one film it was
  /// tried on a fourth time still bettered them a little.
  int rounds = 4;
  /// Of how many pictures of a camera, evenly over the film, rooms are estimated, and in how many the body is followed
  /// for that. More take longer; a film of a few seconds shows little new in between.
  std::size_t samples = 50;
  /// How many of these a pixel of the room is the median of. Few, because the room may be seen for a moment only.
  std::size_t kept = 5;
  /// Pixels within this of the body may be its shadow or its rim, in pixels of the picture.
  double body_reach_px = 8;
};

/// What became of it.
struct UnmarkedMotion {
  Clip clip;          ///< of the person's own skeleton, metres
  BodyMotion motion;  ///< the same as twenty joints
  double stature_m = 0;
  std::size_t held = 0;  ///< frames in which fewer than two pictures show anybody: they show the last pose
  /// Mean of what silhouettes say against the body (`SilhouetteFit::picture_cost`), for each camera and frame.
  double cost = 0;
  std::vector<ColourImage> rooms;              ///< of each camera
  std::vector<std::vector<Mask>> silhouettes;  ///< of each camera and frame
};

/// How a person moved, by nothing but outlines (engine/silhouettes) *(ours)*: no marks, no estimator, no picture of the
/// empty room. The room is first estimated from where little moves; a body followed in front of that tells where the
/// room is uncovered and when, which betters the room, and so on. Fails when no frame shows anybody to two cameras.
Result<UnmarkedMotion> RecoverUnmarked(const UnmarkedTake& take, const UnmarkedOptions& options = {});

}  // namespace etude
