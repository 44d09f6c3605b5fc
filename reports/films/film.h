#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "reports/films/canvas.h"
#include "reports/films/film_workers.h"

namespace etude {

constexpr int kFilmWidth = 1280, kFilmHeight = 720;
constexpr int kFilmRate = 30;

/// The caller's side of a film being made: it hears how far the film is, and can stop it.
struct FilmWatch {
  std::function<void(const std::string& file, std::size_t done, std::size_t frames)> progress = {};
  const std::atomic<bool>* stop = nullptr;
  int jobs = 0;  ///< processes that draw; 0 = one per processor

  void Tell(const std::filesystem::path& film, std::size_t done, std::size_t frames) const {
    if (progress) progress(film.filename().string(), done, frames);
  }
  bool IsStopped() const { return stop != nullptr && *stop; }
};

/// A picture with the words that tell what it shows.
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
  std::string why_not;  ///< the reason, in plain words, when something could not be made
  Picture poster;       ///< png empty when nothing could be drawn; its caption is the film's
};

/// The content of a film, drawn frame by frame.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual int Frames() const = 0;
  /// Gives the frame that tells most by itself.
  virtual int PosterFrame() const = 0;
  /// Describes in words what is to be seen.
  virtual std::string Words() const = 0;
  /// Gives a canvas of kFilmWidth × kFilmHeight. Frames are asked for in any order, also by copies of this process;
  /// what a scene keeps from one to the next must not change them.
  virtual Canvas Draw(int frame) = 0;
  /// Gives the times at which a beat clicks, seconds since the film began, ascending; none in a silent film.
  virtual std::vector<double> Beats() const { return {}; }
};

/// Encodes frames that FilmWorkers draw into `path`, with a sound file or none. False when `watch` stopped it: there is
/// no file then.
Result<bool> EncodeFrames(const std::filesystem::path& path, int frames, int rate_hz,
                          const std::function<Canvas(int frame)>& draw, const FilmWatch& watch,
                          const std::filesystem::path& sound = {});
/// The same, in silence, of frames that are drawn from what `feed` gives.
Result<bool> EncodeFedFrames(const std::filesystem::path& path, int frames, int rate_hz, FrameFeed feed,
                             const FilmWorkers::Draw& draw, const FilmWatch& watch);

/// Makes an empty canvas of a film's size, with its heading in the uppermost 52 pixels.
Canvas BeginFrame(const std::string& heading);

Picture PictureOf(const Canvas& canvas, std::string caption);

/// Draws the poster and encodes all frames into `path`. Without an encoder, or when `watch` stops it, the film is its
/// poster and says why.
Film Shoot(Scene& scene, const std::filesystem::path& path, const FilmWatch& watch = {});

}  // namespace etude
