#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

/// The facts of a film that must be known before the film's frames are read.
struct FilmFacts {
  int width = 0;  ///< width as shown, after the rotation that a telephone may have stored
  int height = 0;
  double rate_hz = 0;  ///< frames per second; the mean for films without a constant rate
  int frames = 0;
};

/// Asks ffprobe about the first video stream of a file; a picture counts as a film of one frame. Fails if ffprobe
/// cannot be started, if there is no video stream, and for frames of more than 64 million pixels.
Result<FilmFacts> ProbeFilm(const std::filesystem::path& path, const std::string& program = "ffprobe");

/// Reads the frames of any film or picture that ffmpeg knows, one after the other, through a pipe. ffmpeg is started
/// directly, without a shell. Every frame is read once, whatever its timestamp.
class Decoder {
 public:
  /// Starts ffmpeg. Fails if `program` cannot be started. `facts` must be the facts of the same file.
  static Result<Decoder> Start(const std::filesystem::path& path, const FilmFacts& facts,
                               const std::string& program = "ffmpeg");
  ~Decoder();
  Decoder(Decoder&& other) noexcept;
  Decoder& operator=(Decoder&&) = delete;

  /// Reads the next frame; returns false after the last frame. Fails with ffmpeg's message if ffmpeg has stopped early.
  Result<bool> Next(ColourImage& frame);

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  Decoder(std::filesystem::path path, FilmFacts facts, pid_t child, File frames, File log);
  int CloseAndWait();

  std::filesystem::path path_;
  FilmFacts facts_;
  pid_t child_;  ///< process ID of ffmpeg; −1 after the process has ended
  File frames_;  ///< the pipe with ffmpeg's output
  File log_;     ///< a file with ffmpeg's standard error
};

}  // namespace etude
