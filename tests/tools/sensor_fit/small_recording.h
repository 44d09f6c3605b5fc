#pragma once

#include <glm/gtc/quaternion.hpp>

#include "tests/sim/performer/all_moves.h"
#include "tools/sensor_fit/fit.h"

namespace etude {

/// The pose of a sensor's space in an optical system's space, for invented recordings.
struct MadeUp {
  glm::dquat rotation = glm::normalize(glm::dquat(0.3, 0.5, -0.7, 0.2));
  glm::dvec3 translation{0.4, -0.3, 2.9};
  double shift_s = 0.35;  ///< time of the twin at the recording's time 0
};

/// Returns a dance recorded by an optical system at 60 Hz; each joint's carrier rotates with time in its own way.
inline TwinMotion DancingTwin(double seconds, double tempo = 1,
                              const std::vector<std::string>& moves = {"boxing", "side_kick", "clap"}) {
  const BodyMotion motion = AfterEachOther(moves);
  TwinMotion twin{.rate_hz = 60, .frames = {}};
  for (double t = 0; t < seconds; t += 1.0 / 60) {
    const double frame = std::fmod(tempo * t * motion.rate_hz, static_cast<double>(motion.poses.size() - 1));
    const auto before = static_cast<std::size_t>(frame);
    auto& carriers = twin.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3 place = glm::mix(motion.poses[before].joints[j], motion.poses[before + 1].joints[j],
                                        frame - static_cast<double>(before));
      const double angle = 0.8 * std::sin(t + static_cast<double>(j));
      carriers[j] = Carrier{place, glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 2, static_cast<double>(j) - 9)))};
    }
  }
  return twin;
}

/// Returns the position of each joint in its carrier's frame.
inline glm::dvec3 OffsetOf(std::size_t joint) {
  const auto j = static_cast<double>(joint);
  return {0.02 * std::sin(j), 0.03 * std::cos(2 * j), 0.01 * std::sin(3 * j)};
}

/// Returns the recording of a perfect sensor at 30 Hz, in its own space.
inline JointRecording PerfectRecording(const TwinMotion& twin, double seconds, const MadeUp& made) {
  JointRecording recording{.rate_hz = 30, .frames = {}, .sensor_at = glm::dvec3(0)};
  for (double t = 0; t < seconds; t += 1.0 / 30) {
    const auto frame = static_cast<std::size_t>(std::lround((t + made.shift_s) * twin.rate_hz));
    RolePositions& places = recording.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const Carrier& carrier = *twin.frames[frame][j];
      places[j] = made.rotation * (carrier.position + carrier.rotation * OffsetOf(j)) + made.translation;
    }
  }
  return recording;
}

}  // namespace etude
