#pragma once

#include <vector>

#include "engine/bridging/bridge_frames.h"
#include "engine/fuzzy/weights.h"

namespace etude {

/// A clip to learn from: its poses and what the fuzzy side makes of them.
struct TrainingClip {
  const BodyMotion* motion = nullptr;
  const TaggedClip* tagged = nullptr;
};

struct TrainingOptions {
  double close_gap = 0.15;   ///< metres: a pair is "close" when its PoseGap is below
  int frames_per_clip = 16;  ///< evenly spaced, so that long clips count no more than short ones
};

/// Every pair of sampled frames of the two clips, labelled by its true pose gap.
std::vector<LabelledPair> LabelPairs(const TrainingClip& a, const TrainingClip& b, const TrainingOptions& options = {});

}  // namespace etude
