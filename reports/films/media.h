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

/// All pictures and films made from a run's recordings, and the reasons why others could not be made.
struct Media {
  /// The run's film: of a capture, or of a coach alone. Empty for other tasks, and if the film of a scenario shows the
  /// same.
  Film film;
  /// Moments of the capture: pictures of both cameras with mask and recovered skeleton.
  std::vector<Picture> strip;
  std::vector<Still> stills;                 ///< the middle frame of the capture, as each camera filmed it
  std::string strip_scenario;                ///< the scenario whose card shows the strip and the stills
  std::vector<ScenarioPicture> plates;       ///< for captures: all stages of some moments
  std::vector<ScenarioFilm> scenario_films;  ///< films of single scenarios: methods side by side, and sessions
};

/// The folders for files beside the page.
struct MediaPaths {
  FilePath films;     ///< a folder for the MP4s
  FilePath pictures;  ///< a folder for EXR files: colour, depth and labels at the moments of Media::strip
};

struct MediaOptions {
  /// If false, films of coached sessions are cut around a correction, and films of judged sessions to 24 s.
  bool whole_sessions = false;
  FilmWatch watch = {};
};

/// Returns the names that films of this run may have.
std::set<std::string> FilmNames(const RunData& run);

/// Draws the recordings of a run: the films, their posters, the strip and the EXR files of its moments. A part that
/// cannot be made is left out, with the reason in `why_not`; the report does not fail because of it.
Media MakeMedia(const RunData& run, const MediaPaths& paths, const MediaOptions& options = {});

}  // namespace etude
