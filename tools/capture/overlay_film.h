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
  PixelFit fit;                                      ///< from the rig's pixels to the film's
  double offset = 0;                                 ///< its frame k was taken at k + offset of the motion's frames
  std::vector<std::optional<SeenPerson>> keypoints;  ///< of each frame of the motion, in the film's pixels; dots
  double drift = 0;                                  ///< … at (1 + drift) k + offset, if its rate is another one
};

/// Writes the films side by side, each with the skeleton as its camera would show it (lines) and the keypoints that it
/// was made of (dots). As many frames as `motion` has. Fails when a film cannot be read or ffmpeg cannot be started.
/// False when it was stopped; there is no file then.
/// @param middle where there is one, it becomes the frame in the middle
Result<bool> WriteOverlayFilm(const std::filesystem::path& path, std::span<const OverlayView> views,
                              const BodyMotion& motion, const FilmWatch& watch, Picture* middle = nullptr);

}  // namespace etude
