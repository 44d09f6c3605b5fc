#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/correct_people.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// Adds a joint named "head" to the skeleton of the body's clips: readers of clips look for one, and in BVH the end of
/// a branch has no name.
void NameHead(CaptureBody& body);

/// Makes the body of a person from bone lengths, metres: for each role, the distance from its parent role. The clip's
/// skeleton has a joint named head. Fails if a bone has no length.
Result<CaptureBody> BodyOfBones(const std::array<double, kRoleCount>& lengths);

/// Estimates a person's body: every bone has its median length over the frames that show both of its joints, left and
/// right separately; the spine is at `kSpineShare` of the trunk (`BodyOfBones`). Fails if a bone is shown in no frame;
/// the error names the joint.
Result<CaptureBody> MedianBody(std::span<const LandmarkPositions> frames);

/// Finds, in every frame, the angles and the root's position that minimise Σ weight · |position − joint|², at least
/// locally, over the joints that landmarks determine (`JointsOf`). For a joint that a frame lacks, the target has
/// weight 0.01: it lies at the offset from a neighbouring joint that the fitted pose of the frame before has, turned
/// by the change of the heading (`CompleteJoints`). No landmark shows the spine, so its target lies on the line from
/// hips to shoulders. This target has weight 1, because otherwise a trunk that appears too short could bend in any
/// direction. Returns nullopt for frames with fewer than eight joints. *(Ours.)*
std::vector<std::optional<TreeState>> FitPerson(const CaptureBody& body, std::span<const LandmarkPositions> frames);

struct RecoverPersonOptions {
  double rate_hz = 30;
  MatchOptions match;
  TriangulateOptions triangulate;
  /// Index among the people seen by two cameras or more, in descending order of `sightings`.
  std::size_t person = 0;
  double max_gap_s = 0.5;  ///< maximum length of gaps that are filled
  double cutoff_hz = 0;    ///< cutoff of the low-pass filter of positions; 0 turns it off
  /// If true, CorrectPerson is run, and `triangulate.robust.outlier_px` is the upper limit of OutlierLimit.
  bool corrects = false;
  double min_outlier_px = 0;  ///< lower limit of OutlierLimit, pixels
};

/// Returns the options for pictures whose longer side is `longer_side_px`. A keypoint is an outlier if it is farther
/// than 3 % of that side from the projection of its triangulated point. Somebody who was not seen for half a second
/// is a new person.
RecoverPersonOptions DefaultRecovery(double rate_hz, double longer_side_px);

/// A person recovered from several cameras' keypoints.
struct RecoveredPerson {
  std::vector<MatchedPerson> people;  ///< all people that were found
  /// Positions of the requested person's landmarks. `FitLocated` fills their gaps and smooths them.
  std::vector<LandmarkPositions> landmarks;
  TriangulationReport report;
  std::vector<PersonCorrection> corrections;  ///< corrections of the requested person's keypoints
  double outlier_px = 0;    ///< the threshold for outliers that was used, pixels
  CaptureBody body;
  std::vector<TreeState> states;  ///< poses of the body, one per frame
  Clip clip;                      ///< the motion as a clip, metres, Y up
  BodyMotion motion;              ///< the motion of `clip` as twenty joints
  std::vector<bool> is_held;      ///< true for frames that were not recovered and repeat the last (or the first) pose
};

/// Removes the lens distortion from keypoints in the camera's own pixels.
SeenPeople UndistortPeople(const Camera& camera, SeenPeople people);

/// Finds all people and triangulates the requested one: MatchPeople, optionally CorrectPerson, TriangulatePerson. Fails
/// if nobody is seen by two cameras, or if there are fewer people than the requested index.
/// @param cameras at least two, without lens distortion; all pixels must be undistorted (`UndistortPeople`)
/// @param people the people of each camera, all with the same number of frames, taken at the same times (otherwise use
/// `EstimateOffsets`, `PeopleInTime` first)
Result<RecoveredPerson> LocatePerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                     const RecoverPersonOptions& options);

/// Recovers the motion of a person whose landmarks are known: InterpolatePoints, SmoothPoints, then the person's own
/// body (MedianBody) and its poses (FitPerson). Fails if no frame shows the length of some bone, or if no frame shows
/// enough joints.
Result<RecoveredPerson> FitLocated(RecoveredPerson person, const RecoverPersonOptions& options);

/// Computes the clip and the motion of `person` from its body and states.
void ShowStates(RecoveredPerson& person);

/// Recovers the motion of one person from the keypoints of all: LocatePerson, then FitLocated.
Result<RecoveredPerson> RecoverPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options);

}  // namespace etude
