#include "reports/films/stage_scene.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/look.h"
#include "io/drawing/studio.h"
#include "reports/films/transition_plots.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

// The visible height in metres. This height is enough for a person with raised arms, and for some floor.
constexpr double kSeenHeight = 2.65;
constexpr double kDistance = 4.2;
constexpr double kEyeHeight = 1.45;
constexpr double kLookAtHeight = 0.94;
// Pictures are rendered larger by this factor and then shrunk, which smooths edges (supersampling) at about half the
// cost of a factor of 2.
constexpr double kCoachDetail = 1.5;
// The camera path is a moving average over this many frames (one second) before and after each frame. While the camera
// stands still, the room is not rendered again.
constexpr int kCoachFollowFrames = 30;
// The smallest distance of the hips from the room's wall, metres.
constexpr double kMinWallDistance = 1.0;
// The film marks the change of moves for kCoachMarkFrames after the transition point. The film shows the partial
// distances from kBarsBefore frames before the point to kBarsAfter frames after the point.
constexpr int kCoachMarkFrames = 15;
constexpr int kBarsBefore = 15, kBarsAfter = 60;
// The width of the distance bars, which are beside the feet, and the height of the bars above the timeline, pixels.
constexpr double kBarsWidth = 320, kBarsLift = 34;

// Moves the motion to the middle of the room. At the transition point, the person faces the camera. The whole motion is
// moved towards the camera until it stays in front of the wall.
void PutOnStage(BodyMotion& motion, int point) {
  const FloorMove move = ToOrigin(motion.poses[static_cast<std::size_t>(point)]);
  double backmost = 0;
  for (BodyPose& pose : motion.poses) {
    pose = move.Apply(pose);
    backmost = std::min(backmost, pose[Role::kHipCentre].z);
  }
  const FloorMove forward{0, 0, std::max(0.0, kWallZ + kMinWallDistance - backmost)};
  for (BodyPose& pose : motion.poses) pose = forward.Apply(pose);
}

Paint Faded(const Paint& paint) { return {paint.r, paint.g, paint.b, 0.55}; }

// The minimum number of frames of the film, enough to watch one change of moves; kLongest is the maximum.
constexpr int kMinFrames = 5 * kFilmRate;
// The number of frames for which a repeated motion shows its last frame before the motion starts again.
constexpr int kRest = kFilmRate / 2;

constexpr Box kCoachBox{12, 52, 1256, 656};

// The frame of the motion that the film shows. A short motion is repeated.
struct Shown {
  int frame;
  bool before;  ///< true: the film has already shown the whole motion at least once
};
Shown ShownAt(int film_frame, int length) {
  const int round = film_frame % (length + kRest);
  return {std::min(round, length - 1), film_frame >= length + kRest};
}

}  // namespace

Result<CoachPanel> CoachPanel::Make(const ShownCell& cell, int longest) {
  ASSIGN_OR_RETURN(auto facts, ReadTransitionFacts(*cell.recording, cell.row->Id()));
  if (facts.transition_frames.empty()) {
    return Fail({.file = "recording " + cell.row->Id()},
                "the extras have no 'transition_frame' that is a whole number within the motion");
  }
  CoachPanel panel;
  panel.bear_ = BearCharacter();
  panel.facts_ = std::move(facts);
  panel.method_ = cell.row->method;
  panel.motion_ = *FindTrack(*cell.recording, "coach");
  panel.CutTo(longest);
  PutOnStage(panel.motion_, panel.FirstPoint());
  panel.followed_ = CameraPath(panel.motion_, kCoachFollowFrames);
  return panel;
}

void CoachPanel::CutTo(int longest) {
  auto& poses = motion_.poses;
  const int count = static_cast<int>(poses.size());
  if (count <= longest) return;
  const int first = std::clamp(FirstPoint() - longest / 2, 0, count - longest);
  poses = {poses.begin() + first, poses.begin() + first + longest};
  for (int& point : facts_.transition_frames) point -= first;
  std::erase_if(facts_.transition_frames, [&](int point) { return point >= longest; });
  if (facts_.request_frame) *facts_.request_frame -= first;
}

std::string CoachPanel::Title() const { return fmt::format("{} → {}, by {}", facts_.from, facts_.to, method_); }

Camera CoachPanel::CameraAt(int frame, double width, double height) const {
  Intrinsics inside;
  inside.width = static_cast<int>(width);
  inside.height = static_cast<int>(height);
  inside.fx = inside.fy = height * kDistance / kSeenHeight;
  inside.cx = width / 2;
  inside.cy = height / 2;
  const glm::dvec3 hips = followed_[static_cast<std::size_t>(frame)];
  const glm::dvec3 target{hips.x, kLookAtHeight, hips.z};
  return LookAt(inside, target + glm::dvec3{0, kEyeHeight - kLookAtHeight, kDistance}, target);
}

void CoachPanel::Draw(Canvas& canvas, const Box& panel, Renderer& renderer, int frame, bool shown_before) const {
  const BodyPose& pose = motion_.poses[static_cast<std::size_t>(frame)];
  const std::vector<Figure> coach{PosedFigure(bear_, pose)};
  const Camera camera = CameraAt(frame, panel.width * kCoachDetail, panel.height * kCoachDetail);
  canvas.DrawImage(renderer.Render(Room{}, coach, camera, Targets::kColour).colour, panel, kPanelRadius);
  DrawTag(canvas, panel, shown_before ? "The coach · shown again" : "The coach");
  const std::string how = facts_.branch.empty() ? method_ : fmt::format("{} · {}", method_, facts_.branch);
  const std::string countdown = CountdownAt(frame);
  DrawCaption(canvas, panel, fmt::format("{}  →  {}", facts_.from, facts_.to),
              fmt::format("changes moves by {}{}{}", how, countdown.empty() ? "" : " · ", countdown), 18);
  DrawTimeline(canvas, panel, frame);
  DrawDistances(canvas, panel, frame);
}

std::string CoachPanel::CountdownAt(int frame) const {
  if (!facts_.request_frame) return "";
  const int request = *facts_.request_frame;
  return CountdownWords(facts_.to, frame - request, facts_.transition_frames.back() - request, motion_.rate_hz);
}

void CoachPanel::DrawTimeline(Canvas& canvas, const Box& panel, int frame) const {
  const double left = panel.x + 16, width = panel.width - 32, y = panel.y + panel.height - 18;
  const double last = std::max(1, Frames() - 1);
  const auto x_of = [&](int at) { return left + width * at / last; };
  const std::vector<int>& points = facts_.transition_frames;
  double from = left;
  for (std::size_t segment = 0; segment <= points.size(); ++segment) {
    const double to = segment < points.size() ? x_of(points[segment]) : left + width;
    canvas.DrawLine({from, y}, {to, y}, 4, Faded(PaintOfSegment(facts_, segment)));
    from = to;
  }
  for (const int point : points) canvas.DrawLine({x_of(point), y - 8}, {x_of(point), y + 8}, 2, kInk);
  if (facts_.request_frame && *facts_.request_frame >= 0) {
    canvas.DrawRing({x_of(std::min(*facts_.request_frame, Frames() - 1)), y}, 5, 2, kInk);
  }
  const auto passed =
      static_cast<std::size_t>(std::ranges::count_if(points, [&](int point) { return point <= frame; }));
  canvas.DrawDot({x_of(frame), y}, 6, PaintOfSegment(facts_, passed));
}

void CoachPanel::DrawDistances(Canvas& canvas, const Box& panel, int frame) const {
  const std::vector<int>& points = facts_.transition_frames;
  const auto is_near = [&](int point) { return frame >= point - kBarsBefore && frame < point + kBarsAfter; };
  const auto near = std::ranges::find_if(points.rbegin(), points.rend(), is_near);
  if (near == points.rend()) return;
  const auto point = static_cast<std::size_t>(points.rend() - near) - 1;
  const Box bars{panel.x + panel.width - kBarsWidth - 12, panel.y + panel.height - kBarsLift - kDistanceBarsHeight,
                 kBarsWidth, kDistanceBarsHeight};
  if (point < facts_.points.size() && facts_.points[point].partials) {
    canvas.FillBox(bars, {0.05, 0.06, 0.07, 0.78}, kPanelRadius);
    DrawDistanceBars(canvas, bars, facts_, point);
  }
  if (frame >= *near && frame < *near + kCoachMarkFrames) DrawMark(canvas, panel, "change");
}

int StageScene::Frames() const { return std::clamp(coach_.Frames(), kMinFrames, kLongest); }

// Returns a frame just after the coach changed moves.
int StageScene::PosterFrame() const { return std::min(coach_.FirstPoint() + 4, Frames() - 1); }

std::string StageScene::Words() const { return fmt::format("The coach changes moves ({}).", coach_.Title()); }

Canvas StageScene::Draw(int frame) {
  Canvas canvas = BeginFrame("a coach changes moves; bars show the distances of the joined frames");
  const Shown shown = ShownAt(frame, coach_.Frames());
  coach_.Draw(canvas, kCoachBox, renderer_, shown.frame, shown.before);
  return canvas;
}

}  // namespace etude
