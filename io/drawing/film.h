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

/// Supplies the data that the frames need and that only this process can produce: the pictures of a film that is read,
/// or the positions of a moving crowd.
struct FrameFeed {
  std::size_t bytes = 0;  ///< bytes of every frame; 0 = frames need no data
  /// Fills in the data of a frame. FilmWorkers calls this function once for each frame, in order, before the frame is
  /// drawn.
  std::function<Result<void>(int frame, std::span<std::uint8_t> into)> fill = {};
};

/// Draws the frames of a film in several processes, which start as copies of this process, and returns the frames in
/// order. Each process draws chunks of consecutive frames. The function that draws a frame may cache data for the next
/// frame, but no picture may depend on the cache. The film is therefore the same for any number of processes.
class FilmWorkers {
 public:
  /// Draws the frame with number 0 … `frames` − 1 from the frame's data; all canvases have the same size, with even
  /// width and height.
  using Draw = std::function<Canvas(int frame, std::span<const std::uint8_t> fed)>;

  /// Draws the first frame in this process, so that all processes get the data that drawing the first frame computes.
  /// Then starts `jobs` processes (0 = one per processor). Other threads of this process must not hold a lock that
  /// `draw` needs.
  static Result<FilmWorkers> Start(int frames, int jobs, const Draw& draw, FrameFeed feed = {});
  FilmWorkers(FilmWorkers&&) noexcept = default;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns the next frame (Canvas::ToI420), valid until the next call, and feeds the data of later frames to the
  /// processes. Fails if a process has died or if the feed fails.
  Result<std::span<const std::uint8_t>> Next();

 private:
  struct Worker {
    /// The socket carries single bytes. The drawing process sends a byte for "drawn"; this process sends a byte for
    /// "the next frame's data have arrived", or, without a feed, for "a slot is free".
    std::optional<ForkedCopy> copy;
    int fed = 0, taken = 0;  ///< counts of the worker's frames: data sent to it, pictures taken from it
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
  Slot SlotOf(std::size_t worker, int index) const;
  int Work(std::size_t worker, int socket, const Draw& draw) const;
  void TellFed(std::size_t worker);
  Result<void> FeedAhead();
  std::size_t PictureBytes() const { return static_cast<std::size_t>(width_) * height_ * 3 / 2; }
  std::size_t SlotBytes() const { return (PictureBytes() + feed_.bytes + 63) / 64 * 64; }
  std::size_t WorkerOf(int frame) const;

  int frames_, width_, height_;
  FrameFeed feed_;
  int chunk_, slots_;  ///< frames per chunk; maximum number of frames that a process may draw ahead of Next
  int next_ = 0, fed_ = 0;
  std::vector<Worker> workers_;
  std::unique_ptr<std::uint8_t, Unmap> memory_{nullptr, Unmap{0}};  ///< `slots_` slots for each process
};

constexpr int kFilmWidth = 1280, kFilmHeight = 720;
constexpr int kFilmRate = 30;

/// Lets a caller observe the progress of a film, and stop the film.
struct FilmWatch {
  std::function<void(const std::string& file, std::size_t done, std::size_t frames)> progress = {};
  const std::atomic<bool>* stop = nullptr;
  int jobs = 0;  ///< processes that draw; 0 = one per processor

  void Tell(const std::filesystem::path& film, std::size_t done, std::size_t frames) const {
    if (progress) progress(film.filename().string(), done, frames);
  }
  bool IsStopped() const { return stop != nullptr && *stop; }
};

/// A picture, and a caption that says what the picture shows.
struct Picture {
  std::string png;  ///< bytes of a PNG file
  int width = 0;
  int height = 0;
  std::string caption;
};

/// A picture from a camera of the run, with its caption.
struct Still {
  std::string jpeg_base64;  ///< bytes of a JPEG in base64, so no character needs escaping
  std::string caption;
};

/// A film, with everything that the page shows about it.
struct Film {
  std::string file;     ///< file name in the run's folder `video`
  std::string mp4;      ///< bytes of the file; empty if there is none
  std::string why_not;  ///< the reason, in plain words, why the film or its poster could not be made
  Picture poster;       ///< the poster, with the film's caption; `poster.png` is empty if it could not be drawn
};

/// The content of a film, drawn frame by frame.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual int Frames() const = 0;
  /// Returns the frame that explains the film best as a still picture.
  virtual int PosterFrame() const = 0;
  /// Returns a description of what the film shows.
  virtual std::string Words() const = 0;
  /// Returns a canvas of kFilmWidth × kFilmHeight. Frames are drawn in any order, and by copies of this process, so
  /// pictures must not depend on data that a scene keeps between frames.
  virtual Canvas Draw(int frame) = 0;
  /// Returns the times of the audible beats, ascending, in seconds since the start of the film; empty for a film
  /// without sound.
  virtual std::vector<double> Beats() const { return {}; }
};

/// Draws frames with FilmWorkers and encodes them into `path`, with a sound file unless `sound` is empty. Returns
/// false, and leaves no file, if `watch` stopped the film.
Result<bool> EncodeFrames(const FilePath& path, int frames, double rate_hz,
                          const std::function<Canvas(int frame)>& draw, const FilmWatch& watch,
                          const std::filesystem::path& sound = {});
/// Works like EncodeFrames without sound, for frames that are drawn from the data of `feed`.
Result<bool> EncodeFedFrames(const FilePath& path, int frames, double rate_hz, FrameFeed feed,
                             const FilmWorkers::Draw& draw, const FilmWatch& watch);

/// Returns an empty canvas of a film's size, with the heading in its top 52 pixels.
Canvas BeginFrame(const std::string& heading);

Picture PictureOf(const Canvas& canvas, std::string caption);

/// Draws the poster and encodes all frames into `path`. Without an encoder, or if `watch` stops the film, the result
/// holds only the poster and the reason.
Film Shoot(Scene& scene, const FilePath& path, const FilmWatch& watch = {});

}  // namespace etude
