#pragma once

#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"

namespace etude {

struct TaggedClip;

/// How often a frame's pose occurs in a library, and how well the frame stands for it (paper A, section 3.4: bridge
/// frames are frequent poses, "those of smallest difference").
struct FrameRating {
  int clips = 0;   ///< in how many clips the frame's ten tags occur together, its own included
  int frames = 0;  ///< in how many frames of the library
  /// Root mean square of the distances to the frames of the same tags in other clips (equation 1): what a transition
  /// within the class would cost. 0 when no other clip has them.
  double difference = 0;
};

/// Rates every frame of every clip, `[clip][frame]`; uses tags and grades only.
std::vector<std::vector<FrameRating>> RateFrames(std::span<const TaggedClip> clips, const FeatureWeights& weights);

}  // namespace etude
