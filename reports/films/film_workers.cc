#include "reports/films/film_workers.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <thread>

namespace etude {
namespace {

// Long enough that frames which share a picture share a process, short enough that all of them end together.
constexpr int kChunk = 8;
// Frames that a process may be ahead.
constexpr int kSlots = 2 * kChunk;

bool Tell(int talk) {
  const char byte = 1;
  ssize_t sent = 0;
  do sent = send(talk, &byte, 1, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == 1;
}

bool Hear(int talk) {
  char byte = 0;
  ssize_t heard = 0;
  do heard = recv(talk, &byte, 1, 0);
  while (heard < 0 && errno == EINTR);
  return heard == 1;
}

}  // namespace

void FilmWorkers::Unmap::operator()(std::uint8_t* memory) const { munmap(memory, bytes); }

FilmWorkers::FilmWorkers(int frames, int jobs, int width, int height)
    : frames_(frames), width_(width), height_(height), taken_(static_cast<std::size_t>(jobs)) {}

std::uint8_t* FilmWorkers::Slot(std::size_t worker, int drawn) const {
  const std::size_t bytes = static_cast<std::size_t>(width_) * height_ * 3 / 2;
  return pictures_.get() + (worker * kSlots + static_cast<std::size_t>(drawn % kSlots)) * bytes;
}

std::size_t FilmWorkers::WorkerOf(int frame) const { return static_cast<std::size_t>(frame / kChunk) % taken_.size(); }

void FilmWorkers::Work(std::size_t worker, int talk, const Draw& draw) const {
  int drawn = 0;
  for (int frame = 0; frame < frames_; ++frame) {
    if (WorkerOf(frame) != worker) continue;
    if (drawn >= kSlots && !Hear(talk)) break;
    draw(frame).ToI420(Slot(worker, drawn));
    if (!Tell(talk)) break;
    ++drawn;
  }
  _exit(0);  // nothing of our parent's is ended
}

Result<FilmWorkers> FilmWorkers::Start(int frames, int jobs, const Draw& draw) {
  if (jobs <= 0) jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  jobs = std::clamp((frames + kChunk - 1) / kChunk, 1, jobs);
  const Canvas first = draw(0);
  FilmWorkers film(frames, jobs, first.width(), first.height());
  const std::size_t bytes = static_cast<std::size_t>(jobs) * kSlots * first.width() * first.height() * 3 / 2;
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    return Fail({}, "there is no memory for {} frames: {}", jobs * kSlots, std::strerror(errno));
  film.pictures_ = {static_cast<std::uint8_t*>(memory), Unmap{bytes}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(jobs); ++i) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      return Fail({}, "cannot talk to a drawing process: {}", std::strerror(errno));
    }
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      for (const Worker& other : film.workers_) close(other.talk);
      film.Work(i, ends[1], draw);
    }
    close(ends[1]);
    film.workers_.push_back({child, ends[0]});
    if (child < 0) return Fail({}, "cannot start a drawing process: {}", std::strerror(errno));
  }
  return film;
}

FilmWorkers::~FilmWorkers() {
  for (const Worker& worker : workers_) {
    close(worker.talk);
    if (worker.child < 0) continue;
    kill(worker.child, SIGKILL);
    while (waitpid(worker.child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

Result<std::span<const std::uint8_t>> FilmWorkers::Next() {
  if (next_ > 0) {
    const std::size_t last = WorkerOf(next_ - 1);
    ++taken_[last];
    Tell(workers_[last].talk);
  }
  const std::size_t worker = WorkerOf(next_);
  if (next_ >= frames_ || !Hear(workers_[worker].talk))
    return Fail({}, "a drawing process has ended before its frames");
  ++next_;
  return std::span<const std::uint8_t>(Slot(worker, taken_[worker]),
                                       static_cast<std::size_t>(width_) * height_ * 3 / 2);
}

}  // namespace etude
