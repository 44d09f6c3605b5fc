#include "reports/films/transition_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/drawing/look.h"
#include "reports/transitions/transition_section.h"
#include "reports/words/figures.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

constexpr double kStageDetail = 1.5;
// The camera follows the moving average of a walking body over this many frames (one second) before and after each
// frame.
constexpr int kFollowFrames = 30;
// Poses change little from frame to frame, so every n-th frame is enough to find the space that the camera must see.
constexpr int kLookedAtEvery = 3;

std::vector<FloorMove> PlacementsOf(const TransitionPath& path) {
  const double yaw = -Heading(path.motion.poses[static_cast<std::size_t>(path.FrameAt(0))]);
  const FloorMove turn{yaw, 0, 0};
  std::vector<FloorMove> placements;
  for (const glm::dvec3& followed : CameraPath(path.motion, kFollowFrames)) {
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

// After a transition, the film marks the transition for kMarkFrames frames. For kGhostFrames frames it shows, as a
// ghost, the last pose before the transition.
constexpr int kMarkFrames = kFilmRate / 2, kGhostFrames = kFilmRate;
constexpr double kPanelMargin = 12;
constexpr Paint kPlate{0.13, 0.15, 0.17, 1};
constexpr Paint kPanelVeil{0.078, 0.090, 0.102, 0.6};

constexpr double kLeft = 12, kTop = 52, kBottom = 12, kBetween = 10;

Box Column(std::size_t index, std::size_t count) {
  const double columns = static_cast<double>(count);
  const double width = (kFilmWidth - 2 * kLeft - (columns - 1) * kBetween) / columns;
  return {kLeft + static_cast<double>(index) * (width + kBetween), kTop, width, kFilmHeight - kTop - kBottom};
}

TransitionStage StageFor(const TransitionRace& race, const TransitionClock& clock) {
  const Box body = TransitionPanel::BodyBox(Column(0, race.paths.size()));
  return {race, clock.First(), clock.Last(), static_cast<int>(body.width), static_cast<int>(body.height)};
}

// Returns the largest jump of all methods. The plots of all methods use this jump as their scale, so that jumps can be
// compared across columns.
double HighestJump(const TransitionRace& race, const TransitionClock& clock) {
  double highest = 1;
  for (const TransitionPath& path : race.paths) {
    for (int time = clock.First(); time <= clock.Last(); ++time) {
      highest = std::max(highest, path.jumps_cm[static_cast<std::size_t>(path.FrameAt(time))]);
    }
    highest = std::max(highest, path.facts.natural_limit_cm.value_or(0));
  }
  return highest;
}

}  // namespace

TransitionStage::TransitionStage(const TransitionRace& race, int first, int last, int width, int height)
    : width_(width),
      height_(height),
      bear_(BearCharacter()),
      placements_(AllPlacements(race)),
      studio_(width, height, kStageDetail, BoundsOf(race, first, last)) {}

ViewBounds TransitionStage::BoundsOf(const TransitionRace& race, int first, int last) const {
  ViewBounds bounds;
  for (std::size_t i = 0; i < race.paths.size(); ++i) {
    for (int time = first; time <= last; time += kLookedAtEvery) {
      const auto frame = static_cast<std::size_t>(race.paths[i].FrameAt(time));
      Studio::Include(Placed(PosedFigure(bear_, race.paths[i].motion.poses[frame]), placements_[i][frame]), bounds);
    }
  }
  return bounds;
}

Image<std::uint32_t> TransitionStage::Picture(Renderer& renderer, const TransitionPath& path, std::size_t index,
                                              int frame, std::optional<int> ghost) const {
  const FloorMove& placement = placements_[index][static_cast<std::size_t>(frame)];
  const auto placed = [&](int at) {
    return Placed(PosedFigure(bear_, path.motion.poses[static_cast<std::size_t>(at)], true), placement);
  };
  std::optional<Mask> shadow;
  if (ghost) shadow = studio_.Silhouette(renderer, placed(*ghost));
  Canvas canvas(width_, height_);
  const Box whole{0, 0, static_cast<double>(width_), static_cast<double>(height_)};
  studio_.Draw(canvas, whole, renderer, placed(frame), placement, shadow ? &*shadow : nullptr);
  return canvas.Copy();
}

Box TransitionPanel::BodyBox(const Box& column) {
  return {column.x, column.y, column.width,
          column.height - kCaptionHeight - kStripHeight - kDistanceBarsHeight - 2 * kGap};
}

// Returns the name of the clip that plays at a time. A clip between two transition points has the name in the
// recording, or "in-between" if the recording gives none.
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
  // For one second after a transition, show, as a ghost, the last pose before the transition.
  std::optional<int> left;
  if (points > 0) left = path_.facts.transition_frames[points - 1];
  const int since = left ? time - path_.TimeOf(*left) : 0;
  const std::optional<int> ghost = left && since <= kGhostFrames ? left : std::nullopt;
  if (!drawn_ || drawn_->frame != frame || drawn_->ghost != ghost) {
    drawn_ = {frame, ghost, stage_.Picture(renderer, path_, index_, frame, ghost)};
  }
  // Mark a recent transition with a bright rim.
  const bool just_changed = left && since <= kMarkFrames;
  const Box plate{box.x, box.y, box.width, box.height + kCaptionHeight};
  if (just_changed) {
    constexpr double kRim = 3;
    canvas.FillBox({plate.x - kRim, plate.y - kRim, plate.width + 2 * kRim, plate.height + 2 * kRim}, kWarm,
                   kPanelRadius + kRim);
  }
  canvas.FillBox(plate, kPlate, kPanelRadius);
  canvas.Put(drawn_->picture, static_cast<int>(box.x), static_cast<int>(box.y), kPanelRadius);
  constexpr double kMarkRoom = 112;
  // Dim the picture until the recording begins.
  if (!path_.IsRecordedAt(time)) {
    canvas.FillBox(box, kPanelVeil, kPanelRadius);
    const std::string begin = FormatFixed(path_.TimeOf(0) / path_.motion.rate_hz, 1);
    canvas.DrawText({box.x + 16, box.y + box.height / 2}, fmt::format("recorded from {} s on", begin), 17, kSoftInk,
                    box.width - 32);
  }
  DrawTag(canvas, box, path_.method, kMarkRoom);
  // Below the method's name, draw a bar in the method's colour, which is the same as on the page.
  canvas.FillBox({box.x + 14, box.y + 45, 44, 4}, MethodPaint(path_.method_index), 2);
  if (just_changed) DrawMark(canvas, box, "change");
  DrawWords(canvas, {box.x, box.y + box.height, box.width, kCaptionHeight}, time);
}

void TransitionPanel::DrawWords(Canvas& canvas, const Box& box, int time) const {
  const double room = box.width - 2 * kPanelMargin;
  canvas.DrawDot({box.x + kPanelMargin + 5, box.y + 17}, 5, PaintOfSegment(path_.facts, path_.PointsBefore(time)));
  canvas.DrawText({box.x + kPanelMargin + 18, box.y + 23}, ClipAt(time), 20, kInk, room - 18, true);
  const std::string countdown = CountdownWords(path_.facts.to, time, path_.LastPoint(), path_.motion.rate_hz);
  canvas.DrawText({box.x + kPanelMargin, box.y + 43}, countdown.empty() ? "before the request" : countdown, 17,
                  kSoftInk, room);
}

TransitionScene::TransitionScene(TransitionRace race, std::string scenario, Renderer& renderer)
    : race_(std::move(race)),
      scenario_(std::move(scenario)),
      renderer_(renderer),
      clock_(race_),
      stage_(StageFor(race_, clock_)),
      strip_(clock_.First(), clock_.Last(), HighestJump(race_, clock_)) {
  for (std::size_t i = 0; i < race_.paths.size(); ++i) panels_.emplace_back(race_.paths[i], i, stage_, strip_);
}

int TransitionScene::PosterFrame() const {
  constexpr int kAfterwards = 2;
  int latest = 0;
  for (const TransitionPath& path : race_.paths) latest = std::max(latest, path.LastPoint());
  return clock_.FrameOf(latest + kAfterwards);
}

std::string TransitionScene::Words() const {
  std::string methods;
  for (const TransitionPath& path : race_.paths) {
    const bool is_late = path.LastPoint() > clock_.Last();
    methods += fmt::format(
        "{}{} ({}{})", methods.empty() ? "" : ", ", path.method,
        path.facts.branch.empty() ? "" : path.facts.branch + ", ",
        is_late ? "after the film ends" : "after " + FormatFixed(path.LastPoint() / path.motion.rate_hz, 2) + " s");
  }
  const std::size_t count = race_.paths.size();
  return fmt::format(
      "The request {} as solved by {}{}. The world is {}: {}. Pale figure: the last pose "
      "of the first clip. Below: the largest second difference of any joint, and the ten partial distances of the two "
      "joined frames. A full bar means that this feature alone reaches the threshold ({}) At the end, the film repeats "
      "the transition {} times slower.",
      race_.request, count > 1 ? fmt::format("{} methods, from left to right: ", count) : "", methods, race_.world,
      race_.choice, kFeatureLegend, TransitionClock::kSlowness);
}

Canvas TransitionScene::Draw(int frame) {
  const int time = clock_.TimeAt(frame);
  const double seconds = time / race_.paths.front().motion.rate_hz;
  Canvas canvas = BeginFrame(
      fmt::format("{}, {} · {} · {} s {} the request{}", scenario_, race_.world, race_.request,
                  FormatFixed(std::abs(seconds), 2), seconds < 0 ? "before" : "after",
                  clock_.IsSlow(frame) ? fmt::format(" · {} times slower", TransitionClock::kSlowness) : ""));
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    panels_[i].Draw(canvas, Column(i, panels_.size()), renderer_, time);
  }
  return canvas;
}

}  // namespace etude
