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

constexpr std::array kWays = {JoinWay::kDirect, JoinWay::kFades};
constexpr std::array kLengths_s = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.2};
constexpr double kAlwaysUsual = 0.01;  // metres per frame²: 9 m/s², as of what falls
constexpr double kLimbsShare = 0.6;    // of the cost of limbs, before a way is played with its feet
constexpr double kPlanned_s = 0.1;     // what a frame costs in which no foot bears by FootPlan
constexpr double kFloating_s = 6;      // what each frame costs, beyond kHop of the most in a row that nothing holds up
constexpr int kHop = 2;
constexpr double kSlid_cm = 10;    // so far feet may slide for a second
constexpr int kMostWithFeet = 60;  // ways that are played with their feet

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

/// Returns where the join planted-feet lays the wanted clip at a pair.
FloorMove PlaceOf(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair) {
  const std::size_t aligned = static_cast<std::size_t>(kAlignedSeconds * playing.rate_hz) + 1;
  const auto head = [&](const BodyMotion& clip, int first) {
    return std::span(clip.poses).subspan(first).first(std::min(aligned, clip.poses.size() - first));
  };
  return AlignOnPlantedFeet(head(playing, pair.leave), head(wanted, pair.enter), playing.rate_hz);
}

/// The window of a pair as the join planted-feet would have it; of the wanted clip the frames up to `last` are real.
JoinWindow WindowOfPair(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair,
                        const FloorMove& place, int last, int frames) {
  JoinWindow window{.shown = {FrameBeforeIn(playing, pair.leave), playing.poses[pair.leave]},
                    .target_before = FrameBeforeIn(wanted, pair.enter),
                    .old = FramesFrom(playing, pair.leave, frames),
                    .next = FramesFrom(wanted, pair.enter, frames),
                    .old_frames = std::min(static_cast<int>(playing.poses.size()) - 1 - pair.leave, frames),
                    .next_frames = std::min(last - pair.enter, frames),
                    .rate_hz = playing.rate_hz};
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

/// Returns how far both feet slide along the floor from one frame to the next, metres: less the higher they are, and a
/// foot 2.5 cm up does so no more (Zhang, Starke, Komura and Saito 2018).
double SlideOf(const BodyPose& here, const BodyPose& after) {
  constexpr double kHeight = 0.025;
  double slid = 0;
  for (const LegRoles& leg : kLegs) {
    const glm::dvec3 way = after[leg.foot] - here[leg.foot];
    slid += std::hypot(way.x, way.z) * std::clamp(2 - std::exp2(here[leg.foot].y / kHeight), 0.0, 1.0);
  }
  return slid;
}

/// Adds up what the frames of a join cost, in their order, the one at the point first.
class CostMeter {
 public:
  CostMeter(const JoinWindow& window, const OwnAccelerations& own, double usual, const PlayedRates& rates)
      : window_(window), own_(own), usual_(usual), rates_(rates), before_(window.shown.before) {}

  void Add(const BodyPose& shown) {
    if (count_ > 0) {
      const std::size_t f = count_ - 1;  // of `here_`, whose neighbours are known now
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

  /// Returns the cost of the frames added so far but for their feet, seconds; it never becomes less.
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
  double off_ = 0;           // metres, summed over the frames
  double slid_ = 0;          // likewise
};

/// The clips are asked what the body may rest on for so many frames before and after a join, as FindSupport looks.
constexpr int kAround = 30;

/// Holds what the ways of one pair have in common.
class PairStage {
 public:
  PairStage(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair, int last, int frames)
      : PairStage(playing, wanted, pair, PlaceOf(playing, wanted, pair), last, frames) {}
  PairStage(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair, const FloorMove& place,
            int last, int frames)
      : window(WindowOfPair(playing, wanted, pair, place, last, frames)),
        own(OwnOf(window)),
        turns(window),
        before_(std::min(pair.leave, kAround)) {
    const auto around = [&](const BodyMotion& clip, int first, int count) {
      const std::size_t begin = static_cast<std::size_t>(first), most = clip.poses.size() - begin;
      return std::span(clip.poses).subspan(begin, std::min(static_cast<std::size_t>(count), most));
    };
    playing_ = around(playing, pair.leave - before_, before_ + frames + kAround);
    for (const BodyPose& pose : around(wanted, pair.enter, frames + kAround)) wanted_.push_back(place.Apply(pose));
    const std::array clips = {SupportingClip{.poses = playing_, .begin = 0, .left_at = before_},
                              SupportingClip{.poses = wanted_, .begin = before_}};
    holds_.emplace(clips, playing.rate_hz);
  }
  PairStage(const PairStage&) = delete;
  PairStage& operator=(const PairStage&) = delete;

  /// Returns of how many frames in a row, at most, nothing holds up a join that shows these.
  int Unsupported(std::span<const BodyPose> played) const {
    std::vector<BodyPose> shown(playing_.begin(), playing_.begin() + before_);
    shown.insert(shown.end(), played.begin(), played.end());
    for (std::size_t f = played.size(); f < wanted_.size(); ++f) shown.push_back(wanted_[f]);
    const int last = std::min(before_ + window.Frames(), static_cast<int>(shown.size()) - 1);
    int run = 0, longest = 0;
    for (const Support& support : holds_->Find(shown, before_, last)) {
      run = support.Holds() ? 0 : run + 1;
      longest = std::max(longest, run);
    }
    return longest;
  }

  const JoinWindow window;  ///< of the longest join
  const OwnAccelerations own;
  WindowTurns turns;

 private:
  const int before_;                    // frames of `playing_` before the pair's
  std::span<const BodyPose> playing_;   // the playing clip about the join
  std::vector<BodyPose> wanted_;        // the wanted clip from the pair's frame on, in its place
  std::optional<SupportFinder> holds_;  // by both
};

bool IsBetterWay(const PlayedWay& a, const PlayedWay& b) {
  return std::tuple(a.cost_s, a.number, a.frames, a.way) < std::tuple(b.cost_s, b.number, b.frames, b.way);
}

/// A way that is played as far as it is worth it.
struct OpenWay {
  struct Limbs {
    MinimumJerkPlay play;
    CostMeter meter;
    int shown = 0;  // frames
  };

  PlayedWay way;  // its cost is that of what was played
  std::unique_ptr<Limbs> limbs = {};
  bool has_feet = false;
};

/// Plays the ways of a request, the cheapest first.
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
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (double length : kLengths_s) {
        const int frames = FramesOf(length);
        // The wanted clip should be there before it ends.
        if (frames > last - pairs[i].enter && length > kLengths_s.front()) break;
        for (JoinWay kind : kWays) {
          PlayedWay& way = open_.emplace_back().way;
          way = {.pair = pairs[i], .number = i, .frames = frames, .way = kind};
          way.cost_s = Time(way);
        }
      }
    }
    std::ranges::make_heap(open_, IsLater);
  }

  std::vector<PlayedWay> Play() {
    std::vector<PlayedWay> ways;
    while (true) {
      std::ranges::pop_heap(open_, IsLater);
      OpenWay& open = open_.back();
      if (open.has_feet || with_feet_ >= kMostWithFeet) break;
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
  double Time(const PlayedWay& way) const {
    return (way.pair.leave - request_.request_frame + way.frames) / playing_.rate_hz;
  }

  PairStage& StageOf(const PlayedWay& way) {
    std::unique_ptr<PairStage>& stage = stages_[way.number];
    if (!stage) {
      stage = std::make_unique<PairStage>(playing_, wanted_, way.pair, last_, FramesOf(kLengths_s.back()));
    }
    return *stage;
  }

  /// Plays a way on without its feet until it costs more than the next one.
  void PlayLimbs(OpenWay& open, double next_s) {
    PlayedWay& way = open.way;
    if (!open.limbs) {
      PairStage& stage = StageOf(way);
      open.limbs.reset(new OpenWay::Limbs{.play = {stage.window, stage.turns, way.frames, way.way},
                                          .meter = {stage.window, stage.own, usual_, rates_}});
    }
    OpenWay::Limbs& limbs = *open.limbs;
    while (limbs.shown <= way.frames && way.cost_s <= next_s) {
      limbs.meter.Add(limbs.play.At(limbs.shown++));
      way.cost_s = Time(way) + kLimbsShare * limbs.meter.Seconds();
    }
  }

  /// Plays a way with its feet, and adds it to `ways`; what holds it up is not asked once it costs more than another.
  void PlayFeet(OpenWay& open, std::vector<PlayedWay>& ways) {
    PlayedWay& way = open.way;
    const PairStage& stage = StageOf(way);
    const JoinWindow window = Shortened(stage.window, way.frames);
    std::vector<BodyPose> played;
    for (int frame = 0; frame <= way.frames; ++frame) played.push_back(open.limbs->play.At(frame));
    const int planned = PlantFeet(window, played);
    CostMeter meter(window, stage.own, usual_, rates_);
    for (const BodyPose& pose : played) meter.Add(pose);
    way.cost_s = Time(way) + meter.SecondsWithFeet() + kPlanned_s * planned;
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
  std::vector<std::unique_ptr<PairStage>> stages_;            // of the pairs, made when first asked for
  std::vector<OpenWay> open_;                                 // a heap, the cheapest first
  int with_feet_ = 0;                                         // ways
  double least_s_ = std::numeric_limits<double>::infinity();  // of the ways with feet
};

}  // namespace

std::vector<PlayedWay> PlayWays(const MotionLibrary& library, const TransitionRequest& request,
                                const PlayedRates& rates, const std::vector<FramePair>& pairs, int last) {
  return Rehearsal(library, request, rates, pairs, last).Play();
}

}  // namespace etude
