#include "reports/films/film.h"

#include <optional>
#include <utility>

#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "bench/films/encoder.h"
#include "engine/formats/wav.h"
#include "reports/films/look.h"
#include "sim/music/music.h"

namespace etude {
namespace {

/// A click track that is there while its film is encoded.
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
  const std::filesystem::path& path() const { return path_; }  ///< empty: silence

 private:
  SoundFile() = default;
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path path_;
};

Result<std::string> Encode(Scene& scene, const std::filesystem::path& path, const FilmWatch& watch) {
  ASSIGN_OR_RETURN(const SoundFile sound, SoundFile::Make(scene));
  const auto draw = [&](int frame) { return scene.Draw(frame); };
  ASSIGN_OR_RETURN(const bool is_whole, EncodeFrames(path, scene.Frames(), kFilmRate, draw, watch, sound.path()));
  if (!is_whole) return Fail({}, "it was stopped");
  return ReadWholeFile(path);
}

Result<bool> EncodeDrawn(const std::filesystem::path& path, int frames, int rate_hz, FilmWorkers workers,
                         const FilmWatch& watch, const std::filesystem::path& sound) {
  ASSIGN_OR_RETURN(auto encoder,
                   Encoder::Start(path, workers.width(), workers.height(), rate_hz, sound, Encoder::Form::kI420));
  for (int frame = 0; frame < frames; ++frame) {
    if (watch.IsStopped()) return false;
    ASSIGN_OR_RETURN(const auto picture, workers.Next());
    RETURN_IF_ERROR(encoder.Add(picture));
    watch.Tell(path, static_cast<std::size_t>(frame + 1), static_cast<std::size_t>(frames));
  }
  RETURN_IF_ERROR(encoder.Finish());
  return true;
}

}  // namespace

Result<bool> EncodeFrames(const std::filesystem::path& path, int frames, int rate_hz,
                          const std::function<Canvas(int frame)>& draw, const FilmWatch& watch,
                          const std::filesystem::path& sound) {
  const auto draw_alone = [&](int frame, std::span<const std::uint8_t>) { return draw(frame); };
  ASSIGN_OR_RETURN(auto workers, FilmWorkers::Start(frames, watch.jobs, draw_alone));
  return EncodeDrawn(path, frames, rate_hz, std::move(workers), watch, sound);
}

Result<bool> EncodeFedFrames(const std::filesystem::path& path, int frames, int rate_hz, FrameFeed feed,
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

Film Shoot(Scene& scene, const std::filesystem::path& path, const FilmWatch& watch) {
  Film film;
  film.file = path.filename().string();
  film.poster = PictureOf(scene.Draw(scene.PosterFrame()), scene.Words());
  if (auto mp4 = Encode(scene, path, watch)) {
    film.mp4 = std::move(*mp4);
  } else {
    film.why_not = "There is no film, only this picture: " + ToString(mp4.error());
  }
  return film;
}

}  // namespace etude
