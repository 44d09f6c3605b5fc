#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "engine/keypoints/people.h"

namespace etude {

struct FollowOptions {
  /// From frame to frame a person moves by less than this share of the own height in the picture. A film at 30 Hz of
  /// somebody who runs across a small picture may need more.
  double longest_step = 0.25;
  /// Somebody who was not seen for longer is somebody new, until other cameras say who it is. Frames.
  int longest_absence = 15;
  double least_confidence = 0.1;  ///< keypoints below are passed over
};

/// A person followed through some frames of one camera: which entry of `people[frame]`.
struct PersonTrack {
  std::map<std::size_t, std::size_t> entries;  ///< of frames; at least one

  std::size_t first() const { return entries.begin()->first; }
  std::size_t last() const { return entries.rbegin()->first; }
};

/// People of one camera followed from frame to frame by where their keypoints are; where two are as near to one, both
/// begin anew. Everybody is in one track; those that began first come first.
std::vector<PersonTrack> FollowPeople(const SeenPeople& people, const FollowOptions& options = {});

}  // namespace etude
