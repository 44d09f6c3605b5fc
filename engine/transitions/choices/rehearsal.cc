#include "engine/transitions/choices/rehearsal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "engine/motion/support.h"
#include "engine/transitions/joins/planted_feet.h"
#include "engine/transitions/joins/splice.h"

namespace etude {
namespace {

constexpr std::array kWays = {JoinStyle::kDirect, JoinStyle::kFades};
constexpr std::array kLengths_s = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.2};
constexpr double kAlwaysUsual = 0.01;  // metres per frame²: 9 m/s², about the acceleration of free fall
constexpr double kLimbShare = 0.6;     // the share of the limbs' cost that counts before the feet are planted
constexpr double kUnplanted_s = 0.1;   // cost of a frame in which no foot bears weight by FootPlan
constexpr double kFloating_s = 6;      // cost of each frame beyond kHop in the longest run without support
constexpr int kHop = 2;
constexpr double kSlid_cm = 10;   // foot slide that costs one second
constexpr int kMaxWithFeet = 60;  // maximal number of joins that are played with planted feet

/// Returns `count` + 1 frames of a clip from frame `first` on; the last frame is repeated after the clip's end.
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

/// Returns the floor move with which the join planted-feet aligns the wanted clip at a pair.
FloorMove FloorMoveOf(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair) {
  const std::size_t aligned = static_cast<std::size_t>(kAlignedSeconds * playing.rate_hz) + 1;
  const auto head = [&](const BodyMotion& clip, int first) {
    return std::span(clip.poses).subspan(first).first(std::min(aligned, clip.poses.size() - first));
  };
  return AlignOnPlantedFeet(head(playing, pair.leave), head(wanted, pair.enter), playing.rate_hz);
}

/// Returns the window of a pair as the join planted-feet would use it; `last` is the last frame of the wanted clip that
/// counts as real.
JoinWindow WindowOfPair(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair,
                        const FloorMove& floor_move, int last, int frames) {
  JoinWindow window{.shown = {FrameBeforeIn(playing, pair.leave), playing.poses[pair.leave]},
                    .target_before = FrameBeforeIn(wanted, pair.enter),
                    .old = FramesFrom(playing, pair.leave, frames),
                    .next = FramesFrom(wanted, pair.enter, frames),
                    .old_frames = std::min(static_cast<int>(playing.poses.size()) - 1 - pair.leave, frames),
                    .next_frames = std::min(last - pair.enter, frames),
                    .rate_hz = playing.rate_hz};
  window.target_before = floor_move.Apply(window.target_before);
  for (BodyPose& pose : window.next) pose = floor_move.Apply(pose);
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

/// The larger of both motions' own second differences, in metres, per frame of the window and per joint. A motion that
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

/// Returns the distance by which both feet slide along the floor from one frame to the next, in metres. The weight of a
/// foot decreases with its height and is 0 from 2.5 cm on (Zhang, Starke, Komura and Saito 2018).
double SlideOf(const BodyPose& here, const BodyPose& after) {
  constexpr double kHeight = 0.025;
  double slid = 0;
  for (const LegRoles& leg : kLegs) {
    const glm::dvec3 way = after[leg.foot] - here[leg.foot];
    slid += std::hypot(way.x, way.z) * std::clamp(2 - std::exp2(here[leg.foot].y / kHeight), 0.0, 1.0);
  }
  return slid;
}

/// Sums up the cost of a join's frames, which are added in order from the transition point on.
class CostMeter {
 public:
  CostMeter(const JoinWindow& window, const OwnAccelerations& own, double usual, const PlayedRates& rates)
      : window_(window), own_(own), usual_(usual), rates_(rates), before_(window.shown.before) {}

  void Add(const BodyPose& shown) {
    if (count_ > 0) {
      const std::size_t f = count_ - 1;  // index of `here_`, whose two neighbours are known now
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        const double jump = glm::length(SecondDifferenceOf(before_, here_, shown, j));
        worst_excess_ = std::max(worst_excess_, jump - std::max(own_[f][j], usual_));
      }
      slid_ += SlideOf(here_, shown);
      if (f > 0) off_ += std::sqrt(std::min(SquaredOff(here_, window_.old[f]), SquaredOff(here_, window_.next[f])));
      before_ = here_;
    }
    here_ = shown;
    ++count_;
  }

  /// Returns the cost in seconds of the frames added so far, without foot slide; it never decreases.
  double Seconds() const {
    return kCm * (worst_excess_ / rates_.excess_per_s + off_ / window_.rate_hz / rates_.invented_per_s);
  }
  double SecondsWithFeet() const { return Seconds() + kCm * slid_ / kSlid_cm; }

 private:
  static constexpr double kCm = 100;
  const JoinWindow& window_;
  const OwnAccelerations& own_;
  const double usual_;  // MotionLibrary::usual_accelerations of the calmer clip
  const PlayedRates& rates_;
  BodyPose before_, here_;
  std::size_t count_ = 0;
  double worst_excess_ = 0;  // the largest second difference of any joint beyond the motions' own, metres
  double off_ = 0;           // deviation from the nearer clip, metres, summed over the frames
  double slid_ = 0;          // foot slide, metres
};

/// The number of frames before and after a join in which support contacts are searched, as in FindSupport.
constexpr int kAround = 30;

/// Holds the data that all joins of one pair share.
class PairStage {
 public:
  PairStage(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair, int last, int frames)
      : PairStage(playing, wanted, pair, FloorMoveOf(playing, wanted, pair), last, frames) {}
  PairStage(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair, const FloorMove& floor_move,
            int last, int frames)
      : window(WindowOfPair(playing, wanted, pair, floor_move, last, frames)),
        own(OwnOf(window)),
        turns(window),
        before_(std::min(pair.leave, kAround)) {
    const auto around = [&](const BodyMotion& clip, int first, int count) {
      const std::size_t begin = static_cast<std::size_t>(first), most = clip.poses.size() - begin;
      return std::span(clip.poses).subspan(begin, std::min(static_cast<std::size_t>(count), most));
    };
    // Prepare the search for support on both clips around the join.
    playing_ = around(playing, pair.leave - before_, before_ + frames + kAround);
    for (const BodyPose& pose : around(wanted, pair.enter, frames + kAround)) wanted_.push_back(floor_move.Apply(pose));
    const std::array clips = {SupportingClip{.poses = playing_, .begin = 0, .left_at = before_},
                              SupportingClip{.poses = wanted_, .begin = before_}};
    support_finder_.emplace(clips, playing.rate_hz);
  }
  PairStage(const PairStage&) = delete;
  PairStage& operator=(const PairStage&) = delete;

  /// Returns the length of the longest run of frames without support if the join shows `played`.
  int Unsupported(std::span<const BodyPose> played) const {
    std::vector<BodyPose> shown(playing_.begin(), playing_.begin() + before_);
    shown.insert(shown.end(), played.begin(), played.end());
    for (std::size_t f = played.size(); f < wanted_.size(); ++f) shown.push_back(wanted_[f]);
    const int last = std::min(before_ + window.Frames(), static_cast<int>(shown.size()) - 1);
    int run = 0, longest = 0;
    for (const Support& support : support_finder_->Find(shown, before_, last)) {
      run = support.Holds() ? 0 : run + 1;
      longest = std::max(longest, run);
    }
    return longest;
  }

  const JoinWindow window;  ///< of the longest join
  const OwnAccelerations own;
  WindowTurns turns;

 private:
  const int before_;                             // number of frames of `playing_` before the pair's frame
  std::span<const BodyPose> playing_;            // the playing clip around the join
  std::vector<BodyPose> wanted_;                 // the wanted clip from the pair's frame on, aligned on the floor
  std::optional<SupportFinder> support_finder_;  // in both clips
};

bool IsBetterWay(const PlayedJoin& a, const PlayedJoin& b) {
  return std::tuple(a.cost_s, a.number, a.frames, a.way) < std::tuple(b.cost_s, b.number, b.frames, b.way);
}

/// A join that has been played partly or completely.
struct OpenWay {
  struct Limbs {
    MinimumJerkPlay play;
    CostMeter meter;
    int shown = 0;  // number of frames played
  };

  PlayedJoin way;  // its cost is that of the frames played so far
  std::unique_ptr<Limbs> limbs = {};
  bool has_feet = false;
};

/// Plays the joins of a request by best-first search.
class Rehearsal {
 public:
  Rehearsal(const MotionLibrary& library, const TransitionRequest& request, const PlayedRates& rates,
            const std::vector<FramePair>& pairs, int last)
      : playing_(library.motions[request.from]),
        wanted_(library.motions[request.to]),
        request_(request),
        rates_(rates),
        last_(last),
        usual_(std::max(std::min(library.usual_accelerations[request.from], library.usual_accelerations[request.to]),
                        kAlwaysUsual)),
        stages_(pairs.size()) {
    // List all joins of all pairs, with their time as a lower bound of the cost.
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (double length : kLengths_s) {
        const int frames = FramesOf(length);
        // A join should end before the wanted clip does.
        if (frames > last - pairs[i].enter && length > kLengths_s.front()) break;
        for (JoinStyle kind : kWays) {
          PlayedJoin& way = open_.emplace_back().way;
          way = {.pair = pairs[i], .number = i, .frames = frames, .way = kind};
          way.cost_s = Time(way);
        }
      }
    }
    std::ranges::make_heap(open_, IsLater);
  }

  std::vector<PlayedJoin> Play() {
    std::vector<PlayedJoin> ways;
    // Expand the cheapest open join until the cheapest one is complete.
    while (true) {
      std::ranges::pop_heap(open_, IsLater);
      OpenWay& open = open_.back();
      if (open.has_feet || with_feet_ >= kMaxWithFeet) break;
      if (!open.limbs || open.limbs->shown <= open.way.frames) {
        PlayLimbs(open, open_.size() > 1 ? open_.front().way.cost_s : std::numeric_limits<double>::infinity());
      } else {
        PlayFeet(open, ways);
      }
      std::ranges::push_heap(open_, IsLater);
    }
    std::ranges::sort(ways, IsBetterWay);
    return ways;
  }

 private:
  static bool IsLater(const OpenWay& a, const OpenWay& b) { return IsBetterWay(b.way, a.way); }

  int FramesOf(double seconds) const { return static_cast<int>(std::lround(seconds * playing_.rate_hz)); }
  double Time(const PlayedJoin& way) const {
    return (way.pair.leave - request_.request_frame + way.frames) / playing_.rate_hz;
  }

  PairStage& StageOf(const PlayedJoin& way) {
    std::unique_ptr<PairStage>& stage = stages_[way.number];
    if (!stage) {
      stage = std::make_unique<PairStage>(playing_, wanted_, way.pair, last_, FramesOf(kLengths_s.back()));
    }
    return *stage;
  }

  /// Plays more frames of a join without planted feet until it costs more than the next one.
  void PlayLimbs(OpenWay& open, double next_s) {
    PlayedJoin& way = open.way;
    if (!open.limbs) {
      PairStage& stage = StageOf(way);
      open.limbs.reset(new OpenWay::Limbs{.play = {stage.window, stage.turns, way.frames, way.way},
                                          .meter = {stage.window, stage.own, usual_, rates_}});
    }
    OpenWay::Limbs& limbs = *open.limbs;
    while (limbs.shown <= way.frames && way.cost_s <= next_s) {
      limbs.meter.Add(limbs.play.At(limbs.shown++));
      way.cost_s = Time(way) + kLimbShare * limbs.meter.Seconds();
    }
  }

  /// Plays a join with planted feet and adds it to `ways`, unless it already costs as much as the best without
  /// support.
  void PlayFeet(OpenWay& open, std::vector<PlayedJoin>& ways) {
    PlayedJoin& way = open.way;
    const PairStage& stage = StageOf(way);
    const JoinWindow window = Shortened(stage.window, way.frames);
    std::vector<BodyPose> played;
    for (int frame = 0; frame <= way.frames; ++frame) played.push_back(open.limbs->play.At(frame));
    const int planned = PlantFeet(window, played);
    CostMeter meter(window, stage.own, usual_, rates_);
    for (const BodyPose& pose : played) meter.Add(pose);
    way.cost_s = Time(way) + meter.SecondsWithFeet() + kUnplanted_s * planned;
    open.limbs.reset();
    open.has_feet = true;
    ++with_feet_;
    if (way.cost_s >= least_s_) return;
    way.unsupported = stage.Unsupported(played);
    way.cost_s += kFloating_s * std::max(way.unsupported - kHop, 0);
    least_s_ = std::min(least_s_, way.cost_s);
    ways.push_back(way);
  }

  const BodyMotion &playing_, &wanted_;
  const TransitionRequest& request_;
  const PlayedRates& rates_;
  const int last_;
  const double usual_;                                        // MotionLibrary::usual_accelerations of the calmer clip
  std::vector<std::unique_ptr<PairStage>> stages_;            // one per pair, created on first use
  std::vector<OpenWay> open_;                                 // a heap, the cheapest first
  int with_feet_ = 0;                                         // number of joins played with planted feet
  double least_s_ = std::numeric_limits<double>::infinity();  // lowest cost of the joins with planted feet
};

}  // namespace

std::vector<PlayedJoin> PlayJoins(const MotionLibrary& library, const TransitionRequest& request,
                                const PlayedRates& rates, const std::vector<FramePair>& pairs, int last) {
  return Rehearsal(library, request, rates, pairs, last).Play();
}

}  // namespace etude
