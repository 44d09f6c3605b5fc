#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <span>
#include <string>
#include <vector>

#include "engine/keypoints/people.h"

namespace etude::engine {

struct CaptureOptions {
  double rate_hz = 30;
  int person = 0;        ///< index among the people seen by two cameras or more; person 0 has the most sightings
  double smooth_hz = 0;  ///< cut-off frequency of the low-pass filter on the landmarks, Hz; 0: no smoothing
};

struct CapturedMotion {
  BodyMotion motion;
  /// The motion as the text of a BVH file: joint rotations of the person's own skeleton, lengths in metres.
  std::string bvh;
  std::vector<bool> is_held;  ///< for each frame: true if no pose could be recovered, so the last pose is repeated
  double residual_px = 0;     ///< median reprojection error of the triangulated keypoints
};

/// Recovers a person's motion from keypoints of two or more synchronised cameras. It identifies people over time and
/// across cameras, leaves out contradictory keypoints, fills gaps, and fits the person's own skeleton. Throws BadInput
/// for options or keypoints out of range, if the cameras' numbers of frames differ, and if no person is seen by two
/// cameras.
/// @param seen the keypoints of each camera, all with the same number of frames; FindKeypointLayout returns the order
/// in which an estimator lists landmarks
ETUDE_API CapturedMotion Capture(std::span<const NamedCamera> cameras, std::span<const SeenPeople> seen,
                                 const CaptureOptions& options = {});

}  // namespace etude::engine
