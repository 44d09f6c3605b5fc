#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "engine/streams/recording.h"

namespace etude {

/// How a recording's space lies to the world, in which Y points up and the floor is at 0. Left alone: X, Z.
struct StreamLevel {
  enum class By { kNothing, kFeet, kTrunk };

  glm::dmat3 R_WF{1};       ///< rotates the file's directions into the world; about a horizontal axis only
  double floor_m = 0;       ///< height of the floor after that rotation
  double tilt_deg = 0;      ///< of that rotation
  By up_by = By::kNothing;  ///< what told where up is

  glm::dvec3 Apply(const glm::dvec3& place) const { return R_WF * place - glm::dvec3(0, floor_m, 0); }
};

/// Finds gravity and floor from the body alone, because few files tell how their sensor was tilted (ours). Up is the
/// normal of the plane under feet that stand, where they stood far enough apart to tell it (the deviation 10 cm both
/// ways, 3 cm off the plane at most, and within 15° of the trunk's); else the trunk's middle direction, which takes a
/// constant lean for a tilt. Neither: within 30° of the file's own up, or nothing is rotated. The floor is where the
/// lower foot mostly is: its 10th percentile. `rate_hz` > 0, of the frames.
StreamLevel EstimateLevel(std::span<const RecordedFrame> frames, double rate_hz);

/// "level by trunk: turned by 6.3 degrees, floor 0.83 m below".
std::string Describe(const StreamLevel& level);

}  // namespace etude
