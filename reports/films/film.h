#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/films/canvas.h"
#include "reports/films/media.h"

namespace etude {

constexpr int kFilmWidth = 1280, kFilmHeight = 720;
constexpr int kFilmRate = 30;

/// What a film shows, drawn frame by frame.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual int Frames() const = 0;
  /// The frame that tells most by itself.
  virtual int PosterFrame() const = 0;
  /// What is to be seen, in words.
  virtual std::string Words() const = 0;
  /// A canvas of kFilmWidth × kFilmHeight. Frames are asked for in order, the poster's before them.
  virtual Canvas Draw(int frame) = 0;
  /// When a beat clicks, seconds since the film began, ascending. None: the film is silent.
  virtual std::vector<double> Beats() const { return {}; }
};

/// An empty canvas of a film's size, with its heading in the uppermost 52 pixels.
Canvas BeginFrame(const std::string& heading);

Picture PictureOf(const Canvas& canvas, std::string caption);

/// Draws the poster and encodes all frames into `path`. Without an encoder the film is its poster, and says why; so it
/// is when whoever waits wants no more of it.
Film Shoot(Scene& scene, const std::filesystem::path& path, const FilmWatch& watch = {});

}  // namespace etude
