#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/drawing/canvas.h"
#include "io/files/file_path.h"
#include "io/process/forked_copy.h"

namespace etude {

/// The bytes that the frames of a film are drawn from, where only this process can tell them, frame by frame: the
/// pictures of a film that is read, a crowd that is followed.
struct FrameFeed {
  std::size_t bytes = 0;  ///< of every frame; 0 = frames need nothing
  /// Fills in what a frame is drawn from. Asked once for each, in order, before it is drawn.
  std::function<Result<void>(int frame, std::span<std::uint8_t> into)> fill = {};
};

/// Draws the frames of a film in several processes, which begin as copies of this one, and hands them over in order.
/// Each draws chunks of frames that follow each other. Frames may keep what they like for the next one, as long as the
/// picture does not depend on it: then the film is the same whoever drew what.
class FilmWorkers {
 public:
  /// Draws a frame, 0 … `frames` − 1, from what it was fed; all canvases have one size with even sides.
  using Draw = std::function<Canvas(int frame, std::span<const std::uint8_t> fed)>;

  /// Draws the first frame here, so that what every frame needs is made once, and starts `jobs` processes (0 = one per
  /// processor). Threads of this process, if it has any, must not hold what `draw` needs.
  static Result<FilmWorkers> Start(int frames, int jobs, const Draw& draw, FrameFeed feed = {});
  FilmWorkers(FilmWorkers&&) noexcept = default;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Gives the next frame (Canvas::ToI420), valid until the next call, and feeds those to come. Fails when a process
  /// has died, and as the feed does.
  Result<std::span<const std::uint8_t>> Next();

 private:
  struct Worker {
    /// On its socket, bytes say "drawn" from it, and "fed", or without a feed "free again", to it.
    std::optional<ForkedCopy> copy;
    int fed = 0, taken = 0;  ///< frames of its own
  };
  struct Unmap {
    std::size_t bytes;
    void operator()(std::uint8_t* memory) const;
  };

  /// Memory for one frame, shared with the process that draws it.
  struct Slot {
    std::span<std::uint8_t> picture, feed;
  };

  FilmWorkers(int frames, int jobs, int width, int height, FrameFeed feed);
  Result<void> MapSlots();
  Slot SlotOf(std::size_t worker, int place) const;
  int Work(std::size_t worker, int talk, const Draw& draw) const;
  void TellFed(std::size_t worker);
  Result<void> FeedAhead();
  std::size_t PictureBytes() const { return static_cast<std::size_t>(width_) * height_ * 3 / 2; }
  std::size_t SlotBytes() const { return (PictureBytes() + feed_.bytes + 63) / 64 * 64; }
  std::size_t WorkerOf(int frame) const;

  int frames_, width_, height_;
  FrameFeed feed_;
  int chunk_, slots_;  ///< frames in a row that one process draws; frames that it may be ahead
  int next_ = 0, fed_ = 0;
  std::vector<Worker> workers_;
  std::unique_ptr<std::uint8_t, Unmap> memory_{nullptr, Unmap{0}};  ///< so many slots for each worker
};

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
Result<bool> EncodeFrames(const FilePath& path, int frames, int rate_hz, const std::function<Canvas(int frame)>& draw,
                          const FilmWatch& watch, const std::filesystem::path& sound = {});
/// The same, in silence, of frames that are drawn from what `feed` gives.
Result<bool> EncodeFedFrames(const FilePath& path, int frames, int rate_hz, FrameFeed feed,
                             const FilmWorkers::Draw& draw, const FilmWatch& watch);

/// Makes an empty canvas of a film's size, with its heading in the uppermost 52 pixels.
Canvas BeginFrame(const std::string& heading);

Picture PictureOf(const Canvas& canvas, std::string caption);

/// Draws the poster and encodes all frames into `path`. Without an encoder, or when `watch` stops it, the film is its
/// poster and says why.
Film Shoot(Scene& scene, const FilePath& path, const FilmWatch& watch = {});

}  // namespace etude
