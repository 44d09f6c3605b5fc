#include "reports/films/transition_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/films/look.h"
#include "reports/transitions/transition_section.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

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

// One scale for all methods, so that jumps compare across columns.
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
  return fmt::format(
      "The same request, {}, under {} methods, left to right {}; {}: {}. Ghost: the pose that was left. Beneath: the "
      "largest second difference of any joint, and the ten partial distances of the frames that met; a full bar alone "
      "reaches the threshold ({}) At the end once more, {} times slower.",
      race_.request, race_.paths.size(), methods, race_.world, race_.choice, kFeatureLegend,
      TransitionClock::kSlowness);
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
