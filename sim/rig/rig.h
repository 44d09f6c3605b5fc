#pragma once

#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// The arrangement of the cameras around the performer.
enum class RigShape {
  kAngles,   ///< "angles": at given angles and heights
  kStereo,   ///< "stereo": a pair side by side in front, with parallel axes
  kRing,     ///< "ring": at equal angles around the performer, the first camera in front
  kCorners,  ///< "corners": four cameras in the corners of a square around the performer
  kFile,     ///< "file": a calibrated rig of the user's own
};

struct RigOptions {
  RigShape shape = RigShape::kAngles;
  /// The angles of the cameras around the performer for kAngles, degrees; 0 = in front, positive = to the performer's
  /// left.
  std::vector<double> angles_deg = {-40, 40};
  /// The heights of the cameras, metres: one per angle for kAngles; for kStereo only the first is used; for kRing and
  /// kCorners the list is repeated over the cameras. The defaults differ, because two cameras at the same height cannot
  /// determine the direction of a limb that is parallel to the line between the cameras: hips, shoulders and stretched
  /// arms of a performer who faces both cameras.
  std::vector<double> heights_m = {1.0, 2.2};
  double distance_m = 3.8;       ///< distance from the middle of the performer's motion; less if the room is too small
  double baseline_m = 0.6;       ///< kStereo: distance between the two cameras
  int cameras = 4;               ///< kRing: number of cameras
  std::vector<Camera> own = {};  ///< kFile: the user's cameras, metres, Y up
};

constexpr std::size_t kMaxCameras = 8;

/// Sets up the cameras of a studio as a crew would do by hand for a take. The cameras are adapted to the room (none is
/// in or behind its back wall) and to the motion: they look at the middle of the performer's motion. A camera that
/// would cut off the performer gets a wider lens, up to 94° (half of the usual focal length); joints that still leave
/// the picture are out of view. Positions and angles have random errors, because nobody places a tripod to the
/// centimetre; every camera has its own random numbers. A user's own rig is only moved along the floor as a whole: the
/// point nearest to the rig's optical axes moves to the middle of the motion.
/// @param motion at least one pose, metres, Y up
std::vector<Camera> SetUpCameras(const RigOptions& options, std::span<const BodyPose> motion, const WorldKey& key);

/// Returns the centre, on the floor, of the bounding box of all joints of a motion.
glm::dvec3 MiddleOnFloor(std::span<const BodyPose> motion);

/// Returns true if all twenty joints project into the camera's picture. Occlusion is ignored.
bool IsInPicture(const Camera& camera, const BodyPose& pose);

/// For each frame, returns true if at least two cameras have the whole body in their pictures. In other frames, the
/// pose cannot be triangulated.
std::vector<bool> FramesInView(std::span<const Camera> cameras, std::span<const BodyPose> motion);

}  // namespace etude
