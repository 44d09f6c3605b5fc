#include "engine/formats/joint_csv.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace etude {
namespace {

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

TEST(JointCsv, GivesEveryNumberBackToTheLastBit) {
  BodyMotion motion;
  motion.poses.resize(2);
  for (std::size_t i = 0; i < kRoleCount; ++i) motion.poses[1].joints[i] = glm::dvec3(1.0 / 3, -0.1, 1e-9) * (i + 1.0);
  std::istringstream text(WriteJointCsv(motion));
  std::string headings, first, second;
  std::getline(text, headings);
  std::getline(text, first);
  std::getline(text, second);
  const auto names = Split(headings), values = Split(second);
  ASSERT_EQ(names.size(), 2 + 3 * kRoleCount);
  ASSERT_EQ(values.size(), names.size());
  EXPECT_EQ(names[0] + "," + names[1] + "," + names[2], "frame,time_s,hip_centre_x_m");
  EXPECT_EQ(names.back(), "right_foot_z_m");
  EXPECT_EQ(values[0], "1");
  EXPECT_EQ(std::stod(values[1]), 1 / 30.0);
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(std::stod(values[2 + 3 * i + axis]), motion.poses[1].joints[i][axis]);
  }
}

}  // namespace
}  // namespace etude
