#pragma once

#include "io/drawing/canvas.h"
#include "reports/films/transition_race.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// A plot of a path's jumps over time (the largest second difference of any joint's position, cm) and of the limit of
/// jumps in natural motion, if this limit is known. Below the curve are the names of the clips that play: the clip that
/// is left, an in-between clip, or the wanted clip. Time is in frames after the request.
class JumpStrip {
 public:
  /// Shows the times `first` … `last`, in frames after the request. The vertical axis ends at `highest_cm` > 0.
  JumpStrip(int first, int last, double highest_cm) : first_(first), last_(last), highest_cm_(highest_cm) {}

  void Draw(Canvas& canvas, const Box& box, const TransitionPath& path, int time) const;

 private:
  struct Frame;
  void DrawClips(Canvas& canvas, const Frame& frame, const TransitionPath& path) const;
  void DrawCurve(Canvas& canvas, const Frame& frame, const TransitionPath& path, int until, const Paint& paint) const;

  int first_, last_;
  double highest_cm_;
};

/// Returns the colour of the clip that plays after the first `points_before` transition points of a path: the clip that
/// is left, an in-between clip, or the wanted clip.
const Paint& PaintOfSegment(const TransitionFacts& facts, std::size_t points_before);

/// The height of the distance bars with their heading, pixels.
constexpr double kDistanceBarsHeight = 120;

/// Draws a transition point's ten partial distances as bars with the features' names. Partial distances are the terms
/// of d², where d is the distance between the two frames that the transition joins. The line above the bars gives d,
/// the threshold and the kind of transition. A partial distance of the squared threshold fills its bar; without a
/// threshold, the largest partial distance fills its bar. `point` is the index of the transition point. The bars are
/// empty if `point` is nullopt, or if the recording has no partial distances. The box is kDistanceBarsHeight high.
void DrawDistanceBars(Canvas& canvas, const Box& box, const TransitionFacts& facts, std::optional<std::size_t> point);

/// Describes a transition point: "distance 0.384 < 0.4 · front half"; if the path has two points, "1 of 2 · distance
/// 0.21 < 0.4 · in-between".
std::string PointWords(const TransitionFacts& facts, std::size_t point);

/// Returns "side kick in 0.34 s" between the request and the start of the wanted clip, and "waited 0.57 s" afterwards;
/// "" before the request. `time` and `last_point` are in frames after the request.
std::string CountdownWords(const std::string& wanted, int time, int last_point, double rate_hz);

}  // namespace etude
