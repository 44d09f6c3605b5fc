#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"

namespace etude {

/// The facts of a film that must be known before the film's frames are read.
struct FilmFacts {
  int width = 0;  ///< width as shown, after the rotation that a telephone may have stored
  int height = 0;
  double rate_hz = 0;  ///< frames per second
  int frames = 0;      ///< number of pictures that decoders give
  int turned = 0;      ///< clockwise quarter turns, 0 to 3, from the stored pictures to the shown ones
  /// For a film whose pictures are unevenly spaced in time: for each frame of even spacing at `rate_hz`, the index of
  /// its picture, with a fraction if the frame lies between two pictures, or −1 if its picture is missing. Empty for
  /// other films, whose frame k is picture k.
  std::vector<double> pictures;
  std::string remark;  ///< what the times in the file show; "" if the pictures are evenly spaced

  int EvenFrames() const { return pictures.empty() ? frames : static_cast<int>(pictures.size()); }
  /// Returns the picture that is shown at an even frame: the nearest, or the one before a missing picture.
  int PictureAt(int frame) const;
  /// Returns the even frame of each picture; −1 for pictures that no even frame is nearest to.
  std::vector<int> FramesOfPictures() const;
};

/// Asks ffprobe about the first video stream of a file; a picture counts as a film of one frame. Fails if ffprobe
/// cannot be started, if there is no video stream, and for frames of more than 64 million pixels. Pictures that an edit
/// list hides, and those before the first key frame, do not count. The pictures' times decide whether they are evenly
/// spaced: `pictures` is set if they are more than 0.4 frames off an even spacing.
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
