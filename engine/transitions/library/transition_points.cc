#include "engine/transitions/library/transition_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

namespace etude {

FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s) {
  constexpr double kRounding = 1e-9;  // tolerance; 4.1 · 30 is rounded below 123, but 4.1 s are 123 frames
  const int wait = static_cast<int>(std::floor(budget_s * playing.rate_hz + kRounding));
  return {request, std::min(request + wait, playing.FrameCount() - 1)};
}

FrameWindow EntryWindow(const TaggedClip& next) { return {0, next.FrameCount() - 2}; }

std::vector<int> FramesWithin(FrameWindow window) {
  std::vector<int> frames(static_cast<std::size_t>(std::max(window.last - window.first + 1, 0)));
  std::iota(frames.begin(), frames.end(), window.first);
  return frames;
}

std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window) {
  std::vector<int> frames;
  std::ranges::copy_if(clip.bridge_frames, std::back_inserter(frames), [&](int f) { return window.Contains(f); });
  return frames;
}

bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const MatchRules& rules) {
  if (rules.within_class && a.tags[frame_a] != b.tags[frame_b]) return false;
  return IsCloser(a.grades[frame_a], b.grades[frame_b], rules.weights, rules.threshold);
}

std::optional<TransitionPoint> FindTransitionPoint(const TaggedClip& playing, FrameWindow window,
                                                   const TaggedClip& next, const MatchRules& rules) {
  // The first match in this order wins. Bridge frames are in ascending order, so the clip's front half is searched
  // first.
  const std::vector<int> entering = BridgeFramesWithin(next, EntryWindow(next));
  const auto rank = [&](const TransitionPoint& point) {
    return std::tuple(!next.InFrontHalf(point.to), point.distance.value);
  };
  std::optional<TransitionPoint> best;
  for (int from : BridgeFramesWithin(playing, window)) {
    for (int to : entering) {
      if (!Matches(playing, from, next, to, rules)) continue;
      const TransitionPoint point{from, to, ComputeDistance(playing.grades[from], next.grades[to], rules.weights)};
      if (rules.pick == Pick::kFirst) return point;
      if (!best || rank(point) < rank(*best)) best = point;
    }
  }
  return best;
}

}  // namespace etude
