#include "engine/motion/sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etude {

LocalPose SampleClip(const Clip& clip, double seconds) {
  assert(!clip.frames.empty());
  const double last = static_cast<double>(clip.frames.size() - 1);
  const double at = std::clamp(seconds * clip.rate_hz, 0.0, last);
  const auto index = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(index);
  LocalPose pose = clip.frames[index];
  if (part == 0) return pose;
  const LocalPose& next = clip.frames[index + 1];
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i].translation = glm::mix(pose[i].translation, next[i].translation, part);
    pose[i].rotation = glm::slerp(pose[i].rotation, next[i].rotation, part);
  }
  return pose;
}

}  // namespace etude
