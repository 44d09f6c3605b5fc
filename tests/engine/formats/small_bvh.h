#pragma once

#include <string_view>

namespace etude::testing {

/// A file with two joints, an end site and two frames, so small that tests know every line and column.
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

}  // namespace etude::testing
