#include "engine/formats/deepmimic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/formats/json_text.h"

namespace etude {
namespace {

using Json = nlohmann::json;

enum class Rotation { kFixed, kAboutZ, kFree };

struct HumanoidJoint {
  const char* name;
  int parent;
  // Offset from the parent, metres, in the parent's axes; a standing body faces +X, and its right side is at +Z.
  glm::dvec3 offset;
  Rotation rotation;
  bool is_end_site = false;
};

// The joints are in the order of the numbers in a frame; end sites follow. Head and toes are not joints in the file;
// they are the centre of the head's sphere and the middle of the foot's front edge.
const std::array<HumanoidJoint, 18> kHumanoid = {{
    {"root", -1, {0, 0, 0}, Rotation::kFree},
    {"chest", 0, {0, 0.236151, 0}, Rotation::kFree},
    {"neck", 1, {0, 0.223894, 0}, Rotation::kFree},
    {"right_hip", 0, {0, 0, 0.084887}, Rotation::kFree},
    {"right_knee", 3, {0, -0.421546, 0}, Rotation::kAboutZ},
    {"right_ankle", 4, {0, -0.409870, 0}, Rotation::kFree},
    {"right_shoulder", 1, {-0.02405, 0.24350, 0.18311}, Rotation::kFree},
    {"right_elbow", 6, {0, -0.274788, 0}, Rotation::kAboutZ},
    {"right_wrist", 7, {0, -0.258947, 0}, Rotation::kFixed},
    {"left_hip", 0, {0, 0, -0.084887}, Rotation::kFree},
    {"left_knee", 9, {0, -0.421546, 0}, Rotation::kAboutZ},
    {"left_ankle", 10, {0, -0.409870, 0}, Rotation::kFree},
    {"left_shoulder", 1, {-0.02405, 0.24350, -0.18311}, Rotation::kFree},
    {"left_elbow", 12, {0, -0.274788, 0}, Rotation::kAboutZ},
    {"left_wrist", 13, {0, -0.258947, 0}, Rotation::kFixed},
    {"head", 2, {0, 0.175, 0}, Rotation::kFixed, true},
    {"right_toe", 5, {0.1335, -0.05, 0}, Rotation::kFixed, true},
    {"left_toe", 11, {0.1335, -0.05, 0}, Rotation::kFixed, true},
}};

constexpr std::size_t kNumbers = 44;
constexpr std::size_t kMaxTextBytes = 64u << 20;

Skeleton HumanoidSkeleton() {
  Skeleton skeleton;
  for (const HumanoidJoint& joint : kHumanoid) {
    skeleton.joints.push_back({.name = joint.name,
                               .parent = joint.parent,
                               .rest = {.translation = joint.offset},
                               .is_end_site = joint.is_end_site});
  }
  return skeleton;
}

using Numbers = std::array<double, kNumbers>;

Result<Numbers> ReadNumbers(const Json& frame, std::size_t index, const std::string& file) {
  constexpr double kMaxNumber = 1e9;
  const Place place{file, 0, 0};
  if (!frame.is_array() || frame.size() != kNumbers) {
    return Fail(place, "Frames[{}] has {} numbers; allowed: {}, the number for DeepMimic's character humanoid3d", index,
                frame.is_array() ? frame.size() : 0, kNumbers);
  }
  Numbers numbers{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const bool is_good = frame[i].is_number() && std::abs(frame[i].get<double>()) <= kMaxNumber;
    if (!is_good) {
      return Fail(place, "Frames[{}][{}]: {}; allowed: numbers within ±10⁹", index, i,
                  frame[i].dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40));
    }
    numbers[i] = frame[i].get<double>();
  }
  return numbers;
}

/// Makes a pose from a frame's numbers; returns nullopt if a quaternion has length 0.
std::optional<LocalPose> PoseOf(const Numbers& numbers) {
  LocalPose pose;
  std::size_t next = 1;  // index 0 is the duration
  const glm::dvec3 root(numbers[1], numbers[2], numbers[3]);
  next += 3;
  for (const HumanoidJoint& joint : kHumanoid) {
    LocalTransform local{.translation = joint.parent < 0 ? root : joint.offset};
    if (joint.rotation == Rotation::kAboutZ) {
      const double half = numbers[next++] / 2;
      local.rotation = {std::cos(half), 0, 0, std::sin(half)};
    } else if (joint.rotation == Rotation::kFree) {
      const glm::dquat turn(numbers[next], numbers[next + 1], numbers[next + 2], numbers[next + 3]);
      constexpr double kMinLength = 1e-6;
      if (glm::length(turn) < kMinLength) return std::nullopt;
      local.rotation = glm::normalize(turn);
      next += 4;
    }
    pose.push_back(local);
  }
  return pose;
}

Result<Clip> ReadFrames(const Json& frames, const std::string& file) {
  const Place place{file, 0, 0};
  Clip clip{.name = "humanoid3d", .skeleton = HumanoidSkeleton(), .frames = {}};
  double duration = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSIGN_OR_RETURN(const Numbers numbers, ReadNumbers(frames[i], i, file));
    constexpr double kMinDuration_s = 1e-4, kMaxDuration_s = 1, kRounding = 1e-3;
    if (i == 0) {
      duration = numbers[0];
      if (duration < kMinDuration_s || duration > kMaxDuration_s) {
        return Fail(place, "Frames[0][0]: the frame lasts {} s; allowed: {} to {} s", duration, kMinDuration_s,
                    kMaxDuration_s);
      }
    } else if (i + 1 < frames.size() && std::abs(numbers[0] - duration) > kRounding * duration) {
      return Fail(place, "Frames[{}][0]: the frame lasts {} s; allowed: {} s, the duration of the first frame", i,
                  numbers[0], duration);
    }
    auto pose = PoseOf(numbers);
    if (!pose) return Fail(place, "Frames[{}]: a quaternion of length 0", i);
    clip.frames.push_back(*std::move(pose));
  }
  clip.rate_hz = 1 / duration;
  return clip;
}

}  // namespace

bool IsDeepMimicMotion(std::string_view text) {
  constexpr std::size_t kFirstKeys = 512;
  return text.substr(0, kFirstKeys).find("\"Frames\"") != std::string_view::npos;
}

Result<Clip> ReadDeepMimicMotion(std::string_view text, const std::string& file) {
  if (text.size() > kMaxTextBytes) {
    return Fail({file, 0, 0}, "found {} MiB; allowed: at most {} MiB", text.size() >> 20, kMaxTextBytes >> 20);
  }
  ASSIGN_OR_RETURN(const Json motion, ParseJsonText(text, file));
  const auto frames = motion.find("Frames");
  if (frames == motion.end() || !frames->is_array() || frames->empty()) {
    return Fail({file, 0, 0}, "found no frames; allowed: a list of frames in \"Frames\"");
  }
  return ReadFrames(*frames, file);
}

}  // namespace etude
