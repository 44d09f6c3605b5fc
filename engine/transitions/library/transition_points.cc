#include "engine/transitions/library/transition_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

#include "engine/transitions/search/frame_matches.h"

namespace etude {

FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s) {
  constexpr double kRounding = 1e-9;  // so that 4.1 s are 123 frames, although 4.1 · 30 is rounded below 123
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
  // The frames are in rising order, so those of the front half come first.
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

namespace {

/// Returns the longest wait for the next of `frames` (in rising order), in seconds, if the clip is repeated at its end.
std::optional<double> WorstWait(std::span<const FrameMatches> frames, const TaggedClip& clip) {
  if (frames.empty()) return std::nullopt;
  int worst = frames.front().frame + clip.FrameCount() - frames.back().frame;
  for (std::size_t i = 1; i < frames.size(); ++i) worst = std::max(worst, frames[i].frame - frames[i - 1].frame);
  return (worst - 1) / clip.rate_hz;
}

/// Returns the number of frames from which none of `frames` is reached within the budget.
int CountLate(std::span<const FrameMatches> frames, const TaggedClip& clip, double budget_s) {
  int late = 0;
  auto next = frames.begin();
  for (int frame = 0; frame < clip.FrameCount(); ++frame) {
    while (next != frames.end() && next->frame < frame) ++next;
    late += next == frames.end() || !WaitWindow(clip, frame, budget_s).Contains(next->frame);
  }
  return late;
}

}  // namespace

Coverage::Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, double budget_s,
                   const OnProgress& on_progress)
    : clip_count_(static_cast<int>(clips.size())), pairs_(clips.size() * clips.size()) {
  // Find the matches of all frames and of the bridge frames.
  std::vector<MatchClip> all_frames, bridge_frames;
  for (const TaggedClip& clip : clips) {
    all_frames.push_back({.grades = clip.grades, .frames = std::nullopt, .tags = clip.tags});
    bridge_frames.push_back({.grades = clip.grades, .frames = clip.bridge_frames, .tags = clip.tags});
  }
  const MatchRules match_rules{
      .weights = rules.weights, .threshold = rules.threshold, .within_class = rules.within_class};
  const auto progress_from = [&](std::size_t first) {
    return [&, first](std::size_t done, std::size_t all) {
      if (on_progress) on_progress(first + done, 2 * all);
    };
  };
  const MatchTable of_all = FindMatches(all_frames, match_rules, nullptr, progress_from(0));
  const MatchTable of_bridges = FindMatches(bridge_frames, match_rules, nullptr, progress_from(clips.size()));
  // Summarise them for every pair of clips.
  for (int from = 0; from < clip_count_; ++from) {
    for (int to = 0; to < clip_count_; ++to) {
      if (from == to || clips[from].FrameCount() == 0) continue;
      PairCoverage& pair = pairs_[Index(from, to)];
      const std::span<const FrameMatches> ways = of_bridges.Of(from, to);
      pair.frame_share = of_all.Share(from, to);
      pair.bridge_share = of_bridges.Share(from, to);
      pair.worst_wait_s = WorstWait(ways, clips[from]);
      pair.in_between_share = static_cast<double>(CountLate(ways, clips[from], budget_s)) / clips[from].FrameCount();
    }
  }
}

std::vector<int> Coverage::WithoutWayInto(int wanted) const {
  std::vector<int> without;
  for (int from = 0; from < clip_count_; ++from) {
    if (from != wanted && !Of(from, wanted).worst_wait_s) without.push_back(from);
  }
  return without;
}

}  // namespace etude
