#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "io/files/files.h"

namespace etude {

/// Encodes pictures as a film by sending them to ffmpeg, which is started directly, without a shell. The same pictures
/// give the same bytes on every CPU. The film's file gets its final name when the film is complete; an encoder that is
/// destroyed before Finish leaves no file.
class Encoder {
 public:
  /// The format of the pictures and of the film. kRgb and kI420 make an MP4 (H.264, lossy): kRgb from RGB pictures,
  /// kI420 from pictures in the form that the encoder needs (three planes, BT.601). kExactRgb makes a Matroska file
  /// (FFV1) that keeps every bit of RGB pictures.
  enum class Form { kRgb, kI420, kExactRgb };

  /// Starts ffmpeg. All pictures must have this size (even numbers, unless the form is kExactRgb); they are shown at
  /// `rate_hz`. `sound` is a WAV file that is stored losslessly (FLAC); empty = silence. Fails with the reason if
  /// `program` cannot be started.
  static Result<Encoder> Start(const FilePath& path, int width, int height, double rate_hz,
                               const std::filesystem::path& sound = {}, Form form = Form::kRgb,
                               const std::string& program = "ffmpeg");
  ~Encoder();
  Encoder(Encoder&& other) noexcept;
  Encoder& operator=(Encoder&&) = delete;

  /// Sends a picture. Fails with ffmpeg's message if ffmpeg has stopped.
  Result<void> Add(const ColourImage& picture);
  /// Sends the bytes of a picture in the encoder's form.
  Result<void> Add(std::span<const std::uint8_t> picture);
  /// Waits until ffmpeg ends and renames the film's file to its final path. Fails with ffmpeg's message if ffmpeg
  /// failed.
  Result<void> Finish();

 private:
  using Log = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  Encoder(PartialFile film, pid_t child, int pictures, Log log);
  tl::unexpected<Error> Complaint(const std::string& what);
  int CloseAndWait();

  PartialFile film_;
  pid_t child_;   ///< process ID of ffmpeg; −1 after it has ended
  int pictures_;  ///< the socket that ffmpeg reads; −1 after it is closed
  Log log_;       ///< a file with ffmpeg's standard error
};

}  // namespace etude
