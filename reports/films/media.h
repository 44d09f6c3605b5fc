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

/// All pictures and films made from a run's recordings, and the reasons why other pictures and films could not be made.
struct Media {
  /// The film of the whole run: a capture or, if there is none, a coach. Empty for runs of other tasks, and if a
  /// scenario's film already compares coaches.
  Film film;
  /// Two frames of the capture: pictures of the first two cameras with mask and recovered skeleton (DrawStrip).
  std::vector<Picture> strip;
  std::vector<Still> stills;                 ///< the middle frame of the capture as each camera took it
  std::string strip_scenario;                ///< the scenario whose card shows the strip and the stills
  std::vector<ScenarioPicture> plates;       ///< for capture scenarios: pictures of all processing stages (DrawPlate)
  std::vector<ScenarioFilm> scenario_films;  ///< films of single scenarios: of compared methods, or of a session
};

/// The folders for files beside the page.
struct MediaPaths {
  FilePath films;     ///< a folder for the MP4s
  FilePath pictures;  ///< a folder for EXR files: colour, depth and labels of the frames in Media::strip
};

struct MediaOptions {
  /// If false, films of coached sessions are cut around a correction, and films of judged sessions are cut to 24 s.
  bool whole_sessions = false;
  FilmWatch watch = {};
};

/// Returns the names that films of this run may have.
std::set<std::string> FilmNames(const RunData& run);

/// Draws the recordings of a run: the films, their posters, the strip, and the EXR files of the strip's frames. A part
/// that cannot be made is left out, and `why_not` gives the reason; a missing part does not make the report fail.
Media MakeMedia(const RunData& run, const MediaPaths& paths, const MediaOptions& options = {});

}  // namespace etude
