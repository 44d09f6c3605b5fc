#include "reports/films/error_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/films/look.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr double kSecondsPerDoubling = 0.7;
constexpr double kShortestRace = 4, kLongest = 8;  // seconds

constexpr Paint kGrid{0.24, 0.27, 0.29, 1};
constexpr Paint kGoal{0.55, 0.82, 0.50, 1};
constexpr Paint kTime{0.95, 0.955, 0.96, 0.35};
constexpr double kTitleSize = 18, kTickSize = 17;
constexpr double kPlotLeft = 64, kPlotRight = 28, kPlotTop = 44, kPlotBottom = 54;
// What the axis can label: digits of a larger decade would not fit into an int.
constexpr int kMostIterations = 100'000'000;
// Below the goal nothing matters, and rounding would stretch the axis without end.
constexpr int kMostDecadesBelowGoal = 2;

}  // namespace

RaceClock::RaceClock(int last_iteration) : last_(last_iteration) {
  const double seconds = std::clamp(kSecondsPerDoubling * std::log2(1.0 + last_), kShortestRace, kLongest);
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

/// The inside of the axes, which gives the place of a value in it.
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
  low = std::max(low, goal * std::pow(10, -kMostDecadesBelowGoal));
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
  // Curves that coincide are all seen: the later ones are thinner.
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
  double free_from = 0;  // where labels do not run into each other
  const auto tick = [&](int at) {
    const std::string label = FormatCount(at);
    const double width = canvas.TextWidth(label, kTickSize), x = frame.X(at), left = x - width / 2;
    if (at > clock_.LastIteration() || left < free_from) return;
    canvas.DrawLine({x, frame.Bottom()}, {x, frame.Bottom() + 4}, 1, kSoftInk);
    canvas.DrawText({left, frame.Bottom() + 20}, label, kTickSize, kSoftInk, width + 1);
    free_from = left + width + 8;
  };
  tick(0);
  for (int decade = 1; decade <= clock_.LastIteration() && decade <= kMostIterations; decade *= 10) {
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

}  // namespace etude
