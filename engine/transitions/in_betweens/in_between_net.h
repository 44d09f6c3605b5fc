#pragma once

#include <span>
#include <vector>

#include "engine/transitions/bridge_frames/bridge_frames.h"
#include "engine/transitions/in_betweens/tween.h"

namespace etude {

/// How the keys of in-betweens are chosen. Ours, as paper A draws its in-between by hand.
struct InBetweenRules {
  FeatureWeights weights = PaperWeights();
  double threshold = kPaperThreshold;  ///< every bridge frame has a key nearer than this
  TweenRules tween;
};

/// Paper A's in-between motion (補間動作, section 3.5, figures 13 and 14): made of bridge frames, so that it can be
/// joined to any two clips. Ours is a star: key poses all over the library, and the tweening from any of them to any
/// other, directly or by way of the hub.
struct InBetweenNet {
  /// A bridge frame that in-betweens are built of.
  struct Key {
    int clip = 0;
    int frame = 0;
  };
  std::vector<Key> keys;  ///< the first is the hub: the most typical frame of the most frequent pose
  TweenRules tween;
};

/// The keys of a library's in-betweens: going from the most frequent poses to the rarest, and in each from the most
/// typical frame on, every bridge frame becomes a key that has none within the threshold. A library without bridge
/// frames gets its keys of all frames. Needs a frame.
InBetweenNet BuildInBetweens(std::span<const TaggedClip> tagged, const InBetweenRules& rules = {});

/// The longest that any in-between takes, seconds: two tweens, in whole frames.
double LongestInBetween(const TweenRules& rules, double rate_hz);

}  // namespace etude
