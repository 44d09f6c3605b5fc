#pragma once

#include <gtest/gtest.h>

#include <string>

#include "io/clips/open_clip.h"
#include "tools/clips/clip_film.h"

namespace etude {

inline constexpr const char* kRealClip = "/usr/share/assimp/models/BVH/01_03.bvh";

inline OpenedClip Opened(const std::string& reference) {
  auto clips = ReadClips(reference);
  EXPECT_TRUE(clips) << reference;
  auto opened = UnderstandClip(std::move(clips->front()), {});
  EXPECT_TRUE(opened) << ToString(opened.error());
  return *opened;
}

inline ClipActor ActorOf(const std::string& reference, ActorKind kind) {
  auto actor = ClipActor::Make(Opened(reference), kind);
  EXPECT_TRUE(actor) << reference;
  return *actor;
}

}  // namespace etude
