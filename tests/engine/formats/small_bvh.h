#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace etude::testing {

/// Two joints and an end site, two frames: small enough to know every line and column.
inline constexpr std::string_view kSmallBvh = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 0 10 0
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 5 0 0
    }
  }
}
MOTION
Frames: 2
Frame Time: .0083333
1 2 3 90 0 0 0 0 0
1 2 3 0 0 0 90 0 0
)";

/// `text` with the first `from` replaced; fails the test when there is none.
inline std::string Replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const std::size_t at = result.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' in the text";
  if (at != std::string::npos) result.replace(at, from.size(), to);
  return result;
}

}  // namespace etude::testing
