#include "engine/transitions/in_betweens/in_between_net.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/transitions/bridge_frames/frame_ratings.h"

namespace etude {
namespace {

using Key = InBetweenNet::Key;

/// What keys may be made of, the most typical of the most frequent pose first.
std::vector<Key> RankForKeys(std::span<const TaggedClip> tagged, const FeatureWeights& weights) {
  const bool has_bridge_frames =
      std::any_of(tagged.begin(), tagged.end(), [](const TaggedClip& clip) { return !clip.bridge_frames.empty(); });
  const std::vector<std::vector<FrameRating>> ratings = RateFrames(tagged, weights);
  std::vector<Key> ranked;
  for (int c = 0; c < static_cast<int>(tagged.size()); ++c) {
    if (has_bridge_frames) {
      for (int frame : tagged[c].bridge_frames) ranked.push_back({c, frame});
    } else {
      for (int frame = 0; frame < tagged[c].FrameCount(); ++frame) ranked.push_back({c, frame});
    }
  }
  const auto rank = [&](const Key& key) {
    const FrameRating& rating = ratings[key.clip][key.frame];
    return std::tuple(-rating.clips, -rating.frames, tagged[key.clip].tags[key.frame], rating.difference);
  };
  std::stable_sort(ranked.begin(), ranked.end(), [&](const Key& a, const Key& b) { return rank(a) < rank(b); });
  return ranked;
}

}  // namespace

InBetweenNet BuildInBetweens(std::span<const TaggedClip> tagged, const InBetweenRules& rules) {
  InBetweenNet net{.keys = {}, .tween = rules.tween};
  std::vector<Grades> taken;  // the keys' own, side by side
  for (const Key& key : RankForKeys(tagged, rules.weights)) {
    const Grades& grades = tagged[key.clip].grades[key.frame];
    const bool is_covered = std::any_of(taken.begin(), taken.end(), [&](const Grades& other) {
      return IsCloser(grades, other, rules.weights, rules.threshold);
    });
    if (is_covered) continue;
    net.keys.push_back(key);
    taken.push_back(grades);
  }
  return net;
}

double LongestInBetween(const TweenRules& rules, double rate_hz) {
  return 2 * std::ceil(LongestTween(rules) * rate_hz) / rate_hz;
}

}  // namespace etude
