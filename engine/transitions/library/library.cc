#include "engine/transitions/library/library.h"

#include <utility>

namespace etude {

MotionLibrary MakeLibraryOfOneBody(std::vector<std::string> names, std::vector<BodyMotion> motions,
                                   const BodyProportions& proportions, const TagRules& rules, const TweenRules& tween) {
  MotionLibrary library{.proportions = proportions,
                        .names = std::move(names),
                        .motions = std::move(motions),
                        .tagged = {},
                        .features = {},
                        .in_betweens = {}};
  library.tagged = TagClips(library.motions, proportions.standing_hip_height, rules);
  library.features = ComputeMotionFeatures(library.motions);
  library.in_betweens =
      BuildInBetweens(library.tagged, {.weights = rules.weights, .threshold = kPaperThreshold, .tween = tween});
  return library;
}

MotionLibrary MakeLibrary(std::vector<std::string> names, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions, const TagRules& rules, const TweenRules& tween) {
  return MakeLibraryOfOneBody(std::move(names), PerformedBy(proportions, clips), proportions, rules, tween);
}

}  // namespace etude
