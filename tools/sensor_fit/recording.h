#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/kinect_text.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The recording of a sensor: places of the twenty joints, absent where it did not see them. Metres, in a space of its
/// own whose Y axis points up.
struct JointRecording {
  double rate_hz = kJudgedRateHz;
  std::vector<RolePositions> frames;
  /// The place of the sensor in that space. A Kinect's own space begins at it; for other files it is not known.
  std::optional<glm::dvec3> sensor_at;

  double DurationSeconds() const { return static_cast<double>(frames.size()) / rate_hz; }
};

/// The rigid body that carries a joint, seen by a system that can be trusted; the joint keeps a constant place in it.
struct Carrier {
  glm::dvec3 position{0};
  glm::dquat rotation{1, 0, 0, 0};
};

/// The motion of a recording as a second system saw it: per frame and joint its carrier, metres.
struct TwinMotion {
  double rate_hz = 60;
  std::vector<std::array<std::optional<Carrier>, kRoleCount>> frames;

  double DurationSeconds() const { return static_cast<double>(frames.size()) / rate_hz; }
};

/// Reads a Kinect v2's text (30 Hz unless `rate_hz` says more) or joint CSV (its own times). Told apart by the first
/// row. Fails naming the file, the line and what is allowed.
Result<JointRecording> ReadJointRecording(std::string_view text, const std::string& file,
                                          std::optional<double> rate_hz);

/// Reads 17 rigid targets or joint CSV, whose joints' carriers are their bones. When neither the file nor `rate_hz`
/// says the rate, it is the usual one (30, 50, 60, 100, 120, 200, 240 Hz) that makes the motion as long as `seconds`
/// most nearly.
Result<TwinMotion> ReadTwinMotion(std::string_view text, const std::string& file, std::optional<double> rate_hz,
                                  double seconds);

/// Returns the frames [begin, end) alone.
JointRecording Excerpt(const JointRecording& recording, std::size_t begin, std::size_t end);

/// Makes a recording of a stream: joints that are not tracked are absent.
JointRecording RecordingOf(const SkeletonStream& stream, const glm::dvec3& sensor_at);

}  // namespace etude
