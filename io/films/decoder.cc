#include "io/films/decoder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/machine.h"
#include "io/process/spawn.h"

namespace etude {
namespace {

using Words = std::vector<std::string>;
using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

struct Child {
  pid_t pid = -1;
  OpenFile output{nullptr, std::fclose};
  OpenFile log{nullptr, std::fclose};
};

Result<Child> StartReading(const Words& words, const Place& place) {
  Child child;
  child.log.reset(std::tmpfile());
  int ends[2];
  if (!child.log || pipe2(ends, O_CLOEXEC) != 0)
    return FailOfMachine("no connection to {}: {}", words[0], std::strerror(errno));
  constexpr int kPipeBytes = 1 << 20;  // for fewer context switches; if the kernel refuses, the default size will do
  fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);
  const int error = SpawnProgram(words, kNowhere, ends[1], child.log.get(), child.pid);
  close(ends[1]);
  child.output.reset(fdopen(ends[0], "rb"));
  if (error != 0 && error != ENOENT) {
    return FailOfMachine("{} cannot be started: {}", words[0], std::strerror(error));
  }
  if (error != 0) {
    return Fail(place, "{} could not be started ({}); it is in the Debian package ffmpeg", words[0],
                std::strerror(error));
  }
  return child;
}

/// Reads lines "key=value". If a key occurs several times, the first value counts.
std::map<std::string, std::string> ReadKeys(std::FILE* file) {
  std::map<std::string, std::string> keys;
  std::array<char, 256> line;
  while (std::fgets(line.data(), line.size(), file) != nullptr) {
    std::string text(line.data());
    text.erase(text.find_last_not_of("\r\n") + 1);
    if (const std::size_t equals = text.find('='); equals != std::string::npos) {
      keys.emplace(text.substr(0, equals), text.substr(equals + 1));
    }
  }
  return keys;
}

double NumberOf(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Reads a ratio such as "60/1"; returns 0 if the text is no ratio.
double RatioOf(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double low = slash == std::string::npos ? 1 : NumberOf(text.substr(slash + 1));
  return low > 0 ? NumberOf(text.substr(0, slash)) / low : 0;
}

}  // namespace

Result<FilmFacts> ProbeFilm(const std::filesystem::path& path, const std::string& program) {
  const Place place{.file = path.string()};
  if (std::filesystem::is_directory(path)) return Fail(place, "is a folder; the name of a film is needed");
  if (!std::filesystem::is_regular_file(path)) return Fail(place, "no such file");
  // Ask for the size, the rates, the number of packets and the rotation of the first video stream.
  ASSIGN_OR_RETURN(
      const Child child,
      StartReading({program, "-v", "error", "-select_streams", "v:0", "-count_packets", "-show_entries",
                    "stream=width,height,avg_frame_rate,r_frame_rate,nb_read_packets:stream_side_data=rotation", "-of",
                    "default=nw=1", "file:" + path.string()},
                   place));
  auto keys = ReadKeys(child.output.get());
  if (const int status = WaitFor(child.pid); !WIFEXITED(status) || WEXITSTATUS(status) != 0 || keys.empty()) {
    const std::string words = FirstLineOf(child.log.get());
    return Fail(place, "not a film that ffmpeg can read{}{}", words.empty() ? "" : ": ", words);
  }
  // Check the size before it is converted to integers.
  FilmFacts facts;
  constexpr double kMaxPixels = 64e6;
  const double width = NumberOf(keys["width"]), height = NumberOf(keys["height"]);
  const double frames = NumberOf(keys["nb_read_packets"]);
  constexpr double kMaxFrames = 1e8;
  if (!(width >= 1) || !(height >= 1) || !(width * height <= kMaxPixels) || !(frames >= 1) || frames > kMaxFrames) {
    return Fail(place, "{:g} frames of {:g} x {:g} pixels; allowed: at least one frame, up to 64 million pixels",
                frames, width, height);
  }
  // Swap width and height of a film that is shown rotated by 90°.
  facts.width = static_cast<int>(width);
  facts.height = static_cast<int>(height);
  facts.frames = static_cast<int>(frames);
  if (std::lround(std::abs(NumberOf(keys["rotation"]))) % 180 == 90) std::swap(facts.width, facts.height);
  facts.rate_hz = RatioOf(keys["avg_frame_rate"]);
  if (!(facts.rate_hz > 0)) facts.rate_hz = RatioOf(keys["r_frame_rate"]);
  return facts;
}

Result<Decoder> Decoder::Start(const std::filesystem::path& path, const FilmFacts& facts, const std::string& program) {
  ASSIGN_OR_RETURN(Child child, StartReading({program, "-v", "error", "-threads", "1", "-i", "file:" + path.string(),
                                              "-map", "0:v:0", "-vsync", "passthrough", "-f", "rawvideo", "-pix_fmt",
                                              "rgb24", "-sws_flags", "+accurate_rnd+bitexact", "-"},
                                             {.file = path.string()}));
  return Decoder(path, facts, child.pid, std::move(child.output), std::move(child.log));
}

Decoder::Decoder(std::filesystem::path path, FilmFacts facts, pid_t child, File frames, File log)
    : path_(std::move(path)), facts_(facts), child_(child), frames_(std::move(frames)), log_(std::move(log)) {}

Decoder::Decoder(Decoder&& other) noexcept
    : path_(std::move(other.path_)),
      facts_(other.facts_),
      child_(std::exchange(other.child_, -1)),
      frames_(std::move(other.frames_)),
      log_(std::move(other.log_)) {}

Decoder::~Decoder() {
  if (child_ < 0) return;
  kill(child_, SIGKILL);
  CloseAndWait();
}

Result<bool> Decoder::Next(ColourImage& frame) {
  static_assert(sizeof(Rgb8) == 3, "pictures are read in their layout in memory");
  if (frame.width != facts_.width || frame.height != facts_.height) frame = ColourImage(facts_.width, facts_.height);
  if (!frames_) return false;
  const std::size_t count = std::fread(frame.pixels.data(), sizeof(Rgb8), frame.pixels.size(), frames_.get());
  if (count == frame.pixels.size()) return true;
  const int status = CloseAndWait();
  const std::string words = FirstLineOf(log_.get());
  if (count != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return Fail(Place{.file = path_.string()}, "ffmpeg failed before the end of the film{}{}",
                words.empty() ? "" : ": ", words);
  }
  return false;
}

int Decoder::CloseAndWait() {
  frames_.reset();
  return WaitFor(std::exchange(child_, -1));
}

}  // namespace etude
