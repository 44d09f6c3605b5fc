#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/keypoints/people.h"
#include "engine/keypoints/pixel_fit.h"
#include "engine/motion/body.h"
#include "io/drawing/film.h"
#include "io/films/decoder.h"

namespace etude {

/// One camera's film, and the keypoints that are drawn over it.
struct OverlayView {
  std::string name;
  std::filesystem::path film;
  FilmFacts facts;
  Camera camera;
  PixelFit fit;  ///< maps the rig's pixels to the film's pixels
  /// Frame k of the film was taken at k + offset frames of the motion.
  double offset = 0;
  /// The person's keypoints in each frame of the motion, in the film's pixels; nullopt if nobody was seen.
  std::vector<std::optional<SeenPerson>> keypoints;
  /// If the rates differ, frame k of the film was taken at (1 + drift) k + offset frames of the motion.
  double drift = 0;
};

/// Writes the films side by side. Over each film, the skeleton is drawn as lines, as the camera would show it, and the
/// keypoints are drawn as dots. The result has as many frames as `motion`. Fails if a film cannot be read or ffmpeg
/// cannot be started. Returns false, and leaves no file, if the writing was stopped.
/// @param middle if not null, receives the middle frame
Result<bool> WriteOverlayFilm(const std::filesystem::path& path, std::span<const OverlayView> views,
                              const BodyMotion& motion, const FilmWatch& watch, Picture* middle = nullptr);

}  // namespace etude
