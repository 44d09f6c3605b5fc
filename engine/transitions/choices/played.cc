#include "engine/transitions/choices/played.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/transitions/choices/planning.h"
#include "engine/transitions/choices/through_clip.h"
#include "engine/transitions/joins/planted_feet.h"
#include "engine/transitions/joins/splice.h"

namespace etude {
namespace {

constexpr int kPairs = 12;
constexpr std::array kLengths_s = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.2};
constexpr std::size_t kMostCompared = 20'000;  // pairs of frames whose features are compared

constexpr std::size_t kWithFeet = 2;   // of each length
constexpr double kAlwaysUsual = 0.01;  // metres per frame²: 9 m/s², as of what falls
constexpr double kUnborne_s = 0.3;     // what a frame costs in which nothing bears the body

struct FramePair {
  int leave = 0, enter = 0;
};

/// Finds, for each part of the wait, the pair that is nearest, if any can be joined (NeedsClip); every few frames of
/// the wanted clip are enough where it is long.
std::vector<FramePair> NearestPairs(const MotionLibrary& library, const TransitionRequest& request,
                                    const AllowedFrames& allowed) {
  const auto &playing = library.features[request.from], &next = library.features[request.to];
  const auto &left = library.stances[request.from], &entered = library.stances[request.to];
  const std::size_t stride = allowed.leave.size() * allowed.enter.size() / kMostCompared + 1;
  const std::size_t parts = std::min<std::size_t>(kPairs, allowed.leave.size());
  std::vector<FramePair> pairs;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * allowed.leave.size() / parts, end = (part + 1) * allowed.leave.size() / parts;
    std::optional<FramePair> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < allowed.enter.size(); ++k) {
        if (best && k % stride != 0) continue;
        const FramePair pair{allowed.leave[i], allowed.enter[k]};
        if (NeedsClip(left[pair.leave], entered[pair.enter])) continue;
        const double distance = SquaredDistance(playing[pair.leave], next[pair.enter]);
        if (distance >= least) continue;
        least = distance;
        best = pair;
      }
    }
    if (best) pairs.push_back(*best);
  }
  return pairs;
}

/// Returns frames of a clip from one on, that one included: `count` more, the last repeated where the clip ends.
std::vector<BodyPose> FramesFrom(const BodyMotion& clip, int first, int count) {
  std::vector<BodyPose> frames;
  const int last = static_cast<int>(clip.poses.size()) - 1;
  for (int f = first; f <= first + count; ++f) frames.push_back(clip.poses[std::min(f, last)]);
  return frames;
}

BodyPose FrameBeforeIn(const BodyMotion& clip, int frame) {
  if (frame > 0) return clip.poses[frame - 1];
  return clip.poses.size() > 1 ? FrameBefore(clip.poses[0], clip.poses[1]) : clip.poses[0];
}

/// The window of a pair as the join planted-feet would have it; of the wanted clip the frames up to `last` are real.
JoinWindow WindowOfPair(const MotionLibrary& library, const TransitionRequest& request, const FramePair& pair, int last,
                        int frames) {
  const BodyMotion &playing = library.motions[request.from], &wanted = library.motions[request.to];
  JoinWindow window{.shown = {FrameBeforeIn(playing, pair.leave), playing.poses[pair.leave]},
                    .target_before = FrameBeforeIn(wanted, pair.enter),
                    .old = FramesFrom(playing, pair.leave, frames),
                    .next = FramesFrom(wanted, pair.enter, frames),
                    .old_frames = std::min(static_cast<int>(playing.poses.size()) - 1 - pair.leave, frames),
                    .next_frames = std::min(last - pair.enter, frames),
                    .rate_hz = playing.rate_hz};
  const std::size_t aligned = static_cast<std::size_t>(kAlignedSeconds * window.rate_hz) + 1;
  const auto head = [&](const BodyMotion& clip, int first) {
    return std::span(clip.poses).subspan(first).first(std::min(aligned, clip.poses.size() - first));
  };
  const FloorMove place = AlignOnPlantedFeet(head(playing, pair.leave), head(wanted, pair.enter), window.rate_hz);
  window.target_before = place.Apply(window.target_before);
  for (BodyPose& pose : window.next) pose = place.Apply(pose);
  return window;
}

JoinWindow Shortened(const JoinWindow& whole, int frames) {
  JoinWindow window = whole;
  window.old.resize(frames + 1);
  window.next.resize(frames + 1);
  window.old_frames = std::min(window.old_frames, frames);
  window.next_frames = std::min(window.next_frames, frames);
  return window;
}

glm::dvec3 SecondDifferenceOf(const BodyPose& before, const BodyPose& here, const BodyPose& after, std::size_t joint) {
  return after.joints[joint] - 2.0 * here.joints[joint] + before.joints[joint];
}

/// The larger of both motions' own second differences, metres, by frame from the point on and by joint; a motion that
/// has ended has none.
using OwnAccelerations = std::vector<std::array<double, kRoleCount>>;

OwnAccelerations OwnOf(const JoinWindow& window) {
  OwnAccelerations own(window.next.size());
  for (int f = 0; f < window.Frames(); ++f) {
    const BodyPose& old_before = f > 0 ? window.old[f - 1] : window.shown.before;
    const BodyPose& next_before = f > 0 ? window.next[f - 1] : window.target_before;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto size = [&](const BodyPose& before, const BodyPose& here, const BodyPose& after) {
        return glm::length(SecondDifferenceOf(before, here, after, j));
      };
      own[f][j] = std::max(f < window.old_frames ? size(old_before, window.old[f], window.old[f + 1]) : 0,
                           f < window.next_frames ? size(next_before, window.next[f], window.next[f + 1]) : 0);
    }
  }
  return own;
}

double SquaredOff(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    const glm::dvec3 off = a.joints[j] - b.joints[j];
    sum += glm::dot(off, off);
  }
  return sum / kRoleCount;
}

/// Adds up what the frames of a join cost, in their order, the one at the point first.
class CostMeter {
 public:
  CostMeter(const JoinWindow& window, const OwnAccelerations& own, double usual, const PlayedOptions& options)
      : window_(window), own_(own), usual_(usual), options_(options), before_(window.shown.before) {}

  void Add(const BodyPose& shown) {
    if (count_ > 0) {
      const std::size_t f = count_ - 1;  // of `here_`, whose neighbours are known now
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        const double jump = glm::length(SecondDifferenceOf(before_, here_, shown, j));
        worst_excess_ = std::max(worst_excess_, jump - std::max(own_[f][j], usual_));
      }
      if (f > 0) off_ += std::sqrt(std::min(SquaredOff(here_, window_.old[f]), SquaredOff(here_, window_.next[f])));
      before_ = here_;
    }
    here_ = shown;
    ++count_;
  }

  /// Returns the cost of the frames added so far, seconds; it never becomes less.
  double Seconds() const {
    constexpr double kCm = 100;
    return kCm * (worst_excess_ / options_.excess_per_s + off_ / window_.rate_hz / options_.invented_per_s);
  }

 private:
  const JoinWindow& window_;
  const OwnAccelerations& own_;
  const double usual_;  // MotionLibrary::usual_accelerations of the calmer clip
  const PlayedOptions& options_;
  BodyPose before_, here_;
  std::size_t count_ = 0;
  double worst_excess_ = 0;  // the largest second difference of any joint beyond the motions' own, metres
  double off_ = 0;           // metres, summed over the frames
};

/// A transition that was played.
struct PlayedWay {
  FramePair pair;
  std::size_t number = 0;  ///< of the pair
  int frames = 0;          ///< of the join
  bool fades = false;      ///< PreferredJoin
  double cost_s = 0;
};

bool IsBetterWay(const PlayedWay& a, const PlayedWay& b) {
  return std::tuple(a.cost_s, a.number, a.frames, a.fades) < std::tuple(b.cost_s, b.number, b.frames, b.fades);
}

/// Plays the transitions that are worth it, and ranks them, the best first. There must be a pair at least; where the
/// wanted clip is soon left again, the joins end by its frame `last`, as far as the shortest one can.
class Rehearsal {
 public:
  Rehearsal(const MotionLibrary& library, const TransitionRequest& request, const PlayedOptions& options,
            const std::vector<FramePair>& pairs, int last)
      : request_(request),
        options_(options),
        rate_hz_(library.motions[request.from].rate_hz),
        usual_(std::max(std::min(library.usual_accelerations[request.from], library.usual_accelerations[request.to]),
                        kAlwaysUsual)) {
    const int longest = FramesOf(kLengths_s.back());
    for (const FramePair& pair : pairs) {
      windows_.push_back(WindowOfPair(library, request, pair, last, longest));
      own_.push_back(OwnOf(windows_.back()));
    }
    for (const JoinWindow& window : windows_) turns_.emplace_back(window);
    PlayAll(pairs);
    PlayBestWithFeet();
  }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  const std::vector<PlayedWay>& ways() const { return ways_; }
  const PlayedWay& best() const { return ways_.front(); }
  PreferredJoin PreferredOf(const PlayedWay& way) const {
    return {.blend_s = way.frames / rate_hz_, .fades = way.fades};
  }

 private:
  int FramesOf(double seconds) const { return static_cast<int>(std::lround(seconds * rate_hz_)); }

  double Time(const PlayedWay& way) const { return (way.pair.leave - request_.request_frame + way.frames) / rate_hz_; }

  /// Returns the cost of a way without planted feet; it is not counted to the end once it is `enough`.
  double Cost(const PlayedWay& way, double enough) {
    const JoinWindow& window = windows_[way.number];
    const MinimumJerkPlay play(window, turns_[way.number], way.frames, way.fades);
    CostMeter meter(window, own_[way.number], usual_, options_);
    for (int frame = 0; frame <= way.frames && Time(way) + meter.Seconds() < enough; ++frame) meter.Add(play.At(frame));
    return Time(way) + meter.Seconds();
  }

  double CostWithFeet(const PlayedWay& way) const {
    const JoinWindow window = Shortened(windows_[way.number], way.frames);
    std::vector<BodyPose> played = PlayMinimumJerk(window, way.fades);
    const int unborne = PlantFeet(window, played);
    CostMeter meter(window, own_[way.number], usual_, options_);
    for (const BodyPose& pose : played) meter.Add(pose);
    return Time(way) + meter.Seconds() + kUnborne_s * unborne;
  }

  /// A way whose time alone costs more than the best is not played.
  void PlayAll(const std::vector<FramePair>& pairs) {
    std::vector<PlayedWay> open;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (double length : kLengths_s) {
        const int frames = FramesOf(length);
        // The wanted clip should be there before it ends.
        if (frames > windows_[i].next_frames && length > kLengths_s.front()) break;
        for (bool fades : {false, true}) {
          open.push_back({.pair = pairs[i], .number = i, .frames = frames, .fades = fades});
          open.back().cost_s = Time(open.back());
        }
      }
    }
    std::ranges::sort(open, IsBetterWay);
    for (double length : kLengths_s) PlayLength(FramesOf(length), open);
    std::ranges::sort(ways_, IsBetterWay);
  }

  /// Plays the ways of one length, and keeps those that cost least. Pairs that were best at the length before are most
  /// likely to be so again: played first, they make an early end of the others.
  void PlayLength(int frames, const std::vector<PlayedWay>& open) {
    std::vector<PlayedWay> best;  // the largest cost first in the heap
    const auto was_best = [&](const PlayedWay& way) {
      return std::ranges::any_of(best_before_, [&](const PlayedWay& b) { return b.number == way.number; });
    };
    for (bool first : {true, false}) {
      for (PlayedWay way : open) {
        if (way.frames != frames || was_best(way) != first) continue;
        const bool is_full = best.size() == kWithFeet;
        const double enough = is_full ? best.front().cost_s : std::numeric_limits<double>::infinity();
        if (way.cost_s >= enough) break;
        way.cost_s = Cost(way, enough);
        if (way.cost_s >= enough) continue;
        if (is_full) {
          std::ranges::pop_heap(best, IsBetterWay);
          best.pop_back();
        }
        best.push_back(way);
        std::ranges::push_heap(best, IsBetterWay);
      }
    }
    ways_.insert(ways_.end(), best.begin(), best.end());
    best_before_ = std::move(best);
  }

  void PlayBestWithFeet() {
    for (PlayedWay& way : ways_) way.cost_s = CostWithFeet(way);
    std::ranges::sort(ways_, IsBetterWay);
  }

  const TransitionRequest& request_;
  const PlayedOptions& options_;
  const double rate_hz_, usual_;
  std::vector<JoinWindow> windows_;
  std::vector<WindowTurns> turns_;  // of the windows
  std::vector<OwnAccelerations> own_;
  std::vector<PlayedWay> ways_, best_before_;
};

int LastFrameOf(const MotionLibrary& library, int clip) { return library.tagged[clip].FrameCount() - 1; }

/// Plans a way through a clip that stands up or lies down, where the wait and the wanted clip's beginning hold no pair
/// of frames that can be joined.
TransitionRecord PlanThroughClip(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const PlayedOptions& options, const AllowedFrames& allowed) {
  TransitionRecord record;
  record.request_frame = request.request_frame;
  record.pairs_seen = allowed.Pairs();
  record.cost_unit = "s";
  const Stance &left = library.stances[request.from][allowed.leave.front()],
               &met = library.stances[request.to][allowed.enter.front()];
  const auto told = [&](int clip, const Stance& stance) {
    return fmt::format("{} {} with its hips at {:.2f} m", library.names[clip],
                       stance.is_down ? "lies, sits or kneels" : "stands", stance.hips);
  };
  const std::string why =
      fmt::format("{} all the while that it may be left, {} where it may be entered: no join can {} a body on nothing",
                  told(request.from, left), told(request.to, met), met.hips > left.hips ? "raise" : "lower");
  const auto through = FindThroughClip(library, request, allowed, options.most_through_s);
  if (!through) {
    record.why = fmt::format("{}; and no clip shows within {:g} s how it is done", why, options.most_through_s);
    return record;
  }
  const TransitionRequest entering{request.from, request.request_frame, through->clip, request.budget_s};
  const Rehearsal in(library, entering, options, NearestPairs(library, entering, {allowed.leave, through->enter}),
                     through->leave.back());
  const int entered = in.best().pair.enter, shown = entered + in.best().frames;
  const double rate_hz = library.motions[through->clip].rate_hz;
  std::vector<int> leave;
  for (int frame : through->leave) {
    const bool is_soon = frame - entered <= options.most_through_s * rate_hz;
    if (frame >= shown && (leave.empty() || is_soon)) leave.push_back(frame);
  }
  const TransitionRequest leaving{through->clip, leave.front(), request.to, request.budget_s};
  const Rehearsal out(library, leaving, options, NearestPairs(library, leaving, {std::move(leave), allowed.enter}),
                      LastFrameOf(library, request.to));
  record.branch = Branch::kInBetween;
  const FramePair &first = in.best().pair, &second = out.best().pair;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = first.leave, .own = {}},
                     {.clip = through->clip,
                      .first = entered,
                      .last = second.leave,
                      .own = {},
                      .preferred = in.PreferredOf(in.best())},
                     {.clip = request.to,
                      .first = second.enter,
                      .last = LastFrameOf(library, request.to),
                      .own = {},
                      .preferred = out.PreferredOf(out.best())}};
  const auto distance = [&](int from, int from_frame, int to, int to_frame) {
    return ComputeDistance(library.tagged[from].grades[from_frame], library.tagged[to].grades[to_frame], rules.weights);
  };
  record.distances = {distance(request.from, first.leave, through->clip, entered),
                      distance(through->clip, second.leave, request.to, second.enter)};
  record.wait_s = WaitOf(record.segments, rate_hz);
  record.why = fmt::format("{}; through {} from frame {} to {}, {:.2f} s", why, library.names[through->clip], entered,
                           second.leave, (second.leave - entered) / rate_hz);
  return record;
}

}  // namespace

const SettingTable<PlayedOptions>& PlayedSettings() {
  static const SettingTable<PlayedOptions> kSettings(
      {{"excess_per_s", &PlayedOptions::excess_per_s, 0.01, 1000,
        "How much acceleration beyond the clips' own, in centimetres per frame², weighs as much as a second of time."},
       {"invented_per_s", &PlayedOptions::invented_per_s, 0.01, 1'000'000,
        "How far from both clips, in centimetres over a second, weighs as much as a second of time."},
       {"most_skipped_s", &PlayedOptions::most_skipped_s, 0, 60,
        "How much of the wanted clip may be skipped, in seconds; never more than its first third."},
       {"most_through_s", &PlayedOptions::most_through_s, 0, 60,
        "How much of a clip that stands up or lies down may be shown on the way, in seconds, after the wait."}});
  return kSettings;
}

TransitionRecord PlanPlayed(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const PlayedOptions& options) {
  const AllowedFrames allowed = AllowedEarlyFrames(library, request, options.most_skipped_s);
  const std::vector<FramePair> pairs = NearestPairs(library, request, allowed);
  if (pairs.empty()) return PlanThroughClip(library, request, rules, options, allowed);
  const Rehearsal rehearsal(library, request, options, pairs, LastFrameOf(library, request.to));
  const PlayedWay& best = rehearsal.best();
  TransitionRecord record = DirectTransition(library, request, best.pair.leave, best.pair.enter, rules);
  const PreferredJoin preferred = rehearsal.PreferredOf(best);
  record.segments.back().preferred = preferred;
  record.pairs_seen = record.pairs_matched = allowed.Pairs();
  record.cost_unit = "s";
  std::vector<RankedPair> others;
  const auto ranked = [](const PlayedWay& way) {
    return RankedPair{way.pair.leave, way.pair.enter, true, way.cost_s, way.cost_s};
  };
  for (std::size_t i = 1; i < rehearsal.ways().size(); ++i) {
    const PlayedWay& way = rehearsal.ways()[i];
    const auto same = [&](const RankedPair& p) { return p.from == way.pair.leave && p.to == way.pair.enter; };
    if (!same(ranked(best)) && std::ranges::none_of(others, same)) others.push_back(ranked(way));
  }
  record.candidates =
      ListCandidates(library, request, rules, ranked(best), std::move(others), CandidateOutcome::kWorse);
  record.why = fmt::format("least cost of the transitions played: {}, joined within {:.2f} s by {}, {:.2f} s in all",
                           DescribePair(library, request, best.pair.leave, best.pair.enter), preferred.blend_s,
                           preferred.fades ? "a fade" : "what was off dying away", best.cost_s);
  return record;
}

}  // namespace etude
