#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "reports/clips/clip_actor.h"
#include "reports/films/canvas.h"
#include "reports/films/studio.h"

namespace etude {

/// From where a clip is seen: as its first frame faces the camera, or turned by a half-right angle, or to the side.
enum class Viewpoint { kFront, kThreeQuarter, kSide };

/// A clip before the camera: who is seen, and where it is put in every frame.
class Shot {
 public:
  /// `smoothing` as for FollowedWay: 0 keeps a walker in the middle of every picture.
  Shot(ClipActor actor, Viewpoint from, int smoothing);

  const ClipActor& actor() const { return actor_; }
  int Frames() const { return static_cast<int>(placements_.size()); }
  double SecondsAt(int frame) const { return frame / actor_.motion().rate_hz; }

  const FloorMove& PlacementAt(int frame) const { return placements_[static_cast<std::size_t>(frame)]; }
  Figure PlacedFigure(int frame) const;

  /// Makes `sight` hold these frames' figures.
  void Include(const std::vector<int>& frames, Sight& sight) const;
  /// Draws a frame, with a dot on the left hand and the left foot.
  void Draw(Canvas& canvas, const Box& box, const Studio& studio, Renderer& renderer, int frame) const;

 private:
  ClipActor actor_;
  std::vector<FloorMove> placements_;
};

/// `count` frames evenly over a shot, first and last among them; fewer when it has fewer.
std::vector<int> SpreadFrames(const Shot& shot, int count);

/// Says what the dots of Shot::Draw mean; `right` is where the words end.
void DrawLegend(Canvas& canvas, double right, double baseline);

}  // namespace etude
