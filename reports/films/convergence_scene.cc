#include "reports/films/convergence_scene.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/films/look.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

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
  if (curves.empty()) title += ": not asked for";
  return {std::move(title), std::move(suffix), goal, std::move(curves), clock};
}

}  // namespace

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
      "The same start under two methods, {} on the left ({}), {} on the right ({}), in {}, {}. Grey: the true pose{}. "
      "Beneath: worst errors by iteration, both axes logarithmic. One clock runs for both methods.",
      left.method, ending(left), right.method, ending(right), race_.world, race_.choice,
      HasTargets() ? "; rings: where right foot, hands and head are told to be; dots: where they are" : "");
}

Canvas ConvergenceScene::Draw(int frame) {
  Canvas canvas = BeginFrame(fmt::format("{}, {} · grey: the true pose{} · same start, same clock", scenario_,
                                         race_.world, HasTargets() ? ", rings: targets of foot, hands and head" : ""));
  const double iteration = clock_.IterationAt(frame);
  for (std::size_t i = 0; i < panels_.size(); ++i) panels_[i].Draw(canvas, kPanels[i], renderer_, iteration);
  position_.Draw(canvas, kPositionPlot, iteration);
  orientation_.Draw(canvas, kOrientationPlot, iteration);
  return canvas;
}

}  // namespace etude
