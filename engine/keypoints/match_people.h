#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/people.h"

namespace etude {

struct FollowOptions {
  /// The largest distance that a person moves in the picture from one frame to the next, as a share of the person's
  /// height in the picture. A film at 30 Hz of somebody who runs across a small picture may need a larger value.
  double max_step = 0.25;
  /// A person who was absent for at most this number of frames continues the same track.
  int max_absence = 15;
  /// A person who was absent for at most this number of frames and returns to the same place also does, unless another
  /// track continues there. Somebody who returns later begins a new track until other cameras identify the person.
  int max_return = 90;
  double min_confidence = 0.1;  ///< keypoints of lower confidence are ignored
};

/// A person tracked through frames of one camera, as indices into `people[frame]`.
struct PersonTrack {
  std::map<std::size_t, std::size_t> entries;  ///< index of the person, by frame; at least one entry

  std::size_t first() const { return entries.begin()->first; }
  std::size_t last() const { return entries.rbegin()->first; }
};

/// Tracks the people of one camera from frame to frame by the positions of their keypoints. If two candidates are
/// nearly equally near, a new track begins for each. Everybody is in exactly one track; tracks are ordered by their
/// first frame.
std::vector<PersonTrack> FollowPeople(const SeenPeople& people, const FollowOptions& options = {});

struct MatchOptions {
  FollowOptions follow;
  /// The largest error of a match: the distance by which the two rays of a keypoint miss each other, as a share of
  /// the person's height in the pictures, median over frames and keypoints. It is 1–2 % for one person, because
  /// estimators are inaccurate, and 10 % or more for two different people *(ours)*.
  double max_error = 0.06;
  /// True if left and right may be exchanged in a camera: tracks that do not match are then also compared with sides
  /// swapped.
  bool may_be_swapped = false;
};

/// One person as seen by all cameras.
struct MatchedPerson {
  /// The person's keypoints, `seen[camera][frame]`; nullopt where a camera does not show the person.
  std::vector<std::vector<std::optional<SeenPerson>>> seen;
  double error = 0;      ///< the quantity that `max_error` limits; 0 if only one camera saw the person
  double sightings = 0;  ///< sum of the confidences of all keypoints, over cameras and frames
  std::size_t cameras = 0;
};

/// Identifies people over cameras and time *(ours)*. The tracks of different cameras (`FollowPeople`) are joined in
/// ascending order of the distance between their rays; two tracks of one camera that overlap in time are never one
/// person. The result is deterministic: ties go to the earlier camera, then to the track that began first. Persons
/// are ordered by `sightings`, descending.
/// @param cameras the cameras of the rig, without lens distortion; all pixels must be undistorted
/// @param people the people of each camera, all with the same number of frames
std::vector<MatchedPerson> MatchPeople(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                       const MatchOptions& options = {});

}  // namespace etude
