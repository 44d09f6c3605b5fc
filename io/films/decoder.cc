#include "io/films/decoder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/machine.h"
#include "engine/formats/row_clock.h"
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
    return Fail(place, "the program {} could not be started ({}); install the Debian package ffmpeg", words[0],
                std::strerror(error));
  }
  return child;
}

double NumberOf(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The properties of a film that ffprobe reports.
struct Answer {
  std::map<std::string, std::string> keys;  ///< the first value of each key
  std::vector<double> times_s;              ///< of all packets or frames; NaN for those without a time
  bool is_cut = false;  ///< true if decoders leave out packets: those of an edit list, or before a key frame
};

/// Reads lines "key=value".
Answer ReadAnswer(std::FILE* file) {
  Answer answer;
  bool is_first = true;
  std::array<char, 256> line;
  while (std::fgets(line.data(), line.size(), file) != nullptr) {
    std::string text(line.data());
    text.erase(text.find_last_not_of("\r\n") + 1);
    if (const std::size_t equals = text.find('='); equals != std::string::npos) {
      const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
      if (key == "pts_time") answer.times_s.push_back(value == "N/A" ? std::nan("") : NumberOf(value));
      if (key == "flags") {
        answer.is_cut = answer.is_cut || value.find('D') != std::string::npos || (is_first && value.front() != 'K');
        is_first = false;
      }
      answer.keys.emplace(key, value);
    }
  }
  return answer;
}

/// Reads a ratio such as "60/1"; returns 0 if the text is not a ratio.
double RatioOf(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double low = slash == std::string::npos ? 1 : NumberOf(text.substr(slash + 1));
  return low > 0 ? NumberOf(text.substr(0, slash)) / low : 0;
}

/// Asks ffprobe for these entries of the first video stream.
Result<Answer> Ask(const std::filesystem::path& path, const std::string& program, const Words& entries) {
  const Place place{.file = path.string()};
  Words words = {program, "-v", "error", "-select_streams", "v:0"};
  words.insert(words.end(), entries.begin(), entries.end());
  words.insert(words.end(), {"-of", "default=nw=1", "file:" + path.string()});
  ASSIGN_OR_RETURN(const Child child, StartReading(words, place));
  Answer answer = ReadAnswer(child.output.get());
  if (const int status = WaitFor(child.pid); !WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.keys.empty()) {
    const std::string log = FirstLineOf(child.log.get());
    return Fail(place, "ffmpeg cannot read this file as a film{}{}", log.empty() ? "" : ": ", log);
  }
  return answer;
}

/// Sets the even frames of a film whose pictures have these times, if the times are uneven.
Result<void> LayPictures(std::vector<double> times_s, const Place& place, FilmFacts& facts) {
  const bool has_all = std::ranges::none_of(times_s, [](double time) { return std::isnan(time); });
  if (!has_all || times_s.size() < 3 || std::ssize(times_s) != facts.frames) return {};
  std::ranges::sort(times_s);  // packets are in the order of decoding
  const double start = times_s.front(), step = (times_s.back() - start) / static_cast<double>(facts.frames - 1);
  // Compare the times with an even spacing that is half-way between the earliest and the latest picture.
  double early = 0, late = 0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    times_s[i] -= start;
    const double off = times_s[i] - static_cast<double>(i) * step;
    early = std::min(early, off);
    late = std::max(late, off);
  }
  constexpr double kMaxOff = 0.4;
  if (late - early <= 2 * kMaxOff * step) return {};
  ASSIGN_OR_RETURN(const auto grid, GridOfRows(times_s, {}, std::nullopt, 1, place.file));
  if (!grid) return {};
  facts.rate_hz = grid->rate_hz;
  facts.remark = grid->remark;
  for (const GridFrame& frame : grid->frames) {
    const auto row = static_cast<double>(frame.row), next = static_cast<double>(frame.next);
    facts.pictures.push_back(frame.is_hole ? -1 : row + frame.part * (next - row));
  }
  return {};
}

}  // namespace

int FilmFacts::PictureAt(int frame) const {
  if (pictures.empty()) return frame;
  while (frame > 0 && pictures[static_cast<std::size_t>(frame)] < 0) --frame;
  return static_cast<int>(std::lround(pictures[static_cast<std::size_t>(frame)]));
}

std::vector<int> FilmFacts::FramesOfPictures() const {
  std::vector<int> even(static_cast<std::size_t>(frames), -1);
  for (int frame = 0; frame < EvenFrames(); ++frame) {
    const double at = pictures.empty() ? frame : pictures[static_cast<std::size_t>(frame)];
    const double picture = std::round(at);
    if (at < 0) continue;
    int& taken = even[static_cast<std::size_t>(picture)];
    const bool is_nearer =
        taken < 0 || std::abs(at - picture) < std::abs(pictures[static_cast<std::size_t>(taken)] - picture);
    if (is_nearer) taken = frame;
  }
  return even;
}

Result<FilmFacts> ProbeFilm(const std::filesystem::path& path, const std::string& program) {
  const Place place{.file = path.string()};
  if (std::filesystem::is_directory(path)) return Fail(place, "this is a folder; allowed: the name of a film");
  if (!std::filesystem::is_regular_file(path)) return Fail(place, "no such file");
  // Ask for the size, the rates, the rotation and the packets of the first video stream.
  ASSIGN_OR_RETURN(Answer answer, Ask(path, program,
                                      {"-count_packets", "-show_entries",
                                       "packet=pts_time,flags:stream=width,height,avg_frame_rate,r_frame_rate,"
                                       "nb_read_packets:stream_side_data=rotation"}));
  auto& keys = answer.keys;
  // Check the size before it is converted to integers.
  FilmFacts facts;
  constexpr double kMaxPixels = 64e6;
  const double width = NumberOf(keys["width"]), height = NumberOf(keys["height"]);
  double frames = NumberOf(keys["nb_read_packets"]);
  if (answer.is_cut) {  // only decoding shows which packets become pictures
    ASSIGN_OR_RETURN(Answer decoded, Ask(path, program, {"-show_entries", "frame=pts_time"}));
    answer.times_s = std::move(decoded.times_s);
    frames = static_cast<double>(answer.times_s.size());
  }
  constexpr double kMaxFrames = 1e8;
  if (!(width >= 1) || !(height >= 1) || !(width * height <= kMaxPixels) || !(frames >= 1) || frames > kMaxFrames) {
    return Fail(place,
                "found {:g} frames of {:g} x {:g} pixels; allowed: at least one frame, at most 64 million pixels",
                frames, width, height);
  }
  // Swap width and height of a film that is shown rotated by 90°.
  facts.width = static_cast<int>(width);
  facts.height = static_cast<int>(height);
  facts.frames = static_cast<int>(frames);
  // ffprobe's angle is counter-clockwise.
  facts.turned = static_cast<int>(((-std::lround(NumberOf(keys["rotation"]) / 90)) % 4 + 4) % 4);
  if (facts.turned % 2 != 0) std::swap(facts.width, facts.height);
  facts.rate_hz = RatioOf(keys["avg_frame_rate"]);
  if (!(facts.rate_hz > 0)) facts.rate_hz = RatioOf(keys["r_frame_rate"]);
  RETURN_IF_ERROR(LayPictures(std::move(answer.times_s), place, facts));
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
