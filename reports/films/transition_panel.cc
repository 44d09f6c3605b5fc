#include "reports/films/transition_panel.h"

#include <fmt/core.h>

#include "reports/films/film.h"
#include "reports/films/look.h"
#include "reports/films/studio.h"
#include "reports/films/transition_plots.h"
#include "reports/words/figures.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

constexpr double kStageDetail = 1.5;
// The camera follows a walking body smoothly: a mean over a second to either side.
constexpr int kFollowFrames = 30;
// Poses change little from one frame to the next: enough to know how much room they need.
constexpr int kLookedAtEvery = 3;

std::vector<FloorMove> PlacementsOf(const TransitionPath& path) {
  const double yaw = -Heading(path.motion.poses[static_cast<std::size_t>(path.FrameAt(0))]);
  const FloorMove turn{yaw, 0, 0};
  std::vector<FloorMove> placements;
  for (const glm::dvec3& followed : FollowedWay(path.motion, kFollowFrames)) {
    const glm::dvec3 turned = turn.Apply(followed);
    placements.push_back({yaw, -turned.x, -turned.z});
  }
  return placements;
}

std::vector<std::vector<FloorMove>> AllPlacements(const TransitionRace& race) {
  std::vector<std::vector<FloorMove>> placements;
  for (const TransitionPath& path : race.paths) placements.push_back(PlacementsOf(path));
  return placements;
}

// How long a change stays marked, and the pose that was left shimmers on.
constexpr int kMarkFrames = kFilmRate / 2, kGhostFrames = kFilmRate;
constexpr double kPanelMargin = 12;
constexpr Paint kPlate{0.13, 0.15, 0.17, 1};
constexpr Paint kVeil{0.078, 0.090, 0.102, 0.6};

}  // namespace

TransitionStage::TransitionStage(const TransitionRace& race, int first, int last, int width, int height)
    : width_(width),
      height_(height),
      bear_(BearCharacter()),
      placements_(AllPlacements(race)),
      studio_(width, height, kStageDetail, SightOf(race, first, last)) {}

Sight TransitionStage::SightOf(const TransitionRace& race, int first, int last) const {
  Sight sight;
  for (std::size_t i = 0; i < race.paths.size(); ++i) {
    for (int time = first; time <= last; time += kLookedAtEvery) {
      const auto frame = static_cast<std::size_t>(race.paths[i].FrameAt(time));
      Studio::Include(Placed(PosedFigure(bear_, race.paths[i].motion.poses[frame]), placements_[i][frame]), sight);
    }
  }
  return sight;
}

ColourImage TransitionStage::Picture(Renderer& renderer, const TransitionPath& path, std::size_t index, int frame,
                                     std::optional<int> ghost) const {
  const FloorMove& placement = placements_[index][static_cast<std::size_t>(frame)];
  const auto placed = [&](int at) {
    return Placed(PosedFigure(bear_, path.motion.poses[static_cast<std::size_t>(at)]), placement);
  };
  std::optional<Mask> shadow;
  if (ghost) shadow = studio_.Silhouette(renderer, placed(*ghost));
  Canvas canvas(width_, height_);
  const Box whole{0, 0, static_cast<double>(width_), static_cast<double>(height_)};
  studio_.Draw(canvas, whole, renderer, placed(frame), placement, shadow ? &*shadow : nullptr);
  return canvas.Pixels();
}

std::string CountdownWords(const std::string& wanted, int time, int last_point, double rate_hz) {
  if (time < 0) return "";
  if (time <= last_point) return fmt::format("{} in {} s", wanted, FormatFixed((last_point - time) / rate_hz, 2));
  return fmt::format("waited {} s", FormatFixed(last_point / rate_hz, 2));
}

Box TransitionPanel::BodyBox(const Box& column) {
  return {column.x, column.y, column.width,
          column.height - kCaptionHeight - kStripHeight - kDistanceBarsHeight - 2 * kGap};
}

// Clips are named by what meets; a recording that does not tell knows the first and the last.
std::string TransitionPanel::ClipAt(int time) const {
  const std::size_t points = path_.PointsBefore(time);
  if (points == 0) return path_.facts.from;
  if (points >= path_.facts.transition_frames.size()) return path_.facts.to;
  const bool is_told = points <= path_.facts.points.size() && !path_.facts.points[points - 1].to.empty();
  return is_told ? path_.facts.points[points - 1].to : "in-between";
}

void TransitionPanel::Draw(Canvas& canvas, const Box& column, Renderer& renderer, int time) {
  const Box body = BodyBox(column);
  DrawBody(canvas, body, renderer, time);
  const Box strip{column.x, body.y + body.height + kCaptionHeight + kGap, column.width, kStripHeight};
  canvas.FillBox(strip, kPlate, kPanelRadius);
  strip_.Draw(canvas, strip, path_, time);
  const Box bars{column.x, strip.y + strip.height + kGap, column.width, kDistanceBarsHeight};
  canvas.FillBox(bars, kPlate, kPanelRadius);
  const std::size_t points = path_.PointsBefore(time);
  DrawDistanceBars(canvas, bars, path_.facts, points > 0 ? std::optional(points - 1) : std::nullopt);
}

void TransitionPanel::DrawBody(Canvas& canvas, const Box& box, Renderer& renderer, int time) {
  const int frame = path_.FrameAt(time);
  const std::size_t points = path_.PointsBefore(time);
  std::optional<int> left;
  if (points > 0) left = path_.facts.transition_frames[points - 1];
  const int since = left ? time - path_.TimeOf(*left) : 0;
  const std::optional<int> ghost = left && since <= kGhostFrames ? left : std::nullopt;
  if (!drawn_ || drawn_->frame != frame || drawn_->ghost != ghost) {
    drawn_ = {frame, ghost, stage_.Picture(renderer, path_, index_, frame, ghost)};
  }
  const bool just_changed = left && since <= kMarkFrames;
  const Box plate{box.x, box.y, box.width, box.height + kCaptionHeight};
  if (just_changed) {
    constexpr double kRim = 3;
    canvas.FillBox({plate.x - kRim, plate.y - kRim, plate.width + 2 * kRim, plate.height + 2 * kRim}, kWarm,
                   kPanelRadius + kRim);
  }
  canvas.FillBox(plate, kPlate, kPanelRadius);
  canvas.DrawImage(drawn_->picture, box, kPanelRadius);
  constexpr double kMarkRoom = 90;
  if (!path_.IsRecordedAt(time)) {
    canvas.FillBox(box, kVeil, kPanelRadius);
    const std::string begin = FormatFixed(path_.TimeOf(0) / path_.motion.rate_hz, 1);
    canvas.DrawText({box.x + 16, box.y + box.height / 2}, fmt::format("recorded from {} s on", begin), 14, kSoftInk,
                    box.width - 32);
  }
  DrawTag(canvas, box, path_.method, kMarkRoom);
  // The method's own colour on the page, beneath its name.
  canvas.FillBox({box.x + 14, box.y + 39, 44, 4}, MethodPaint(path_.method_index), 2);
  if (just_changed) DrawMark(canvas, box, "change");
  DrawWords(canvas, {box.x, box.y + box.height, box.width, kCaptionHeight}, time);
}

void TransitionPanel::DrawWords(Canvas& canvas, const Box& box, int time) const {
  const double room = box.width - 2 * kPanelMargin;
  canvas.DrawDot({box.x + kPanelMargin + 5, box.y + 17}, 5, PaintOfSegment(path_.facts, path_.PointsBefore(time)));
  canvas.DrawText({box.x + kPanelMargin + 18, box.y + 23}, ClipAt(time), 17, kInk, room - 18, true);
  const std::string countdown = CountdownWords(path_.facts.to, time, path_.LastPoint(), path_.motion.rate_hz);
  canvas.DrawText({box.x + kPanelMargin, box.y + 43}, countdown.empty() ? "before the request" : countdown, 14,
                  kSoftInk, room);
}

}  // namespace etude
