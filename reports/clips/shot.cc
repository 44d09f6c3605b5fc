#include "reports/clips/shot.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "reports/films/followed_way.h"
#include "reports/films/look.h"

namespace etude {
namespace {

constexpr double kDot = 0.012;  // of the picture's height

double TurnFor(Viewpoint from) {
  switch (from) {
    case Viewpoint::kFront:
      return 0;
    case Viewpoint::kThreeQuarter:
      return Radians(40);
    case Viewpoint::kSide:
      break;
  }
  return Radians(90);
}

}  // namespace

Shot::Shot(ClipActor actor, Viewpoint from, int smoothing) : actor_(std::move(actor)) {
  const BodyMotion& motion = actor_.motion();
  const FloorMove turn{TurnFor(from) - Heading(motion.poses.front()), 0, 0};
  for (const glm::dvec3& followed : FollowedWay(motion, smoothing)) {
    const glm::dvec3 turned = turn.Apply(followed);
    placements_.push_back({turn.yaw, -turned.x, -turned.z});
  }
}

Figure Shot::PlacedFigure(int frame) const {
  return Placed(actor_.FigureAt(static_cast<std::size_t>(frame)), PlacementAt(frame));
}

void Shot::Include(const std::vector<int>& frames, Sight& sight) const {
  for (const int frame : frames) Studio::Include(PlacedFigure(frame), sight);
}

void Shot::Draw(Canvas& canvas, const Box& box, const Studio& studio, Renderer& renderer, int frame) const {
  const FloorMove& placement = PlacementAt(frame);
  studio.Draw(canvas, box, renderer, PlacedFigure(frame), placement);
  const BodyPose& pose = actor_.motion().poses[static_cast<std::size_t>(frame)];
  for (const Role left : {Role::kLeftHand, Role::kLeftFoot}) {
    canvas.DrawDot(studio.PixelOf(box, placement.Apply(pose[left])), kDot * box.height, kAccent);
  }
}

std::vector<int> SpreadFrames(const Shot& shot, int count) {
  const int shown = std::min(count, shot.Frames());
  std::vector<int> frames;
  for (int i = 0; i < shown; ++i) {
    const double part = shown > 1 ? static_cast<double>(i) / (shown - 1) : 0;
    frames.push_back(static_cast<int>(std::lround(part * (shot.Frames() - 1))));
  }
  return frames;
}

void DrawLegend(Canvas& canvas, double right, double baseline) {
  const std::string words = "left hand and foot";
  constexpr double kSize = 13;
  const double width = canvas.TextWidth(words, kSize);
  canvas.DrawText({right - width, baseline}, words, kSize, kSoftInk, width + 1);
  canvas.DrawDot({right - width - 10, baseline - 4.5}, 4, kAccent);
}

}  // namespace etude
