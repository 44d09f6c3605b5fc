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

/// The recording of a sensor: positions of the twenty joints in metres, absent where the sensor did not see them.
/// Positions are in the recording's own coordinate frame, in which Y points up.
struct JointRecording {
  double rate_hz = kJudgedRateHz;
  std::vector<RolePositions> frames;
  /// The position of the sensor in the recording's coordinate frame: the origin for a Kinect, unknown for other files.
  std::optional<glm::dvec3> sensor_at;
  std::string remark = "";  ///< a message for the user about the file's times; "" if there is none
  /// By how much each frame was taken later than `frame / rate_hz`, seconds; empty: by nothing.
  std::vector<double> late_s = {};

  double DurationSeconds() const { return static_cast<double>(frames.size()) / rate_hz; }
  double TimeOf(std::size_t frame) const {
    return static_cast<double>(frame) / rate_hz + (late_s.empty() ? 0 : late_s[frame]);
  }
};

/// The rigid body that carries a joint (for example an optical target), measured by a second capture system
/// (TwinMotion). The joint's position in the frame of this rigid body is constant.
struct Carrier {
  glm::dvec3 position{0};
  glm::dquat rotation{1, 0, 0, 0};
};

/// The motion of a recording, measured by a second capture system: the carrier of each joint in each frame, metres.
struct TwinMotion {
  double rate_hz = 60;
  std::vector<std::array<std::optional<Carrier>, kRoleCount>> frames;
  std::string remark = "";  ///< a message for the user about the file's times; "" if there is none

  double DurationSeconds() const { return static_cast<double>(frames.size()) / rate_hz; }
};

/// Reads a Kinect v2's text (30 Hz unless `rate_hz` is given) or a joint CSV. The first row decides the format. The
/// rows of a CSV are placed on evenly spaced frames by their times (GridOfRows), without interpolation, which would
/// average their noise away; JointRecording::late_s keeps their own times. In a frame whose row is missing, no joint is
/// seen. `rate_hz` replaces the rate of the times. A failure states the file, the line and what is allowed; so
/// do bones of a length that no person has, because then the positions are not in metres.
Result<JointRecording> ReadJointRecording(std::string_view text, const std::string& file,
                                          std::optional<double> rate_hz);

/// Reads a file of 17 rigid targets, or a joint CSV (as ReadJointRecording does). For a joint CSV, the trunk is the
/// rigid body of the trunk's joints; for every other joint, the bone from the parent joint is the rigid body. The rate
/// is `rate_hz` if it is given, otherwise the rate of the file's times. If the file has no times, the rate is chosen
/// among 30, 50, 60, 100, 120, 200 and 240 Hz, so that the duration is closest to `seconds`.
Result<TwinMotion> ReadTwinMotion(std::string_view text, const std::string& file, std::optional<double> rate_hz,
                                  double seconds);

/// Returns only the frames [begin, end).
JointRecording Excerpt(const JointRecording& recording, std::size_t begin, std::size_t end);

/// Makes a recording from a stream; joints that are not tracked are absent.
JointRecording RecordingOf(const SkeletonStream& stream, const glm::dvec3& sensor_at);

}  // namespace etude
