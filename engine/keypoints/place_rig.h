#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// The options for the unit, the up axis and the floor of a rig.
struct PlacementOptions {
  /// "auto", a name of RigUnits(), or the number of metres in one unit of the file.
  std::string unit = "auto";
  /// The direction that points up: "auto", an axis of the file ("z", "-y"), or "floor": found from cameras and feet.
  std::string up = "auto";
  /// The position of the floor, which becomes height 0: "feet", "keep" (as in the file), its height in metres, or
  /// "auto" ("feet" if the feet determined the up axis, otherwise "keep").
  std::string floor = "auto";
};

/// Returns "m, cm, mm, inch, foot".
std::string RigUnits();

/// Fails if a text in `options` is not one of the allowed values.
Result<void> CheckPlace(const PlacementOptions& options);

/// The map from a rig's world to ours: p' = scale · R · p + shift.
struct RigPlacement {
  double scale = 1;
  glm::dmat3 R{1};
  glm::dvec3 shift{0};
  double stature_m = 0;  ///< the person's stature, from the legs, to within 15 %; 0 if no person was used
  std::string told;      ///< explanation for users: "lengths in mm (…), up is -y (…)"
  std::string doubt;     ///< the cameras that lie below the floor, for users; "" if there are none

  glm::dvec3 operator()(const glm::dvec3& p) const { return scale * (R * p) + shift; }
  bool IsNone() const { return scale == 1 && R == glm::dmat3(1) && shift == glm::dvec3(0); }
};

/// Finds the unit and the up axis of a rig from a person in it *(ours)*. The stature is estimated as 2.0 times the
/// length of the leg (hip, knee, ankle; medians over frames). The format's unit is kept if the stature is then 0.5 to
/// 2.2 m; otherwise metres, centimetres and millimetres are tried, then inches and feet, which must give 1.2 to
/// 2.2 m. The format's up axis is kept if it is within 35° of the result of `FindUp` (or within the uncertainty of
/// that result, if larger), the format defines a unit, and the world is not a camera's frame. (For Caliscope, whose
/// axes are those of a calibration board, it must also be within 8° or three standard deviations, whichever is
/// larger.) Otherwise the up axis is the axis of the file within 4° of the result (up to 10° if the result is less
/// accurate), or else the result itself; `told` then states the error that 95 of 100 takes do not exceed.
/// Fails in these cases:
/// - The stature is not plausible in the requested unit or in any unit (the message names a factor that makes it so).
/// - Neither the format nor `options` defines the unit.
/// - The up direction is uncertain by more than 35°.
/// - A requested axis puts cameras and person upside down.
/// - The keypoints do not show hips, knees, ankles and shoulders (the error's place is "keypoints").
/// @param points the points of the person, triangulated with the rig as in its file
Result<RigPlacement> PlaceRig(const RigFile& rig, std::span<const LandmarkPositions> points, double rate_hz,
                              const PlacementOptions& options);

/// Places a rig without a person, by `options` and, for "auto", by the format's conventions. The up axis is found as
/// with a person, but from the cameras alone: another axis than the format's is taken only if most pictures would be
/// tilted, or look up, with the format's. Fails if lengths have no unit, if the format's unit puts the outermost
/// cameras less than 3 cm or more than 100 m apart, if the cameras do not determine the up axis, or if the world is a
/// camera's frame and no up axis is given; the message names the options.
Result<RigPlacement> PlaceRig(const RigFile& rig, const PlacementOptions& options);

/// Returns the camera with its pose in our world, to which `place` maps.
Camera Placed(const RigPlacement& place, Camera camera);

}  // namespace etude
