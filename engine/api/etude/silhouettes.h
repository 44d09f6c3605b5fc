#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <optional>
#include <span>
#include <vector>

#include "engine/silhouettes/silhouette.h"

namespace etude::engine {

struct FollowOptions {
  double stature_m = 1.74;  ///< height of the person, 0.5 to 2.5; the limbs have an adult's average proportions
  /// If given, limb lengths are measured from these poses of the person, and `stature_m` is ignored.
  std::vector<BodyPose> measured = {};
  double rate_hz = 30;  ///< frames per second, 1 to 1000; it limits how far a person can move between two pictures
};

/// Tracks a person through films by silhouettes alone (engine/silhouettes), without marks or keypoints. Returns one
/// pose per frame; nullopt for frames in which fewer than two cameras show a person. The method works best for a person
/// who fills half of the picture's height. Throws BadInput if cameras and masks do not fit each other, if a camera has
/// lens distortion, or if a limb has length zero.
/// @param cameras two or more fixed cameras without lens distortion: undistort the pictures first
/// @param masks one mask per camera and frame; all cameras take a frame at the same moment. A mask has the size of its
/// camera's picture, or is smaller by the same whole factor in both directions. Pixels other than 0 show the person.
ETUDE_API std::vector<std::optional<BodyPose>> TrackSilhouettes(std::span<const NamedCamera> cameras,
                                                                std::span<const std::vector<Mask>> masks,
                                                                const FollowOptions& options = {});

}  // namespace etude::engine
