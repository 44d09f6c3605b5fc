#pragma once

#include <filesystem>

#include "engine/base/result.h"
#include "reports/clips/shot.h"
#include "reports/films/film_watch.h"
#include "sim/render/renderer.h"

namespace etude {

struct FilmOptions {
  Viewpoint from = Viewpoint::kThreeQuarter;
  int width = 720;  ///< even numbers
  int height = 720;
  FilmWatch watch = {};  ///< stopped early, it leaves no file
};

/// Films a clip from its first to its last frame as an MP4; the camera follows. False when it was stopped.
Result<bool> FilmClip(ClipActor actor, const FilmOptions& options, const std::filesystem::path& path,
                      Renderer& renderer);

}  // namespace etude
