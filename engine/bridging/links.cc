#include "engine/bridging/links.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace etude {
namespace {

struct Halves {
  std::span<const int> front, rear;
};

Halves SplitTargets(const TaggedClip& next) {
  const std::vector<int>& frames = next.bridge_frames;
  const auto middle = std::lower_bound(frames.begin(), frames.end(), next.FrameCount() / 2);
  const auto end = std::lower_bound(frames.begin(), frames.end(), next.FrameCount() - 1);
  const auto split = std::min(middle, end);
  return {{frames.begin(), split}, {split, end}};
}

Link MakeLink(const TaggedClip& playing, int from, const TaggedClip& next, int to, const SwitchRules& rules) {
  return {from, to, ComputeDistance(playing.grades[from], next.grades[to], rules.weights)};
}

LinkSearch FindFirst(const TaggedClip& playing, FrameWindow window, const TaggedClip& next, const SwitchRules& rules) {
  LinkSearch search;
  const Halves halves = SplitTargets(next);
  for (int from : playing.bridge_frames) {
    if (!window.Contains(from)) continue;
    for (std::span<const int> half : {halves.front, halves.rear}) {
      for (int to : half) {
        ++search.pairs_seen;
        if (!Matches(playing, from, next, to, rules)) continue;
        search.link = MakeLink(playing, from, next, to, rules);
        return search;
      }
    }
  }
  return search;
}

LinkSearch FindSmallest(const TaggedClip& playing, FrameWindow window, const TaggedClip& next,
                        const SwitchRules& rules) {
  LinkSearch search;
  const Halves halves = SplitTargets(next);
  for (std::span<const int> half : {halves.front, halves.rear}) {
    for (int from : playing.bridge_frames) {
      if (!window.Contains(from)) continue;
      for (int to : half) {
        ++search.pairs_seen;
        if (!Matches(playing, from, next, to, rules)) continue;
        const Link link = MakeLink(playing, from, next, to, rules);
        if (!search.link || link.distance.value < search.link->distance.value) search.link = link;
      }
    }
    if (search.link) return search;
  }
  return search;
}

}  // namespace

FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s) {
  const int wait = static_cast<int>(std::floor(budget_s * playing.rate_hz));
  return {request, std::min(request + wait, playing.FrameCount() - 1)};
}

bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const SwitchRules& rules) {
  if (rules.within_class && a.tags[frame_a] != b.tags[frame_b]) return false;
  return IsCloser(a.grades[frame_a], b.grades[frame_b], rules.weights, rules.threshold);
}

LinkSearch FindLink(const TaggedClip& playing, FrameWindow window, const TaggedClip& next, const SwitchRules& rules) {
  return rules.pick == Pick::kFirst ? FindFirst(playing, window, next, rules)
                                    : FindSmallest(playing, window, next, rules);
}

}  // namespace etude
