#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "tools/sensor_fit/recording.h"

namespace etude {

/// The alignment of a recording with its twin, which is the optical recording of the same motion. The alignment
/// accounts for the differences between recording and twin that are not errors of the sensor, as far as one recording
/// can separate the two.
struct TwinAlignment {
  /// The twin's time at the recording's time 0: the difference of the clocks plus the sensor's lag.
  double shift_s = 0;
  glm::dmat3 R_ST{1};  ///< rotates the twin's directions into the sensor's frame
  glm::dvec3 p_ST{0};  ///< the twin's origin in the sensor's frame
  /// The position of each joint in the coordinate frame of the rigid body that carries the joint (`Carrier`); absent if
  /// no frame of the recording shows both.
  std::array<std::optional<glm::dvec3>, kRoleCount> offsets{};
  double rms_m = 0;  ///< RMS residual over all joints, metres

  /// Returns the position of the carried joint in the sensor's frame; nullopt if the joint has no carrier or no offset.
  std::optional<glm::dvec3> JointAt(const std::optional<Carrier>& carrier, Role role) const;
};

/// The alignment of a recording, and the twin's joints at the recording's frames.
struct TwinMatch {
  TwinAlignment alignment;
  std::vector<RolePositions> truth;  ///< positions, one entry per frame of the recording, in the sensor's frame
};

/// Finds time shift, rotation, translation and offsets by least squares over all joints. The shift is first found by
/// correlating the joints' speeds in the recording and in the twin, and then refined to a tenth of a frame. For each
/// shift, rigid motion and offsets are fitted alternately until they converge. Returns nullopt if the overlap is
/// shorter than a second or has fewer than three joints.
std::optional<TwinMatch> AlignTwin(const JointRecording& recording, const TwinMotion& twin);

/// Returns the RMS residual that other shifts leave, metres: the median over shifts at least a second from the shift of
/// `match`, at which at least half of the shorter recording overlaps. Another motion than the twin's fits at the best
/// shift hardly better than at these. Returns nullopt if there are fewer than three such shifts.
std::optional<double> ChanceRms(const JointRecording& recording, const TwinMotion& twin, const TwinMatch& match);

/// Aligns a recording that differs little from an aligned one: starts from `start`, and searches only shifts within
/// `max_shift_s` of the shift in `start`.
std::optional<TwinMatch> RealignTwin(const JointRecording& recording, const TwinMotion& twin,
                                     const TwinAlignment& start, double max_shift_s);

}  // namespace etude
