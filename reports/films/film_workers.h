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

/// Draws the frames of a film in several processes, which begin as copies of this one, and hands them over in order.
/// Each draws chunks of frames that follow each other. Frames may keep what they like for the next one, as long as the
/// picture does not depend on it: then the film is the same whoever drew what.
class FilmWorkers {
 public:
  /// Draws a frame, 0 … `frames` − 1; all canvases have one size with even sides.
  using Draw = std::function<Canvas(int frame)>;

  /// Draws the first frame here, so that what every frame needs is made once, and starts `jobs` processes (0 = one per
  /// processor). Threads of this process, if it has any, must not hold what `draw` needs.
  static Result<FilmWorkers> Start(int frames, int jobs, const Draw& draw);
  ~FilmWorkers();
  FilmWorkers(FilmWorkers&&) noexcept = default;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Gives the next frame (Canvas::ToI420), valid until the next call. Fails when a process has died.
  Result<std::span<const std::uint8_t>> Next();

 private:
  struct Worker {
    pid_t child = -1;
    int talk = -1;  ///< a socket: bytes that say "drawn" from it, "free again" to it
  };
  struct Unmap {
    std::size_t bytes;
    void operator()(std::uint8_t* memory) const;
  };

  FilmWorkers(int frames, int jobs, int width, int height);
  std::uint8_t* Slot(std::size_t worker, int drawn) const;
  [[noreturn]] void Work(std::size_t worker, int talk, const Draw& draw) const;
  std::size_t WorkerOf(int frame) const;

  int frames_, width_, height_;
  int next_ = 0;
  std::vector<Worker> workers_;
  std::vector<int> taken_;                                            ///< by worker: frames handed over
  std::unique_ptr<std::uint8_t, Unmap> pictures_{nullptr, Unmap{0}};  ///< kSlots for each worker, shared with it
};

}  // namespace etude
