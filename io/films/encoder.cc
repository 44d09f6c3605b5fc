#include "io/films/encoder.h"

#include <fmt/core.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/machine.h"
#include "io/process/spawn.h"

namespace etude {
namespace {

// Preset veryfast gives the smallest files on drawn films; no other preset is more than two milliseconds faster per
// frame of 720 × 720. The number of threads and the processor's instructions change the bytes, so x264 runs one thread
// and chooses no algorithm by the processor (cpu-independent). The bitexact flags keep dates and versions out of the
// file. FLAC needs no floating-point arithmetic, so its bytes are the same on every CPU, and browsers play it in an
// MP4. FFV1 with Golomb-Rice codes and the small context takes half the time of FFV1's range coder, and gives files of
// the same size for noisy pictures; every frame is a key frame, so that players seek exactly.
std::vector<std::string> Arguments(const std::string& program, int width, int height, double rate_hz,
                                   const std::filesystem::path& sound, Encoder::Form form) {
  const bool is_drawn = form == Encoder::Form::kI420;
  std::vector<std::string> all = {program, "-loglevel", "error", "-xerror", "-y"};
  const auto add = [&](const std::vector<std::string>& words) { all.insert(all.end(), words.begin(), words.end()); };
  add({"-f", "rawvideo", "-pix_fmt", is_drawn ? "yuv420p" : "rgb24", "-s", fmt::format("{}x{}", width, height)});
  add({"-r", fmt::format("{:.9g}", rate_hz), "-i", "-"});
  if (!sound.empty()) add({"-i", sound.string(), "-c:a", "flac", "-strict", "-2", "-flags:a", "+bitexact"});
  if (sound.empty()) add({"-an"});
  const bool is_exact = form == Encoder::Form::kExactRgb;
  if (is_exact) {
    add({"-c:v", "ffv1", "-level", "3", "-coder", "0", "-context", "0", "-g", "1", "-slices", "4", "-pix_fmt", "bgr0"});
  } else {
    add({"-sws_flags", "+accurate_rnd+bitexact", "-c:v", "libx264", "-preset", "veryfast", "-crf", "20"});
    add({"-x264-params", "cpu-independent=1", "-pix_fmt", "yuv420p"});
  }
  add({"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
  // ffmpeg writes to its standard output, the open file. A path is not used, because somebody may have put a link at
  // that path. ffmpeg opens the file again through /proc, because MP4 needs an output that can seek.
  add({"-map_metadata", "-1", "-f", is_exact ? "matroska" : "mp4", "/proc/self/fd/1"});
  return all;
}

}  // namespace

Result<Encoder> Encoder::Start(const FilePath& path, int width, int height, double rate_hz,
                               const std::filesystem::path& sound, Form form, const std::string& program) {
  const Place place{.file = path.string()};
  ASSIGN_OR_RETURN(auto film, PartialFile::Claim(path));
  Log log(std::tmpfile(), std::fclose);
  if (!log) return FailOfMachine("Etude cannot create a temporary file: {}", std::strerror(errno));
  // Use a socket and not a pipe: writing to a closed socket returns an error, but writing to a closed pipe raises a
  // signal.
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return FailOfMachine("no connection to {}: {}", program, std::strerror(errno));
  }
  pid_t child = -1;
  const int error =
      SpawnProgram(Arguments(program, width, height, rate_hz, sound, form), ends[1], film.file(), log.get(), child);
  close(ends[1]);
  if (error != 0) close(ends[0]);
  if (error != 0 && error != ENOENT) {
    return FailOfMachine("{} cannot be started: {}", program, std::strerror(error));
  }
  if (error != 0) {
    return Fail(place, "the program {} could not be started ({}); install the Debian package of the same name", program,
                std::strerror(error));
  }
  return Encoder(std::move(film), child, ends[0], std::move(log));
}

Encoder::Encoder(PartialFile film, pid_t child, int pictures, Log log)
    : film_(std::move(film)), child_(child), pictures_(pictures), log_(std::move(log)) {}

Encoder::Encoder(Encoder&& other) noexcept
    : film_(std::move(other.film_)),
      child_(std::exchange(other.child_, -1)),
      pictures_(std::exchange(other.pictures_, -1)),
      log_(std::move(other.log_)) {}

Encoder::~Encoder() {
  if (child_ < 0) return;
  kill(child_, SIGKILL);
  CloseAndWait();
}

Result<void> Encoder::Add(const ColourImage& picture) {
  static_assert(sizeof(Rgb8) == 3, "pictures are sent in their layout in memory");
  return Add({reinterpret_cast<const std::uint8_t*>(picture.pixels.data()), picture.pixels.size() * sizeof(Rgb8)});
}

Result<void> Encoder::Add(std::span<const std::uint8_t> picture) {
  const std::uint8_t* bytes = picture.data();
  std::size_t left = picture.size();
  while (left > 0) {
    const ssize_t sent = send(pictures_, bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      CloseAndWait();
      return Complaint("ffmpeg stopped early");
    }
    bytes += sent;
    left -= static_cast<std::size_t>(sent);
  }
  return {};
}

Result<void> Encoder::Finish() {
  const int status = CloseAndWait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return film_.Finish();
  return Complaint(WIFEXITED(status) ? fmt::format("ffmpeg ended with code {}", WEXITSTATUS(status))
                                     : "ffmpeg was killed");
}

int Encoder::CloseAndWait() {
  if (pictures_ >= 0) close(std::exchange(pictures_, -1));
  return WaitFor(std::exchange(child_, -1));
}

tl::unexpected<Error> Encoder::Complaint(const std::string& what) {
  const std::string words = FirstLineOf(log_.get());
  if (auto room = film_.CheckRoom(); !room) return tl::unexpected(room.error());
  return Fail({film_.path().string()}, "{}{}{}", what, words.empty() ? "" : ": ", words);
}

}  // namespace etude
