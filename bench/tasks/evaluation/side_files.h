#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A joint's coordinates over a training set, metres.
struct JointStatistics {
  glm::dvec3 mean{0}, deviation{1};
};
using StatisticsByJoint = std::map<std::string, JointStatistics, std::less<>>;

/// Reads what L2P is standardised by: a heading with `JOINT_x_m,JOINT_y_m,JOINT_z_m` of each joint, a row of means, and
/// a row of standard deviations, which are positive. Fails with the line for anything else.
Result<StatisticsByJoint> ReadJointStatistics(std::string_view text, const std::string& file);

/// Reads the beats of a piece of music: one time a line, seconds from the truth's first frame, increasing. Fails with
/// the line for anything else.
Result<std::vector<double>> ReadMusicBeats(std::string_view text, const std::string& file);

}  // namespace etude
