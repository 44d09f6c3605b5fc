#include "engine/bridging/in_between.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/bridging/frame_ratings.h"
#include "engine/bridging/library.h"

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

/// Where a clip and the in-between meet.
struct Junction {
  int frame = 0;  ///< of the clip
  int key = -1;   ///< of the net
  FuzzyDistance distance;
  bool matches = false;
};

/// One clip of the library against the keys, counting the pairs that it compares.
class KeySearch {
 public:
  KeySearch(const MotionLibrary& library, int clip, const SwitchRules& rules, SwitchRecord& record)
      : library_(library), clip_(library.tagged[clip]), rules_(rules), record_(record) {}

  /// The first of `frames` that a key matches, with the nearest such key; else the nearest pair of `all` and any key.
  Junction Find(std::span<const int> frames, std::span<const int> all) const {
    for (int frame : frames) {
      if (const Junction junction = MatchKeys(frame); junction.matches) return junction;
    }
    Junction nearest;
    for (int frame : all) {
      for (int key = 0; key < KeyCount(); ++key) {
        const bool is_first = nearest.key < 0;
        if (is_first || IsCloser(clip_.grades[frame], GradesOf(key), rules_.weights, nearest.distance.value)) {
          nearest = {frame, key, DistanceTo(key, frame), false};
        }
      }
      record_.pairs_seen += KeyCount();
    }
    return nearest;
  }

  FuzzyDistance DistanceTo(int key, int frame) const {
    return ComputeDistance(clip_.grades[frame], GradesOf(key), rules_.weights);
  }

 private:
  int KeyCount() const { return static_cast<int>(library_.in_betweens.keys.size()); }
  const Grades& GradesOf(int key) const {
    const Key& place = library_.in_betweens.keys[key];
    return library_.tagged[place.clip].grades[place.frame];
  }

  Junction MatchKeys(int frame) const {
    Junction best{.frame = frame, .key = -1, .distance = {}, .matches = false};
    for (int key = 0; key < KeyCount(); ++key) {
      const Key& place = library_.in_betweens.keys[key];
      if (!Matches(clip_, frame, library_.tagged[place.clip], place.frame, rules_)) continue;
      ++record_.pairs_matched;
      const FuzzyDistance distance = DistanceTo(key, frame);
      if (!best.matches || distance.value < best.distance.value) best = {frame, key, distance, true};
    }
    record_.pairs_seen += KeyCount();
    return best;
  }

  const MotionLibrary& library_;
  const TaggedClip& clip_;
  const SwitchRules& rules_;
  SwitchRecord& record_;
};

std::vector<int> Range(int first, int end) {
  std::vector<int> frames(static_cast<std::size_t>(std::max(end - first, 0)));
  std::iota(frames.begin(), frames.end(), first);
  return frames;
}

std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window) {
  std::vector<int> frames;
  for (int frame : clip.bridge_frames) {
    if (window.Contains(frame)) frames.push_back(frame);
  }
  return frames;
}

/// The frames from one key to another, directly unless a limb would have to turn too far.
std::vector<BodyPose> MakeInBetween(const MotionLibrary& library, int from, int to, double rate_hz) {
  const InBetweenNet& net = library.in_betweens;
  const auto pose = [&](int key) { return library.motions[net.keys[key].clip].poses[net.keys[key].frame]; };
  const Tween direct(pose(from), pose(to));
  constexpr int kHub = 0;
  if (direct.WidestTurn() <= net.tween.widest_turn || from == kHub || to == kHub) {
    return SampleTween(direct, rate_hz, net.tween);
  }
  std::vector<BodyPose> frames = SampleTween(Tween(pose(from), pose(kHub)), rate_hz, net.tween);
  const std::vector<BodyPose> rest = SampleTween(Tween(frames.back(), pose(to)), rate_hz, net.tween);
  frames.insert(frames.end(), rest.begin() + 1, rest.end());
  return frames;
}

/// The junction, and beside it the frames of the clip that come nearest to the same key, `most` in all.
void AddCandidates(const KeySearch& search, const Junction& junction, std::span<const int> frames, double threshold,
                   std::size_t most, std::vector<Candidate>& candidates) {
  std::vector<Candidate> added;
  for (int frame : frames) {
    if (frame == junction.frame) continue;
    const FuzzyDistance distance = search.DistanceTo(junction.key, frame);
    const Fate fate = distance.value < threshold ? Fate::kLater : Fate::kTooFar;
    added.push_back({.from_frame = frame, .to_frame = 0, .distance = distance, .cost = std::nullopt, .fate = fate});
  }
  std::stable_sort(added.begin(), added.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance.value < b.distance.value; });
  if (added.size() >= most) added.resize(most - 1);
  added.push_back({.from_frame = junction.frame,
                   .to_frame = 0,
                   .distance = junction.distance,
                   .cost = std::nullopt,
                   .fate = Fate::kTaken});
  std::stable_sort(added.begin(), added.end(),
                   [](const Candidate& a, const Candidate& b) { return a.from_frame < b.from_frame; });
  candidates.insert(candidates.end(), added.begin(), added.end());
}

std::string Explain(const MotionLibrary& library, const SwitchRequest& request, const Junction& exit,
                    const Junction& entrance, double threshold) {
  const auto name = [&](const Junction& junction) {
    const Key& key = library.in_betweens.keys[junction.key];
    return fmt::format("{} {}", library.names[key.clip], key.frame);
  };
  const auto judge = [&](const Junction& junction) {
    const bool is_near = junction.distance.value < threshold;
    return fmt::format("{} (d = {:.2f}{})", junction.frame, junction.distance.value,
                       junction.matches ? ""
                       : is_near        ? ", but no bridge frame"
                                        : fmt::format(", not below {}", threshold));
  };
  return fmt::format("left at {} {} for the key pose {}, entered from the key pose {} at {} {}",
                     library.names[request.from], judge(exit), name(exit), name(entrance), library.names[request.to],
                     judge(entrance));
}

}  // namespace

bool TakeInBetween(const MotionLibrary& library, const SwitchRequest& request, FrameWindow window,
                   const SwitchRules& rules, SwitchRecord& record) {
  if (library.in_betweens.keys.empty()) return false;
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const KeySearch exits(library, request.from, rules, record), entrances(library, request.to, rules, record);
  const std::vector<int> exit_frames = BridgeFramesWithin(playing, window);
  const Junction exit = exits.Find(exit_frames, Range(window.first, window.last + 1));
  // In rising order the front half comes first by itself.
  const std::vector<int> entrance_frames = BridgeFramesWithin(next, {0, next.FrameCount() - 2});
  const Junction entrance = entrances.Find(entrance_frames, Range(0, std::max(next.FrameCount() / 2, 1)));

  record.branch = exit.matches && entrance.matches ? Branch::kInBetween : Branch::kForced;
  record.request_frame = request.request_frame;
  std::vector<BodyPose> own = MakeInBetween(library, exit.key, entrance.key, playing.rate_hz);
  const int last = static_cast<int>(own.size()) - 1;
  record.legs = {{.clip = request.from, .first = request.request_frame, .last = exit.frame, .own = {}},
                 {.clip = Leg::kOwnFrames, .first = 0, .last = last, .own = std::move(own)},
                 {.clip = request.to, .first = entrance.frame, .last = next.FrameCount() - 1, .own = {}}};
  record.meetings = {exit.distance, entrance.distance};
  record.wait_s = WaitOf(record.legs, playing.rate_hz);
  AddCandidates(exits, exit, exit_frames, rules.threshold, kMostCandidates / 2, record.candidates);
  const std::size_t of_entrance = record.candidates.size();
  AddCandidates(entrances, entrance, entrance_frames, rules.threshold, kMostCandidates / 2, record.candidates);
  for (Candidate& candidate : std::span(record.candidates).subspan(of_entrance)) {
    candidate.to_frame = std::exchange(candidate.from_frame, last);
  }
  record.why = Explain(library, request, exit, entrance, rules.threshold);
  return true;
}

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
