#pragma once

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The mean and the standard deviation of a joint's coordinates over a training set, metres.
struct JointStatistics {
  glm::dvec3 mean{0}, deviation{1};
};
using StatisticsByJoint = std::map<std::string, JointStatistics, std::less<>>;

/// Reads the statistics by which L2P is standardised: a heading with `JOINT_x_m,JOINT_y_m,JOINT_z_m` for each joint, a
/// row of means, and a row of standard deviations, which must be positive. Fails on any other text, naming the line.
Result<StatisticsByJoint> ReadJointStatistics(std::string_view text, const std::string& file);

/// Reads the beats of a piece of music: one time per line, in seconds from the truth's first frame, increasing. Fails
/// on any other text, naming the line.
Result<std::vector<double>> ReadMusicBeats(std::string_view text, const std::string& file);

/// Returns a doubt on beats that are probably not in seconds: their median distance is more than 3 s (20 beats per
/// minute) and the last one is after the motion's end, but in frames of the motion, frames of librosa or milliseconds,
/// they are 0.25 to 1.5 s apart. The doubt names the unit in which the last beat is nearest to the motion's end. "" if
/// there is none.
std::string DoubtOnBeats(std::span<const double> beats_s, double motion_s, double rate_hz);

}  // namespace etude
