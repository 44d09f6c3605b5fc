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
  /// The longest step of a person from frame to frame, as a share of the own height in the picture. A film at 30 Hz of
  /// somebody who runs across a small picture may need more.
  double longest_step = 0.25;
  /// The longest absence in frames after which a person is still the same one; who comes back later is new until other
  /// cameras tell who it is.
  int longest_absence = 15;
  double least_confidence = 0.1;  ///< keypoints below are passed over
};

/// A person followed through some frames of one camera, as indices into `people[frame]`.
struct PersonTrack {
  std::map<std::size_t, std::size_t> entries;  ///< of frames; at least one

  std::size_t first() const { return entries.begin()->first; }
  std::size_t last() const { return entries.rbegin()->first; }
};

/// Follows the people of one camera from frame to frame by the places of their keypoints; where two are as near to one,
/// both begin anew. Everybody is in one track; those that began first come first.
std::vector<PersonTrack> FollowPeople(const SeenPeople& people, const FollowOptions& options = {});

struct MatchOptions {
  FollowOptions follow;
  /// The largest distance by which the rays of the same keypoints of one person miss each other, as a share of the
  /// person's height in the pictures, median over time: estimators are off by 1–2 % of it, other people by 10 % and
  /// more *(ours)*.
  double largest_error = 0.06;
  /// A camera may have exchanged left and right: tracks that do not fit are tried with their sides swapped, too.
  bool may_be_swapped = false;
};

/// One person as all cameras saw it.
struct MatchedPerson {
  /// `seen[camera][frame]`
  std::vector<std::vector<std::optional<SeenPerson>>> seen;
  double error = 0;      ///< what `largest_error` bounds; 0 where one camera alone saw the person
  double sightings = 0;  ///< sum of the confidences of all keypoints, over cameras and frames
  std::size_t cameras = 0;
};

/// Identifies people over cameras and time *(ours)*. The tracks of each camera's people (`FollowPeople`) are joined
/// over the cameras, those first whose rays meet best; tracks of one camera that run at the same time are never one
/// person. No dice: ties go to the track that began first. Persons come by `sightings`, the one seen most first.
/// @param cameras without their lenses, as are the pixels
/// @param people of each camera, all of as many frames
std::vector<MatchedPerson> MatchPeople(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                       const MatchOptions& options = {});

}  // namespace etude
