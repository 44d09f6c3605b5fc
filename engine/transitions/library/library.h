#pragma once

#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/bridge_frames/bridge_frames.h"
#include "engine/transitions/in_betweens/in_between_net.h"
#include "engine/transitions/library/body_proportions.h"
#include "engine/transitions/library/motion_features.h"

namespace etude {

/// Clips made ready for transitions: all performed by one body, at 30 Hz, tagged, and joined by in-betweens.
struct MotionLibrary {
  BodyProportions proportions;
  std::vector<std::string> names;
  std::vector<BodyMotion> motions;
  std::vector<TaggedClip> tagged;                     ///< as `motions`, frame by frame
  std::vector<std::vector<MotionFeatures>> features;  ///< as `motions`, frame by frame
  InBetweenNet in_betweens;
};

/// Makes a library of motions that one body performs already, at 30 Hz: tags them by `rules`, and builds in-betweens
/// that move by `tween`.
MotionLibrary MakeLibraryOfOneBody(std::vector<std::string> names, std::vector<BodyMotion> motions,
                                   const BodyProportions& proportions, const TagRules& rules = {},
                                   const TweenRules& tween = {});

/// Makes a library of clips as they came: has them performed by one body, and goes on as MakeLibraryOfOneBody.
MotionLibrary MakeLibrary(std::vector<std::string> names, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions, const TagRules& rules = {}, const TweenRules& tween = {});

}  // namespace etude
