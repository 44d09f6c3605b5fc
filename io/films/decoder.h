#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

/// The facts of a film that are needed before its frames are read.
struct FilmFacts {
  int width = 0;  ///< as shown: a film that a telephone turned is told turned
  int height = 0;
  double rate_hz = 0;  ///< frames a second; of films without a constant rate the mean
  int frames = 0;
};

/// Asks ffprobe about the first video stream of a file; a picture is a film of one frame. Fails when it cannot be
/// started, when there is no such stream, and for frames of more than 64 million pixels.
Result<FilmFacts> ProbeFilm(const std::filesystem::path& path, const std::string& program = "ffprobe");

/// Reads the frames of any film (or picture) that ffmpeg knows, one after the other, through a pipe (started directly,
/// no shell); every frame once, whatever its time.
class Decoder {
 public:
  /// Fails when `program` cannot be started. `facts` are those of the file.
  static Result<Decoder> Start(const std::filesystem::path& path, const FilmFacts& facts,
                               const std::string& program = "ffmpeg");
  ~Decoder();
  Decoder(Decoder&& other) noexcept;
  Decoder& operator=(Decoder&&) = delete;

  /// Reads the next frame; false behind the last. Fails when ffmpeg has given up, with its last words.
  Result<bool> Next(ColourImage& frame);

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  Decoder(std::filesystem::path path, FilmFacts facts, pid_t child, File frames, File log);
  int CloseAndWait();

  std::filesystem::path path_;
  FilmFacts facts_;
  pid_t child_;  ///< −1 once it has ended
  File frames_;  ///< what ffmpeg writes
  File log_;     ///< what it says on its standard error
};

}  // namespace etude
