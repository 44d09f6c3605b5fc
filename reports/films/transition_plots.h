#pragma once

#include "io/drawing/canvas.h"
#include "reports/films/transition_race.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// A strip that shows the jumps of a path over time: the largest second difference of any joint (cm), with the limit of
/// natural motion where it is known. Below the curve, it names the clip that plays: the clip left, an in-between, or
/// the clip wanted. Time is in frames after the request.
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

/// Returns the colour of the clip that plays after `points_before` transition points of a path: the clip left, an
/// in-between, or the clip wanted.
const Paint& PaintOfSegment(const TransitionFacts& facts, std::size_t points_before);

/// The height of the distance bars with their heading, pixels.
constexpr double kDistanceBarsHeight = 120;

/// Draws the ten partial distances between the two frames of a transition point as bars with the features' names. The
/// line above the bars gives the distance d, the threshold and the branch. A full bar means that this partial distance
/// alone reaches the threshold. `point` counts from 0. Before the first transition point, and if the recording has no
/// distances, the bars are empty. The box is kDistanceBarsHeight high.
void DrawDistanceBars(Canvas& canvas, const Box& box, const TransitionFacts& facts, std::optional<std::size_t> point);

/// Describes a transition point: "distance 0.384 < 0.4 · front half"; if the path has two points, "1 of 2 · distance
/// 0.21 < 0.4 · in-between".
std::string PointWords(const TransitionFacts& facts, std::size_t point);

/// Returns "side kick in 0.34 s" from the request until the wanted clip starts, and "waited 0.57 s" from then on; ""
/// before the request. `time` and `last_point` are in frames after the request.
std::string CountdownWords(const std::string& wanted, int time, int last_point, double rate_hz);

}  // namespace etude
