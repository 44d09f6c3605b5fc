#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "tools/sensor_fit/recording.h"

namespace etude {

/// The alignment of a recording and its twin: what is not the sensor's error, as far as one recording tells.
struct TwinAlignment {
  double shift_s = 0;  ///< the recording's time 0 is this time of the twin: clocks, and the sensor's lag
  glm::dmat3 R_ST{1};  ///< rotates the twin's directions into the sensor's space
  glm::dvec3 p_ST{0};  ///< the twin's origin there
  /// The offset of each joint in its carrier; no value where the two never saw it together.
  std::array<std::optional<glm::dvec3>, kRoleCount> offsets{};
  double rms_m = 0;  ///< what is left, over all joints

  /// Returns where the carried joint is in the sensor's space.
  std::optional<glm::dvec3> JointAt(const std::optional<Carrier>& carrier, Role role) const;
};

/// The twin at the frames of a recording.
struct TwinMatch {
  TwinAlignment alignment;
  std::vector<RolePositions> truth;  ///< as many frames as the recording; in the sensor's space
};

/// Finds time shift, rotation, translation and offsets together, in the sense of least squares over all joints: shifts
/// by the correlation of both systems' speeds first, then to a tenth of a frame; the rest by turns until it settles.
/// Nothing when the two overlap in less than a second, or in less than three joints.
std::optional<TwinMatch> AlignTwin(const JointRecording& recording, const TwinMotion& twin);

/// Aligns a recording that differs little from one aligned before: starts from that alignment and looks for shifts
/// within `most_shift_s` of it only.
std::optional<TwinMatch> RealignTwin(const JointRecording& recording, const TwinMotion& twin,
                                     const TwinAlignment& start, double most_shift_s);

}  // namespace etude
