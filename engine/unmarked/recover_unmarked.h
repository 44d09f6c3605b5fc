#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/people.h"
#include "engine/kinematics/body_tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/vision/change_detection.h"

namespace etude {

/// Returns the limb lengths of an adult with this stature, metres: `LimbLengths{}`, which belongs to a stature of 1.74
/// m, scaled uniformly.
LimbLengths AdultLengths(double stature_m);

/// The pictures that a take's cameras took at one time (a moment), and the body's pose in them.
struct PosedViews {
  std::span<const SilhouetteView> views;
  TreeState state;
};

/// Finds the stature with the lowest cost *(ours)*, from 6 % below to 6 % above `stature_m`. At each stature the body
/// is fitted again to every moment, starting from the moment's pose. The body's thickness relative to an average adult
/// is kept. Silhouettes alone suffice for this, because the calibrated cameras give the scale in metres. `body` must be
/// `MakeSilhouetteBody(AdultLengths(stature_m))`, with any thickness.
double FitStature(const SilhouetteBody& body, double stature_m, std::span<const PosedViews> moments,
                  const FitOptions& options);

/// Returns the joints that keypoints show. A keypoint of confidence 1 has the standard deviation `sigma_px`; at a lower
/// confidence, its variance is sigma_px² divided by the confidence. Nose, eyes, ears and the top of the head are left
/// out, because they are not joints of the body.
std::vector<SeenJoint> SeenJointsOf(const SeenPerson& person, double sigma_px);

/// Films of one person by stationary cameras.
struct UnmarkedTake {
  /// The longer side, in pixels, of the pictures for which the default options are tuned; the person fills half of it.
  static constexpr int kPictureSide = 480;
  /// Pinhole cameras, at least two; each camera's lens is given in pixels of the camera's pictures. Y of the world
  /// points up.
  std::span<const Camera> cameras;
  /// `pictures[camera][frame]`, taken at the same times by all cameras.
  std::span<const std::vector<ColourImage>> pictures;
  /// The empty room in each camera's picture; if there are none, rooms are estimated from the pictures.
  std::span<const ColourImage> rooms;
  /// `masks[camera][frame]`: the person in each picture, at the cameras' picture sizes, from any segmenter. With masks,
  /// `pictures` and `rooms` are not used and may be empty. Without masks, the person is found in `pictures`.
  std::span<const std::vector<Mask>> masks = {};
  double rate_hz = 30;
  /// The person's stature, metres; if absent, it is estimated from the pictures.
  std::optional<double> stature_m;
  /// The person's limb lengths, which then also determine the stature; if absent, an adult's.
  std::optional<LimbLengths> lengths = {};
  /// `people[camera][frame]`: the keypoints of an estimator, in pixels of the pictures; nullopt where the estimator
  /// does not see the person. Empty: there are no keypoints.
  std::span<const std::vector<std::optional<SeenPerson>>> people = {};
};

struct UnmarkedOptions {
  /// The options of the person finder. Minimum sizes of regions are smaller than the finder's own defaults, which suit
  /// pictures of 640 × 480.
  PersonOptions person = {.segmenter = Segmenter::kRatio,
                          .change = {},
                          .pieces = PersonPieces::kLarge,
                          .min_piece_px = 60,
                          .piece_reach = 30};
  TrackOptions track;
  /// The number of times that rooms are estimated. Each estimate after the first leaves out pixels near the body, which
  /// was tracked with the previous estimate as background. In the one film that was tried, a fourth estimate was still
  /// slightly better than the third.
  int rounds = 4;
  /// The number of pictures from each camera, evenly spaced over the film, in which the body is tracked and from which
  /// rooms are estimated. More pictures take longer, and improve a short film little.
  std::size_t samples = 50;
  /// A pixel of the room is the median over this number of pictures, those with the least motion at the pixel. Keep it
  /// small: a pixel of the room may be visible only for a moment.
  std::size_t kept = 5;
  /// A picture's pixels at most this many pixels away from the body may show the body's shadow or rim, and are left out
  /// of estimates of the room.
  double body_reach_px = 8;
  /// The standard deviation of the distance between a keypoint of confidence 1 and the true joint, pixels.
  double keypoint_px = 3;
};

/// The recovered motion.
struct UnmarkedMotion {
  Clip clip;          ///< the motion on the person's own skeleton, metres
  BodyMotion motion;  ///< the same motion as twenty joints
  double stature_m = 0;
  std::size_t held = 0;  ///< number of frames that repeat the last pose, because fewer than two pictures show a person
  /// The mean of `SilhouetteFit::picture_cost` over cameras and tracked frames.
  double cost = 0;
  std::vector<ColourImage> rooms;              ///< the empty room of each camera
  std::vector<std::vector<Mask>> silhouettes;  ///< [camera][frame]: the mask of the person
  /// For each camera and frame, 1 − intersection over union of the projected body and the silhouette; nullopt if body
  /// or silhouette has no pixels.
  std::vector<std::vector<std::optional<double>>> apart;
};

/// Recovers a person's motion from silhouettes (engine/silhouettes) *(ours)*; the method needs no marks, no keypoints
/// and no picture of the empty room. The room is first estimated from pixels with little motion. The body tracked in
/// front of that estimate shows where and when the room is visible, which improves the next estimate. Fails if no frame
/// shows a person to two cameras.
Result<UnmarkedMotion> RecoverUnmarked(const UnmarkedTake& take, const UnmarkedOptions& options = {});

}  // namespace etude
