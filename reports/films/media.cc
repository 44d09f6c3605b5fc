#include "reports/films/media.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "io/drawing/escape.h"
#include "reports/films/capture_scene.h"
#include "reports/films/coached_scene.h"
#include "reports/films/convergence_scene.h"
#include "reports/films/judged_scene.h"
#include "reports/films/shown_cell.h"
#include "reports/films/transition_race.h"
#include "reports/films/transition_scene.h"

namespace etude {
namespace {

constexpr const char* kRunFilm = "etude.mp4";
constexpr const char *kConvergence = "convergence", *kTransitions = "transitions", *kSession = "session",
                     *kWorstSession = "worst-session", *kJudged = "judged";

void Note(std::string& words, const std::string& more) { words += (words.empty() ? "" : " ") + more; }

// Makes the film of a recorded capture. If the run recorded neither captures nor transitions, the reason is stated.
void MakeCaptureFilm(const RunData& run, const MediaPaths& paths, const FilmWatch& watch, Media& media) {
  const auto has_pictures = [](const ScenarioSummary& scenario) {
    return scenario.task == "transition" || scenario.task == "capture";
  };
  if (std::ranges::none_of(run.scenarios, has_pictures)) return;
  std::string& why = media.film.why_not;
  const auto capture_cell = ChooseCell(run, "capture", "recovered");
  if (!capture_cell) {
    if (ChooseCell(run, "transition", "coach")) return;
    why = "There is no film of a coach or of cameras, because this run kept no recordings of transitions or captures.";
    return;
  }
  const auto renderer = SharedRenderer();
  if (!renderer) {
    why = "There are no pictures: " + ToString(renderer.error());
    return;
  }
  // Make the capture's strip, stills and EXR files.
  const auto typical = CapturePanel::Make(run, *capture_cell);
  auto captures = FindCaptures(run, *capture_cell);
  if (!typical || !captures) {
    return Note(why, "The film does not show the capture: " + ToString(typical ? captures.error() : typical.error()));
  }
  media.strip = DrawStrip(*typical, **renderer);
  media.stills = typical->Stills();
  media.strip_scenario = capture_cell->scenario->name;
  if (auto saved = SaveStripPictures(*typical, **renderer, paths.pictures); !saved) Note(why, ToString(saved.error()));
  // Film the capture. `why` collects the reasons why pictures or films could not be made; the film states them all.
  CaptureScene scene(**renderer, std::move(*captures));
  Film film = Shoot(scene, paths.films / kRunFilm, watch);
  if (!film.why_not.empty()) Note(why, film.why_not);
  film.why_not = why;
  media.film = std::move(film);
}

// Draws one plate (DrawPlate) for each capture scenario, from a recorded cell that keeps intermediate results
// (CaptureExtras::moments).
void MakePlates(const RunData& run, Media& media) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.task != "capture") continue;
    const auto cell = ChooseCell(run, scenario, "recovered");
    if (!cell) continue;
    const auto panel = CapturePanel::Make(run, *cell);
    if (!panel || panel->Moments().empty()) continue;
    const auto renderer = SharedRenderer();
    if (!renderer) return;
    if (auto plate = DrawPlate(*panel, **renderer)) media.plates.push_back({scenario.name, std::move(*plate)});
  }
}

/// Returns a film without frames, which only states why the film could not be made.
Film NoFilm(const FilePath& path, std::string why_not) {
  Film film;
  film.file = path.whole().filename().string();
  film.why_not = std::move(why_not);
  return film;
}

/// Makes a film that shows methods side by side in one world. If that is impossible, the returned film states why there
/// is no film of `what` (such as "the transitions").
template <typename SideBySide, typename Race>
Film MakeComparingFilm(Result<Race> race, const std::string& scenario, std::string_view what, const FilePath& path,
                       const FilmWatch& watch) {
  if (!race) return NoFilm(path, fmt::format("There is no film of {}: {}.", what, ToString(race.error())));
  const auto renderer = SharedRenderer();
  if (!renderer) return NoFilm(path, "There are no pictures: " + ToString(renderer.error()));
  SideBySide scene(std::move(*race), scenario, **renderer);
  return Shoot(scene, path, watch);
}

/// Returns the file name of a film: "convergence.mp4", or "convergence-SCENARIO.mp4" if several scenarios have the same
/// task.
std::string FilmName(const RunData& run, std::size_t index, std::string_view what) {
  const ScenarioSummary& scenario = run.scenarios[index];
  const bool alone = std::ranges::count(run.scenarios, scenario.task, &ScenarioSummary::task) == 1;
  return alone ? fmt::format("{}.mp4", what) : fmt::format("{}-{}.mp4", what, FileNameOf(scenario.name, index));
}

/// Makes the film of a coached session, cut around a correction unless whole sessions are wanted. If that is
/// impossible, the returned film states the reason.
Film MakeSessionFilm(const std::optional<ShownCell>& cell, const std::string& which, const FilePath& path,
                     const MediaOptions& options) {
  if (!cell) return NoFilm(path, "There is no film of a session, because this run kept no recordings of sessions.");
  auto facts = ReadCoachedSession(*cell);
  const auto renderer = facts ? SharedRenderer() : Result<Renderer*>(nullptr);
  if (!facts || !renderer) {
    return NoFilm(path, "There is no film of a session: " + ToString(facts ? renderer.error() : facts.error()));
  }
  const int longest = options.whole_sessions ? std::numeric_limits<int>::max() : 12 * kFilmRate;
  CoachedScene scene(std::move(*facts), fmt::format("{} · {} · {}", cell->scenario->name, cell->row->method, which),
                     longest, **renderer);
  return Shoot(scene, path, options.watch);
}

/// Makes one film of a typical session and one of the worst session, or a single film if the typical session is also
/// the worst session.
void MakeSessionFilms(const RunData& run, std::size_t index, const MediaPaths& paths, const MediaOptions& options,
                      Media& media) {
  const ScenarioSummary& scenario = run.scenarios[index];
  const auto add = [&](const std::optional<ShownCell>& cell, const std::string& which, std::string_view file) {
    Film film = MakeSessionFilm(cell, which, paths.films / FilmName(run, index, file), options);
    media.scenario_films.push_back({scenario.name, std::move(film)});
  };
  const auto typical = ChooseCell(run, scenario, "coach"), worst = ChooseWorstSession(run, scenario);
  add(typical, "a typical session", kSession);
  const auto same = [&] {
    return worst->row->trial == typical->row->trial && worst->row->method == typical->row->method;
  };
  if (!worst || (typical && same())) return;
  add(worst, "the worst session", kWorstSession);
}

/// Makes the film of a typical judged session. Returns nullopt if no motion was recorded: scenarios need not record
/// any.
std::optional<Film> MakeJudgedFilm(const RunData& run, std::size_t index, const MediaPaths& paths,
                                   const MediaOptions& options) {
  const ScenarioSummary& scenario = run.scenarios[index];
  const auto cell = ChooseCell(run, scenario, "sensed");
  if (!cell) return std::nullopt;
  auto facts = ReadJudgedSession(run, *cell);
  const FilePath path = paths.films / FilmName(run, index, kJudged);
  if (!facts) return NoFilm(path, "There is no film of a session: " + ToString(facts.error()));
  const int longest = options.whole_sessions ? std::numeric_limits<int>::max() : 24 * kFilmRate;
  JudgedScene scene(std::move(*facts), fmt::format("{} · trial {}", scenario.name, cell->row->trial), longest);
  return Shoot(scene, path, options.watch);
}

}  // namespace

std::set<std::string> FilmNames(const RunData& run) {
  std::set<std::string> names = {kRunFilm};
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    for (const char* what : {kConvergence, kTransitions, kSession, kWorstSession, kJudged}) {
      names.insert(FilmName(run, i, what));
    }
  }
  return names;
}

Media MakeMedia(const RunData& run, const MediaPaths& paths, const MediaOptions& options) {
  Media media;
  MakeCaptureFilm(run, paths, options.watch, media);
  MakePlates(run, media);
  // Make one film for each scenario of a task that has films; a coach's scenario has up to two films.
  for (std::size_t i = 0; i < run.scenarios.size() && !options.watch.IsStopped(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    Film film;
    if (scenario.task == "ik") {
      film = MakeComparingFilm<ConvergenceScene>(FindIkRace(run, scenario), scenario.name, "two solvers by iteration",
                                                 paths.films / FilmName(run, i, kConvergence), options.watch);
    } else if (scenario.task == "transition" && ChooseCell(run, scenario, "coach")) {
      film = MakeComparingFilm<TransitionScene>(FindTransitionRace(run, scenario), scenario.name, "transitions",
                                                paths.films / FilmName(run, i, kTransitions), options.watch);
    } else if (scenario.task == "coach") {
      MakeSessionFilms(run, i, paths, options, media);
      continue;
    } else if (scenario.task == "detection") {
      auto judged = MakeJudgedFilm(run, i, paths, options);
      if (!judged) continue;
      film = std::move(*judged);
    } else {
      continue;
    }
    media.scenario_films.push_back({scenario.name, std::move(film)});
  }
  return media;
}

}  // namespace etude
