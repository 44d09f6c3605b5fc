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

/// Returns the limb lengths of an adult of that stature, metres: those of `LimbLengths{}`, whose stature is 1.74, all
/// scaled alike.
LimbLengths AdultLengths(double stature_m);

/// The views of one moment of a take and the pose that was found in them.
struct PosedViews {
  std::span<const SilhouetteView> views;
  TreeState state;
};

/// Finds the stature that costs least *(ours)*: of adults who stand as these moments say, 6 % smaller to 6 % larger
/// than `stature_m`, each fitted anew from there, as thick as `body` is beside an average adult of `stature_m`. A
/// silhouette tells it because cameras tell metres. `body` is `MakeSilhouetteBody(AdultLengths(stature_m))` with any
/// thickness.
double FitStature(const SilhouetteBody& body, double stature_m, std::span<const PosedViews> moments,
                  const FitOptions& options);

/// Returns the joints that keypoints tell, limb by limb; of a confidence of one they are as exact as `sigma_px`, of a
/// lower one less: its variance is divided by it. Nose, eyes, ears and the top of the head are no joints of the body.
std::vector<SeenJoint> SeenJointsOf(const SeenPerson& person, double sigma_px);

/// Films of one person by cameras that stand still.
struct UnmarkedTake {
  /// The longer side, in pixels, of the pictures that the default options are made for, with a person who fills half of
  /// it.
  static constexpr int kPictureSide = 480;
  /// Pinholes, two at least, each in the pixels of its pictures; their world's Y points up.
  std::span<const Camera> cameras;
  /// `pictures[camera][frame]`, taken at the same moments.
  std::span<const std::vector<ColourImage>> pictures;
  /// The empty room as each camera sees it; when there is none at all, it is estimated from the pictures.
  std::span<const ColourImage> rooms;
  double rate_hz = 30;
  /// The person's stature, metres; without one it is found from the pictures.
  std::optional<double> stature_m;
  /// The person's limb lengths, which then tell the stature, too; without them an adult's.
  std::optional<LimbLengths> lengths = {};
  /// `people[camera][frame]`: the person as an estimator of keypoints sees it, in pixels of the pictures; nothing where
  /// it does not. Empty: there is no estimator.
  std::span<const std::vector<std::optional<SeenPerson>>> people = {};
};

struct UnmarkedOptions {
  /// The options of finding the person; pieces are smaller here than in pictures of 640 × 480.
  PersonOptions person = {.segmenter = Segmenter::kRatio,
                          .change = {},
                          .pieces = PersonPieces::kLarge,
                          .smallest_piece = 60,
                          .piece_reach = 30};
  TrackOptions track;
  /// The number of times that rooms are estimated, each time from the body that was found with the ones before. On the
  /// one film it was tried on a fourth time still bettered them a little.
  int rounds = 4;
  /// The number of pictures of a camera, evenly over the film, from which rooms are estimated and in which the body is
  /// followed for that. More take longer; a film of a few seconds shows little new in between.
  std::size_t samples = 50;
  /// The number of these pictures whose median a pixel of the room is. Few, because the room may be seen for a moment
  /// only.
  std::size_t kept = 5;
  /// The distance from the body, in pixels, within which a pixel may be its shadow or its rim.
  double body_reach_px = 8;
  /// The standard deviation of a sure keypoint from the joint in the flesh, pixels.
  double keypoint_px = 3;
};

/// The recovered motion.
struct UnmarkedMotion {
  Clip clip;          ///< of the person's own skeleton, metres
  BodyMotion motion;  ///< the same as twenty joints
  double stature_m = 0;
  std::size_t held = 0;  ///< frames in which fewer than two pictures show anybody: they show the last pose
  /// The mean cost of the body by its silhouettes (`SilhouetteFit::picture_cost`), for each camera and frame.
  double cost = 0;
  std::vector<ColourImage> rooms;              ///< of each camera
  std::vector<std::vector<Mask>> silhouettes;  ///< of each camera and frame
  /// The share of what the body or the silhouette covers that only one of them does, of each camera and frame; nothing
  /// where either shows nobody.
  std::vector<std::vector<std::optional<double>>> apart;
};

/// Recovers a person's motion from outlines alone (engine/silhouettes) *(ours)*: no marks, no estimator, no picture of
/// the empty room. The room is first estimated from where little moves; a body followed in front of that tells where
/// the room is uncovered and when, which betters the room, and so on. Fails when no frame shows anybody to two cameras.
Result<UnmarkedMotion> RecoverUnmarked(const UnmarkedTake& take, const UnmarkedOptions& options = {});

}  // namespace etude
