#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/follow_people.h"
#include "engine/keypoints/people.h"

namespace etude {

struct MatchOptions {
  FollowOptions follow;
  /// Two cameras see the same person when the rays of the same keypoints miss each other by less than this share of
  /// the person's height, in the pictures, median over time: estimators are off by 1–2 % of it, other people by
  /// 10 % and more *(ours)*.
  double largest_error = 0.06;
};

/// One person, as all cameras saw it.
struct MatchedPerson {
  /// `seen[camera][frame]`
  std::vector<std::vector<std::optional<SeenPerson>>> seen;
  double error = 0;      ///< what `largest_error` bounds; 0 where one camera alone saw the person
  double sightings = 0;  ///< sum of the confidences of all keypoints, over cameras and frames
  std::size_t cameras = 0;
};

/// Who is who, over cameras and time *(ours)*. The tracks of each camera's people (`FollowPeople`) are joined over the
/// cameras, those first whose rays meet best; tracks of one camera that run at the same time are never one person. No
/// dice: ties go to the track that began first. Persons come by `sightings`, the one seen most first.
/// @param cameras without their lenses, as are the pixels
/// @param people of each camera, all of as many frames
std::vector<MatchedPerson> MatchPeople(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                       const MatchOptions& options = {});

}  // namespace etude
