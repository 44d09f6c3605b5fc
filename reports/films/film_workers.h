#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "reports/films/canvas.h"

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
  ~FilmWorkers();
  FilmWorkers(FilmWorkers&&) noexcept = default;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Gives the next frame (Canvas::ToI420), valid until the next call, and feeds those to come. Fails when a process
  /// has died, and as the feed does.
  Result<std::span<const std::uint8_t>> Next();

 private:
  struct Worker {
    pid_t child = -1;
    int talk = -1;           ///< a socket: bytes that say "drawn" from it, "fed", or without a feed "free again", to it
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
  [[noreturn]] void Work(std::size_t worker, int talk, const Draw& draw) const;
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

}  // namespace etude
