#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// The ways in which lengths and directions of a rig are to be taken.
struct PlaceOptions {
  /// "auto", a name of RigUnits(), or metres in one unit of the file.
  std::string unit = "auto";
  /// "auto", an axis of the file that points up ("z", "-y"), or "floor": square to the plane that the feet stand on.
  std::string up = "auto";
  /// The floor becomes height 0: "auto" (at the feet where the up axis was found from them, else as the file has it),
  /// "keep", "feet", or its height in metres.
  std::string floor = "auto";
};

/// Returns "m, cm, mm, inch, foot".
std::string RigUnits();

/// Fails for texts of `options` that mean nothing.
Result<void> CheckPlace(const PlaceOptions& options);

/// The findings about a rig's world, and the way into ours: p' = scale · R · p + shift.
struct RigPlace {
  double scale = 1;
  glm::dmat3 R{1};
  glm::dvec3 shift{0};
  double stature_m = 0;  ///< of the person, as its legs and trunk tell; 0: nothing was asked of a person
  std::string told;      ///< what was taken and why, for people: "lengths in mm (…), up is -y (…)"

  glm::dvec3 operator()(const glm::dvec3& p) const { return scale * (R * p) + shift; }
  bool IsNone() const { return scale == 1 && R == glm::dmat3(1) && shift == glm::dvec3(0); }
};

/// Finds unit and up axis of a rig from a person that it shows *(ours)*. The stature is 2.0 times a leg (hip, knee,
/// ankle, medians over frames). As the format has it, a unit stays where that gives 0.5 to 2.2 m; else metres,
/// centimetres and millimetres are tried, then inches and feet, which must give 1.2 to 2.2 m. Up stays where the
/// format's axis is within 35° of the person's own mean (ankles to shoulders) and the world is no camera's frame; else
/// it is square to the plane of resting feet (ankles, heels, toes each in a plane of its own), as far as these tell,
/// and along the person where they do not; an axis of the file within 4° of it is taken exactly. Fails where no unit
/// makes it a person, naming the factor that would, for lengths without a unit, and for a person that is upside down in
/// the axes that were asked for.
/// @param points of the person, triangulated by the rig as its file has it
Result<RigPlace> PlaceRig(const RigFile& rig, std::span<const LandmarkPlaces> points, double rate_hz,
                          const PlaceOptions& options);

/// Places a rig without a person: what `options` say, and the format's own where they say "auto". Fails for lengths
/// without a unit, and for a world that is a camera's frame without its up axis, naming the options.
Result<RigPlace> PlaceRig(const RigFile& rig, const PlaceOptions& options);

/// Moves a camera into the placed world.
Camera Placed(const RigPlace& place, Camera camera);

}  // namespace etude
