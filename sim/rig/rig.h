#pragma once

#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// The arrangement of the cameras about the performer.
enum class RigShape {
  kAngles,   ///< "angles": at the angles and heights that are given
  kStereo,   ///< "stereo": a pair side by side in front, both axes parallel
  kRing,     ///< "ring": evenly about the performer, the first one in front
  kCorners,  ///< "corners": four, in the corners of a square about the performer
  kFile,     ///< "file": somebody's own, as they were calibrated
};

struct RigOptions {
  RigShape shape = RigShape::kAngles;
  /// The angles about the performer for kAngles, degrees; 0 = in front, positive = to the performer's left.
  std::vector<double> angles_deg = {-40, 40};
  /// The heights of the cameras, metres: one per angle for kAngles, else taken in turn. Cameras at one height cannot
  /// tell the direction of a limb parallel to the line between them, and a performer who faces two has hips, shoulders
  /// and stretched arms there: so heights differ.
  std::vector<double> heights_m = {1.0, 2.2};
  double distance_m = 3.8;       ///< from the middle of where the performer moves, as far as the room allows
  double baseline_m = 0.6;       ///< kStereo: between the two
  int cameras = 4;               ///< kRing: how many
  std::vector<Camera> own = {};  ///< kFile: metres, Y up
};

constexpr std::size_t kMostCameras = 8;

/// Sets up the cameras of a studio as people do by hand for a take: fitted to the room (none stands in or behind its
/// back wall) and to the motion. They look at the middle of where the performer moves; a camera that would lose a part
/// of the performer takes a wider lens, to 94° (half of the usual focal length), and what leaves the picture then is
/// out of view. Nobody sets up a tripod to the centimetre: every camera has dice of its own. A rig of one's own is
/// moved along the floor as a whole, its cameras' common middle to that of the motion, and left as it is otherwise.
/// @param motion at least one pose, metres, Y up
std::vector<Camera> SetUpCameras(const RigOptions& options, std::span<const BodyPose> motion, const WorldKey& key);

/// Returns the middle of the box around all joints of a motion, on the floor.
glm::dvec3 MiddleOnFloor(std::span<const BodyPose> motion);

/// Tells whether the camera's picture shows all twenty joints, as far as nothing stands before them.
bool IsInPicture(const Camera& camera, const BodyPose& pose);

/// Tells for each frame whether at least two cameras have the whole body in their pictures; otherwise nothing can be
/// measured.
std::vector<bool> FramesInView(std::span<const Camera> cameras, std::span<const BodyPose> motion);

}  // namespace etude
