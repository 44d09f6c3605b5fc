#include "engine/motion/sample.h"

#include <algorithm>
#include <cassert>

namespace etude {

LocalTransform Between(const LocalTransform& from, const LocalTransform& to, double part) {
  return {.translation = glm::mix(from.translation, to.translation, part),
          .rotation = glm::slerp(from.rotation, to.rotation, part),
          .scale = glm::mix(from.scale, to.scale, part)};
}

LocalPose SampleFrame(const Clip& clip, double frame) {
  assert(!clip.frames.empty());
  const double last = static_cast<double>(clip.frames.size() - 1);
  const double at = std::clamp(frame, 0.0, last);
  const auto index = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(index);
  LocalPose pose = clip.frames[index];
  if (part == 0) return pose;
  const LocalPose& next = clip.frames[index + 1];
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = Between(pose[i], next[i], part);
  return pose;
}

}  // namespace etude
