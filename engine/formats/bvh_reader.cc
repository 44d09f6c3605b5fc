#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/result.h"
#include "engine/base/text.h"
#include "engine/formats/bvh.h"
#include "engine/formats/row_rates.h"
#include "engine/formats/text_scanner.h"
#include "engine/formats/unique_names.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {
namespace {

/// The property of a joint that one number of a BVH frame sets.
struct BvhChannel {
  int joint = 0;
  bool is_rotation = false;
  int axis = 0;  ///< 0, 1, 2 = X, Y, Z
};

/// The HIERARCHY section of a BVH file.
struct BvhHierarchy {
  Skeleton skeleton;
  std::vector<BvhChannel> channels;  ///< the channels, in the order of their numbers in a frame
};

constexpr int kMaxNesting = 128;
constexpr std::size_t kMaxJoints = 1024;
constexpr std::size_t kMaxNameBytes = 500;
constexpr int kMaxChannels = 6;

constexpr std::array<std::string_view, kMaxChannels> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                                      "Xrotation", "Yrotation", "Zrotation"};

class HierarchyReader {
 public:
  explicit HierarchyReader(TextScanner& scanner) : scanner_(scanner) {}

  Result<BvhHierarchy> Read() {
    RETURN_IF_ERROR(Expect("HIERARCHY"));
    RETURN_IF_ERROR(Expect("ROOT"));
    RETURN_IF_ERROR(ReadJoint(-1, 1));
    const Token after = scanner_.Next();
    if (EqualsIgnoringCase(after.text, "ROOT")) {
      return Fail(scanner_.At(after), "found a second ROOT; allowed: one skeleton per file");
    }
    if (!EqualsIgnoringCase(after.text, "MOTION")) return Unexpected(after, "MOTION after the root's closing '}'");
    if (hierarchy_.channels.empty()) {
      return Fail(scanner_.At(after), "no joint has channels; at least one is needed");
    }
    return std::move(hierarchy_);
  }

 private:
  tl::unexpected<Error> Unexpected(const Token& token, std::string_view allowed) const {
    return Fail(scanner_.At(token), "found {}; expected {}", Quote(token.text), allowed);
  }

  Result<void> Expect(std::string_view word) {
    const Token token = scanner_.Next();
    if (!EqualsIgnoringCase(token.text, word)) return Unexpected(token, word);
    return {};
  }

  /// Reads a joint's name and its block; `parent` is −1 for the root.
  Result<void> ReadJoint(int parent, int depth) {
    // Read the name.
    const Token name = scanner_.NameInLine();
    if (name.text.empty()) return Unexpected(name, "a joint's name");
    if (name.text.size() > kMaxNameBytes) {
      return Fail(scanner_.At(name), "a joint's name has {} bytes; allowed: at most {}", name.text.size(),
                  kMaxNameBytes);
    }
    ASSIGN_OR_RETURN(auto index, AddJoint(std::string(name.text), parent, name, depth));
    RETURN_IF_ERROR(Expect("{"));

    // Read the block's entries up to the closing brace.
    bool has_offset = false;
    bool has_channels = false;
    bool has_children = false;
    for (;;) {
      const Token token = scanner_.Next();
      Result<void> ok;
      if (token.text == "}") {
        if (!has_offset) return Unexpected(token, "OFFSET, which every joint needs");
        return {};
      } else if (EqualsIgnoringCase(token.text, "OFFSET") && !has_offset) {
        has_offset = true;
        ok = ReadOffset(index);
      } else if (EqualsIgnoringCase(token.text, "CHANNELS") && !has_channels && !has_children) {
        has_channels = true;
        ok = ReadChannels(index);
      } else if (EqualsIgnoringCase(token.text, "JOINT")) {
        has_children = true;
        ok = ReadJoint(index, depth + 1);
      } else if (EqualsIgnoringCase(token.text, "End")) {
        has_children = true;
        ok = ReadEndSite(index, token, depth + 1);
      } else {
        return Unexpected(token, "OFFSET or CHANNELS (each once, before any child), JOINT, End Site or '}'");
      }
      if (!ok) return ok;
    }
  }

  Result<void> ReadEndSite(int parent, const Token& start, int depth) {
    RETURN_IF_ERROR(Expect("Site"));
    scanner_.NameInLine();  // some exporters name the site; the name is ignored
    ASSIGN_OR_RETURN(auto index, AddJoint(hierarchy_.skeleton.joints[parent].name + "_End", parent, start, depth));
    hierarchy_.skeleton.joints[index].is_end_site = true;
    RETURN_IF_ERROR(Expect("{"));
    RETURN_IF_ERROR(Expect("OFFSET"));
    RETURN_IF_ERROR(ReadOffset(index));
    return Expect("}");
  }

  Result<int> AddJoint(const std::string& name, int parent, const Token& place, int depth) {
    auto& joints = hierarchy_.skeleton.joints;
    if (depth > kMaxNesting) {
      return Fail(scanner_.At(place), "joints nested more than {} levels deep", kMaxNesting);
    }
    if (joints.size() >= kMaxJoints) {
      return Fail(scanner_.At(place), "more than {} joints and end sites", kMaxJoints);
    }
    joints.push_back({.name = names_.Add(name), .parent = parent, .rest = {}});
    return static_cast<int>(joints.size()) - 1;
  }

  Result<void> ReadOffset(int joint) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSIGN_OR_RETURN(auto value, scanner_.Number(scanner_.Next(), "one of the three numbers of an OFFSET"));
      hierarchy_.skeleton.joints[joint].rest.translation[axis] = value;
    }
    return {};
  }

  Result<void> ReadChannels(int joint) {
    const Token count_token = scanner_.Next();
    ASSIGN_OR_RETURN(auto count, scanner_.Number(count_token, "the number of channels"));
    if (count < 0 || count > kMaxChannels || count != static_cast<int>(count)) {
      return Fail(scanner_.At(count_token), "found {} channels; allowed: a whole number from 0 to {}",
                  Quote(count_token.text), kMaxChannels);
    }
    std::array<bool, kMaxChannels> seen{};
    for (int i = 0; i < count; ++i) {
      const Token token = scanner_.Next();
      const auto known = std::ranges::find_if(
          kChannelNames, [&](std::string_view name) { return EqualsIgnoringCase(name, token.text); });
      if (known == kChannelNames.end()) {
        return Unexpected(token, fmt::format("{} channels out of {}", count, fmt::join(kChannelNames, ", ")));
      }
      const int kind = static_cast<int>(known - kChannelNames.begin());
      if (seen[kind]) return Fail(scanner_.At(token), "channel {} appears twice in one joint", *known);
      seen[kind] = true;
      hierarchy_.channels.push_back({.joint = joint, .is_rotation = kind >= 3, .axis = kind % 3});
    }
    return {};
  }

  TextScanner& scanner_;
  BvhHierarchy hierarchy_;
  UniqueNames names_;
};

/// Reads from the start of the file up to the word MOTION, inclusive.
Result<BvhHierarchy> ReadBvhHierarchy(TextScanner& scanner) { return HierarchyReader(scanner).Read(); }

constexpr double kMinFrameSeconds = 1e-4;
constexpr double kMaxFrameSeconds = 10;
constexpr double kMaxFrameBytes = 1e9;

struct MotionHeader {
  int frame_count = 0;
  double rate_hz = 0;
  std::string rough_time = "";  ///< a remark about a frame time with few digits; "" for others
  Token frames_place;  ///< position of the number of frames, for error messages
};

/// Returns the rate for a frame time, rounded to a nearby whole number, because files print few digits.
double RateOf(double frame_seconds) {
  constexpr double kPrintedPrecision = 1e-4;
  const double rate = 1.0 / frame_seconds;
  const double whole = std::round(rate);
  return std::abs(rate - whole) < kPrintedPrecision * whole ? whole : rate;
}

/// Returns a remark if the frame time is printed with so few digits that a usual rate has the same digits, rounded or
/// cut off, and the file's duration at that rate differs by at least half a frame; otherwise "". A frame time of a
/// usual rate itself gets no remark (0.04 is 25 Hz, although 1/24 s rounds to it).
std::string DescribeRoughTime(const Token& printed, double seconds, double frames) {
  const std::size_t point = printed.text.find('.');
  if (point == std::string_view::npos || printed.text.find_first_of("eE") != std::string_view::npos) return "";
  const double rate = RateOf(seconds);
  double digit = 1;  // the value of 1 in the last place
  // Zeros at the end do not count as digits, because "%f" prints 0.033 as 0.033000, unless the rate is whole: 0.008000
  // is 125 Hz.
  const bool is_whole = std::abs(rate - std::round(rate)) < 1e-6 * rate;
  const std::size_t end = is_whole ? printed.text.size() : printed.text.find_last_not_of('0') + 1;
  for (std::size_t i = point + 1; i < end; ++i) digit /= 10;
  double likely = 0;
  for (const double whole : kUsualRates_hz) {
    for (const double usual : {whole, whole * kTelevision}) {
      constexpr double kSameRate = 1e-4;
      if (std::abs(rate / usual - 1) < kSameRate) return "";
      const double more = 1 / usual - seconds;
      const bool is_nearer = likely == 0 || std::abs(more) < std::abs(1 / likely - seconds);
      if (more >= -digit / 2 && more < digit && (usual == whole ? is_nearer : likely == 0)) likely = usual;
    }
  }
  const double longer_s = likely == 0 ? 0 : frames * (1 / likely - seconds);
  if (std::abs(longer_s) * likely < 0.5) return "";
  return fmt::format(
      "the Frame Time {} has few digits. Etude reads it as {:.6g} Hz, but it may be 1 / {:.6g} s, rounded. At {:.6g} "
      "Hz the {:g} frames would last {:.2g} s {}. Use `--rate {:.6g}` (for `etude clip convert`: `--file-rate`) to set "
      "this rate",
      printed.text, rate, likely, likely, frames, std::abs(longer_s), longer_s > 0 ? "longer" : "shorter", likely);
}

Result<void> ExpectWords(TextScanner& scanner, std::initializer_list<std::string_view> words) {
  for (std::string_view word : words) {
    const Token token = scanner.Next();
    if (!EqualsIgnoringCase(token.text, word)) {
      return Fail(scanner.At(token), "found {}; expected {}, as in \"Frames: <count>\" and \"Frame Time: <seconds>\"",
                  Quote(token.text), Quote(word));
    }
  }
  return {};
}

Result<MotionHeader> ReadMotionHeader(TextScanner& scanner, std::size_t joints) {
  RETURN_IF_ERROR(ExpectWords(scanner, {"Frames", ":"}));
  const Token count_token = scanner.Next();
  ASSIGN_OR_RETURN(auto count, scanner.Number(count_token, "the number of frames"));
  if (count < 1 || count != std::floor(count)) {
    return Fail(scanner.At(count_token), "found {} frames; allowed: a whole number of 1 or more",
                Quote(count_token.text));
  }
  // Check the announced size before any frame is stored, so that a false size cannot exhaust the memory.
  const double bytes = count * static_cast<double>(joints * sizeof(LocalTransform));
  if (bytes > kMaxFrameBytes) {
    return Fail(scanner.At(count_token), "{} frames of {} joints take {:.0f} MB; allowed: at most {:.0f} MB",
                count_token.text, joints, bytes / 1e6, kMaxFrameBytes / 1e6);
  }

  RETURN_IF_ERROR(ExpectWords(scanner, {"Frame", "Time", ":"}));
  const Token time_token = scanner.Next();
  ASSIGN_OR_RETURN(auto seconds, scanner.Number(time_token, "the frame time"));
  if (seconds < kMinFrameSeconds || seconds > kMaxFrameSeconds) {
    return Fail(scanner.At(time_token), "found a frame time of {} s; allowed: {:g} to {:g} s", time_token.text,
                kMinFrameSeconds, kMaxFrameSeconds);
  }
  if (const Token extra = scanner.NextInLine(); !extra.text.empty()) {
    return Fail(scanner.At(extra), "found {} after the frame time; expected the first frame on a line of its own",
                Quote(extra.text));
  }
  return MotionHeader{static_cast<int>(count), RateOf(seconds), DescribeRoughTime(time_token, seconds, count),
                      count_token};
}

/// Multiplies `rotation` from the right by a rotation about the axis `kAxis` (0 = x, 1 = y, 2 = z). Products with zero
/// are left out. The axis is a template parameter so that the four numbers stay in registers; most of the reading time
/// is spent here.
template <int kAxis>
void Turn(glm::dquat& rotation, double degrees) {
  constexpr int kNext = (kAxis + 1) % 3, kLast = (kAxis + 2) % 3;
  const double half = 0.5 * Radians(degrees);
  const double c = std::cos(half), s = std::sin(half);
  const glm::dquat old = rotation;
  rotation.w = c * old.w - s * old[kAxis];
  rotation[kAxis] = c * old[kAxis] + s * old.w;
  rotation[kNext] = c * old[kNext] + s * old[kLast];
  rotation[kLast] = c * old[kLast] - s * old[kNext];
}

void Apply(const BvhChannel& channel, double value, LocalTransform& local) {
  if (!channel.is_rotation) {
    local.translation[channel.axis] = value;
  } else if (channel.axis == 0) {
    Turn<0>(local.rotation, value);
  } else if (channel.axis == 1) {
    Turn<1>(local.rotation, value);
  } else {
    Turn<2>(local.rotation, value);
  }
}

/// Reads one line of numbers. `pose` is initially the rest pose.
Result<void> ReadFrame(TextScanner& scanner, const std::vector<BvhChannel>& channels, std::size_t number,
                       LocalPose& pose) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (const std::optional<double> value = scanner.TakeNumberInLine()) {
      Apply(channels[i], *value, pose[channels[i].joint]);
      continue;
    }
    // This word is a number with a leading plus, which TakeNumberInLine does not accept, or no valid number.
    const Token token = scanner.NextInLine();
    if (token.text.empty()) {
      return Fail(scanner.At(token), "frame {} has {} numbers; allowed: {}, one for each channel", number, i,
                  channels.size());
    }
    ASSIGN_OR_RETURN(auto value, scanner.Number(token, "a channel's value"));
    Apply(channels[i], value, pose[channels[i].joint]);
  }
  if (const Token extra = scanner.NextInLine(); !extra.text.empty()) {
    return Fail(scanner.At(extra), "frame {} has {} after its {} numbers; allowed: one number for each channel", number,
                Quote(extra.text), channels.size());
  }
  return {};
}

/// Returns true if the position channels of joints below the root are relative to the OFFSETs. Absolute positions
/// stay near the OFFSET; relative positions stay near 0. The criterion: for most joints with three position channels
/// and an OFFSET other than 0, the median length of the position over the frames is below a fifth of the OFFSET's
/// length.
bool AreRelativeToOffsets(const Skeleton& skeleton, const std::vector<BvhChannel>& channels,
                          const std::vector<LocalPose>& frames) {
  constexpr double kNear = 0.2;
  constexpr std::size_t kSamples = 100;
  std::vector<int> positions(skeleton.joints.size());
  for (const BvhChannel& channel : channels) positions[channel.joint] += channel.is_rotation ? 0 : 1;
  int joints = 0, relative = 0;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const double offset = glm::length(skeleton.joints[i].rest.translation);
    if (skeleton.joints[i].parent < 0 || positions[i] < 3 || offset == 0) continue;
    std::vector<double> lengths;
    for (std::size_t f = 0; f < frames.size(); f += 1 + frames.size() / kSamples) {
      lengths.push_back(glm::length(frames[f][i].translation));
    }
    ++joints;
    relative += LowerPercentile(std::move(lengths), 0.5) < kNear * offset ? 1 : 0;
  }
  return 2 * relative > joints;
}

/// Adds the OFFSETs to the positions of joints below the root.
void AddOffsets(const std::vector<BvhChannel>& channels, Clip& clip) {
  for (const auto& [joint, is_rotation, axis] : channels) {
    if (is_rotation || clip.skeleton.joints[joint].parent < 0) continue;
    const double offset = clip.skeleton.joints[joint].rest.translation[axis];
    for (LocalPose& frame : clip.frames) frame[joint].translation[axis] += offset;
  }
}

/// Returns the largest rotation of a joint relative to its parent, degrees, in at most a hundred evenly spaced frames.
double LargestRotation(const std::vector<LocalPose>& frames) {
  constexpr std::size_t kSamples = 100;
  double sine = 0;  // sine of half the largest rotation so far
  for (std::size_t f = 0; f < frames.size(); f += 1 + frames.size() / kSamples) {
    for (const LocalTransform& local : frames[f]) {
      sine = std::max(sine, glm::length(glm::dvec3(local.rotation.x, local.rotation.y, local.rotation.z)));
    }
  }
  return 2 * Degrees(std::asin(std::min(sine, 1.0)));
}

/// For joints below the root with an offset of 0, takes the positions of the first frame as rest positions. Returns
/// true if this changes a rest position.
bool TakeOffsetsFromFrame(const LocalPose& frame, Skeleton& skeleton) {
  bool takes = false;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    LocalTransform& rest = skeleton.joints[i].rest;
    if (skeleton.joints[i].parent < 0 || rest.translation != glm::dvec3(0)) continue;
    rest.translation = frame[i].translation;
    takes |= rest.translation != glm::dvec3(0);
  }
  return takes;
}

}  // namespace

Result<Clip> ReadBvh(std::string_view bytes, const std::string& file, std::vector<std::string>* remarks,
                     std::optional<double> told_hz) {
  const auto remark = [&](std::string text) {
    if (remarks != nullptr) remarks->push_back(std::move(text));
  };
  // Read the hierarchy and the header.
  TextScanner scanner(bytes, file);
  ASSIGN_OR_RETURN(auto hierarchy, ReadBvhHierarchy(scanner));
  ASSIGN_OR_RETURN(auto header, ReadMotionHeader(scanner, hierarchy.skeleton.joints.size()));

  // Read the frames; one more than announced is allowed.
  Clip clip;
  clip.name = std::filesystem::path(file).stem().string();
  clip.skeleton = std::move(hierarchy.skeleton);
  clip.rate_hz = told_hz.value_or(header.rate_hz);
  if (!told_hz && !header.rough_time.empty()) remark(header.rough_time);
  const LocalPose rest = RestPose(clip.skeleton);
  const auto announced = static_cast<std::size_t>(header.frame_count);
  while (scanner.SkipToText()) {
    if (clip.frames.size() > announced) {
      return Fail(scanner.At(scanner.Next()), "found more rows than the {} frames that line {} states", announced,
                  header.frames_place.line);
    }
    clip.frames.push_back(rest);
    if (auto read = ReadFrame(scanner, hierarchy.channels, clip.frames.size(), clip.frames.back()); !read) {
      const bool ends = !scanner.SkipToText() && clip.frames.size() < announced;
      if (ends) read.error().message += fmt::format("; the file ends in frame {} of {}", clip.frames.size(), announced);
      return tl::unexpected(read.error());
    }
  }
  // Exporters that announce the number of their last frame write one frame more; drop it, as other readers do.
  if (clip.frames.size() == announced + 1) {
    clip.frames.pop_back();
    remark(fmt::format("found {} rows, but the file states {} frames, so the last row is left out", announced + 1,
                       announced));
  }
  if (clip.frames.size() != announced) {
    return Fail(scanner.At(header.frames_place), "the file states {} frames, but contains {}", announced,
                clip.frames.size());
  }
  if (AreRelativeToOffsets(clip.skeleton, hierarchy.channels, clip.frames)) {
    AddOffsets(hierarchy.channels, clip);
    remark("the position channels are relative to the OFFSETs, so Etude added the OFFSETs");
  }
  // If all angles are small numbers, they may be radians that were read as degrees.
  constexpr double kMaxRadians = 6.2832, kMoves = 1.2;
  if (const double largest = LargestRotation(clip.frames); largest > kMoves && largest < kMaxRadians) {
    remark(
        fmt::format("no joint rotates by more than {:.2g} degrees; if the file's angles are radians, convert them to "
                    "degrees, as BVH requires",
                    largest));
  }
  // A joint with positions and an OFFSET of 0 rests at its position in the first frame. This is usual for our own
  // bodies, so they get no remark.
  const bool is_body = std::ranges::none_of(clip.skeleton.joints, [](const Joint& j) { return !FindRole(j.name); });
  if (TakeOffsetsFromFrame(clip.frames.front(), clip.skeleton) && !is_body)
    remark("joints with position channels and an OFFSET of 0 get their rest positions from the first frame");
  return clip;
}

}  // namespace etude
