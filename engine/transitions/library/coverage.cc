#include "engine/transitions/library/coverage.h"

#include <algorithm>
#include <utility>

#include "engine/transitions/library/transition_points.h"
#include "engine/transitions/search/frame_matches.h"
#include "engine/transitions/search/grade_index.h"

namespace etude {
namespace {

/// Returns the longest wait for the next of `frames` (in ascending order), in seconds, if the clip is played in a loop.
/// Returns nullopt if `frames` is empty.
std::optional<double> WorstWait(std::span<const int> frames, const TaggedClip& clip) {
  if (frames.empty()) return std::nullopt;
  int worst = frames.front() + clip.FrameCount() - frames.back();
  for (std::size_t i = 1; i < frames.size(); ++i) worst = std::max(worst, frames[i] - frames[i - 1]);
  return (worst - 1) / clip.rate_hz;
}

/// Returns the number of the clip's frames after which none of `frames` follows within the budget.
int CountLate(std::span<const int> frames, const TaggedClip& clip, double budget_s) {
  int late = 0;
  auto next = frames.begin();
  for (int frame = 0; frame < clip.FrameCount(); ++frame) {
    while (next != frames.end() && *next < frame) ++next;
    late += next == frames.end() || !WaitWindow(clip, frame, budget_s).Contains(*next);
  }
  return late;
}

double ShareOf(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Returns the coverage of a clip from its matching frames and its matching bridge frames.
ClipCoverage CoverageOf(const TaggedClip& clip, std::span<const int> frames, std::span<const int> bridge_frames,
                        double budget_s) {
  if (clip.FrameCount() == 0) return {};
  return {.frame_share = ShareOf(frames.size(), clip.grades.size()),
          .bridge_share = ShareOf(bridge_frames.size(), clip.bridge_frames.size()),
          .worst_wait_s = WorstWait(bridge_frames, clip),
          .in_between_share = static_cast<double>(CountLate(bridge_frames, clip, budget_s)) / clip.FrameCount()};
}

std::vector<int> AllFrames(const TaggedClip& clip) { return FramesWithin({0, clip.FrameCount() - 1}); }
std::vector<int> BridgeFrames(const TaggedClip& clip) { return clip.bridge_frames; }

/// Returns, for each clip, the frames that match a frame of any other clip. `participating` returns the frames of a
/// clip that are compared.
std::vector<std::vector<int>> MatchesAnywhere(std::span<const TaggedClip> clips, const MatchRules& rules,
                                              std::vector<int> (*participating)(const TaggedClip&),
                                              const OnProgress& on_progress) {
  // Index the frames that may be entered.
  std::vector<Grades> grades;
  std::vector<Tags> tags;
  std::vector<int> starts;
  for (const TaggedClip& clip : clips) {
    starts.push_back(static_cast<int>(grades.size()));
    for (int frame : participating(clip)) {
      if (!EntryWindow(clip).Contains(frame)) continue;
      grades.push_back(clip.grades[frame]);
      if (rules.within_class) tags.push_back(clip.tags[frame]);
    }
  }
  starts.push_back(static_cast<int>(grades.size()));
  const GradeIndex index(std::exchange(grades, {}), rules.weights, std::exchange(tags, {}));
  // Search a match for each frame in time order.
  std::vector<std::vector<int>> matches(clips.size());
  int hint = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (int frame : participating(clips[c])) {
      const GradeIndex::Query query{.grades = clips[c].grades[frame],
                                    .threshold = rules.threshold,
                                    .own_first = starts[c],
                                    .own_end = starts[c + 1],
                                    .tags = rules.within_class ? &clips[c].tags[frame] : nullptr};
      if (index.HasMatch(query, hint)) matches[c].push_back(frame);
    }
    if (on_progress) on_progress(c + 1, clips.size());
  }
  return matches;
}

}  // namespace

Coverage::Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, const CoverageOptions& options) {
  const std::size_t phases = options.with_pairs ? 3 : 2;
  const auto progress_of = [&](std::size_t phase) {
    return [&, phase](std::size_t done, std::size_t all) {
      if (options.on_progress) options.on_progress(phase * all + done, phases * all);
    };
  };
  // Compare every clip with all other clips together.
  const auto of_all = MatchesAnywhere(clips, rules, AllFrames, progress_of(0));
  const auto of_bridges = MatchesAnywhere(clips, rules, BridgeFrames, progress_of(1));
  for (std::size_t c = 0; c < clips.size(); ++c) {
    any_.push_back(CoverageOf(clips[c], of_all[c], of_bridges[c], options.budget_s));
  }
  // Compare every pair of clips if the options ask for it. Otherwise find only, for each wanted clip, the clips that
  // have no matching bridge frame.
  if (options.with_pairs) {
    CoverageOptions of_pairs = options;
    of_pairs.on_progress = progress_of(2);
    ComputePairs(clips, rules, of_pairs);
    return;
  }
  for (int wanted : options.wanted) {
    std::vector<int>& without = without_[wanted];
    const MatchClip to(clips[wanted].grades, clips[wanted].tags, clips[wanted].bridge_frames, rules);
    for (int from = 0; from < ClipCount(); ++from) {
      if (from == wanted) continue;
      const MatchClip leaving(clips[from].grades, clips[from].tags, clips[from].bridge_frames, rules);
      if (FindMatchingFrames(leaving, to, rules).empty()) without.push_back(from);
    }
  }
}

void Coverage::ComputePairs(std::span<const TaggedClip> clips, const MatchRules& rules,
                            const CoverageOptions& options) {
  // Prepare every clip once.
  std::vector<MatchClip> all, bridges;
  for (const TaggedClip& clip : clips) {
    all.emplace_back(clip.grades, clip.tags, AllFrames(clip), rules);
    bridges.emplace_back(clip.grades, clip.tags, clip.bridge_frames, rules);
  }
  // Compare each clip with every other clip.
  pairs_.resize(clips.size() * clips.size());
  for (int from = 0; from < ClipCount(); ++from) {
    for (int to = 0; to < ClipCount(); ++to) {
      if (from == to) continue;
      const std::vector<int> ways = FindMatchingFrames(bridges[from], bridges[to], rules);
      pairs_[Pair(from, to)] =
          CoverageOf(clips[from], FindMatchingFrames(all[from], all[to], rules), ways, options.budget_s);
      if (ways.empty()) without_[to].push_back(from);
    }
    without_.try_emplace(from);
    if (options.on_progress) options.on_progress(static_cast<std::size_t>(from) + 1, clips.size());
  }
}

}  // namespace etude
