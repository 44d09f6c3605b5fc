#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/films/film_watch.h"

namespace etude {

/// One picture with the words that tell what it shows.
struct Picture {
  std::string png;  ///< bytes of a PNG file
  int width = 0;
  int height = 0;
  std::string caption;
};

/// A picture as a camera of the run took it, with its caption.
struct Still {
  std::string jpeg_base64;  ///< nothing but letters of that alphabet
  std::string caption;
};

/// A film as the page shows it.
struct Film {
  std::string file;     ///< its name in the run's folder `video`
  std::string mp4;      ///< bytes of the file; empty when there is none
  std::string why_not;  ///< plain words for what could not be made
  Picture poster;       ///< png empty when nothing could be drawn; its caption is the film's
};

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

/// What the recordings gave to look at, and plain words for what they did not.
struct Media {
  Film film;  ///< of the run: coach and cameras; empty for tasks without either, and where a scenario's film shows all
  std::vector<Picture> strip;           ///< moments of the capture: stereo pictures, mask, recovered skeleton
  std::vector<Still> stills;            ///< the same capture's middle frame as its cameras took it
  std::string strip_scenario;           ///< whose card shows the strip and the stills
  std::vector<ScenarioPicture> plates;  ///< of captures: every stage of some moments
  std::vector<ScenarioFilm>
      scenario_films;  ///< methods side by side: inverse kinematics settling, transitions from clip to clip
};

/// Where files go that stand beside the page.
struct MediaPaths {
  std::filesystem::path films;     ///< a folder: the MP4s
  std::filesystem::path pictures;  ///< a folder: colour, depth and labels of the strip's moments, as EXR
};

struct MediaOptions {
  bool whole_sessions = false;  ///< sessions are not cut: coached ones around a correction, judged ones to 24 s
  FilmWatch watch = {};
};

/// Draws what the recordings of a run show: the films, their posters, the strip and the pictures behind it.
/// Whatever cannot be made is left out, with the reason in `why_not`; never a failure of the report.
Media MakeMedia(const RunData& run, const MediaPaths& paths, const MediaOptions& options = {});

}  // namespace etude
