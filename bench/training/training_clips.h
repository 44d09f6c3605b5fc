#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/features.h"
#include "engine/transitions/library/body_proportions.h"

namespace etude {

/// A frame to learn from. Its grades are left open, because membership functions may be what is learnt.
struct TrainingFrame {
  BodyPose pose;
  PoseFeatures features;
};

/// Clips to learn from, performed by one body. What is learnt for a transition never saw the two clips that it is
/// judged by.
struct TrainingClips {
  std::vector<std::string> identities;             ///< equal for equal dances: "builtin:clap", or the file
  std::vector<std::vector<TrainingFrame>> frames;  ///< of each clip, sampled evenly
};

/// Frames taken of a clip, in the middles of as many equal parts, so that long clips count no more than short ones;
/// all frames of a shorter clip.
constexpr int kFramesPerClip = 16;

/// Samples clips as they came, retargeted to `proportions`.
TrainingClips SampleClips(std::vector<std::string> identities, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions);

/// Pairs grow with the square of the clips: more would make learning slow, and teach little.
constexpr std::size_t kMostTrainingClips = 40;

/// Every built-in move, and those of `clips` that are none, by their identities; all retargeted to `proportions`. Of
/// more than kMostTrainingClips, evenly chosen ones.
Result<TrainingClips> GatherTrainingClips(std::span<const BodyMotion> clips, const std::vector<std::string>& identities,
                                          const BodyProportions& proportions);

}  // namespace etude
