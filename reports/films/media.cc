#include "reports/films/media.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "reports/films/cast.h"
#include "reports/films/convergence_scene.h"
#include "reports/films/film.h"
#include "reports/films/picture_strip.h"
#include "reports/films/stage_scene.h"
#include "reports/words/file_name.h"

namespace etude {
namespace {

void Note(std::string& words, const std::string& more) { words += (words.empty() ? "" : " ") + more; }

// Made once it is needed: a run without recordings needs no GL.
class LazyRenderer {
 public:
  Result<Renderer*> Get() {
    if (!made_) made_ = Renderer::Create();
    if (!*made_) return tl::unexpected(made_->error());
    return (*made_)->get();
  }

 private:
  std::optional<Result<std::unique_ptr<Renderer>>> made_;
};

void MakeStageFilm(const RunData& run, const MediaPaths& paths, LazyRenderer& lazy, Media& media) {
  const auto has_pictures = [](const ScenarioSummary& scenario) {
    return scenario.task == "transition" || scenario.task == "capture";
  };
  if (std::ranges::none_of(run.scenarios, has_pictures)) return;
  std::string& why = media.film.why_not;
  const auto coach_cell = ChooseCell(run, "transition", "coach");
  const auto capture_cell = ChooseCell(run, "capture", "recovered");
  if (!coach_cell && !capture_cell) {
    why = "There is no film of coach and cameras: this run kept no recordings of a coach or a capture.";
    return;
  }
  const auto renderer = lazy.Get();
  if (!renderer) {
    why = "There are no pictures: " + ToString(renderer.error());
    return;
  }

  std::optional<CoachPanel> coach;
  std::optional<CapturePanel> capture;
  if (coach_cell) {
    if (auto made = CoachPanel::Make(*coach_cell, StageScene::kLongest)) {
      coach = std::move(*made);
    } else {
      Note(why, "The coach cannot be shown: " + ToString(made.error()));
    }
  }
  if (capture_cell) {
    if (auto made = CapturePanel::Make(run, *capture_cell)) {
      media.strip = DrawStrip(*made, **renderer);
      media.strip_scenario = capture_cell->scenario->name;
      if (auto saved = SaveStripPictures(*made, **renderer, paths.pictures); !saved) Note(why, ToString(saved.error()));
      capture = std::move(*made);
    } else {
      Note(why, "The capture cannot be shown: " + ToString(made.error()));
    }
  }
  if (!coach && !capture) return;
  StageScene scene(**renderer, std::move(coach), std::move(capture));
  Film film = Shoot(scene, paths.films / "etude.mp4");
  if (!film.why_not.empty()) Note(why, film.why_not);
  film.why_not = why;
  media.film = std::move(film);
}

Film MakeConvergenceFilm(const RunData& run, const ScenarioSummary& scenario, const std::filesystem::path& path,
                         LazyRenderer& lazy) {
  Film film;
  film.file = path.filename().string();
  auto race = FindIkRace(run, scenario);
  if (!race) {
    film.why_not = "There is no film of two methods settling: " + ToString(race.error()) + ".";
    return film;
  }
  const auto renderer = lazy.Get();
  if (!renderer) {
    film.why_not = "There are no pictures: " + ToString(renderer.error());
    return film;
  }
  ConvergenceScene scene(std::move(*race), scenario.name, **renderer);
  return Shoot(scene, path);
}

}  // namespace

Media MakeMedia(const RunData& run, const MediaPaths& paths) {
  Media media;
  LazyRenderer renderer;
  MakeStageFilm(run, paths, renderer, media);
  const auto is_ik = [](const ScenarioSummary& scenario) { return scenario.task == "ik"; };
  const bool alone = std::ranges::count_if(run.scenarios, is_ik) == 1;
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    if (!is_ik(scenario)) continue;
    const std::string file = alone ? "convergence.mp4" : "convergence-" + FileNameOf(scenario.name, i) + ".mp4";
    media.scenario_films.push_back({scenario.name, MakeConvergenceFilm(run, scenario, paths.films / file, renderer)});
  }
  return media;
}

}  // namespace etude
