#include "engine/formats/trc.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace etude {
namespace {

std::vector<std::string> SplitAtTabs(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == '\t') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Two frames in which joint i is at (i, i + 0.25, −i) metres, the second one higher by 1 mm.
BodyMotion Steps() {
  BodyMotion motion;
  for (int frame = 0; frame < 2; ++frame) {
    BodyPose& pose = motion.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double x = static_cast<double>(i);
      pose.joints[i] = {x, x + 0.25 + 0.001 * frame, -x};
    }
  }
  return motion;
}

// The layout that OpenSim reads: three lines about the file, two of headings, one empty, then frames.
TEST(Trc, HasTheHeadingsAndColumnsThatOpenSimWants) {
  std::istringstream text(WriteTrc(Steps(), "steps"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 6u + 2u);
  EXPECT_EQ(lines[0], "PathFileType\t4\t(X/Y/Z)\tsteps.trc");
  EXPECT_EQ(lines[1],
            "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames");
  EXPECT_EQ(lines[2], "30\t30\t2\t20\tmm\t30\t1\t2");
  EXPECT_EQ(lines[5], "");
  const auto names = SplitAtTabs(lines[3]), axes = SplitAtTabs(lines[4]), second = SplitAtTabs(lines[7]);
  ASSERT_EQ(second.size(), 2 + 3 * kRoleCount);
  ASSERT_EQ(axes.size(), second.size());
  EXPECT_EQ(names[0], "Frame#");
  EXPECT_EQ(names[1], "Time");
  EXPECT_EQ(second[0], "2");
  EXPECT_EQ(second[1], "0.033333");
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const double x = static_cast<double>(i);
    EXPECT_EQ(names[2 + 3 * i], RoleName(AllRoles()[i]));
    EXPECT_EQ(axes[2 + 3 * i], "X" + std::to_string(i + 1));
    EXPECT_EQ(std::stod(second[2 + 3 * i]), 1000 * x);
    EXPECT_EQ(std::stod(second[3 + 3 * i]), 1000 * x + 251);
    EXPECT_EQ(std::stod(second[4 + 3 * i]), -1000 * x);
  }
}

TEST(Trc, KeepsItsFirstLineWhateverTheName) {
  EXPECT_TRUE(
      WriteTrc(Steps(), "a\nb\tc \xC3\xA9").starts_with("PathFileType\t4\t(X/Y/Z)\ta_b_c \xC3\xA9.trc\nDataRate"));
}

}  // namespace
}  // namespace etude
