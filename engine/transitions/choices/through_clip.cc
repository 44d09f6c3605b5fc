#include "engine/transitions/choices/through_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace etude {
namespace {

constexpr double kRunUp_s = 2.5;   // so long before it changes its stance a clip may be entered
constexpr double kRunOut_s = 2.5;  // and so long after it be left
constexpr double kLeast_s = 0.3;   // of it is shown: the shortest join

/// The frames of one clip that a request may use, seen from both of its ends.
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

/// The way of a clip whose frame `before` may be entered, and whose later frame `after` may be left: the frames up to
/// the one and on from the other, as far as they, too, may be.
ThroughClip WayAround(const MotionLibrary& library, const Ends& ends, int clip, int before, int after, double most_s) {
  const TaggedClip& tagged = library.tagged[clip];
  const auto frames = [&](double seconds) { return static_cast<int>(std::lround(seconds * tagged.rate_hz)); };
  const int least = frames(kLeast_s), most = frames(most_s);
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

}  // namespace

std::optional<ThroughClip> FindThroughClip(const MotionLibrary& library, const TransitionRequest& request,
                                           const AllowedFrames& allowed, double most_s) {
  const Ends ends(library, request, allowed);
  std::optional<ThroughClip> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int clip = 0; clip < static_cast<int>(library.motions.size()); ++clip) {
    int before = -1;  // the last frame that may be entered, none since one could be left
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

}  // namespace etude
