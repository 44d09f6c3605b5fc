#include "engine/bridging/in_between.h"

#include "engine/bridging/library.h"

namespace etude {

InBetweenNet BuildInBetweens(std::span<const BodyMotion> /*motions*/, std::span<const TaggedClip> /*tagged*/) {
  return {};
}

bool TakeInBetween(const MotionLibrary& /*library*/, const SwitchRequest& /*request*/, FrameWindow /*window*/,
                   const SwitchRules& /*rules*/, SwitchRecord& /*record*/) {
  return false;
}

}  // namespace etude
