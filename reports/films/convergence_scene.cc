#include "reports/films/convergence_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/angles.h"
#include "io/drawing/look.h"
#include "reports/films/capture_panel.h"
#include "reports/words/figures.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

constexpr double kSecondsPerDoubling = 0.7;
// The duration of a race in the film, without the time for which the first and the last state are held.
constexpr double kMinRaceSeconds = 4, kMaxRaceSeconds = 8;

constexpr Paint kGrid{0.24, 0.27, 0.29, 1};
constexpr Paint kGoal{0.55, 0.82, 0.50, 1};
constexpr Paint kTime{0.95, 0.955, 0.96, 0.35};
constexpr double kTitleSize = 18, kTickSize = 17;
constexpr double kPlotLeft = 64, kPlotRight = 28, kPlotTop = 44, kPlotBottom = 54;
// The largest iteration that the axis can label: the digits of a larger decade would not fit into an int.
constexpr int kMaxLabelledIteration = 100'000'000;
// The vertical axis ends this many decades below the goal: smaller errors are irrelevant, and rounding noise would
// extend the axis without limit.
constexpr int kMaxDecadesBelowGoal = 2;

}  // namespace

RaceClock::RaceClock(int last_iteration) : last_(last_iteration) {
  const double seconds = std::clamp(kSecondsPerDoubling * std::log2(1.0 + last_), kMinRaceSeconds, kMaxRaceSeconds);
  run_ = static_cast<int>(std::lround(seconds * kFilmRate));
}

double RaceClock::IterationAt(int frame) const {
  if (frame >= kOpening + run_) return last_;
  const double share = std::max(frame - kOpening, 0) / static_cast<double>(run_);
  return std::min(std::expm1(share * std::log1p(last_)), static_cast<double>(last_));
}

double RaceClock::ShareOf(double iteration) const {
  return last_ == 0 ? 0 : std::clamp(std::log1p(iteration) / std::log1p(last_), 0.0, 1.0);
}

/// The plot area inside the axes, which maps iterations and errors to pixels.
struct ErrorPlot::Frame {
  Box box;
  const ErrorPlot& plot;

  double X(double iteration) const { return box.x + box.width * plot.clock_.ShareOf(iteration); }
  double Y(double value) const {
    const double decade = value > 0 ? std::log10(value) : plot.lowest_;
    const double share = (decade - plot.lowest_) / (plot.highest_ - plot.lowest_);
    return box.y + box.height * (1 - std::clamp(share, 0.0, 1.0));
  }
  double Right() const { return box.x + box.width; }
  double Bottom() const { return box.y + box.height; }
};

ErrorPlot::ErrorPlot(std::string title, std::string suffix, double goal, std::vector<ErrorCurve> curves,
                     const RaceClock& clock)
    : title_(std::move(title)), suffix_(std::move(suffix)), goal_(goal), curves_(std::move(curves)), clock_(clock) {
  double low = goal / 2, high = 2 * goal;
  for (const ErrorCurve& curve : curves_) {
    low = std::min(low, std::ranges::min(curve.values));
    high = std::max(high, std::ranges::max(curve.values));
  }
  low = std::max(low, goal * std::pow(10, -kMaxDecadesBelowGoal));
  lowest_ = static_cast<int>(std::floor(std::log10(low)));
  highest_ = static_cast<int>(std::ceil(std::log10(high)));
}

void ErrorPlot::Draw(Canvas& canvas, const Box& panel, double iteration) const {
  canvas.FillBox(panel, {0.13, 0.15, 0.17, 1}, kPanelRadius);
  canvas.DrawText({panel.x + 16, panel.y + 28}, title_, kTitleSize, kInk, panel.width - 32, true);
  if (curves_.empty()) return;
  const Frame frame{{panel.x + kPlotLeft, panel.y + kPlotTop, panel.width - kPlotLeft - kPlotRight,
                     panel.height - kPlotTop - kPlotBottom},
                    *this};
  DrawValueAxis(canvas, frame);
  DrawIterationAxis(canvas, frame);
  const double now = frame.X(iteration);
  canvas.DrawLine({now, frame.box.y}, {now, frame.Bottom()}, 1.5, kTime);
  // Draw later curves thinner, so that equal curves are all visible.
  double width = 3 + 2.0 * (static_cast<double>(curves_.size()) - 1);
  for (const ErrorCurve& curve : curves_) {
    DrawCurve(canvas, frame, curve, iteration, width);
    width -= 2;
  }
}

void ErrorPlot::DrawValueAxis(Canvas& canvas, const Frame& frame) const {
  for (int decade = lowest_; decade <= highest_; ++decade) {
    const double value = std::pow(10, decade), y = frame.Y(value);
    canvas.DrawLine({frame.box.x, y}, {frame.Right(), y}, 1, kGrid);
    const std::string label = fmt::format("{:g}", value);
    const double width = canvas.TextWidth(label, kTickSize);
    canvas.DrawText({frame.box.x - 8 - width, y + 5}, label, kTickSize, kSoftInk, width + 1);
  }
  constexpr double kDash = 8;
  const double y = frame.Y(goal_);
  for (double x = frame.box.x; x < frame.Right(); x += 2 * kDash) {
    canvas.DrawLine({x, y}, {std::min(x + kDash, frame.Right()), y}, 1.5, kGoal);
  }
  canvas.DrawText({frame.box.x + 6, y + 17}, fmt::format("goal {:g}{}", goal_, suffix_), kTickSize, kGoal, 120);
}

void ErrorPlot::DrawIterationAxis(Canvas& canvas, const Frame& frame) const {
  double free_from = 0;  // smallest x at which the next label does not overlap the previous label
  const auto tick = [&](int at) {
    const std::string label = FormatCount(at);
    const double width = canvas.TextWidth(label, kTickSize), x = frame.X(at), left = x - width / 2;
    if (at > clock_.LastIteration() || left < free_from) return;
    canvas.DrawLine({x, frame.Bottom()}, {x, frame.Bottom() + 4}, 1, kSoftInk);
    canvas.DrawText({left, frame.Bottom() + 20}, label, kTickSize, kSoftInk, width + 1);
    free_from = left + width + 8;
  };
  tick(0);
  for (int decade = 1; decade <= clock_.LastIteration() && decade <= kMaxLabelledIteration; decade *= 10) {
    for (const int digit : {1, 2, 5}) tick(digit * decade);
  }
  const std::string axis = "iteration, log scale";
  const double width = canvas.TextWidth(axis, kTickSize);
  canvas.DrawText({frame.Right() - width, frame.Bottom() + 43}, axis, kTickSize, kSoftInk, width + 1);
}

void ErrorPlot::DrawCurve(Canvas& canvas, const Frame& frame, const ErrorCurve& curve, double iteration,
                          double width) const {
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i < curve.iterations.size() && (i == 0 || curve.iterations[i] <= iteration); ++i) {
    points.emplace_back(frame.X(curve.iterations[i]), frame.Y(curve.values[i]));
  }
  canvas.DrawPath(points, width, curve.colour);
  canvas.DrawDot(points.back(), 3 + width, curve.colour);
}

namespace {

// The bodies are rendered larger by this factor and then shrunk, which smooths the edges (supersampling).
constexpr double kDetail = 1.5;
// The share of the panel's width that is reserved for text, at the left of the panel.
constexpr double kWordsShare = 0.34;
// The bodies are turned by this angle from the frontal view, so that near and far limbs can be distinguished.
constexpr double kTurn = Radians(25);
// The smallest visible motion of a joint, metres; about a tenth of a pixel. If no joint has moved more than this since
// the last picture, as often happens in late iterations, the last picture is shown again.
constexpr double kVisible = 0.0005;
constexpr Paint kGhostRim{0.90, 0.93, 0.95, 0.55};
constexpr Paint kMarkShadow{0.05, 0.06, 0.07, 0.8};
constexpr Paint kWarn{0.98, 0.52, 0.45, 1};
constexpr Paint kGood{0.60, 0.86, 0.54, 1};

Rgb8 ToRgb8(const Paint& paint, double brightness) {
  const auto channel = [&](double share) { return static_cast<std::uint8_t>(std::lround(255 * share * brightness)); };
  return {channel(paint.r), channel(paint.g), channel(paint.b)};
}

Figure BodyOf(const BodyPose& pose, const Paint& paint) {
  Figure figure{BodyCapsules(pose)};
  figure.colours.fill(ToRgb8(paint, 0.85));
  return figure;
}

double LowestPoint(const IkRace& race) {
  double lowest = std::numeric_limits<double>::max();
  const auto include = [&](const BodyPose& pose) {
    for (const Capsule& capsule : BodyCapsules(pose)) {
      lowest = std::min(lowest, std::min(capsule.a.y, capsule.b.y) - capsule.radius);
    }
  };
  include(race.truth);
  for (const IkPath& path : race.paths) std::ranges::for_each(path.poses, include);
  return lowest;
}

void DrawMarks(Canvas& canvas, const std::vector<std::pair<glm::dvec2, glm::dvec2>>& marks, const Paint& colour) {
  for (const auto& [end, target] : marks) canvas.DrawLine(end, target, 2, kInk);
  for (const auto& [end, target] : marks) {
    canvas.DrawRing(target, 9, 5, kMarkShadow);
    canvas.DrawRing(target, 9, 2.5, kInk);
    canvas.DrawDot(end, 6.5, kMarkShadow);
    canvas.DrawDot(end, 5, colour);
  }
}

// Returns a number as text; errors below 0.001, which is far below the goal, become "< 0.001".
std::string ShortNumber(double value) { return value < 0.001 ? "< 0.001" : FormatNumber(value); }

double LargestShift(const BodyPose& a, const BodyPose& b) {
  double largest = 0;
  for (const Role role : AllRoles()) largest = std::max(largest, glm::distance(a[role], b[role]));
  return largest;
}

constexpr int kPanelWidth = 622, kPanelHeight = 400;
constexpr Box kPanels[] = {{12, 52, kPanelWidth, kPanelHeight}, {646, 52, kPanelWidth, kPanelHeight}};
constexpr Box kPositionPlot{12, 464, 622, 244}, kOrientationPlot{646, 464, 622, 244};

ErrorPlot PlotOf(const IkRace& race, std::vector<double> IkPath::*values, std::string title, std::string suffix,
                 double goal, const RaceClock& clock) {
  std::vector<ErrorCurve> curves;
  for (const IkPath& path : race.paths) {
    if (!IsAskedFor(path.*values)) continue;
    curves.push_back({path.iterations, path.*values, MethodPaint(path.method_index)});
  }
  if (curves.empty()) title += ": no target";
  return {std::move(title), std::move(suffix), goal, std::move(curves), clock};
}

}  // namespace

ConvergenceStage::ConvergenceStage(const IkRace& race, Renderer& renderer, int width, int height)
    : box_{0, 0, static_cast<double>(width), static_cast<double>(height)},
      move_(ToOrigin(race.truth)),
      lift_(-LowestPoint(race)),
      truth_(Placed(race.truth)),
      targets_(race.targets),
      studio_(width, height, kDetail, BoundsOf(race)),
      ghost_(studio_.Silhouette(renderer, BodyOf(truth_, kInk))),
      rim_(OutlineOf(ghost_)) {}

glm::dvec3 ConvergenceStage::Placed(const glm::dvec3& point) const {
  return FloorMove{kTurn, 0, 0}.Apply(move_.Apply(point)) + glm::dvec3(0, lift_, 0);
}

BodyPose ConvergenceStage::Placed(const BodyPose& pose) const {
  BodyPose placed = pose;
  for (glm::dvec3& joint : placed.joints) joint = Placed(joint);
  return placed;
}

ViewBounds ConvergenceStage::BoundsOf(const IkRace& race) const {
  ViewBounds bounds;
  Studio::Include(BodyOf(truth_, kInk), bounds);
  for (const IkPath& path : race.paths) {
    for (const BodyPose& pose : path.poses) Studio::Include(BodyOf(Placed(pose), kInk), bounds);
  }
  for (const auto& target : targets_) {
    constexpr double kMargin = 0.05;  // space around the poses for the rings that mark targets, metres
    if (target) Studio::Include({{{Part::kHead, Placed(*target), Placed(*target), kMargin}}}, bounds);
  }
  // Centre the bodies in the space beside the text.
  const double left_over = box_.width * (1 - kWordsShare) / box_.height;
  const glm::dvec2 extent = bounds.high - bounds.low;
  const double width = std::max(extent.x, extent.y * left_over);
  const double middle = (bounds.low.x + bounds.high.x) / 2;
  bounds.high.x = middle + width / 2;
  bounds.low.x = bounds.high.x - width / (1 - kWordsShare);
  return bounds;
}

Image<std::uint32_t> ConvergenceStage::Picture(Renderer& renderer, const BodyPose& pose, const Paint& colour) const {
  const BodyPose body = Placed(pose);
  Canvas canvas(static_cast<int>(box_.width), static_cast<int>(box_.height));
  studio_.Draw(canvas, box_, renderer, BodyOf(body, colour), {}, &ghost_);
  canvas.DrawMask(rim_, box_, kGhostRim);
  std::vector<std::pair<glm::dvec2, glm::dvec2>> marks;
  for (std::size_t i = 0; i < kIkEnds.size(); ++i) {
    if (!targets_[i]) continue;
    marks.emplace_back(studio_.PixelOf(box_, body[kIkEnds[i]]), studio_.PixelOf(box_, Placed(*targets_[i])));
  }
  DrawMarks(canvas, marks, colour);
  return canvas.Copy();
}

ConvergencePanel::ConvergencePanel(const IkPath& path, const ConvergenceStage& stage, const Paint& colour)
    : path_(path), stage_(stage), colour_(colour) {
  std::size_t seen = 0;
  for (std::size_t entry = 0; entry < path.poses.size(); ++entry) {
    if (LargestShift(path.poses[seen], path.poses[entry]) > kVisible) seen = entry;
    seen_.push_back(seen);
  }
}

void ConvergencePanel::Draw(Canvas& canvas, const Box& panel, Renderer& renderer, double iteration) {
  // Draw the body, or reuse the last picture if no joint has moved visibly.
  const std::size_t entry = path_.EntryAt(iteration);
  const std::size_t seen = seen_[entry];
  if (!drawn_ || drawn_->entry != seen) drawn_ = {seen, stage_.Picture(renderer, path_.poses[seen], colour_)};
  canvas.Put(drawn_->picture, static_cast<int>(panel.x), static_cast<int>(panel.y), kPanelRadius);

  // Write the method, the iteration and the errors beside the body.
  const double x = panel.x + 18, room = panel.width * kWordsShare - 18;
  const auto figure = [&](double y, const std::string& label, const std::string& value, const Paint& paint) {
    canvas.DrawText({x, panel.y + y}, label, 17, kSoftInk, room);
    canvas.DrawText({x, panel.y + y + 34}, value, 32, paint, panel.width - 36, true);
  };
  const auto error = [&](double y, const std::string& label, const std::vector<double>& errors, double goal,
                         const std::string& suffix) {
    const double now = errors[entry];
    if (!IsAskedFor(errors)) return figure(y, label, "no target", kSoftInk);
    figure(y, label, ShortNumber(now) + suffix, now < goal ? kGood : kInk);
  };
  canvas.DrawText({x, panel.y + 36}, path_.method, 25, colour_, panel.width - 36, true);
  // Show the film's current iteration instead of the last recorded one, because recordings leave out some iterations.
  const int reached = std::min(static_cast<int>(iteration), path_.iterations.back());
  figure(84, "iteration", FormatCount(reached), kInk);
  error(164, "worst position error", path_.position_cm, kGoalCm, " cm");
  error(244, "worst orientation error", path_.orientation_deg, kGoalDeg, "°");
  // After the method has ended, show how it ended. The method's last pose stays until the other method ends.
  if (entry + 1 == path_.poses.size()) {
    const Paint& paint = path_.solved_at ? kGood : kWarn;
    canvas.DrawText({x, panel.y + 342}, path_.ending, 25, paint, panel.width - 36, true);
    const std::string detail =
        path_.solved_at ? fmt::format("at iteration {}", FormatCount(*path_.solved_at)) : path_.reason;
    canvas.DrawText({x, panel.y + 366}, detail, 17, paint, panel.width - 36);
  }
}

ConvergenceScene::ConvergenceScene(IkRace race, std::string scenario, Renderer& renderer)
    : race_(std::move(race)),
      scenario_(std::move(scenario)),
      renderer_(renderer),
      clock_(race_.LastIteration()),
      stage_(race_, renderer, kPanelWidth, kPanelHeight),
      panels_{ConvergencePanel(race_.paths[0], stage_, MethodPaint(race_.paths[0].method_index)),
              ConvergencePanel(race_.paths[1], stage_, MethodPaint(race_.paths[1].method_index))},
      position_(PlotOf(race_, &IkPath::position_cm, "Worst position error, cm", " cm", kGoalCm, clock_)),
      orientation_(PlotOf(race_, &IkPath::orientation_deg, "Worst orientation error, degrees", "°", kGoalDeg, clock_)) {
}

bool ConvergenceScene::HasTargets() const {
  return std::ranges::any_of(race_.targets, [](const auto& target) { return target.has_value(); });
}

std::string ConvergenceScene::Words() const {
  const IkPath &left = race_.paths[0], &right = race_.paths[1];
  const auto ending = [](const IkPath& path) {
    return path.solved_at ? fmt::format("solved at iteration {}", FormatCount(*path.solved_at))
                          : fmt::format("{}: {}", path.ending, path.reason);
  };
  return fmt::format(
      "Two methods from the same start pose: {} on the left ({}), {} on the right ({}). The world is {}, {}. Grey: the "
      "true pose{}. Below: the worst errors at each iteration, on two logarithmic axes. Both methods show the same "
      "iteration at the same time.",
      left.method, ending(left), right.method, ending(right), race_.world, race_.choice,
      HasTargets() ? "; rings: the targets of right foot, hands and head; dots: their positions" : "");
}

Canvas ConvergenceScene::Draw(int frame) {
  Canvas canvas = BeginFrame(fmt::format("{}, {} · grey: the true pose{} · same start pose, same iteration", scenario_,
                                         race_.world, HasTargets() ? ", rings: targets of foot, hands and head" : ""));
  const double iteration = clock_.IterationAt(frame);
  for (std::size_t i = 0; i < panels_.size(); ++i) panels_[i].Draw(canvas, kPanels[i], renderer_, iteration);
  position_.Draw(canvas, kPositionPlot, iteration);
  orientation_.Draw(canvas, kOrientationPlot, iteration);
  return canvas;
}

}  // namespace etude
