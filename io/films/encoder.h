#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "io/files/files.h"

namespace etude {

/// Makes an MP4 of pictures by piping them into ffmpeg (started directly, no shell). The same pictures
/// give the same bytes on every CPU. The file gets its name when it is whole; an encoder that is
/// dropped before Finish leaves nothing behind.
class Encoder {
 public:
  /// The form in which pictures are handed over: as they are, or as encoders take them (three planes, BT.601).
  enum class Form { kRgb, kI420 };

  /// Starts ffmpeg. Pictures must have this size (even numbers) and follow at `rate_hz`. `sound`: a WAV file that goes
  /// with them, kept without a loss (FLAC); empty = silence. Fails when `program` cannot be started, saying why.
  static Result<Encoder> Start(const FilePath& path, int width, int height, int rate_hz,
                               const std::filesystem::path& sound = {}, Form form = Form::kRgb,
                               const std::string& program = "ffmpeg");
  ~Encoder();
  Encoder(Encoder&& other) noexcept;
  Encoder& operator=(Encoder&&) = delete;

  /// Sends a picture. Fails when ffmpeg has stopped; its message comes with the error.
  Result<void> Add(const ColourImage& picture);
  /// Sends the bytes of a picture in the encoder's form.
  Result<void> Add(std::span<const std::uint8_t> picture);
  /// Waits for ffmpeg to end and puts the file at its path.
  Result<void> Finish();

 private:
  using Log = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  Encoder(PartialFile film, pid_t child, int pictures, Log log);
  tl::unexpected<Error> Complaint(const std::string& what);
  int CloseAndWait();

  PartialFile film_;
  pid_t child_;   ///< −1 once it has ended
  int pictures_;  ///< the socket that ffmpeg reads from; −1 once closed
  Log log_;       ///< what ffmpeg says on its standard error
};

}  // namespace etude
