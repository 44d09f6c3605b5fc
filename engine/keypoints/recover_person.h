#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/keypoints/mend_people.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Makes the body of a person whose bones are so long, metres, each from the parent of a role to the role; the head is
/// a joint of its clip. Fails for a bone without a length.
Result<CaptureBody> BodyOfBones(const std::array<double, kRoleCount>& lengths);

/// Estimates a person's body: every bone between two joints as long as it is in the median of the frames that show
/// both, left and right by themselves; the spine at `kSpineShare` of the trunk (`BodyOfBones`). Fails, naming the
/// joint, when no frame shows some bone.
Result<CaptureBody> MedianBody(std::span<const LandmarkPlaces> frames);

/// Finds the angles and the root's place in every frame that bring all joints of the body nearest to where landmarks
/// say they are (`JointsOf`): Σ weight · |place − joint|² is least, at least locally. Joints that a frame lacks hang as
/// they did in the frame before, and weigh a hundredth; the spine, which no landmark shows, lies on the line from hips
/// to shoulders and weighs one, since else the trunk would bend any way where it is seen shorter. Nothing for frames
/// that tell of fewer than eight joints. *(Ours.)*
std::vector<std::optional<TreeState>> FitPerson(const CaptureBody& body, std::span<const LandmarkPlaces> frames);

struct RecoverPersonOptions {
  double rate_hz = 30;
  MatchOptions match;
  TriangulateOptions triangulate;
  std::size_t person = 0;       ///< which of those found, the one seen most first
  double longest_gap_s = 0.5;   ///< longer ones are not bridged
  double cutoff_hz = 0;         ///< places are smoothed below this; 0: not at all
  bool mends = false;           ///< MendPerson, and `triangulate.robust.outlier_px` becomes the most of OutlierLimit
  double least_outlier_px = 0;  ///< … and this its least
};

/// Returns the options for pictures whose longer side has so many pixels: outliers are 3 % of it off, and somebody who
/// was not seen for half a second is somebody new.
RecoverPersonOptions UsualRecovery(double rate_hz, double longer_side_px);

/// A person recovered from several cameras' keypoints.
struct RecoveredPerson {
  std::vector<MatchedPerson> people;      ///< everybody that was found
  std::vector<LandmarkPlaces> landmarks;  ///< of the person asked for, bridged and smoothed
  TriangulationReport report;
  std::vector<Mend> mends;  ///< of the person asked for
  double outlier_px = 0;    ///< the limit that was used
  CaptureBody body;
  std::vector<TreeState> states;  ///< of the body, one per frame
  Clip clip;                      ///< metres, Y up
  BodyMotion motion;              ///< the same as twenty joints
  std::vector<bool> is_held;      ///< the frames of which nothing could be recovered: they show the last pose
};

/// Removes the lens's distortion from keypoints in the camera's own pixels.
SeenPeople UndistortPeople(const Camera& camera, SeenPeople people);

/// Finds everybody and the points of the person asked for: MatchPeople, (MendPerson,) TriangulatePerson. Fails when
/// nobody is seen by two cameras, or there are not so many people.
/// @param cameras at least two, without their lenses, as are the pixels (`UndistortPeople`)
/// @param people of each camera, as many frames, taken at the same times (else `EstimateOffsets`, `PeopleInTime`)
Result<RecoveredPerson> LocatePerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                     const RecoverPersonOptions& options);

/// Recovers the motion of a person whose landmarks are known: BridgePoints, SmoothPoints, then the person's own body
/// (MedianBody) and its poses (FitPerson). Fails when some limb never was seen.
Result<RecoveredPerson> FitLocated(RecoveredPerson person, const RecoverPersonOptions& options);

/// Makes clip and poses anew of the body and its states.
void ShowStates(RecoveredPerson& person);

/// Recovers the motion of one person from the keypoints of everybody: LocatePerson, FitLocated.
Result<RecoveredPerson> RecoverPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options);

}  // namespace etude
