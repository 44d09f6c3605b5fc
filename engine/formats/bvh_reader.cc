#include <cmath>
#include <initializer_list>
#include <optional>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/formats/bvh.h"
#include "engine/formats/bvh_hierarchy.h"
#include "engine/formats/text_scanner.h"

namespace etude {
namespace {

constexpr double kShortestFrameSeconds = 1e-4;
constexpr double kLongestFrameSeconds = 10;
constexpr double kMostFrameBytes = 1e9;

struct MotionHeader {
  int frame_count = 0;
  double rate_hz = 0;
  Token frames_place;  ///< where the number of frames stands
};

/// Files print a frame time with few digits; the rate meant is a whole number nearly always.
double RateOf(double frame_seconds) {
  constexpr double kPrintedPrecision = 1e-4;
  const double rate = 1.0 / frame_seconds;
  const double whole = std::round(rate);
  return std::abs(rate - whole) < kPrintedPrecision * whole ? whole : rate;
}

Result<void> ExpectWords(TextScanner& scanner, std::initializer_list<std::string_view> words) {
  for (std::string_view word : words) {
    const Token token = scanner.Next();
    if (!SameWord(token.text, word)) {
      return Fail(scanner.At(token), "found {}; expected {} of \"Frames: <count>\" and \"Frame Time: <seconds>\"",
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
    return Fail(scanner.At(count_token), "found {} frames; allowed: a whole number from 1", Quote(count_token.text));
  }
  // Before any frame is stored: the announced size, not the file's, is what memory would be taken for.
  const double bytes = count * static_cast<double>(joints * sizeof(LocalTransform));
  if (bytes > kMostFrameBytes) {
    return Fail(scanner.At(count_token), "{} frames of {} joints take {:.0f} MB; allowed: {:.0f} MB", count_token.text,
                joints, bytes / 1e6, kMostFrameBytes / 1e6);
  }

  RETURN_IF_ERROR(ExpectWords(scanner, {"Frame", "Time", ":"}));
  const Token time_token = scanner.Next();
  ASSIGN_OR_RETURN(auto seconds, scanner.Number(time_token, "the frame time"));
  if (seconds < kShortestFrameSeconds || seconds > kLongestFrameSeconds) {
    return Fail(scanner.At(time_token), "found a frame time of {} s; allowed: {:g} to {:g} s", time_token.text,
                kShortestFrameSeconds, kLongestFrameSeconds);
  }
  if (const Token extra = scanner.NextInLine(); !extra.text.empty()) {
    return Fail(scanner.At(extra), "found {} after the frame time; expected the first frame on a line of its own",
                Quote(extra.text));
  }
  return MotionHeader{static_cast<int>(count), RateOf(seconds), count_token};
}

/// Turns a rotation about one of its own axes: the product of quaternions without all that is multiplied by zero. The
/// axis is known to the compiler so that the four numbers stay in registers; reading spends most of its time here.
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

/// One line of numbers. `pose` comes in at rest.
Result<void> ReadFrame(TextScanner& scanner, const std::vector<BvhChannel>& channels, std::size_t number,
                       LocalPose& pose) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (const std::optional<double> value = scanner.TakeNumberInLine()) {
      Apply(channels[i], *value, pose[channels[i].joint]);
      continue;
    }
    // Rarely taken: a number written in another way, or a complaint.
    const Token token = scanner.NextInLine();
    if (token.text.empty()) {
      return Fail(scanner.At(token), "frame {} has {} numbers; its {} channels need {}", number, i, channels.size(),
                  channels.size());
    }
    ASSIGN_OR_RETURN(auto value, scanner.Number(token, "a channel's value"));
    Apply(channels[i], value, pose[channels[i].joint]);
  }
  if (const Token extra = scanner.NextInLine(); !extra.text.empty()) {
    return Fail(scanner.At(extra), "frame {} goes on with {} after its {} numbers, one for each channel", number,
                Quote(extra.text), channels.size());
  }
  return {};
}

std::string NameWithoutFolderAndExtension(std::string_view file) {
  const std::string_view base = file.substr(file.find_last_of('/') + 1);
  return std::string(base.substr(0, base.find_last_of('.')));
}

}  // namespace

Result<Clip> ReadBvh(std::string_view bytes, const std::string& file) {
  TextScanner scanner(bytes, file);
  ASSIGN_OR_RETURN(auto hierarchy, ReadBvhHierarchy(scanner));
  ASSIGN_OR_RETURN(auto header, ReadMotionHeader(scanner, hierarchy.skeleton.joints.size()));

  Clip clip;
  clip.name = NameWithoutFolderAndExtension(file);
  clip.skeleton = std::move(hierarchy.skeleton);
  clip.rate_hz = header.rate_hz;
  const LocalPose rest = RestPose(clip.skeleton);
  const auto announced = static_cast<std::size_t>(header.frame_count);
  while (scanner.SkipToText()) {
    if (clip.frames.size() > announced) {
      return Fail(scanner.At(scanner.Next()), "more lines than the {} frames announced on line {}", announced,
                  header.frames_place.line);
    }
    clip.frames.push_back(rest);
    RETURN_IF_ERROR(ReadFrame(scanner, hierarchy.channels, clip.frames.size(), clip.frames.back()));
  }
  // Exporters that announce their last frame's number write one frame more: read like everybody does.
  if (clip.frames.size() == announced + 1) clip.frames.pop_back();
  if (clip.frames.size() != announced) {
    return Fail(scanner.At(header.frames_place), "{} frames announced; the file holds {}", announced,
                clip.frames.size());
  }
  return clip;
}

}  // namespace etude
