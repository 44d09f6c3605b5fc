#include "engine/transitions/choices/through_in_between.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/transitions/library/transition_points.h"

namespace etude {
namespace {

using Key = InBetweenNet::Key;

/// A transition point between a clip and a key pose of the in-between.
struct KeyPoint {
  int frame = 0;  ///< index in the clip
  int key = -1;   ///< index in the net; −1 if the net has no keys
  FuzzyDistance distance;
  bool matches = false;
};

/// Compares one clip of the library with all key poses, and adds the number of compared pairs to the record.
class KeySearch {
 public:
  KeySearch(const MotionLibrary& library, int clip, const MatchRules& rules, TransitionRecord& record)
      : library_(library), clip_(library.tagged[clip]), rules_(rules), record_(record) {}

  /// Returns the first of `frames` that matches a key, with the nearest key. Without a match, returns the nearest pair
  /// of a frame in `all` and any key.
  KeyPoint Find(std::span<const int> frames, std::span<const int> all) const {
    for (int frame : frames) {
      if (const KeyPoint key_point = MatchKeys(frame); key_point.matches) return key_point;
    }
    KeyPoint nearest;
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

  /// Returns at most kMaxCandidates / 2 candidates: `key_point`, which is taken, and those of `frames` that are nearest
  /// to `key_point.key`. The index of the clip's frame is stored in `from_frame`, even if the clip is entered there.
  std::vector<Candidate> ListCandidates(const KeyPoint& key_point, std::span<const int> frames) const {
    std::vector<Candidate> listed;
    for (int frame : frames) {
      if (frame == key_point.frame) continue;
      const CandidateOutcome outcome =
          MatchesKey(frame, key_point.key) ? CandidateOutcome::kLater : CandidateOutcome::kTooFar;
      listed.push_back(
          {.from_frame = frame, .distance = DistanceTo(key_point.key, frame), .cost = {}, .outcome = outcome});
    }
    std::ranges::stable_sort(listed, {}, [](const Candidate& candidate) { return candidate.distance.value; });
    listed.resize(std::min(listed.size(), kMaxCandidates / 2 - 1));
    listed.push_back({.from_frame = key_point.frame,
                      .distance = key_point.distance,
                      .cost = {},
                      .outcome = CandidateOutcome::kTaken});
    std::ranges::stable_sort(listed, {}, &Candidate::from_frame);
    return listed;
  }

 private:
  int KeyCount() const { return static_cast<int>(library_.in_betweens.keys.size()); }
  const Grades& GradesOf(int key) const {
    const Key& key_frame = library_.in_betweens.keys[key];
    return library_.tagged[key_frame.clip].grades[key_frame.frame];
  }

  FuzzyDistance DistanceTo(int key, int frame) const {
    return ComputeDistance(clip_.grades[frame], GradesOf(key), rules_.weights);
  }
  bool MatchesKey(int frame, int key) const {
    const Key& key_frame = library_.in_betweens.keys[key];
    return Matches(clip_, frame, library_.tagged[key_frame.clip], key_frame.frame, rules_);
  }

  KeyPoint MatchKeys(int frame) const {
    KeyPoint best{.frame = frame, .key = -1, .distance = {}, .matches = false};
    for (int key = 0; key < KeyCount(); ++key) {
      if (!MatchesKey(frame, key)) continue;
      ++record_.pairs_matched;
      const FuzzyDistance distance = DistanceTo(key, frame);
      if (!best.matches || distance.value < best.distance.value) best = {frame, key, distance, true};
    }
    record_.pairs_seen += KeyCount();
    return best;
  }

  const MotionLibrary& library_;
  const TaggedClip& clip_;
  const MatchRules& rules_;
  TransitionRecord& record_;
};

/// Returns the frames of a motion from one key pose to another. If a limb would rotate too far, the motion goes through
/// the hub (the first key).
std::vector<BodyPose> MakeInBetween(const MotionLibrary& library, int from, int to, double rate_hz) {
  const InBetweenNet& net = library.in_betweens;
  const auto pose = [&](int key) { return library.motions[net.keys[key].clip].poses[net.keys[key].frame]; };
  const Tween direct(pose(from), pose(to));
  constexpr int kHub = 0;
  if (direct.WidestTurn() <= net.tween.widest_turn || from == kHub || to == kHub) {
    return SampleTween(direct, rate_hz, net.tween);
  }
  std::vector<BodyPose> frames = SampleTween(Tween(pose(from), pose(kHub)), rate_hz, net.tween);
  AppendTween(pose(to), rate_hz, net.tween, frames);
  return frames;
}

std::string Explain(const MotionLibrary& library, const TransitionRequest& request, const KeyPoint& exit,
                    const KeyPoint& entrance, double threshold) {
  const auto name = [&](const KeyPoint& key_point) {
    const Key& key = library.in_betweens.keys[key_point.key];
    return fmt::format("{} {}", library.names[key.clip], key.frame);
  };
  const auto judge = [&](const KeyPoint& key_point) {
    const bool is_near = key_point.distance.value < threshold;
    return fmt::format("{} (d = {:.2f}{})", key_point.frame, key_point.distance.value,
                       key_point.matches ? ""
                       : is_near         ? ", but no allowed bridge frame"
                                         : fmt::format(", not below {}", threshold));
  };
  return fmt::format(
      "the transition leaves {} at frame {} for the key pose {}, and goes from the key pose {} into {} at frame {}",
      library.names[request.from], judge(exit), name(exit), name(entrance), library.names[request.to], judge(entrance));
}

}  // namespace

TransitionRecord ThroughInBetween(const MotionLibrary& library, const TransitionRequest& request,
                                  const MatchRules& rules, const std::string& why_not, std::int64_t pairs_seen) {
  TransitionRecord record;
  record.request_frame = request.request_frame;
  record.pairs_seen = pairs_seen;
  if (library.in_betweens.keys.empty()) {
    record.why = why_not + "; and the library has no in-between clip";
    return record;
  }
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  // Find the frames at which the playing clip is left and the wanted clip is entered.
  const KeySearch exits(library, request.from, rules, record), entrances(library, request.to, rules, record);
  const FrameWindow window = WaitWindow(playing, request.request_frame, request.budget_s);
  const std::vector<int> exit_frames = BridgeFramesWithin(playing, window);
  const KeyPoint exit = exits.Find(exit_frames, FramesWithin(window));
  // The search takes the first match. Bridge frames are in ascending order, so the clip's front half is searched first.
  const std::vector<int> entrance_frames = BridgeFramesWithin(next, EntryWindow(next));
  const KeyPoint entrance = entrances.Find(entrance_frames, FramesWithin({0, std::max(next.FrameCount() / 2, 1) - 1}));

  record.branch = exit.matches && entrance.matches ? Branch::kInBetween : Branch::kForced;
  // Make the in-between, and record the three segments and the candidates at both points.
  std::vector<BodyPose> own = MakeInBetween(library, exit.key, entrance.key, playing.rate_hz);
  const int last = static_cast<int>(own.size()) - 1;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = exit.frame, .own = {}},
                     {.clip = Segment::kOwnFrames, .first = 0, .last = last, .own = std::move(own)},
                     {.clip = request.to, .first = entrance.frame, .last = next.FrameCount() - 1, .own = {}}};
  record.distances = {exit.distance, entrance.distance};
  record.wait_s = WaitOf(record.segments, playing.rate_hz);
  record.candidates = exits.ListCandidates(exit, exit_frames);
  for (Candidate& candidate : entrances.ListCandidates(entrance, entrance_frames)) {
    candidate.to_frame = std::exchange(candidate.from_frame, last);
    candidate.point = 1;
    record.candidates.push_back(candidate);
  }
  record.why = why_not + "; " + Explain(library, request, exit, entrance, rules.threshold);
  return record;
}

}  // namespace etude
