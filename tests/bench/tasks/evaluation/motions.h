#pragma once

#include <cmath>
#include <string>

#include "bench/model/row.h"
#include "engine/motion/raw_motion.h"
#include "sim/choreography/canonical_body.h"

namespace etude {

/// Returns the standing body, which glides along Z at 0.3 m/s.
inline RawMotion Gliding(double rate_hz, std::size_t frames) {
  RawMotion motion;
  motion.name = "gliding";
  motion.rate_hz = rate_hz;
  for (const Role role : AllRoles()) {
    motion.roles[Index(role)] = static_cast<int>(motion.joints.size());
    motion.joints.emplace_back(RoleName(role));
  }
  const BodyPose pose = StandingPose();
  for (std::size_t f = 0; f < frames; ++f) {
    const glm::dvec3 moved(0, 0, 0.3 * static_cast<double>(f) / rate_hz);
    for (const glm::dvec3& joint : pose.joints) motion.positions.push_back(joint + moved);
  }
  return motion;
}

/// Returns a metric's value; −1 if it has none, −2 if it was not measured.
inline double ValueIn(const CellResult& result, const std::string& id) {
  for (const MetricValue& metric : result.metrics) {
    if (metric.id == id) return metric.value.value_or(-1);
  }
  return -2;
}

/// Returns the standing body with limbs that sway, each at its own frequency, delayed by `late_s`.
inline RawMotion Swaying(double rate_hz, std::size_t frames, double late_s) {
  RawMotion motion = Gliding(rate_hz, frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate_hz - late_s;
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
      const double phase = static_cast<double>(j);
      motion.positions[f * motion.joints.size() + j] =
          StandingPose().joints[j] +
          glm::dvec3(0.1 * std::sin(5 * t + phase), 0.05 * std::cos(7 * t + phase), 0.08 * std::sin(3 * t + 2 * phase));
    }
  }
  return motion;
}

}  // namespace etude
