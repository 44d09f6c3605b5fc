#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude {

/// A moment at which something was done, or was said to be, seconds.
struct Moment {
  std::string move;
  double at_s = 0;
};

struct MomentMatch {
  int matched = 0, points = 0, detections = 0;

  /// 2 matched / (points + detections); nothing when there are neither.
  std::optional<double> FScore() const;
};

/// Which detections are of action points of their move: at most `tolerance_s` away, each point with at most one
/// detection and the other way round; as many pairs as can be. Further detections of the same point are false ones
/// (Fothergill et al. 2012).
MomentMatch MatchMoments(std::span<const Moment> points, std::span<const Moment> detections, double tolerance_s);

/// The mean over the moves that occur of their own F-scores, as MSRC-12's paper gives it.
std::optional<double> MeanFScore(std::span<const Moment> points, std::span<const Moment> detections,
                                 double tolerance_s);

}  // namespace etude
