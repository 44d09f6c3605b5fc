#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

struct RecoverPersonOptions {
  double rate_hz = 30;
  MatchOptions match;
  TriangulateOptions triangulate;
  std::size_t person = 0;      ///< which of those found, the one seen most first
  double longest_gap_s = 0.5;  ///< longer ones are not bridged
  double cutoff_hz = 0;        ///< places are smoothed below this; 0: not at all
};

/// For keypoints in pictures whose longer side has so many pixels: outliers are 3 % of it off, and somebody who was not
/// seen for half a second is somebody new.
RecoverPersonOptions UsualRecovery(double rate_hz, double longer_side_px);

/// A person out of several cameras' keypoints.
struct RecoveredPerson {
  std::vector<MatchedPerson> people;      ///< everybody that was found
  std::vector<LandmarkPlaces> landmarks;  ///< of the person asked for, bridged and smoothed
  TriangulationReport report;
  CaptureBody body;
  Clip clip;                  ///< metres, Y up
  BodyMotion motion;          ///< the same as twenty joints
  std::vector<bool> is_held;  ///< the frames of which nothing could be recovered: they show the last pose
};

/// Keypoints in the rig's own pixels, with what its lenses do, as they would be without.
SeenPeople UndistortPeople(const Camera& camera, SeenPeople people);

/// From the keypoints of everybody to the motion of one person: MatchPeople, TriangulatePerson, BridgePoints,
/// SmoothPoints, then the person's own body (MedianBody) and its poses (FitPerson). Fails when nobody is seen by two
/// cameras, there are not so many people, or some limb never was seen.
/// @param cameras at least two, without their lenses, as are the pixels (`UndistortPeople`)
/// @param people of each camera, as many frames, taken at the same times (else `EstimateOffsets`, `PeopleInTime`)
Result<RecoveredPerson> RecoverPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options);

}  // namespace etude
