#include "engine/transitions/choices/played.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/transitions/choices/planning.h"
#include "engine/transitions/choices/rehearsal.h"

namespace etude {
namespace {

/// An intermediate clip, in which the person stands up or lies down. It is entered from the playing clip and later left
/// for the wanted clip.
struct ThroughClip {
  int clip = 0;            ///< index in the library
  std::vector<int> enter;  ///< the clip's frames that may be entered, ascending; all come before the frames of `leave`
  std::vector<int> leave;  ///< the clip's frames from which the wanted clip may be entered, ascending
};

constexpr double kRunUp_s = 2.5;     // a clip may be entered at most this long before it changes its stance
constexpr double kRunOut_s = 2.5;    // a clip may be left at most this long after it has changed its stance
constexpr double kMinShown_s = 0.3;  // minimum time for which a clip is shown; it equals the shortest join

/// Tests frames of an intermediate clip. `MayEnter`: can an allowed frame of the playing clip lead to this frame?
/// `MayLeave`: can this frame lead to an allowed frame of the wanted clip?
class Ends {
 public:
  Ends(const MotionLibrary& library, const TransitionRequest& request, const AllowedFrames& allowed)
      : library_(library), request_(request), allowed_(allowed) {}

  bool MayEnter(int clip, int frame) const { return Fits(clip, frame, request_.from, allowed_.leave); }
  bool MayLeave(int clip, int frame) const { return Fits(clip, frame, request_.to, allowed_.enter); }

  double NearestEntry(int clip, std::span<const int> frames) const {
    return Nearest(clip, frames, request_.from, allowed_.leave);
  }
  double NearestExit(int clip, std::span<const int> frames) const {
    return Nearest(clip, frames, request_.to, allowed_.enter);
  }

 private:
  bool Fits(int clip, int frame, int other, std::span<const int> others) const {
    const Stance& stance = library_.stances[clip][frame];
    return std::ranges::any_of(others, [&](int o) { return !NeedsClip(stance, library_.stances[other][o]); });
  }

  double Nearest(int clip, std::span<const int> frames, int other, std::span<const int> others) const {
    double least = std::numeric_limits<double>::infinity();
    for (int frame : frames) {
      for (int o : others) {
        least = std::min(least, SquaredDistance(library_.features[clip][frame], library_.features[other][o]));
      }
    }
    return least;
  }

  const MotionLibrary& library_;
  const TransitionRequest& request_;
  const AllowedFrames& allowed_;
};

/// Collects the frames of a clip around a change of stance. The clip may be entered in an unbroken run of frames that
/// ends at `before`, and left in an unbroken run that begins at `after`; `ends` must allow every frame of both runs. At
/// most `most_s` seconds of the clip are shown.
ThroughClip WayAround(const MotionLibrary& library, const Ends& ends, int clip, int before, int after, double most_s) {
  const TaggedClip& tagged = library.tagged[clip];
  const auto frames = [&](double seconds) { return static_cast<int>(std::lround(seconds * tagged.rate_hz)); };
  const int least = frames(kMinShown_s), most = frames(most_s);
  ThroughClip way{.clip = clip, .enter = {}, .leave = {}};
  if (most < least) return way;
  const int last_leave = std::min(after + frames(kRunOut_s), tagged.FrameCount() - 1);
  for (int f = after; f <= last_leave && ends.MayLeave(clip, f); ++f) way.leave.push_back(f);
  for (int f = before; f >= std::max(before - frames(kRunUp_s), 0) && ends.MayEnter(clip, f); --f) {
    if (f + least <= way.leave.back() && way.leave.front() - f <= most) way.enter.push_back(f);
  }
  std::ranges::reverse(way.enter);
  if (!way.enter.empty()) std::erase_if(way.leave, [&](int f) { return f - way.enter.back() > most; });
  return way;
}

/// Searches all clips, including the playing one, for a change of stance. Returns the clip whose frames on both sides
/// of the change are most similar to the allowed frames, by MotionFeatures. NeedsClip must be true for all pairs of
/// `allowed`. Returns nullopt if no clip of the library changes the stance within `most_s` seconds.
std::optional<ThroughClip> FindThroughClip(const MotionLibrary& library, const TransitionRequest& request,
                                           const AllowedFrames& allowed, double most_s) {
  const Ends ends(library, request, allowed);
  std::optional<ThroughClip> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int clip = 0; clip < static_cast<int>(library.motions.size()); ++clip) {
    int before = -1;  // the last frame that may be entered; −1 if there is none, or if WayAround has used this frame
    for (int f = 0; f < library.tagged[clip].FrameCount(); ++f) {
      if (before >= 0 && ends.MayLeave(clip, f)) {
        ThroughClip way = WayAround(library, ends, clip, std::exchange(before, -1), f, most_s);
        if (!way.enter.empty() && !way.leave.empty()) {
          const double distance = ends.NearestEntry(clip, way.enter) + ends.NearestExit(clip, way.leave);
          if (distance < least) nearest = std::move(way);
          least = std::min(least, distance);
        }
      }
      if (ends.MayEnter(clip, f)) before = f;
    }
  }
  return nearest;
}

constexpr int kPairs = 16;          // number of pairs that are played at a time: one for each part (NearestPairs)
constexpr int kRounds = 4;          // maximum number of such sets of pairs (PlayNearestPairs)
constexpr int kFloatingFrames = 4;  // a body that is unsupported for this many consecutive frames floats
constexpr int kMinSpacing = 4;      // minimum distance, in frames of the wanted clip, between the pairs of one part
constexpr std::size_t kMaxCompared = 20'000;  // maximal number of pairs of frames whose features are compared

/// Divides the frames `allowed.leave` into parts, and finds for each part the nearest pair that can be joined without
/// an intermediate clip (NeedsClip), if there is such a pair. If there are more than kMaxCompared pairs, only every
/// `stride`-th frame of the wanted clip is compared as soon as the part has a pair. Pairs close to those in `tried`
/// are skipped.
std::vector<FramePair> NearestPairs(const MotionLibrary& library, const TransitionRequest& request,
                                    const AllowedFrames& allowed, std::span<const FramePair> tried = {}) {
  const auto &playing = library.features[request.from], &next = library.features[request.to];
  const auto &left = library.stances[request.from], &entered = library.stances[request.to];
  const std::size_t stride = allowed.leave.size() * allowed.enter.size() / kMaxCompared + 1;
  const std::size_t parts = std::min<std::size_t>(kPairs, allowed.leave.size());
  std::vector<FramePair> pairs;
  // Divide the frames that may be left into parts; find the nearest pair of each part.
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * allowed.leave.size() / parts, end = (part + 1) * allowed.leave.size() / parts;
    std::optional<FramePair> best;
    double least = std::numeric_limits<double>::infinity();
    // Skip pairs near a pair that was already tried in this part.
    const auto is_tried = [&](int enter) {
      return std::ranges::any_of(tried, [&](const FramePair& pair) {
        return pair.leave >= allowed.leave[begin] && pair.leave <= allowed.leave[end - 1] &&
               std::abs(pair.enter - enter) < kMinSpacing;
      });
    };
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < allowed.enter.size(); ++k) {
        if (best && k % stride != 0) continue;
        const FramePair pair{allowed.leave[i], allowed.enter[k]};
        if (is_tried(pair.enter)) continue;
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

/// Plays the joins of the nearest pairs. As long as the body floats in the best join (kFloatingFrames), also plays the
/// joins of further pairs. Returns the played joins, the best first; an empty list if no pair can be joined.
std::vector<PlayedJoin> PlayNearestPairs(const MotionLibrary& library, const TransitionRequest& request,
                                        const PlayedRates& rates, const AllowedFrames& allowed, int last) {
  std::vector<PlayedJoin> ways;
  std::vector<FramePair> tried;
  for (int round = 0; round < kRounds && (ways.empty() || ways.front().unsupported >= kFloatingFrames); ++round) {
    const std::vector<FramePair> pairs = NearestPairs(library, request, allowed, tried);
    if (pairs.empty()) break;
    const std::vector<PlayedJoin> played = PlayJoins(library, request, rates, pairs, last);
    ways.insert(ways.end(), played.begin(), played.end());
    std::ranges::stable_sort(ways, {}, &PlayedJoin::cost_s);
    tried.insert(tried.end(), pairs.begin(), pairs.end());
  }
  return ways;
}

PlayedRates RatesOf(const PlayedOptions& options) {
  return {.excess_per_s = options.excess_per_s, .invented_per_s = options.invented_per_s};
}

PreferredJoin PreferredOf(const PlayedJoin& way, double rate_hz) {
  return {.blend_s = way.frames / rate_hz, .way = way.way, .carried = way.carried};
}

int LastFrameOf(const MotionLibrary& library, int clip) { return library.tagged[clip].FrameCount() - 1; }

/// Plans a transition through a clip in which the person stands up or lies down, for requests in which no pair of
/// allowed frames can be joined.
TransitionRecord PlanThroughClip(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const PlayedOptions& options, const AllowedFrames& allowed) {
  TransitionRecord record;
  record.request_frame = request.request_frame;
  record.pairs_seen = allowed.Pairs();
  record.cost_unit = "s";
  const Stance &left = library.stances[request.from][allowed.leave.front()],
               &wanted = library.stances[request.to][allowed.enter.front()];
  // Explain why the two clips cannot be joined.
  const auto describe = [&](int clip, const Stance& stance) {
    return fmt::format("in {}, the body {} with the hips at {:.2f} m", library.names[clip],
                       stance.is_down ? "lies, sits or kneels" : "stands", stance.hips);
  };
  const std::string why = fmt::format(
      "{} at every frame where the clip can be left, and {} at every frame where the clip can be entered; no join can "
      "{} a body without support",
      describe(request.from, left), describe(request.to, wanted), wanted.hips > left.hips ? "raise" : "lower");
  // Find a clip that changes the stance.
  const auto through = FindThroughClip(library, request, allowed, options.most_through_s);
  if (!through) {
    record.why = fmt::format("{}; and no clip shows this movement within {:g} s", why, options.most_through_s);
    return record;
  }
  // Choose the join into the intermediate clip.
  const TransitionRequest entering{request.from, request.request_frame, through->clip, request.budget_s};
  const PlayedRates rates = RatesOf(options);
  const PlayedJoin in =
      PlayNearestPairs(library, entering, rates, {allowed.leave, through->enter}, through->leave.back()).front();
  const int entered = in.pair.enter, shown = entered + in.frames;
  const double rate_hz = library.motions[through->clip].rate_hz;
  // Choose the join out of the intermediate clip: after the first join is complete, and before the clip has been shown
  // for `most_through_s`.
  std::vector<int> leave;
  for (int frame : through->leave) {
    const bool is_soon = frame - entered <= options.most_through_s * rate_hz;
    if (frame >= shown && (leave.empty() || is_soon)) leave.push_back(frame);
  }
  const TransitionRequest leaving{through->clip, leave.front(), request.to, request.budget_s};
  const PlayedJoin out =
      PlayNearestPairs(library, leaving, rates, {std::move(leave), allowed.enter}, LastFrameOf(library, request.to))
          .front();
  // Record the three segments and their two joins.
  record.branch = Branch::kInBetween;
  const FramePair &first = in.pair, &second = out.pair;
  record.segments = {
      {.clip = request.from, .first = request.request_frame, .last = first.leave, .own = {}},
      {.clip = through->clip, .first = entered, .last = second.leave, .own = {}, .preferred = PreferredOf(in, rate_hz)},
      {.clip = request.to,
       .first = second.enter,
       .last = LastFrameOf(library, request.to),
       .own = {},
       .preferred = PreferredOf(out, rate_hz)}};
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
        "Acceleration in excess of the acceleration in the clips, in centimetres per frame², that costs as much as one "
        "second of waiting."},
       {"invented_per_s", &PlayedOptions::invented_per_s, 0.01, 1'000'000,
        "Distance from the nearer clip, in centimetres for one second, that costs as much as one second of waiting."},
       {"most_skipped_s", &PlayedOptions::most_skipped_s, 0, 60,
        "Maximum time of the wanted clip that may be skipped, in seconds. At most the first third of the wanted clip "
        "is skipped."},
       {"most_through_s", &PlayedOptions::most_through_s, 0, 60,
        "Maximum time, in seconds, for which an intermediate clip that stands up or lies down is shown."}});
  return kSettings;
}

TransitionRecord PlanPlayed(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const PlayedOptions& options) {
  // Play the joins. If no pair can be joined, go through an intermediate clip.
  const AllowedFrames allowed = AllowedEarlyFrames(library, request, options.most_skipped_s);
  const std::vector<PlayedJoin> ways =
      PlayNearestPairs(library, request, RatesOf(options), allowed, LastFrameOf(library, request.to));
  if (ways.empty()) return PlanThroughClip(library, request, rules, options, allowed);
  // Record the best join, and the best join of each other pair as a candidate.
  const PlayedJoin& best = ways.front();
  TransitionRecord record = DirectTransition(library, request, best.pair.leave, best.pair.enter, rules);
  const PreferredJoin preferred = PreferredOf(best, library.motions[request.from].rate_hz);
  record.segments.back().preferred = preferred;
  record.pairs_seen = record.pairs_matched = allowed.Pairs();
  record.cost_unit = "s";
  std::vector<RankedPair> others;
  const auto ranked = [](const PlayedJoin& way) {
    return RankedPair{way.pair.leave, way.pair.enter, true, way.cost_s, way.cost_s};
  };
  for (const PlayedJoin& way : ways) {
    const auto same = [&](const RankedPair& p) { return p.from == way.pair.leave && p.to == way.pair.enter; };
    if (!same(ranked(best)) && std::ranges::none_of(others, same)) others.push_back(ranked(way));
  }
  record.candidates =
      ListCandidates(library, request, rules, ranked(best), std::move(others), CandidateOutcome::kWorse);
  record.why = fmt::format(
      "the lowest cost among the transitions tried, equal to {:.2f} s of waiting: {}, joined within {:.2f} s by {}",
      best.cost_s, DescribePair(library, request, best.pair.leave, best.pair.enter), preferred.blend_s,
      preferred.way == JoinStyle::kFades ? "a fade" : "minimum-jerk movements");
  return record;
}

}  // namespace etude
