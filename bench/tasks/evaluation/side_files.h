#pragma once

#include <glm/glm.hpp>
#include <map>
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

}  // namespace etude
