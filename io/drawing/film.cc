#include "io/drawing/film.h"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "engine/base/machine.h"
#include "engine/formats/wav.h"
#include "io/drawing/look.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/films/encoder.h"
#include "sim/music/music.h"

namespace etude {
namespace {

// The number of consecutive frames that one process draws. A larger number lets one process draw all consecutive frames
// that show the same rendered picture; a smaller number lets all processes end at about the same time.
constexpr int kChunk = 8;

bool SendByte(int socket) { return SendAll(socket, "."); }

bool ReceiveByte(int socket) {
  char byte = 0;
  return ReceiveAll(socket, &byte, 1);
}

/// The file of a click track. The file exists only while the film is encoded.
class SoundFile {
 public:
  static Result<SoundFile> Make(const Scene& scene) {
    SoundFile sound;
    const std::vector<double> beats = scene.Beats();
    if (beats.empty()) return sound;
    constexpr int kSoundRate = 44100;
    ASSIGN_OR_RETURN(sound.folder_, TemporaryFolder::Make("sound"));
    sound.path_ = sound.folder_->path() / "clicks.wav";
    const double seconds = static_cast<double>(scene.Frames()) / kFilmRate;
    RETURN_IF_ERROR(
        WriteFileAtomically(sound.path_, WriteWav(ClickTrack(beats, seconds, kSoundRate), kSoundRate), OnDisk::kLater));
    return sound;
  }
  const std::filesystem::path& path() const { return path_; }  ///< path of the file; empty for a silent film

 private:
  SoundFile() = default;
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path path_;
};

Result<std::string> Encode(Scene& scene, const FilePath& path, const FilmWatch& watch) {
  ASSIGN_OR_RETURN(const SoundFile sound, SoundFile::Make(scene));
  const auto draw = [&](int frame) { return scene.Draw(frame); };
  ASSIGN_OR_RETURN(const bool is_whole, EncodeFrames(path, scene.Frames(), kFilmRate, draw, watch, sound.path()));
  if (!is_whole) return Fail({}, "it was stopped");
  return ReadWholeFile(path);
}

Result<bool> EncodeDrawn(const FilePath& path, int frames, double rate_hz, FilmWorkers workers, const FilmWatch& watch,
                         const std::filesystem::path& sound) {
  ASSIGN_OR_RETURN(auto encoder,
                   Encoder::Start(path, workers.width(), workers.height(), rate_hz, sound, Encoder::Form::kI420));
  for (int frame = 0; frame < frames; ++frame) {
    if (watch.IsStopped()) return false;
    ASSIGN_OR_RETURN(const auto picture, workers.Next());
    RETURN_IF_ERROR(encoder.Add(picture));
    watch.Tell(path.whole(), static_cast<std::size_t>(frame + 1), static_cast<std::size_t>(frames));
  }
  RETURN_IF_ERROR(encoder.Finish());
  return true;
}

}  // namespace

void FilmWorkers::Unmap::operator()(std::uint8_t* memory) const { munmap(memory, bytes); }

// With a feed, data arrive in the order of frames, so the processes alternate after every frame (chunks of 1).
FilmWorkers::FilmWorkers(int frames, int jobs, int width, int height, FrameFeed feed)
    : frames_(frames),
      width_(width),
      height_(height),
      feed_(std::move(feed)),
      chunk_(feed_.bytes > 0 ? 1 : kChunk),
      slots_(2 * chunk_),
      workers_(static_cast<std::size_t>(std::clamp((frames + chunk_ - 1) / chunk_, 1, jobs))) {}

Result<void> FilmWorkers::MapSlots() {
  const std::size_t slots = workers_.size() * static_cast<std::size_t>(slots_), bytes = slots * SlotBytes();
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    return FailOfMachine("there is not enough memory for {} frames: {}", slots, std::strerror(errno));
  memory_ = {static_cast<std::uint8_t*>(memory), Unmap{bytes}};
  return {};
}

FilmWorkers::Slot FilmWorkers::SlotOf(std::size_t worker, int index) const {
  std::uint8_t* begin =
      memory_.get() +
      (worker * static_cast<std::size_t>(slots_) + static_cast<std::size_t>(index % slots_)) * SlotBytes();
  return {{begin, PictureBytes()}, {begin + PictureBytes(), feed_.bytes}};
}

std::size_t FilmWorkers::WorkerOf(int frame) const {
  return static_cast<std::size_t>(frame / chunk_) % workers_.size();
}

int FilmWorkers::Work(std::size_t worker, int socket, const Draw& draw) const {
  int drawn = 0;
  for (int frame = 0; frame < frames_; ++frame) {
    if (WorkerOf(frame) != worker) continue;
    if ((feed_.bytes > 0 || drawn >= slots_) && !ReceiveByte(socket)) break;
    const Slot slot = SlotOf(worker, drawn);
    draw(frame, slot.feed).ToI420(slot.picture.data());
    if (!SendByte(socket)) break;
    ++drawn;
  }
  return 0;
}

Result<FilmWorkers> FilmWorkers::Start(int frames, int jobs, const Draw& draw, FrameFeed feed) {
  if (jobs <= 0) jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::uint8_t> first_data(feed.bytes);
  if (feed.bytes > 0) RETURN_IF_ERROR(feed.fill(0, first_data));
  const Canvas first = draw(0, first_data);
  FilmWorkers film(frames, jobs, first.width(), first.height(), std::move(feed));
  RETURN_IF_ERROR(film.MapSlots());
  for (std::size_t i = 0; i < film.workers_.size(); ++i) {
    ASSIGN_OR_RETURN(auto copy, ForkedCopy::Start([&](int socket) { return film.Work(i, socket, draw); }));
    film.workers_[i].copy = std::move(copy);
  }
  if (film.feed_.bytes > 0) {
    std::ranges::copy(first_data, film.SlotOf(0, 0).feed.begin());
    film.TellFed(0);
  }
  return film;
}

void FilmWorkers::TellFed(std::size_t worker) {
  ++fed_;
  ++workers_[worker].fed;
  SendByte(workers_[worker].copy->socket());
}

Result<void> FilmWorkers::FeedAhead() {
  while (feed_.bytes > 0 && fed_ < frames_) {
    const std::size_t worker = WorkerOf(fed_);
    if (workers_[worker].fed - workers_[worker].taken == slots_) break;
    RETURN_IF_ERROR(feed_.fill(fed_, SlotOf(worker, workers_[worker].fed).feed));
    TellFed(worker);
  }
  return {};
}

Result<std::span<const std::uint8_t>> FilmWorkers::Next() {
  if (next_ > 0) {
    Worker& last = workers_[WorkerOf(next_ - 1)];
    ++last.taken;
    if (feed_.bytes == 0) SendByte(last.copy->socket());
  }
  RETURN_IF_ERROR(FeedAhead());
  const std::size_t worker = WorkerOf(next_);
  if (next_ >= frames_ || !ReceiveByte(workers_[worker].copy->socket()))
    return Fail({}, "a drawing process ended before it had drawn all of its frames");
  ++next_;
  return SlotOf(worker, workers_[worker].taken).picture;
}

Result<bool> EncodeFrames(const FilePath& path, int frames, double rate_hz,
                          const std::function<Canvas(int frame)>& draw, const FilmWatch& watch,
                          const std::filesystem::path& sound) {
  const auto draw_alone = [&](int frame, std::span<const std::uint8_t>) { return draw(frame); };
  ASSIGN_OR_RETURN(auto workers, FilmWorkers::Start(frames, watch.jobs, draw_alone));
  return EncodeDrawn(path, frames, rate_hz, std::move(workers), watch, sound);
}

Result<bool> EncodeFedFrames(const FilePath& path, int frames, double rate_hz, FrameFeed feed,
                             const FilmWorkers::Draw& draw, const FilmWatch& watch) {
  ASSIGN_OR_RETURN(auto workers, FilmWorkers::Start(frames, watch.jobs, draw, std::move(feed)));
  return EncodeDrawn(path, frames, rate_hz, std::move(workers), watch, {});
}

Canvas BeginFrame(const std::string& heading) {
  Canvas canvas(kFilmWidth, kFilmHeight);
  canvas.FillBox({0, 0, kFilmWidth, kFilmHeight}, kBackdrop);
  canvas.DrawText({16, 34}, "Etude", 20, kInk, 120, true);
  canvas.DrawText({92, 33}, heading, 17, kSoftInk, kFilmWidth - 108);
  return canvas;
}

Picture PictureOf(const Canvas& canvas, std::string caption) {
  return {canvas.Png(), canvas.width(), canvas.height(), std::move(caption)};
}

Film Shoot(Scene& scene, const FilePath& path, const FilmWatch& watch) {
  Film film;
  film.file = path.whole().filename().string();
  film.poster = PictureOf(scene.Draw(scene.PosterFrame()), scene.Words());
  if (auto mp4 = Encode(scene, path, watch)) {
    film.mp4 = std::move(*mp4);
  } else {
    film.why_not = "Etude made only this picture, because it could not make the film: " + ToString(mp4.error());
  }
  return film;
}

}  // namespace etude
