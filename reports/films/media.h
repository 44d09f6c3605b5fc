#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "io/drawing/film.h"

namespace etude {

/// A film that belongs to one scenario's card.
struct ScenarioFilm {
  std::string scenario;
  Film film;
};

/// A picture that belongs to one scenario's card.
struct ScenarioPicture {
  std::string scenario;
  Picture picture;
};

/// All pictures and films made from a run's recordings, with plain words for those that could not be made.
struct Media {
  Film film;  ///< of the run: a capture, or a coach alone; empty for other tasks, and where a scenario's film shows all
  std::vector<Picture> strip;                ///< moments of the capture: stereo pictures, mask, recovered skeleton
  std::vector<Still> stills;                 ///< the same capture's middle frame as its cameras took it
  std::string strip_scenario;                ///< the scenario whose card shows the strip and the stills
  std::vector<ScenarioPicture> plates;       ///< of captures: every stage of some moments
  std::vector<ScenarioFilm> scenario_films;  ///< of single scenarios: methods side by side, sessions
};

/// The folders that files go to which stand beside the page.
struct MediaPaths {
  FilePath films;     ///< a folder: the MP4s
  FilePath pictures;  ///< a folder: colour, depth and labels of the strip's moments, as EXR
};

struct MediaOptions {
  bool whole_sessions = false;  ///< sessions are not cut: coached ones around a correction, judged ones to 24 s
  FilmWatch watch = {};
};

/// The names that films of this run may have.
std::set<std::string> FilmNames(const RunData& run);

/// Draws what the recordings of a run show: the films, their posters, the strip and the pictures behind it.
/// Whatever cannot be made is left out, with the reason in `why_not`; never a failure of the report.
Media MakeMedia(const RunData& run, const MediaPaths& paths, const MediaOptions& options = {});

}  // namespace etude
