#include "engine/transitions/choices/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/choices/pair_stage.h"

namespace etude {
namespace {

constexpr double kAlwaysUsual = 0.01;  // lowest usual acceleration, metres per frame²: 9 m/s², about free fall
constexpr double kLimbShare = 0.6;     // before the feet are planted, only this share of the limbs' cost counts
constexpr double kUnplanted_s = 0.1;   // cost of a frame in which no foot carries weight (FootPlan)
constexpr double kFloating_s = 6;      // cost of each frame beyond kHop in the longest run without support
constexpr int kHop = 2;
constexpr double kSlides_s = 10;           // cost of one metre that feet slide
constexpr double kBeside_s = 60;           // cost of a zero-moment point one metre too far from the supports, for 1 s
constexpr double kGlides_s = 100;          // cost of one metre that the slowest of the supporting joints glides
constexpr double kTurns_s = 5.73;          // cost of one radian by which the hips turn farther than kEasyTurn
constexpr double kEasyTurn = Radians(30);  // turn against a resting foot that costs nothing
constexpr int kMaxWithFeet = 60;           // maximal number of joins that are played with planted feet

bool IsBetterWay(const PlayedJoin& a, const PlayedJoin& b) {
  const auto key = [](const PlayedJoin& w) { return std::tuple(w.cost_s, w.number, w.frames, w.way, w.carried); };
  return key(a) < key(b);
}

/// A join that has been played partly or completely.
struct OpenWay {
  struct Limbs {
    Limbs(const PairStage& stage, const PlayedJoin& way, double usual, const PlayedRates& rates)
        : shift(way.carried ? stage.ShiftFor(way.frames) : glm::dvec3(0)),
          window(stage.WindowFor(way.frames, shift)),
          meter(window, stage.own(), usual, rates) {
      shown.reserve(window.next.size());
    }

    const glm::dvec3 shift;  // shift of the wanted clip, metres
    const JoinWindow window;
    CostMeter meter;
    std::vector<BodyPose> shown = {};
  };

  bool HasLimbs() const { return limbs && static_cast<int>(limbs->shown.size()) > way.frames; }

  PlayedJoin way;  // the join, with the cost of the frames played so far
  std::unique_ptr<Limbs> limbs = {};
  bool has_feet = false;
};

/// Plays the joins of a request by best-first search.
class Rehearsal {
 public:
  Rehearsal(const MotionLibrary& library, const TransitionRequest& request, const PlayedRates& rates,
            const std::vector<FramePair>& pairs, int last)
      : library_(library),
        playing_(library.motions[request.from]),
        wanted_(library.motions[request.to]),
        request_(request),
        rates_(rates),
        last_(last),
        usual_(std::max(std::min(library.usual_accelerations[request.from], library.usual_accelerations[request.to]),
                        kAlwaysUsual)),
        stages_(pairs.size()) {
    // List all joins of all pairs. The wait plus the join's length is a lower bound of a join's cost.
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (std::size_t length = 0; length < kLengths_s.size(); ++length) {
        const int frames = FramesOf(kLengths_s[length]);
        // Skip joins for which the wanted clip is too short, except joins of the shortest length.
        if (frames > last - pairs[i].enter && length > 0) break;
        for (JoinStyle kind : kWays) {
          for (bool carried : {false, true}) {
            PlayedJoin& way = open_.emplace_back().way;
            way = {.pair = pairs[i], .number = i, .length = length, .frames = frames, .way = kind, .carried = carried};
            way.cost_s = Time(way);
          }
        }
      }
    }
    std::ranges::make_heap(open_, IsLater);
  }

  std::vector<PlayedJoin> Play() {
    std::vector<PlayedJoin> ways;
    // Best-first search: continue the cheapest open join until the cheapest join is complete.
    while (true) {
      std::ranges::pop_heap(open_, IsLater);
      OpenWay& open = open_.back();
      if (open.has_feet || with_feet_ >= kMaxWithFeet) break;
      if (!open.HasLimbs()) {
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
      stage = std::make_unique<PairStage>(library_, request_, way.pair, last_, FramesOf(kLengths_s.back()));
    }
    return *stage;
  }

  /// Plays more frames of a join, without planted feet, until its cost exceeds the next join's cost.
  void PlayLimbs(OpenWay& open, double next_s) {
    PlayedJoin& way = open.way;
    PairStage& stage = StageOf(way);
    if (!open.limbs) open.limbs = std::make_unique<OpenWay::Limbs>(stage, way, usual_, rates_);
    OpenWay::Limbs& limbs = *open.limbs;
    while (!open.HasLimbs() && way.cost_s <= next_s) {
      const int frame = static_cast<int>(limbs.shown.size());
      BodyPose& pose = limbs.shown.emplace_back(stage.LimbsAt(way.length, way.frames, way.way, frame));
      // The shift grows along the minimum-jerk quintic, like the share of the new motion.
      if (way.carried) Shift(Smootherstep(static_cast<double>(frame) / way.frames) * limbs.shift, pose);
      limbs.meter.Add(pose);
      way.cost_s = Time(way) + kLimbShare * limbs.meter.Seconds();
    }
  }

  /// Plays a join with planted feet and adds it to `ways`, unless the join's cost reaches the best join's cost even
  /// without the cost of missing support.
  void PlayFeet(OpenWay& open, std::vector<PlayedJoin>& ways) {
    PlayedJoin& way = open.way;
    PairStage& stage = StageOf(way);
    OpenWay::Limbs& limbs = *open.limbs;
    const FootPlan& plan = stage.StepsIn(limbs.window, way.length, way.carried);
    PlantFeet(limbs.window, plan, limbs.shown);
    CostMeter meter(limbs.window, stage.own(), usual_, rates_);
    for (const BodyPose& pose : limbs.shown) meter.Add(pose);
    way.cost_s = Time(way) + meter.Seconds() + kSlides_s * SlideOf(limbs.shown) + kUnplanted_s * plan.unplanted_frames;
    if (way.cost_s < least_s_) {
      const Burden burden = stage.Rate(limbs.shown, limbs.shift);
      way.unsupported = burden.unsupported;
      way.cost_s += kFloating_s * std::max(way.unsupported - kHop, 0) + kBeside_s * burden.beside +
                    kGlides_s * burden.glide + kTurns_s * std::max(burden.turn - kEasyTurn, 0.0);
      least_s_ = std::min(least_s_, way.cost_s);
      ways.push_back(way);
    }
    open.limbs.reset();
    open.has_feet = true;
    ++with_feet_;
  }

  const MotionLibrary& library_;
  const BodyMotion &playing_, &wanted_;
  const TransitionRequest& request_;
  const PlayedRates& rates_;
  const int last_;
  const double usual_;                                        // calmer clip's usual acceleration, ≥ kAlwaysUsual
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
